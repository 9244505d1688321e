#include "study/manual_work.h"

#include <algorithm>
#include <set>

#include "common/random.h"
#include "stackabilization/improvement/suggestions.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization::experiments {

namespace {

/// The largest steps of the automatic method (ContactEditOptions: three times the least).
constexpr double max_move = 0.18, max_scaling = 0.3;

/// In [0, count).
int choice(int count, Random& random) {
  return std::min(count - 1, static_cast<int>(random.uniform() * count));
}

/// In [-1, 1).
double signed_size(Random& random) {
  return 2 * random.uniform() - 1;
}

Edit random_edit(const ManualTool& tool, const std::vector<Handle>& handles, Random& random) {
  Edit edit;
  edit.handle = handles[static_cast<std::size_t>(choice(static_cast<int>(handles.size()), random))];
  if (edit.handle.kind == HandleKind::section && random.uniform() < 0.5) edit.falloff = Falloff::linear;
  const int axis = choice(3, random);
  if (edit.handle.kind == HandleKind::corner || random.uniform() < 0.5) {
    edit.operation = Move{signed_size(random) * max_move * tool.extent(axis) * tool.frame().col(axis)};
    return edit;
  }
  Scale scale{1 + signed_size(random) * max_scaling, std::nullopt};
  if (edit.handle.kind == HandleKind::part && random.uniform() < 0.75) scale.along = tool.frame().col(axis);
  edit.operation = scale;
  return edit;
}

bool preferred(const Candidate& a, const Candidate& b, Habit habit) {
  switch (habit) {
    case Habit::random:
      return a.measured.value >= b.measured.value - tolerance::stackability;
    case Habit::greedy:
      return a.measured.value > b.measured.value + tolerance::stackability;
    case Habit::careful:
      break;
  }
  return a.energy.value < b.energy.value - tolerance::stackability;
}

Eigen::Matrix3d frame_along(const Eigen::Vector3d& direction) {
  Eigen::Matrix3d frame;
  const Eigen::Vector3d side =
      std::abs(direction.normalized().y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  frame.col(2) = direction.normalized();
  frame.col(0) = side.cross(frame.col(2)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

}  // namespace

std::string name_of(Habit habit) {
  switch (habit) {
    case Habit::random:
      return "random";
    case Habit::greedy:
      return "greedy";
    case Habit::careful:
      return "careful";
  }
  return {};
}

ManualTool::ManualTool(const RequirementChecker& checker, const Eigen::Vector3d& direction)
    : checker_(checker),
      direction_(direction),
      constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction_)),
      meter_(checker.space().rest(), checker.requirements().measure.boxes),
      handles_(checker.space().handles()),
      frame_(frame_along(direction)),
      before_(checker.rest_shape().measure(direction_).value) {
  std::erase_if(handles_, [](const Handle& handle) { return handle.kind == HandleKind::shape; });
  for (int axis = 0; axis < 3; ++axis)
    extents_[axis] = range_along(checker.space().rest().shape, frame_.col(axis)).length();
}

Candidate ManualTool::at_rest() const {
  return measured(checker_.space().at_rest());
}

Candidate ManualTool::measured(Design design) const {
  Candidate candidate;
  candidate.direction = direction_.vector();
  candidate.measured = checker_.measure(design.shape, direction_);
  candidate.energy = meter_.energy(design, candidate.measured.value - before_);
  candidate.design = std::move(design);
  return candidate;
}

std::vector<Handle> ManualTool::touching_handles(const Candidate& now) const {
  std::set<int> parts;
  for (const ContactRegion& region : situation(checker_, now.design, direction_).contacts)
    parts.insert({region.upper_part, region.lower_part});
  std::vector<Handle> handles = handles_;
  std::erase_if(handles, [&](const Handle& handle) { return !parts.contains(handle.part); });
  return handles.empty() ? handles_ : handles;
}

std::optional<Candidate> ManualTool::edited(const Candidate& now, const Edit& edit) const {
  DeformationResult outcome = checker_.space().edited(now.design, edit, constraints_);
  if (outcome.refusal || checker_.form_obstacle(outcome.design)) return std::nullopt;
  return measured(std::move(outcome.design));
}

bool ManualTool::finished(const Candidate& candidate) const {
  return checker_.meets_target(candidate.measured) && checker_.check(candidate.design, direction_).passed();
}

ManualWork worked(const ManualTool& tool, const ManualUser& user) {
  Random random(user.seed);
  ManualWork work{tool.at_rest(), false, 0, {}};
  work.reached = tool.finished(work.result);
  const bool watching = user.habit == Habit::careful;
  std::vector<Handle> handles = watching ? tool.touching_handles(work.result) : tool.handles();
  while (!work.reached && work.tried < user.max_edits) {
    std::optional<Candidate> best;
    const int compared = user.habit == Habit::random ? 1 : user.compared;
    for (int k = 0; k < compared && work.tried < user.max_edits; ++k, ++work.tried) {
      std::optional<Candidate> next = tool.edited(work.result, random_edit(tool, handles, random));
      if (next && preferred(*next, best ? *best : work.result, user.habit)) best = std::move(next);
    }
    if (!best) continue;
    work.result = std::move(*best);
    work.kept.push_back(work.result.measured.value);
    work.reached = tool.finished(work.result);
    if (watching) handles = tool.touching_handles(work.result);
  }
  return work;
}

}  // namespace stackabilization::experiments
