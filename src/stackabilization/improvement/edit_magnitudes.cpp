#include "stackabilization/improvement/edit_magnitudes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "stackabilization/improvement/refinement.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization {

namespace {

/// +1 or -1 where the vectors lie on one line through 0 as nearly as relations hold, else 0.
int same_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.cross(b).norm() > tolerance::relation * a.norm() * b.norm()) return 0;
  return a.dot(b) < 0 ? -1 : 1;
}

/// Both operations as one, where they do the same thing.
struct Merge {
  std::optional<Operation> operator()(const Move& a, const Move& b) const {
    if (same_line(a.by, b.by) == 0) return std::nullopt;
    const Eigen::Vector3d sum = a.by + b.by;
    if (sum.norm() <= tolerance::relative * a.by.norm()) return Move{};
    return Move{sum};
  }
  std::optional<Operation> operator()(const Rotate& a, const Rotate& b) const {
    const int side = same_line(a.axis, b.axis);
    if (side == 0) return std::nullopt;
    const double sum = a.radians + side * b.radians;
    return Rotate{a.axis, std::abs(sum) <= tolerance::relative * std::abs(a.radians) ? 0 : sum};
  }
  std::optional<Operation> operator()(const Scale& a, const Scale& b) const {
    if (a.along.has_value() != b.along.has_value()) return std::nullopt;
    if (a.along && same_line(*a.along, *b.along) == 0) return std::nullopt;
    const double product = a.factor * b.factor;
    return Scale{std::abs(product - 1) <= tolerance::relative ? 1 : product, a.along};
  }
  template <typename A, typename B>
  std::optional<Operation> operator()(const A&, const B&) const {
    return std::nullopt;
  }
};

std::optional<Edit> merge(const Edit& a, const Edit& b) {
  if (!(a.handle == b.handle) || a.falloff != b.falloff) return std::nullopt;
  std::optional<Operation> both = std::visit(Merge(), a.operation, b.operation);
  if (!both) return std::nullopt;
  return Edit{a.handle, std::move(*both), a.falloff};
}

bool changes_nothing(const Edit& edit) {
  if (const auto* move = std::get_if<Move>(&edit.operation)) return move->by.isZero(0);
  if (const auto* turn = std::get_if<Rotate>(&edit.operation)) return turn->radians == 0;
  return std::get<Scale>(edit.operation).factor == 1;
}

std::optional<Handle> opposite(const Handle& handle, const Structure& structure) {
  if (handle.kind == HandleKind::face) return Handle{handle.kind, handle.part, handle.index ^ 1};
  if (handle.kind != HandleKind::section) return std::nullopt;
  const auto* cylinder =
      std::get_if<GeneralizedCylinder>(&structure.parts[static_cast<std::size_t>(handle.part)].primitive);
  if (!cylinder || cylinder->closed) return std::nullopt;
  const int last = static_cast<int>(cylinder->radii.size()) - 1;
  return Handle{handle.kind, handle.part, 2 * handle.index < last ? last : 0};
}

}  // namespace

namespace detail {

std::vector<MagnitudeEdit> merged_edits(
    const std::vector<Edit>& edits,
    const std::function<bool(const std::vector<MagnitudeEdit>&)>& acceptable) {
  std::vector<MagnitudeEdit> result;
  for (std::size_t k = 0; k < edits.size(); ++k)
    if (!changes_nothing(edits[k])) result.push_back({edits[k], k});
  for (std::size_t later = 1; later < result.size(); ++later)
    for (std::size_t first = 0; first < later; ++first) {
      std::optional<Edit> both = merge(result[first].edit, result[later].edit);
      if (!both) continue;
      std::vector<MagnitudeEdit> fewer = result;
      fewer[first].edit = std::move(*both);
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(later));
      const bool nothing = changes_nothing(fewer[first].edit);
      if (nothing) fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(first));
      if (!acceptable(fewer)) continue;
      result = std::move(fewer);
      later -= nothing ? 2 : 1;
      break;
    }
  return result;
}

std::vector<MagnitudeEdit> counterparts(const std::vector<MagnitudeEdit>& edits, const DesignSpace& space) {
  const std::vector<Handle> handles = space.handles();
  std::vector<MagnitudeEdit> result;
  for (const MagnitudeEdit& given : edits) {
    const std::optional<Handle> handle = opposite(given.edit.handle, space.rest().structure);
    if (!handle || std::find(handles.begin(), handles.end(), *handle) == handles.end()) continue;
    const Edit edit{*handle, given.edit.operation, given.edit.falloff};
    const auto is_there = [&](const MagnitudeEdit& there) { return merge(there.edit, edit).has_value(); };
    if (std::none_of(edits.begin(), edits.end(), is_there) &&
        std::none_of(result.begin(), result.end(), is_there))
      result.push_back({edit, std::nullopt});
  }
  return result;
}

}  // namespace detail

Edit with_magnitude(Edit edit, double x) {
  if (auto* move = std::get_if<Move>(&edit.operation))
    move->by *= x;
  else if (auto* turn = std::get_if<Rotate>(&edit.operation))
    turn->radians *= x;
  else {
    auto& scale = std::get<Scale>(edit.operation);
    if (x != 1) scale.factor = std::pow(scale.factor, x);
  }
  return edit;
}

std::vector<Edit> merged(const std::vector<Edit>& edits) {
  std::vector<Edit> result;
  for (const detail::MagnitudeEdit& one : detail::merged_edits(edits, [](const auto&) { return true; }))
    result.push_back(one.edit);
  return result;
}

}  // namespace stackabilization
