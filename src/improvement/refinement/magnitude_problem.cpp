#include "improvement/refinement/magnitude_problem.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

#include "improvement/requirements/size_ratios.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/refinement.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization::detail {

namespace {

/// A pair of blocks is near if its separation is within this fraction of the extent of f_max, or of the f_max
/// that the target allows. At most max_pairs pairs are used.
constexpr double near_band = 0.1;
constexpr std::size_t max_pairs = 80;

/// Violation reported for the whole shape where pairs of blocks represent it.
constexpr double no_shortfall = -1;

/// A pair that passes at any height is satisfied by at least this much. When a pair moves apart, its
/// separation first falls to that of its lowest and highest points and then vanishes.
constexpr double passing_surplus = 0.02;

/// Returns whether the deformation model leaves the check open; it guarantees extent, relations and box by
/// itself.
bool is_open(const Check& check) {
  return check.kind == CheckKind::thickness || check.kind == CheckKind::draft ||
         check.kind == CheckKind::standing || check.kind == CheckKind::jam ||
         check.kind == CheckKind::resting || check.kind == CheckKind::quality;
}

/// Returns the signed changes whose absolute values add up to D.
Eigen::VectorXd in_a_row(const DistortionChanges& changes) {
  Eigen::VectorXd row(changes.volume.size() + changes.proximity.size() + changes.box.size() + 1);
  row << changes.volume, changes.proximity, changes.box, changes.symmetry;
  return row / 4;
}

/// Largest number of vertices, evenly chosen, used for the slopes of the displacement.
constexpr Eigen::Index max_vertices = 20000;

Points some_rows(const Points& all) {
  const Eigen::Index stride = (all.rows() + max_vertices - 1) / max_vertices;
  if (stride <= 1) return all;
  Points some((all.rows() + stride - 1) / stride, 3);
  for (Eigen::Index row = 0; row < some.rows(); ++row) some.row(row) = all.row(row * stride);
  return some;
}

}  // namespace

MagnitudeProblem::MagnitudeProblem(const RequirementChecker& checker, std::vector<Edit> edits,
                                   const Direction& direction, Limits limits)
    : checker_(checker),
      edits_(std::move(edits)),
      direction_(direction),
      limits_(std::move(limits)),
      constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction)),
      meter_(checker.rest_shape().energy_meter()),
      blocks_(checker.space().rest().shape, direction, checker.requirements().measure.semantics) {
  const Requirements& asked = checker.requirements();
  checks_ = asked.min_thickness || asked.min_draft_degrees || asked.standing_copies || asked.friction ||
            asked.resting_part || asked.quality;
}

double MagnitudeProblem::target_offset(const Stackability& measured) const {
  return checker_.required_stackability(measured) - checker_.requirements().target;
}

double MagnitudeProblem::target() const {
  return checker_.requirements().target + tolerance::target / 2;
}

bool MagnitudeProblem::stopped() const {
  return evaluations_ >= limits_.evaluations || (limits_.cancelled && limits_.cancelled());
}

std::vector<Edit> MagnitudeProblem::edits(const Magnitudes& x) const {
  std::vector<Edit> result;
  for (std::size_t k = 0; k < edits_.size(); ++k)
    if (x[k] != 0) result.push_back(with_magnitude(edits_[k], x[k]));
  return result;
}

DeformationResult MagnitudeProblem::design(const Magnitudes& x) const {
  return checker_.space().deformed(edits(x), constraints_);
}

void MagnitudeProblem::constrain_pairs(const Magnitudes& x) {
  samples_.clear();
  pairs_.clear();
  if (checker_.requirements().measure.play > 0) return;
  const Design design = this->design(x).design;
  const Stackability whole = checker_.measure(design.shape, direction_);
  const double allowed = (1 - target() - target_offset(whole)) / whole.loss_per_length();
  const double clearance = checker_.requirements().measure.clearance;
  pairs_ = blocks_.pairs_above(design.shape,
                               std::min(whole.f_max, allowed) - clearance - near_band * whole.extent);
  if (pairs_.size() > max_pairs) pairs_.resize(max_pairs);
}

void MagnitudeProblem::measure_blocks(const Design& design, const Stackability& whole,
                                      MagnitudeSample& sample) const {
  const double loss = whole.loss_per_length(), clearance = checker_.requirements().measure.clearance;
  const std::vector<BlockSeparation> separations = blocks_.separations(design.shape, pairs_);
  double largest = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const double f = separations[p].f + clearance, lack = target() + target_offset(whole) - (1 - f * loss);
    sample.violations[static_cast<Eigen::Index>(p) + 1] =
        separations[p].blocked ? lack : std::min(lack, -passing_surplus);
    if (separations[p].blocked) largest = std::max(largest, f);
  }
  const bool covered = !pairs_.empty() && largest >= whole.f_max - tolerance::relative * whole.extent;
  sample.violations[0] = covered ? no_shortfall : target() - sample.stackability;
}

MagnitudeProblem::Measured MagnitudeProblem::measured(const Magnitudes& x) const {
  Measured result;
  MagnitudeSample& sample = result.sample;
  const DeformationResult outcome = design(x);
  if (outcome.refusal) return result;
  sample.made = true;
  if (limits_.measure != ChangeMeasure::displacement) {
    const DistortionChanges changes = meter_.changes(outcome.design);
    sample.change = changes.distortion().total();
    sample.changes = in_a_row(changes);
  }
  if (limits_.measure != ChangeMeasure::distortion) {
    const Points moved = displacements(checker_.space().rest().shape, outcome.design.shape);
    sample.displacement = root_mean_square(moved);
    sample.change += sample.displacement;
    result.moved = some_rows(moved);
  }
  Assessment assessment;
  if (checks_) {
    assessment = checker_.check(outcome.design, direction_, QualityScope::parts);
  } else {
    assessment.measured = checker_.measure(outcome.design.shape, direction_);
  }
  std::erase_if(assessment.checks, [](const Check& check) { return !is_open(check); });
  sample.stackability = assessment.measured.value - target_offset(assessment.measured);
  const Requirements& asked = checker_.requirements();
  const double size_ratio = min_size_ratio(checker_.space().rest(), outcome.design).ratio;
  sample.passes =
      size_ratio >= asked.min_size_ratio && std::all_of(assessment.checks.begin(), assessment.checks.end(),
                                                        [](const Check& c) { return c.passed; });
  sample.feasible = sample.passes && sample.stackability >= asked.target + tolerance::stackability;
  const auto of_pairs = static_cast<Eigen::Index>(pairs_.size()) + 1;
  const auto checks = static_cast<Eigen::Index>(assessment.checks.size());
  sample.violations.resize(of_pairs + checks + 1);
  measure_blocks(outcome.design, assessment.measured, sample);
  for (Eigen::Index c = 0; c < checks; ++c)
    sample.violations[of_pairs + c] = violation(assessment.checks[static_cast<std::size_t>(c)]);
  sample.violations[of_pairs + checks] = asked.min_size_ratio + tolerance::magnitude - size_ratio;
  return result;
}

std::vector<MagnitudeProblem::Measured> MagnitudeProblem::measured(
    const std::vector<Magnitudes>& points, const std::function<bool()>& cancelled) const {
  std::vector<Measured> made(points.size());
  std::atomic<bool> stopped = false;
  const auto ask = [&, caller = std::this_thread::get_id()] {
    if (cancelled && std::this_thread::get_id() == caller && cancelled()) stopped = true;
    return stopped.load();
  };
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    if (!ask()) made[k] = measured(points[k]);
  });
  return made;
}

void MagnitudeProblem::remember(const Magnitudes& x, MagnitudeSample sample) {
  ++evaluations_;
  if (sample.feasible && (!best_ || sample.change < best_change_)) {
    best_ = x;
    best_change_ = sample.change;
  }
  if (sample.passes && (!nearest_ || sample.stackability > nearest_stackability_)) {
    nearest_ = x;
    nearest_stackability_ = sample.stackability;
  }
  samples_.emplace(x, std::move(sample));
}

void MagnitudeProblem::prefer(const Magnitudes& x) {
  best_ = x;
  best_change_ = samples_.at(x).change;
}

void MagnitudeProblem::prepare(const std::vector<Magnitudes>& points) {
  std::vector<Magnitudes> fresh;
  for (const Magnitudes& x : points)
    if (!samples_.contains(x) && std::find(fresh.begin(), fresh.end(), x) == fresh.end()) fresh.push_back(x);
  std::vector<Measured> made = measured(fresh, {});
  for (std::size_t k = 0; k < fresh.size(); ++k) remember(fresh[k], std::move(made[k].sample));
}

const MagnitudeSample& MagnitudeProblem::at(const Magnitudes& x) {
  prepare({x});
  return samples_.at(x);
}

MagnitudeSlopes MagnitudeProblem::slopes(const Magnitudes& x) {
  std::vector<double> steps(size());
  std::vector<Magnitudes> points{x};
  const auto neighbour = [&x](std::size_t k, double step) {
    Magnitudes y = x;
    y[k] += step;
    return y;
  };
  for (std::size_t k = 0; k < size(); ++k) {
    steps[k] = x[k] + step_ <= highest() ? step_ : -step_;
    points.push_back(neighbour(k, steps[k]));
  }
  std::vector<Measured> made = measured(points, limits_.cancelled);
  if (!made.front().sample.made) {  // only after cancellation
    const auto columns = static_cast<Eigen::Index>(size());
    return {Eigen::MatrixXd::Zero(at(x).changes.size(), columns),
            Eigen::MatrixXd::Zero(at(x).violations.size(), columns),
            {},
            std::vector<bool>(size()),
            {},
            {}};
  }
  std::vector<bool> above(size()), below(size());
  std::vector<std::size_t> refused;
  std::vector<Magnitudes> others;
  for (std::size_t k = 0; k < size(); ++k) {
    if (made[k + 1].sample.made) continue;
    (steps[k] > 0 ? above : below)[k] = true;
    refused.push_back(k);
    steps[k] = -steps[k];
    others.push_back(neighbour(k, steps[k]));
  }
  std::vector<Measured> instead = measured(others, {});
  for (std::size_t i = 0; i < refused.size(); ++i) {
    const std::size_t k = refused[i];
    made[k + 1] = std::move(instead[i]);
    if (!made[k + 1].sample.made) (steps[k] > 0 ? above : below)[k] = true;
  }
  for (std::size_t k = 0; k <= size(); ++k)
    remember(k == 0 ? x : neighbour(k - 1, steps[k - 1]), made[k].sample);
  MagnitudeSlopes result = differences(made, steps);
  result.refused_above = std::move(above);
  result.refused_below = std::move(below);
  return result;
}

MagnitudeSlopes MagnitudeProblem::differences(const std::vector<Measured>& made,
                                              const std::vector<double>& steps) const {
  const MagnitudeSample& base = made.front().sample;
  const auto columns = static_cast<Eigen::Index>(steps.size());
  MagnitudeSlopes result{Eigen::MatrixXd::Zero(base.changes.size(), columns),
                         Eigen::MatrixXd::Zero(base.violations.size(), columns),
                         {},
                         std::vector<bool>(steps.size()),
                         {},
                         {}};
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(made.front().moved.size(), columns + 1);
  moved.col(0) = made.front().moved.reshaped();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const MagnitudeSample& there = made[k + 1].sample;
    if (!there.made || !base.made) continue;
    result.made[k] = true;
    const auto column = static_cast<Eigen::Index>(k);
    result.changes.col(column) = (there.changes - base.changes) / steps[k];
    result.violations.col(column) = (there.violations - base.violations) / steps[k];
    if (moved.rows() > 0)
      moved.col(column + 1) = (made[k + 1].moved.reshaped() - made.front().moved.reshaped()) / steps[k];
  }
  if (moved.rows() > 0) result.gram = 3 * moved.transpose() * moved / static_cast<double>(moved.rows());
  return result;
}

}  // namespace stackabilization::detail
