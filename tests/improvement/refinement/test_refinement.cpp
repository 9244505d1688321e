#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "improvement/contacts/block_separations.h"
#include "improvement/refinement/magnitude_problem.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/improvement/refinement.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/solids.h"
#include "support/still_designs.h"
#include "support/variants.h"

using namespace stackabilization;
using cups::Cups;
using cups::scale;

namespace {

constexpr double limit = 0.7;  // of the scale of the bottom, in spaces that refuse more

/// The reason of the edit in row k of a start.
EditReason reason(int k) {
  return {EditEffect::narrower, false, k};
}

/// Cups of eight segments whose bottoms may have a least radius.
class BoundedCups : public Cups {
 public:
  explicit BoundedCups(double min_bottom = 0) : Cups(8), min_bottom_(min_bottom) {}

  DeformationResult edited(const Design& now, const Edit& edit,
                           const DeformationConstraints& constraints) const override {
    const DeformationResult outcome = Cups::edited(now, edit, constraints);
    if (!outcome.refusal && cups::radii(outcome.design)[0] < min_bottom_)
      return {Refusal{.cause = RefusalCause::collapsed_radius, .part = 0, .index = 0}, now};
    return outcome;
  }

  Candidate candidate(const RequirementChecker& checker, const std::vector<Edit>& edits) const {
    Candidate result;
    result.design = deformed(edits, {}).design;
    result.measured = checker.measure(result.design.shape, Direction(0, 0, 1));
    for (std::size_t k = 0; k < edits.size(); ++k) result.reasons.push_back(reason(static_cast<int>(k)));
    return result;
  }

 private:
  double min_bottom_;
};

Requirements stacks(double target) {
  Requirements requirements = designs::frame_requirements(target);
  requirements.min_size_ratio = 0;
  return requirements;
}

double radius(const RefinementResult& result, int section) {
  return cups::radii(result.candidate.design)[section];
}

double volume_change(double bottom, double top) {
  return (bottom * bottom + bottom * top + top * top) / 3 - 1;
}

RefinementOptions of_distortion() {
  RefinementOptions options;
  options.objective = ChangeMeasure::distortion;
  return options;
}

RefinementOptions without_joining() {
  RefinementOptions options = of_distortion();
  options.max_added_edits = 0;
  return options;
}

void check_met(const RefinementResult& result, double target) {
  CHECK(result.reached);
  CHECK(result.candidate.measured.value >= target);
  CHECK(result.candidate.measured.value <= target + 1e-7);
}

}  // namespace

TEST_CASE("the shape at rest is refined to itself where no edit can be added") {
  const designs::Still space(designs::cup(), DeformationKind::surface);
  for (const double target : {0.2, 0.9}) {
    const RequirementChecker checker(space, stacks(target));
    Candidate rest;
    rest.design = space.at_rest();
    rest.measured = checker.measure(rest.design.shape, Direction(0, 0, 1));
    const RefinementResult result = refine_candidate(checker, rest, {});
    CHECK(result.reached == (rest.measured.value >= target));
    CHECK(result.candidate.design.shape.vertices == rest.design.shape.vertices);
    CHECK(result.candidate.design.edits.empty());
  }
}

TEST_CASE("a magnitude multiplies moves and angles, and is an exponent of factors") {
  const Edit move{{HandleKind::part, 0, 0}, Move{{1, -2, 3}}};
  CHECK(std::get<Move>(with_magnitude(move, 1).operation).by == Eigen::Vector3d(1, -2, 3));
  CHECK(std::get<Move>(with_magnitude(move, -0.5).operation).by == Eigen::Vector3d(-0.5, 1, -1.5));
  CHECK(std::get<Move>(with_magnitude(move, 0).operation).by == Eigen::Vector3d::Zero());
  const Edit turn{{HandleKind::part, 0, 0}, Rotate{{0, 1, 0}, 0.3}};
  CHECK(std::get<Rotate>(with_magnitude(turn, 2).operation).radians == 0.6);
  CHECK(std::get<Rotate>(with_magnitude(turn, 2).operation).axis == Eigen::Vector3d::UnitY());
  CHECK(std::get<Scale>(with_magnitude(scale(0, 0.9), 2).operation).factor == Approx(0.81).epsilon(1e-15));
  CHECK(std::get<Scale>(with_magnitude(scale(0, 0.9), -1).operation).factor ==
        Approx(1 / 0.9).epsilon(1e-15));
  CHECK(std::get<Scale>(with_magnitude(scale(0, 0.9), 1).operation).factor == 0.9);
  CHECK(std::get<Scale>(with_magnitude(scale(0, 0.9), 0).operation).factor == 1);
  CHECK(with_magnitude(scale(0, 0.9), 2).falloff == Falloff::linear);
  const Edit taper{{HandleKind::shape, 0, 0}, Taper{0.9, {0, 0, 1}, {}}};
  CHECK(std::get<Taper>(with_magnitude(taper, 2).operation).factor == Approx(0.81).epsilon(1e-15));
  CHECK(std::get<Taper>(with_magnitude(taper, 1).operation).factor == 0.9);
  const Edit lean{{HandleKind::part, 0, 0}, Lean{{1, -2, 0}, {0, 0, 3}}};
  CHECK(std::get<Lean>(with_magnitude(lean, -0.5).operation).by == Eigen::Vector3d(-0.5, 1, 0));
  CHECK(std::get<Lean>(with_magnitude(lean, -0.5).operation).axis == Eigen::Vector3d(0, 0, 3));
}

TEST_CASE("edits that do the same thing become one, those that change nothing vanish") {
  const Handle part{HandleKind::part, 1, 0}, other{HandleKind::part, 2, 0};
  const std::vector<Edit> edits = {{part, Move{{1, 0, 0}}},
                                   {other, Move{{0, 1, 0}}},
                                   {part, Scale{0.5, {}}},
                                   {part, Move{{2, 0, 0}}},
                                   {part, Move{{0, 0, 1}}},
                                   {other, Move{{0, -1, 0}}},
                                   {part, Scale{3, {}}},
                                   {part, Scale{3, Eigen::Vector3d(0, 0, 1)}},
                                   {part, Rotate{{0, 0, 1}, 0.25}},
                                   {part, Rotate{{0, 0, -2}, 1}},
                                   {part, Scale{1, {}}}};
  const std::vector<Edit> result = merge_edits(edits);
  REQUIRE(result.size() == 5);
  CHECK(std::get<Move>(result[0].operation).by == Eigen::Vector3d(3, 0, 0));
  CHECK(std::get<Scale>(result[1].operation).factor == 1.5);
  CHECK_FALSE(std::get<Scale>(result[1].operation).along);
  CHECK(std::get<Move>(result[2].operation).by == Eigen::Vector3d(0, 0, 1));
  CHECK(std::get<Scale>(result[3].operation).factor == 3);
  CHECK(std::get<Scale>(result[3].operation).along);
  CHECK(std::get<Rotate>(result[4].operation).radians == -0.75);
  for (const Edit& edit : result) CHECK(edit.handle == part);

  Edit linear = scale(0, 0.5), gaussian = linear;
  gaussian.falloff = Falloff::gaussian;
  CHECK(merge_edits({linear, gaussian}).size() == 2);
  CHECK(merge_edits({linear, scale(1, 0.5)}).size() == 2);
  CHECK(merge_edits({scale(0, 0.5), scale(0, 2)}).empty());
}

TEST_CASE("leanings of one part towards one end along one line become one") {
  const Handle part{HandleKind::part, 1, 0};
  const auto lean = [&](const Eigen::Vector3d& by, const Eigen::Vector3d& axis) {
    return Edit{part, Lean{by, axis}};
  };
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<Edit> merged = merge_edits({lean(x, z), lean(2 * x, 3 * z), lean(-0.5 * x, z)});
  REQUIRE(merged.size() == 1);
  CHECK(std::get<Lean>(merged[0].operation).by == 2.5 * x);
  CHECK(std::get<Lean>(merged[0].operation).axis == z);
  CHECK(merge_edits({lean(x, z), lean(y, z)}).size() == 2);
  CHECK(merge_edits({lean(x, z), lean(x, -z)}).size() == 2);  // the other end moves
  CHECK(merge_edits({lean(x, z), lean(-x, z)}).empty());
  CHECK(merge_edits({lean(0 * x, z)}).empty());
}

TEST_CASE("f_max is the maximum over pairs of blocks") {
  const Direction direction(0.1, -0.2, 1);
  for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Shape rest = solids::triangle_soup({seed, 120, 0.3, 3});
      const detail::BlockSeparations blocks(rest, direction, semantics);
      for (const Shape& shape : {rest, transformed(rest, solids::random_rotation(seed), {0, 0, 0})}) {
        const double f_max = minimal_stacking_translation(shape, direction, {semantics, std::nullopt}).length;
        const std::vector<detail::BlockPair> pairs = blocks.pairs_above(shape, f_max / 2);
        REQUIRE(pairs.size() > 1);
        const std::vector<detail::BlockSeparation> asked = blocks.separations(shape, pairs);
        CHECK(asked.front().f == Approx(f_max).epsilon(1e-11));
        CHECK(asked.back().f >= f_max / 2);
        for (std::size_t p = 1; p < asked.size(); ++p) CHECK(asked[p].f <= asked[p - 1].f);
        CHECK(blocks.pairs_above(shape, f_max / 4).size() > pairs.size());
      }
    }
}

TEST_CASE("blocks that pass each other are told from those that meet") {
  const Shape apart = concatenate(solids::box({0, 0, 0}, {1, 1, 1}), solids::box({5, 0, 2}, {6, 1, 4}));
  Shape met = apart;
  for (Eigen::Index v = 8; v < met.vertex_count(); ++v) met.vertices(v, 0) -= 4.5;
  const detail::BlockSeparations blocks(apart, Direction(0, 0, 2), ContactSemantics::solid);
  CHECK(blocks.separations(apart, blocks.pairs_above(apart, 1.5)).front().f == Approx(2));
  const std::vector<detail::BlockPair> pairs = blocks.pairs_above(met, 3.5);
  REQUIRE(pairs.size() == 1);
  CHECK(blocks.separations(met, pairs).front().blocked);
  CHECK(blocks.separations(met, pairs).front().f == Approx(4));
  CHECK_FALSE(blocks.separations(apart, pairs).front().blocked);
  CHECK(blocks.separations(apart, pairs).front().f <= 4);
}

TEST_CASE("the signed changes add up to the distortion") {
  const BoundedCups cups;
  for (const BoxModel boxes : {BoxModel::frame, BoxModel::oriented}) {
    const EnergyMeter meter(cups.rest(), boxes);
    for (const double factor : {0.6, 1.0, 1.4}) {
      const Design design = cups.deformed({scale(0, 0.8), scale(1, factor)}, {}).design;
      const DistortionChanges changes = meter.changes(design);
      CHECK(changes.distortion().total() == meter.distortion(design).total());
      CHECK(changes.volume[0] == Approx(volume_change(0.8, factor)).epsilon(1e-12));
      CHECK(meter.distortion(design).volume == Approx(std::abs(volume_change(0.8, factor))).epsilon(1e-12));
      // The box is as wide as the larger end: its sign says whether it grew. The least box of eight corners
      // lies along their edges.
      const double width = boxes == BoxModel::frame ? 2 : 2 * std::cos(std::numbers::pi / 8);
      const double wider = 2 * width * (std::max(0.8, factor) - 1);
      CHECK(changes.box.sum() == Approx(wider / (2 * width + Cups::height)).margin(1e-12));
    }
  }
}

TEST_CASE("slopes tell what a small step changes, the displacement to second order") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.6));
  detail::MagnitudeProblem problem(checker, {scale(0, 0.7), scale(1, 1.2)}, Direction(0, 0, 1),
                                   {1000, 3, ChangeMeasure::both, {}});
  const detail::Magnitudes x{1, 0.5};
  const detail::MagnitudeSample base = problem.at(x);
  const detail::MagnitudeSlopes slopes = problem.slopes(x);
  REQUIRE(slopes.made == std::vector<bool>{true, true});
  CHECK(base.displacement > 0.01);
  CHECK(base.change == Approx(base.displacement + base.changes.cwiseAbs().sum()));
  const auto wrong = [&](double length) {
    double largest = 0;
    for (const Eigen::Vector2d& y : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0.6, -0.8)}) {
      const detail::MagnitudeSample there = problem.at({x[0] + length * y[0], x[1] + length * y[1]});
      const Eigen::Vector3d from(1, length * y[0], length * y[1]);
      CHECK(std::abs(there.displacement - base.displacement) > 0.005 * length);
      largest =
          std::max({largest, std::abs(std::sqrt(from.dot(slopes.gram * from)) - there.displacement),
                    (base.changes + slopes.changes * from.tail(2) - there.changes).cwiseAbs().maxCoeff()});
    }
    return largest;
  };
  CHECK(wrong(0.1) < 0.01);
  CHECK(wrong(0.01) < wrong(0.1) / 50);
}

TEST_CASE("the least taper of a cup has a closed form") {
  const BoundedCups cups;
  for (const double target : {0.75, 0.8, 0.85}) {
    const RequirementChecker checker(cups, stacks(target));
    const double bottom = 1 - Cups::wall / (1 - target);
    // Too much, just so, too little.
    for (const double start : {bottom - 0.1, bottom, std::sqrt(bottom)}) {
      const RefinementResult result =
          refine_candidate(checker, cups.candidate(checker, {scale(0, start)}), without_joining());
      check_met(result, target);
      CHECK(radius(result, 0) == Approx(bottom).epsilon(1e-6));
      CHECK(radius(result, 1) == 1);
      CHECK(result.candidate.energy.distortion.total() ==
            Approx(-volume_change(bottom, 1) / 4).epsilon(1e-6));
      CHECK(result.evaluations <= 60);
      REQUIRE(result.candidate.design.edits.size() == 1);
      CHECK(result.candidate.reasons == std::vector<EditReason>{reason(0)});
    }
  }
}

TEST_CASE("of two edits those magnitudes are found that keep the volume, where D has its kink") {
  // S asks for b <= t / 2. Then 4 D = |7/12 t^2 - 1| + (t - 1) / 2 is least where the volume is kept.
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const double top = std::sqrt(12.0 / 7);
  for (const auto& [b, t] : {std::pair(0.4, 1.1), std::pair(0.5, 1.2), std::pair(0.8, 1.25)}) {
    const RefinementResult result =
        refine_candidate(checker, cups.candidate(checker, {scale(0, b), scale(1, t)}), of_distortion());
    check_met(result, 0.8);
    CHECK(result.candidate.energy.distortion.total() == Approx((top - 1) / 8).epsilon(1e-3));
    CHECK(radius(result, 1) == Approx(top).epsilon(1e-3));
    CHECK(radius(result, 0) == Approx(top / 2).epsilon(1e-3));
  }
}

TEST_CASE("what one end takes away the other may give back") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const Candidate start = cups.candidate(checker, {scale(0, 0.5)});
  const RefinementResult result = refine_candidate(checker, start, of_distortion());
  check_met(result, 0.8);
  CHECK(radius(result, 1) == Approx(std::sqrt(12.0 / 7)).epsilon(1e-3));
  REQUIRE(result.candidate.design.edits.size() == 2);
  CHECK(result.candidate.design.edits[1].handle == Handle{HandleKind::section, 0, 1});
  REQUIRE(result.candidate.reasons.size() == 2);
  CHECK(result.candidate.reasons[0] == reason(0));
  CHECK(result.candidate.reasons[1] == EditReason{EditEffect::compensation});
}

TEST_CASE("the displacement is least where no other cup that stacks as well is nearer") {
  // On the border S = 0.8 lies b = t / 2: one number is left, and can be looked through.
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const Candidate start = cups.candidate(checker, {scale(0, 0.4), scale(1, 1.1)});
  for (const ChangeMeasure least : {ChangeMeasure::displacement, ChangeMeasure::both}) {
    RefinementOptions options;
    options.objective = least;
    const RefinementResult result = refine_candidate(checker, start, options);
    check_met(result, 0.8);
    double nearest = 1;
    for (int step = 0; step <= 400; ++step) {
      const double top = 1 + 0.001 * step;
      const Candidate other = cups.candidate(checker, {scale(0, top / 2), scale(1, top)});
      const Distortion distortion = EnergyMeter(cups.rest(), BoxModel::frame).distortion(other.design);
      nearest =
          std::min(nearest, size_of(least, distortion, shape_change(cups.rest().shape, other.design.shape)));
    }
    const double found = size_of(least, result.candidate, cups.rest().shape);
    CHECK(found <= nearest * (1 + 1e-4));
    CHECK(found >= nearest * (1 - 1e-3));
  }
}

TEST_CASE("a room is filled to the end, though boxes change with the design") {
  const BoundedCups space;
  const Direction aslant(0.2, 0, 1);
  Requirements asked = stacks(0);
  asked.keep_height = false;
  const Stackability rest = stackability(space.rest().shape, aslant, asked.measure);
  asked.length_limit = StackLengthLimit{6, rest.extent + 5 * 0.6 * rest.f_max};
  const RequirementChecker checker(space, asked);
  Candidate start = space.candidate(checker, {scale(1, 1.5)});
  start.direction = aslant.vector();
  start.measured = checker.measure(start.design.shape, aslant);
  const RefinementResult result = refine_candidate(checker, start, without_joining());
  REQUIRE(result.reached);
  const Stackability measured = checker.check(result.candidate.design, aslant).measured;
  const double length = measured.extent + 5 * measured.f_max;
  CHECK(length <= asked.length_limit->length);
  CHECK(length == Approx(asked.length_limit->length).epsilon(1e-5));
  // S alone would have said something else.
  const double share = measured.stack_box_volume() / measured.box_volume;
  CHECK(std::abs(share - rest.stack_box_volume() / rest.box_volume) > 0.01);
}

TEST_CASE("an edit that is of no use is left out, its counterpart merged") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const Candidate start =
      cups.candidate(checker, {scale(0, 0.5), scale(1, 1.25), scale(0, 0.8), scale(1, 0.8)});
  const RefinementResult result = refine_candidate(checker, start, without_joining());
  check_met(result, 0.8);
  REQUIRE(result.candidate.design.edits.size() == 1);
  CHECK(radius(result, 0) == Approx(0.5).epsilon(1e-6));
}

TEST_CASE("edits that hardly matter leave together, even when the time is up") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  RefinementOptions options = without_joining();
  options.cancelled = [] { return true; };
  std::vector<Edit> edits{scale(0, 0.4), scale(1, 0.99999), scale(1, 0.99998)};
  edits.back().falloff = Falloff::gaussian;
  const RefinementResult result = refine_candidate(checker, cups.candidate(checker, edits), options);
  CHECK(result.reached);
  REQUIRE(result.candidate.design.edits.size() == 1);
  CHECK(result.candidate.design.edits.front().handle.index == 0);
}

TEST_CASE("proportions are kept") {
  // The kink lies at b = 0.65: b stays at what it may, and t = 2 b.
  const BoundedCups cups;
  Requirements requirements = stacks(0.8);
  requirements.min_size_ratio = limit;
  const RequirementChecker checker(cups, requirements);
  const RefinementResult result =
      refine_candidate(checker, cups.candidate(checker, {scale(0, 0.65), scale(1, 1.35)}), of_distortion());
  check_met(result, 0.8);
  CHECK(radius(result, 0) == Approx(limit).epsilon(1e-4));
  CHECK(radius(result, 0) >= limit);
  CHECK(radius(result, 1) == Approx(2 * limit).epsilon(1e-4));
}

TEST_CASE("where edits are refused the best of the others is found") {
  // The kink lies at b = 0.65, which is refused: b stays at its limit, and t = 2 b.
  const BoundedCups cups(limit);
  const RequirementChecker checker(cups, stacks(0.8));
  const RefinementResult result =
      refine_candidate(checker, cups.candidate(checker, {scale(0, 0.75), scale(1, 1.6)}), of_distortion());
  check_met(result, 0.8);
  CHECK(radius(result, 0) >= limit);
  const double least = (std::abs(volume_change(limit, 2 * limit)) + (2 * limit - 1) / 2) / 4;
  CHECK(result.candidate.energy.distortion.total() == Approx(least).epsilon(0.01));
}

TEST_CASE("a target out of reach gives the largest S, and says so") {
  const BoundedCups cups(limit);
  const RequirementChecker checker(cups, stacks(0.8));
  const RefinementResult result =
      refine_candidate(checker, cups.candidate(checker, {scale(0, 0.8)}), without_joining());
  CHECK_FALSE(result.reached);
  CHECK(radius(result, 0) >= limit);
  CHECK(result.candidate.measured.value == Approx(1 - Cups::wall / (1 - limit)).epsilon(0.01));
}

TEST_CASE("edits that are added reach a target that those given do not") {
  const BoundedCups cups(limit);
  const double target = 0.72;  // the bottom alone reaches 1 - wall / (1 - limit) = 2 / 3
  const RequirementChecker checker(cups, stacks(target));
  const Candidate start = cups.candidate(checker, {scale(0, 0.8)});
  RefinementOptions options = of_distortion();
  CHECK_FALSE(refine_candidate(checker, start, options).reached);
  options.reach_with_added = true;
  const RefinementResult result = refine_candidate(checker, start, options);
  check_met(result, target);
  CHECK(radius(result, 0) >= limit);
  CHECK(radius(result, 1) > 1);
  options.max_added_edits = 0;
  CHECK_FALSE(refine_candidate(checker, start, options).reached);
}

TEST_CASE("the result is never worse than what was given") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.6));
  for (const auto& [b, t] : {std::pair(0.75, 1.0), std::pair(0.7, 0.94), std::pair(0.9, 1.3)}) {
    const Candidate start = cups.candidate(checker, {scale(0, b), scale(1, t)});
    RefinementOptions few;
    few.evaluations = 10;
    const RefinementResult result = refine_candidate(checker, start, few);
    const EnergyMeter meter(cups.rest(), BoxModel::frame);
    CHECK(result.evaluations <= 20);
    if (start.measured.value >= 0.6) {
      CHECK(result.reached);
      CHECK(result.candidate.energy.distortion.total() <= meter.distortion(start.design).total());
    }
  }
}

TEST_CASE("a refinement that is cancelled at once gives back what it was given, judged") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  RefinementOptions options;
  options.cancelled = [] { return true; };
  const Candidate start = cups.candidate(checker, {scale(0, 0.4), scale(1, 1.1)});
  const RefinementResult result = refine_candidate(checker, start, options);
  CHECK(result.reached);
  CHECK(result.evaluations <= 10);
  const RefinementResult nothing = refine_candidate(checker, cups.candidate(checker, {}), of_distortion());
  CHECK_FALSE(nothing.reached);
  CHECK(nothing.evaluations == 0);
}

TEST_CASE("the same bytes for any number of threads") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const Candidate start = cups.candidate(checker, {scale(0, 0.8), scale(1, 1.1)});
  std::vector<RefinementResult> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(refine_candidate(checker, start, of_distortion()));
  }
  CHECK(results[0].evaluations == results[1].evaluations);
  CHECK(results[0].candidate.design.shape.vertices == results[1].candidate.design.shape.vertices);
  CHECK(results[0].candidate.energy.value == results[1].candidate.energy.value);
}

TEST_CASE("options out of range are refused") {
  const BoundedCups cups;
  const RequirementChecker checker(cups, stacks(0.8));
  const Candidate start = cups.candidate(checker, {scale(0, 0.8)});
  RefinementOptions options;
  options.evaluations = 9;
  CHECK_THROWS_AS(refine_candidate(checker, start, options), UsageError);
  options = {};
  options.magnitude_bound = 0;
  CHECK_THROWS_AS(refine_candidate(checker, start, options), UsageError);
  options = {};
  options.alpha = 2;
  CHECK_THROWS_AS(refine_candidate(checker, start, options), UsageError);
}
