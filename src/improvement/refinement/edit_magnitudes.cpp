#include "improvement/refinement/edit_magnitudes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "deformation/model/straight_curve.h"
#include "improvement/contacts/contact_handles.h"
#include "improvement/contacts/contact_side.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/improvement/refinement.h"
#include "stackabilization/improvement/removal.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Returns +1 or -1 if the vectors lie on one line through 0, equally or oppositely directed, within
/// tolerance::relation; else 0.
int same_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (!on_one_line(a, b, tolerance::relation)) return 0;
  return a.dot(b) < 0 ? -1 : 1;
}

/// Merges two operations that do the same thing into one.
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
    if (product < 1 / edit_limits::max_scale || product > edit_limits::max_scale) return std::nullopt;
    return Scale{std::abs(product - 1) <= tolerance::relative ? 1 : product, a.along};
  }
  std::optional<Operation> operator()(const Taper& a, const Taper& b) const {
    if (a.along.has_value() != b.along.has_value() || same_line(a.axis, b.axis) != 1) return std::nullopt;
    if (a.along && same_line(*a.along, *b.along) == 0) return std::nullopt;
    const double product = a.factor * b.factor;
    if (product < 1 / edit_limits::max_scale || product > edit_limits::max_scale) return std::nullopt;
    return Taper{std::abs(product - 1) <= tolerance::relative ? 1 : product, a.axis, a.along};
  }
  std::optional<Operation> operator()(const Lean& a, const Lean& b) const {
    if (same_line(a.axis, b.axis) != 1 || same_line(a.by, b.by) == 0) return std::nullopt;
    const Eigen::Vector3d sum = a.by + b.by;
    return Lean{
        sum.norm() <= tolerance::relative * a.by.norm() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : sum,
        a.axis};
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
  if (const auto* taper = std::get_if<Taper>(&edit.operation)) return taper->factor == 1;
  if (const auto* lean = std::get_if<Lean>(&edit.operation)) return lean->by.isZero(0);
  return std::get<Scale>(edit.operation).factor == 1;
}

/// Sizes of added edits of magnitude 1: a move as a fraction of the diagonal, and the factor of a scaling.
constexpr double unit_move = 0.02;
constexpr double unit_factor = 0.9;

/// Returns whether the part reaches an end of the shape along w. Such a part is not edited along w.
bool is_on_end(const Shape& shape, int part, const ContactFrame& frame) {
  const Eigen::VectorXd heights = part_points(shape, part) * frame.w;
  return frame.on_end({heights.minCoeff(), heights.maxCoeff()});
}

/// Returns the unit normal of a face; outwards unless the cuboid is inside out.
Eigen::Vector3d face_normal(const Cuboid& cuboid, int face) {
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (const int corner : cuboid_face(face)) middle += cuboid.corners.row(corner) / 4;
  return (middle - cuboid.corners.colwise().mean()).transpose().normalized();
}

/// Returns the edits offered for one handle. `round_body`: see there.
std::vector<Edit> edits_of(const Handle& handle, const StructuredShape& rest, const ContactFrame& frame,
                           int round_body) {
  const Structure& structure = rest.structure;
  const Primitive& primitive = structure.parts[static_cast<std::size_t>(handle.part)].primitive;
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  std::vector<Eigen::Vector3d> axes{frame.u, frame.v};
  Falloff falloff = Falloff::gaussian;
  if (handle.kind == HandleKind::section) {
    const int last = static_cast<int>(cylinder->radii.size()) - 1;
    if (cylinder->closed) return {};
    if (handle.index != 0 && handle.index != last) {
      const bool chosen =
          handle.index == last / 4 || handle.index == last / 2 || handle.index == 3 * last / 4;
      if (!chosen || has_straight_wall(*cylinder)) return {};
      return {{handle, Scale{unit_factor, std::nullopt}, falloff}};
    }
    falloff = Falloff::linear;
    const double height = cylinder->centres.row(handle.index).dot(frame.w);
    if (handle.part == round_body && !frame.on_end({height, height})) axes.push_back(frame.w);
  } else if (handle.kind == HandleKind::face) {
    const Eigen::Vector3d normal = face_normal(std::get<Cuboid>(primitive), handle.index);
    const bool along_r = std::abs(normal.dot(frame.w)) > std::sqrt(0.5);
    if (along_r && is_on_end(rest.shape, handle.part, frame)) return {};
    return {{handle, Move{unit_move * structure.diagonal * normal}, falloff}};
  } else if (handle.kind == HandleKind::part) {
    if (!is_on_end(rest.shape, handle.part, frame)) axes.push_back(frame.w);
  } else {
    return {};
  }
  std::vector<Edit> result;
  for (const Eigen::Vector3d& axis : axes)
    result.push_back({handle, Move{unit_move * structure.diagonal * axis}, falloff});
  if (handle.kind != HandleKind::part) result.push_back({handle, Scale{unit_factor, std::nullopt}, falloff});
  if (handle.kind == HandleKind::part)
    for (const Eigen::Vector3d& axis : axes) result.push_back({handle, Scale{unit_factor, axis}, falloff});
  return result;
}

}  // namespace

namespace detail {

std::vector<MagnitudeEdit> merge_magnitude_edits(
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

std::vector<MagnitudeEdit> possible_edits(const std::vector<MagnitudeEdit>& edits,
                                          const DeformationModel& space, const Direction& direction,
                                          EditFamily family) {
  if (!space.capabilities().edits_primitives) return {};
  const StructuredShape& rest = space.rest();
  const std::vector<Handle> handles = space.handles();
  const Design design = space.at_rest();
  const ContactFrame frame =
      contact_frame({rest, space.capabilities(), handles, design, {}, direction}, tolerance::relative);
  std::vector<bool> stands_for_others(rest.structure.parts.size());
  for (const std::vector<int>& members : symmetric_classes(rest.structure))
    stands_for_others[static_cast<std::size_t>(members.front())] = true;
  const int body = round_body(design.primitives, frame);
  std::vector<MagnitudeEdit> result;
  if (family == EditFamily::smooth)
    for (const Edit& edit : tapers(frame, design.primitives, unit_factor))
      if (std::none_of(edits.begin(), edits.end(),
                       [&](const MagnitudeEdit& there) { return merge(there.edit, edit).has_value(); }))
        result.push_back({edit, std::nullopt});
  for (const Handle& handle : handles) {
    if (handle.kind == HandleKind::shape || !stands_for_others[static_cast<std::size_t>(handle.part)])
      continue;
    const Primitive& primitive = rest.structure.parts[static_cast<std::size_t>(handle.part)].primitive;
    for (const Edit& edit : edits_of(handle, rest, frame, body))
      if ((family != EditFamily::smooth || is_smooth(edit, primitive)) &&
          std::none_of(edits.begin(), edits.end(),
                       [&](const MagnitudeEdit& there) { return merge(there.edit, edit).has_value(); }))
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
  else if (auto* lean = std::get_if<Lean>(&edit.operation))
    lean->by *= x;
  else if (auto* taper = std::get_if<Taper>(&edit.operation)) {
    if (x != 1) taper->factor = std::pow(taper->factor, x);
  } else {
    auto& scale = std::get<Scale>(edit.operation);
    if (x != 1) scale.factor = std::pow(scale.factor, x);
  }
  return edit;
}

std::vector<Edit> merge_edits(const std::vector<Edit>& edits) {
  std::vector<Edit> result;
  for (const detail::MagnitudeEdit& one :
       detail::merge_magnitude_edits(edits, [](const auto&) { return true; }))
    result.push_back(one.edit);
  return result;
}

}  // namespace stackabilization
