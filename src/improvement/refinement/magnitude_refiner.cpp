#include "improvement/refinement/magnitude_refiner.h"

#include <Eigen/QR>
#include <algorithm>
#include <optional>
#include <utility>

#include "improvement/refinement/magnitude_search.h"

namespace stackabilization::detail {

namespace {

/// Edits that are added are chosen by reduced cost in a trust region of this radius. One is added only if its
/// reduced cost per unit of magnitude is above min_reduced_cost times what is minimised.
constexpr double pricing_radius = 0.1;
constexpr double min_reduced_cost = 0.01;
/// An edit moves the surface in a new way if at least this share of its squared displacement is none that the
/// others can make.
constexpr double new_motion = 0.2;

std::vector<Edit> plain(const std::vector<MagnitudeEdit>& edits) {
  std::vector<Edit> result;
  for (const MagnitudeEdit& one : edits) result.push_back(one.edit);
  return result;
}

/// Returns the given edits and the added ones. Given edits are merged unless the merged list is refused.
std::vector<MagnitudeEdit> variables(const RequirementChecker& checker, const Candidate& start,
                                     const RefinementOptions& options,
                                     const std::vector<MagnitudeEdit>& added) {
  const DeformationConstraints constraints =
      deformation_constraints(checker.requirements(), checker.space().rest(), Direction(start.direction));
  std::vector<MagnitudeEdit> edits =
      merge_magnitude_edits(start.design.edits, [&](const std::vector<MagnitudeEdit>& fewer) {
        const bool late = options.cancelled && options.cancelled();  // replaying long lists is slow
        return !late && !checker.space().deformed(plain(fewer), constraints).refusal;
      });
  edits.insert(edits.end(), added.begin(), added.end());
  return edits;
}

}  // namespace

MagnitudeRefiner::MagnitudeRefiner(const RequirementChecker& checker, const Candidate& start,
                                   const RefinementOptions& options, const std::vector<MagnitudeEdit>& added)
    : checker_(checker),
      start_(start),
      options_(options),
      direction_(start.direction),
      edits_(variables(checker, start, options, added)),
      meter_(checker.rest_shape().energy_meter().with_alpha(options.alpha)),
      problem_(checker, plain(edits_), direction_,
               {options.evaluations, options.magnitude_bound, options.objective, options.cancelled}) {}

std::vector<MagnitudeEdit> MagnitudeRefiner::promising(MagnitudeGoal goal, std::size_t most) {
  const Magnitudes x = found();
  if (x.empty() || !problem_.at(x).made) return {};
  problem_.constrain_pairs(x);
  const MagnitudeSlopes slopes = problem_.slopes(x);
  const MagnitudeModel model(goal, x, problem_.at(x), slopes);
  Magnitudes low = x, high = x;
  for (double& magnitude : low) magnitude -= pricing_radius;
  for (double& magnitude : high) magnitude += pricing_radius;
  const Eigen::VectorXd pulls = model.step(low, high).reduced_costs;
  const double least = min_reduced_cost * model.merit(problem_.at(x));
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t k = 0; k < edits_.size(); ++k) {
    const double reduced_costs = pulls(static_cast<Eigen::Index>(k));
    if (!edits_[k].source && slopes.made[k] && reduced_costs > least) ranked.emplace_back(-reduced_costs, k);
  }
  std::sort(ranked.begin(), ranked.end());
  if (options_.edit_price > 0) leave_out_likes(ranked, slopes.gram);
  if (ranked.size() > most) ranked.resize(most);
  std::vector<MagnitudeEdit> result;
  for (const auto& [reduced_costs, k] : ranked) result.push_back(edits_[k]);
  return result;
}

RefinementResult MagnitudeRefiner::result() {
  Verdict best = judged(start_.design, start_.reasons);
  if (!edits_.empty() && problem_.at(found()).made) {
    search_magnitudes(problem_, found(), options_);
    if (const std::optional<Magnitudes>& x = problem_.best() ? problem_.best() : problem_.nearest()) {
      Verdict verdict = judged(*x);
      if (verdict.is_better_than(best)) best = std::move(verdict);
    }
  }
  return {std::move(best.candidate), best.reached, problem_.evaluations()};
}

bool MagnitudeRefiner::Verdict::is_better_than(const Verdict& other) const {
  if (reached != other.reached) return reached;
  if (!reached) return candidate.measured.value > other.candidate.measured.value;
  return std::pair(change, candidate.design.edits.size()) <
         std::pair(other.change, other.candidate.design.edits.size());
}

/// Leaves out edits that move the surface like given ones and those before them do together: the second
/// face of a part that is symmetric to itself, or the scaling of a part whose faces move.
void MagnitudeRefiner::leave_out_likes(std::vector<std::pair<double, std::size_t>>& ranked,
                                       const Eigen::MatrixXd& gram) const {
  if (gram.size() == 0) return;
  std::vector<Eigen::Index> chosen;  // columns of `gram`, of which the first is the surface itself
  for (std::size_t k = 0; k < edits_.size(); ++k)
    if (edits_[k].source) chosen.push_back(static_cast<Eigen::Index>(k) + 1);
  std::erase_if(ranked, [&](const auto& entry) {
    const Eigen::Index column = static_cast<Eigen::Index>(entry.second) + 1;
    const Eigen::VectorXd along = gram(chosen, column);
    const Eigen::MatrixXd between = gram(chosen, chosen);
    const double own = gram(column, column);
    const double left =
        chosen.empty() ? own : own - along.dot(between.completeOrthogonalDecomposition().solve(along));
    if (left < new_motion * own) return true;
    chosen.push_back(column);
    return false;
  });
}

/// Returns the magnitudes of the start: 1 for given edits, 0 for added ones.
Magnitudes MagnitudeRefiner::found() const {
  Magnitudes x;
  for (const MagnitudeEdit& one : edits_) x.push_back(one.source ? 1 : 0);
  return x;
}

MagnitudeRefiner::Verdict MagnitudeRefiner::judged(const Magnitudes& x) const {
  std::vector<EditReason> reasons;
  for (std::size_t k = 0; k < edits_.size(); ++k)
    if (x[k] != 0)
      reasons.push_back(edits_[k].source && *edits_[k].source < start_.reasons.size()
                            ? start_.reasons[*edits_[k].source]
                            : EditReason{EditEffect::compensation});
  return judged(problem_.design(x).design, std::move(reasons));
}

MagnitudeRefiner::Verdict MagnitudeRefiner::judged(Design design, std::vector<EditReason> reasons) const {
  Verdict verdict;
  const Assessment assessment = checker_.check(design, direction_);
  Candidate& candidate = verdict.candidate;
  candidate.measured = assessment.measured;
  const double gain = start_.energy.gain + assessment.measured.value - start_.measured.value;
  candidate.energy = meter_.energy(design, gain);
  candidate.design = std::move(design);
  candidate.direction = start_.direction;
  candidate.reasons = std::move(reasons);
  verdict.reached = assessment.passed();
  verdict.change = size_of(options_.objective, candidate, checker_.space().rest().shape);
  return verdict;
}

}  // namespace stackabilization::detail
