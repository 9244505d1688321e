#include "improvement/search/follower_slide.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/index.h"
#include "stackabilization/improvement/removal.h"

namespace stackabilization::detail {

namespace {

/// Share of the allowed growth that the part gets.
constexpr double share_of_growth = 0.8;

bool same_class(const Structure& structure, int a, int b) {
  const std::vector<std::vector<int>> classes = symmetric_classes(structure);
  return std::any_of(classes.begin(), classes.end(), [&](const std::vector<int>& members) {
    return std::find(members.begin(), members.end(), a) != members.end() &&
           std::find(members.begin(), members.end(), b) != members.end();
  });
}

/// Returns whether the upper end along r of a part is the one that moves when it leans; nothing if it does
/// not lean.
std::optional<bool> upper_end_moves(const ContactEdit& edit, const Primitive& part,
                                    const Eigen::Vector3d& up) {
  if (const auto* lean = std::get_if<Lean>(&edit.edit.operation)) return lean->axis.dot(up) > 0;
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&part);
  if (!edit.reason.leaning || edit.edit.handle.kind != HandleKind::section || cylinder == nullptr)
    return std::nullopt;
  const Eigen::VectorXd heights = cylinder->centres * up;
  return heights(edit.edit.handle.index) > (heights.minCoeff() + heights.maxCoeff()) / 2;
}

}  // namespace

std::optional<Edit> follower_slide(const ContactEdit& leaning, const Obstacle& refused,
                                   const StructuredShape& rest, const Design& now,
                                   const Direction& direction) {
  const auto* check = std::get_if<Check>(&refused);
  if (check == nullptr || check->kind != CheckKind::quality || check->measure != QualityMeasure::size ||
      check->where < 0 || !(check->value > 0 && check->value < check->demanded))
    return std::nullopt;
  const int part = leaning.edit.handle.part, follower = check->where;
  if (same_class(rest.structure, part, follower)) return std::nullopt;
  const Eigen::Vector3d up = direction.unit();
  const auto upper = upper_end_moves(leaning, now.primitives[at(part)], up);
  if (!upper) return std::nullopt;
  const Eigen::VectorXd leg = control_points(now.primitives[at(part)]) * up;
  const double fixed_end = *upper ? leg.minCoeff() : leg.maxCoeff(), span = leg.maxCoeff() - leg.minCoeff(),
               distance = std::abs((control_points(now.primitives[at(follower)]) * up).mean() - fixed_end);
  if (!(distance > 0 && distance < span)) return std::nullopt;
  const double growth = 1 / check->value - 1, allowed = 1 / check->demanded - 1,
               slide = distance * (1 - share_of_growth * allowed / growth);
  return Edit{{HandleKind::part, follower, 0}, Move{(*upper ? -slide : slide) * up}, Falloff::gaussian};
}

}  // namespace stackabilization::detail
