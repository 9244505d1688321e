#include "stackabilization/improvement/magnitude_problem.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stackabilization/improvement/proportions.h"
#include "stackabilization/improvement/refinement.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Pairs of blocks count as near when they miss f_max, or what the target allows, by less than this fraction
/// of the extent; so many at most.
constexpr double near_band = 0.2;
constexpr std::size_t most_pairs = 160;

/// Shortfall of the whole shape where the pairs stand for it.
constexpr double no_shortfall = -1;

/// Less the shortfall, at least, of a pair that passes at any height: as it moves apart, what it asks for
/// falls to what its lowest and highest points would, and then to nothing.
constexpr double passing_surplus = 0.02;

/// Whether the deformation cannot see to it: it keeps extent, relations and box by itself.
bool is_open(const Check& check) {
  return check.name == "thickness" || check.name == "draft" || check.name == "standing";
}

double shortfall(const Check& check) {
  const double lack = check.demanded - check.value;
  if (!std::isfinite(lack)) return check.passed ? -1 : 1;
  return check.demanded > 0 ? lack / check.demanded : lack;
}

/// Changes whose magnitudes add up to D.
Eigen::VectorXd in_a_row(const DistortionChanges& changes) {
  Eigen::VectorXd row(changes.volume.size() + changes.proximity.size() + changes.box.size() + 1);
  row << changes.volume, changes.proximity, changes.box, changes.symmetry;
  return row / 4;
}

/// S lost per unit of f_max.
double loss_per_length(const Stackability& measured) {
  return measured.stack_box_volume / (measured.extent * measured.box_volume);
}

}  // namespace

MagnitudeProblem::MagnitudeProblem(const RequirementChecker& checker, std::vector<Edit> edits,
                                   const Direction& direction, Limits limits)
    : checker_(checker),
      edits_(std::move(edits)),
      direction_(direction),
      limits_(std::move(limits)),
      constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction)),
      meter_(checker.space().rest(), checker.requirements().measure.boxes),
      blocks_(checker.space().rest().shape, direction, checker.requirements().measure.semantics) {
  const Requirements& asked = checker.requirements();
  checks_ = asked.least_thickness || asked.least_draft_degrees || asked.standing_copies;
}

double MagnitudeProblem::handicap(const Stackability& measured) const {
  return checker_.needed(measured) - checker_.requirements().target;
}

double MagnitudeProblem::aim() const {
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

DesignOutcome MagnitudeProblem::design(const Magnitudes& x) const {
  return checker_.space().replayed(edits(x), constraints_);
}

void MagnitudeProblem::constrain_pairs(const Magnitudes& x) {
  samples_.clear();
  pairs_.clear();
  if (checker_.requirements().play > 0) return;
  const Design design = this->design(x).design;
  const Stackability whole = checker_.measured(design.shape, direction_);
  const double allowed = (1 - aim() - handicap(whole)) / loss_per_length(whole);
  const double clearance = checker_.requirements().clearance;
  pairs_ = blocks_.pairs_above(design.shape,
                               std::min(whole.f_max, allowed) - clearance - near_band * whole.extent);
  if (pairs_.size() > most_pairs) pairs_.resize(most_pairs);
}

void MagnitudeProblem::measure_blocks(const Design& design, const Stackability& whole,
                                      MagnitudeSample& sample) const {
  const double loss = loss_per_length(whole), clearance = checker_.requirements().clearance;
  const std::vector<BlockSeparation> separations = blocks_.separations(design.shape, pairs_);
  double largest = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const double f = separations[p].f + clearance, lack = aim() + handicap(whole) - (1 - f * loss);
    sample.shortfalls[static_cast<Eigen::Index>(p) + 1] =
        separations[p].blocked ? lack : std::min(lack, -passing_surplus);
    if (separations[p].blocked) largest = std::max(largest, f);
  }
  const bool covered = !pairs_.empty() && largest >= whole.f_max - tolerance::relative * whole.extent;
  sample.shortfalls[0] = covered ? no_shortfall : aim() - sample.stackability;
}

MagnitudeSample MagnitudeProblem::measured(const Magnitudes& x) const {
  MagnitudeSample sample;
  const DesignOutcome outcome = design(x);
  if (outcome.refusal) return sample;
  sample.made = true;
  const DistortionChanges changes = meter_.changes(outcome.design);
  sample.distortion = changes.distortion().total();
  sample.changes = in_a_row(changes);
  Assessment assessment;
  if (checks_) {
    assessment = checker_.checked(outcome.design, direction_);
  } else {
    assessment.measured = checker_.measured(outcome.design.shape, direction_);
  }
  std::erase_if(assessment.checks, [](const Check& check) { return !is_open(check); });
  sample.stackability = assessment.measured.value - handicap(assessment.measured);
  const Requirements& asked = checker_.requirements();
  const double proportion = least_proportion(checker_.space().rest(), outcome.design).ratio;
  sample.passes =
      proportion >= asked.least_proportion && std::all_of(assessment.checks.begin(), assessment.checks.end(),
                                                          [](const Check& c) { return c.passed; });
  sample.feasible = sample.passes && sample.stackability >= asked.target + tolerance::stackability;
  const auto of_pairs = static_cast<Eigen::Index>(pairs_.size()) + 1;
  const auto checks = static_cast<Eigen::Index>(assessment.checks.size());
  sample.shortfalls.resize(of_pairs + checks + 1);
  measure_blocks(outcome.design, assessment.measured, sample);
  for (Eigen::Index c = 0; c < checks; ++c)
    sample.shortfalls[of_pairs + c] = shortfall(assessment.checks[static_cast<std::size_t>(c)]);
  sample.shortfalls[of_pairs + checks] = asked.least_proportion + tolerance::magnitude - proportion;
  return sample;
}

void MagnitudeProblem::remember(const Magnitudes& x, MagnitudeSample sample) {
  ++evaluations_;
  if (sample.feasible && (!best_ || sample.distortion < best_distortion_)) {
    best_ = x;
    best_distortion_ = sample.distortion;
  }
  if (sample.passes && (!nearest_ || sample.stackability > nearest_stackability_)) {
    nearest_ = x;
    nearest_stackability_ = sample.stackability;
  }
  samples_.emplace(x, std::move(sample));
}

void MagnitudeProblem::prefer(const Magnitudes& x) {
  best_ = x;
  best_distortion_ = samples_.at(x).distortion;
}

void MagnitudeProblem::prepare(const std::vector<Magnitudes>& points) {
  std::vector<Magnitudes> fresh;
  for (const Magnitudes& x : points)
    if (!samples_.contains(x) && std::find(fresh.begin(), fresh.end(), x) == fresh.end()) fresh.push_back(x);
  std::vector<MagnitudeSample> made(fresh.size());
  tbb::parallel_for(std::size_t{0}, fresh.size(), [&](std::size_t k) { made[k] = measured(fresh[k]); });
  for (std::size_t k = 0; k < fresh.size(); ++k) remember(fresh[k], std::move(made[k]));
}

const MagnitudeSample& MagnitudeProblem::at(const Magnitudes& x) {
  prepare({x});
  return samples_.at(x);
}

MagnitudeSlopes MagnitudeProblem::slopes(const Magnitudes& x) {
  const auto neighbour = [&](std::size_t k, double step) {
    Magnitudes y = x;
    y[k] += step;
    return y;
  };
  std::vector<double> steps(size());
  std::vector<Magnitudes> neighbours;
  for (std::size_t k = 0; k < size(); ++k) {
    steps[k] = x[k] + tolerance::magnitude_step <= highest() ? tolerance::magnitude_step
                                                             : -tolerance::magnitude_step;
    neighbours.push_back(neighbour(k, steps[k]));
  }
  prepare(neighbours);
  neighbours.clear();
  for (std::size_t k = 0; k < size(); ++k) {
    if (at(neighbour(k, steps[k])).made) continue;
    steps[k] = -steps[k];
    neighbours.push_back(neighbour(k, steps[k]));
  }
  prepare(neighbours);

  const MagnitudeSample& base = at(x);
  const auto columns = static_cast<Eigen::Index>(size());
  MagnitudeSlopes result{Eigen::MatrixXd::Zero(base.changes.size(), columns),
                         Eigen::MatrixXd::Zero(base.shortfalls.size(), columns)};
  for (std::size_t k = 0; k < size(); ++k) {
    const MagnitudeSample& there = at(neighbour(k, steps[k]));
    if (!there.made || !base.made) continue;
    result.changes.col(static_cast<Eigen::Index>(k)) = (there.changes - base.changes) / steps[k];
    result.shortfalls.col(static_cast<Eigen::Index>(k)) = (there.shortfalls - base.shortfalls) / steps[k];
  }
  return result;
}

}  // namespace stackabilization::detail
