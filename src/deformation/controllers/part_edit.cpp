#include "deformation/controllers/part_edit.h"

#include <cmath>
#include <numeric>

#include "deformation/model/skinning.h"
#include "deformation/model/straight_curve.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

std::vector<int> all_points(const Primitive& primitive) {
  std::vector<int> points(static_cast<std::size_t>(control_points(primitive).rows()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

[[noreturn]] void no_handle(const std::string& part_name, const std::string& what) {
  throw UsageError("part '" + part_name + "' " + what);
}

int checked(int index, int count, const std::string& part_name, const std::string& what) {
  if (index < 0 || index >= count)
    no_handle(part_name, "has " + std::to_string(count) + " " + what + ", found " + std::to_string(index));
  return index;
}

/// Returns the control points that the handle holds.
std::vector<int> held_points(const Primitive& primitive, const Handle& handle, const std::string& part_name) {
  const bool cuboid = std::holds_alternative<Cuboid>(primitive);
  switch (handle.kind) {
    case HandleKind::part:
      return all_points(primitive);
    case HandleKind::face: {
      if (!cuboid) no_handle(part_name, "is a generalized cylinder: it has cross-sections, no faces");
      const std::array<int, 4> ring =
          cuboid_face(checked(handle.index, 6, part_name, "faces, numbered from 0"));
      return {ring.begin(), ring.end()};
    }
    case HandleKind::corner:
      if (!cuboid) no_handle(part_name, "is a generalized cylinder: it has cross-sections, no corners");
      return {checked(handle.index, 8, part_name, "corners, numbered from 0")};
    case HandleKind::section:
      if (cuboid) no_handle(part_name, "is a cuboid: it has faces and corners, no cross-sections");
      return {checked(handle.index, static_cast<int>(control_points(primitive).rows()), part_name,
                      "cross-sections, numbered from 0")};
    default:
      throw UsageError(
          "controllers have the shape, parts, faces, corners and cross-sections to take hold of");
  }
}

Eigen::Matrix3d linear_map(const Operation& operation) {
  if (const auto* rotate = std::get_if<Rotate>(&operation))
    return Eigen::AngleAxisd(rotate->radians, rotate->axis.normalized()).toRotationMatrix();
  const auto* scale = std::get_if<Scale>(&operation);
  if (scale == nullptr) return Eigen::Matrix3d::Identity();
  if (!scale->along) return scale->factor * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d axis = scale->along->normalized();
  return Eigen::Matrix3d::Identity() + (scale->factor - 1) * axis * axis.transpose();
}

void check_operation(const Edit& edit, const std::string& part_name) {
  const auto* scale = std::get_if<Scale>(&edit.operation);
  const bool move = std::holds_alternative<Move>(edit.operation);
  if (edit.handle.kind != HandleKind::part && scale != nullptr && scale->along)
    no_handle(part_name, "can be scaled along an axis only as a whole");
  if (edit.handle.kind == HandleKind::corner && !move)
    no_handle(part_name, "has corners that can only be moved");
  if (edit.handle.kind == HandleKind::section && !move && scale == nullptr)
    no_handle(part_name, "has cross-sections that can be moved and scaled, not turned");
}

void prescribe(PartEdit& edit, int value, double change) {
  edit.values.push_back(value);
  edit.changes.conservativeResize(edit.changes.size() + 1);
  edit.changes(edit.changes.size() - 1) = change;
}

struct PlacedOperation {
  const Operation& operation;
  Eigen::Vector3d centre;
};

/// How a leaning changes a part.
struct Leaning {
  Points changes;                                            ///< of the control points
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< from the axis to where it leans
};

Leaning leaning(const Points& points, const Lean& lean) {
  const Eigen::Vector3d axis = lean.axis.normalized();
  Eigen::VectorXd shares = points * axis;
  const double low = shares.minCoeff(), range = shares.maxCoeff() - low;
  if (!(range > 0)) return {Points::Zero(points.rows(), 3)};
  shares = (shares.array() - low) / range;
  return {shares * lean.by.transpose(), smallest_rotation(axis, (range * axis + lean.by).normalized())};
}

void prescribe_points(PartEdit& edit, const Primitive& now, const std::vector<int>& held,
                      const PlacedOperation& placed) {
  const Points points = control_points(now);
  const Eigen::Matrix3d linear = linear_map(placed.operation);
  Points changes =
      (points.rowwise() - placed.centre.transpose()) * (linear - Eigen::Matrix3d::Identity()).transpose();
  if (const auto* move = std::get_if<Move>(&placed.operation)) changes.rowwise() = move->by.transpose();
  if (const auto* lean = std::get_if<Lean>(&placed.operation)) changes = leaning(points, *lean).changes;
  for (const int i : held)
    for (int k = 0; k < 3; ++k) prescribe(edit, 3 * i + k, changes(i, k));
}

/// Returns whether a bar of constant section would be bent to this curve: a handle, a frame.
bool is_bent_bar(const GeneralizedCylinder& cylinder) {
  return !cylinder.closed && !is_straight(cylinder);
}

PartEdit of_whole(const Primitive& now, const Operation& operation, int part, const Eigen::Vector3d& centre,
                  Following following) {
  PartEdit result;
  result.part = part;
  result.leans = std::holds_alternative<Lean>(operation);
  prescribe_points(result, now, all_points(now), {operation, centre});
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&now);
  if (cylinder == nullptr) return result;
  const Eigen::Matrix3d linear = linear_map(operation);
  if (std::holds_alternative<Rotate>(operation)) result.rotation = Eigen::Quaterniond(linear);
  if (const auto* lean = std::get_if<Lean>(&operation))
    result.rotation = leaning(cylinder->centres, *lean).turn;
  const auto n = static_cast<int>(cylinder->radii.size());
  const auto* scale = std::get_if<Scale>(&operation);
  const bool keeps_sections =
      scale == nullptr || (scale->along && following == Following::smooth && is_bent_bar(*cylinder));
  const Eigen::VectorXd factors =
      keeps_sections ? Eigen::VectorXd::Ones(n) : radius_factors(*cylinder, linear);
  for (int i = 0; i < n; ++i) prescribe(result, 3 * n + i, (factors(i) - 1) * cylinder->radii(i));
  return result;
}

}  // namespace

std::vector<Handle> handles_of(int part, const Primitive& primitive) {
  std::vector<Handle> handles = {{HandleKind::part, part, 0}};
  const bool cuboid = std::holds_alternative<Cuboid>(primitive);
  if (cuboid)
    for (int face = 0; face < 6; ++face) handles.push_back({HandleKind::face, part, face});
  for (const int i : all_points(primitive))
    handles.push_back({cuboid ? HandleKind::corner : HandleKind::section, part, i});
  return handles;
}

Eigen::Vector3d handle_centre(const Primitive& primitive, const Handle& handle,
                              const std::string& part_name) {
  const Points points = control_points(primitive);
  const std::vector<int> held = held_points(primitive, handle, part_name);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int i : held) sum += points.row(i).transpose();
  return sum / static_cast<double>(held.size());
}

Eigen::Vector3d shape_centre(const std::vector<Primitive>& primitives) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Index count = 0;
  for (const Primitive& primitive : primitives) {
    const Points points = control_points(primitive);
    sum += points.colwise().sum().transpose();
    count += points.rows();
  }
  return sum / static_cast<double>(count);
}

Eigen::VectorXd radius_factors(const GeneralizedCylinder& cylinder, const Eigen::Matrix3d& linear) {
  const Points tangents = section_tangents(cylinder);
  Eigen::Matrix3d cofactors;
  for (int k = 0; k < 3; ++k) cofactors.col(k) = linear.col((k + 1) % 3).cross(linear.col((k + 2) % 3));
  Eigen::VectorXd factors(tangents.rows());
  for (Eigen::Index i = 0; i < tangents.rows(); ++i)
    factors(i) = std::sqrt((cofactors * tangents.row(i).transpose()).norm());
  return factors;
}

PartEdit edit_handle(const Primitive& now, const Edit& edit, const std::string& part_name,
                     Following following) {
  const std::vector<int> held = held_points(now, edit.handle, part_name);
  check_operation(edit, part_name);
  const Eigen::Vector3d centre = handle_centre(now, edit.handle, part_name);
  if (edit.handle.kind == HandleKind::part)
    return of_whole(now, edit.operation, edit.handle.part, centre, following);
  PartEdit result;
  result.part = edit.handle.part;
  const auto* curve = std::get_if<GeneralizedCylinder>(&now);
  if (curve && !curve->closed && edit.falloff == Falloff::linear) result.linear_from = held.front();
  if (const auto* scale = std::get_if<Scale>(&edit.operation);
      scale && edit.handle.kind == HandleKind::section) {
    prescribe(result, 3 * static_cast<int>(curve->centres.rows()) + held.front(),
              (scale->factor - 1) * curve->radii(held.front()));
  } else {
    prescribe_points(result, now, held, {edit.operation, centre});
  }
  return result;
}

std::vector<PartEdit> edit_handle(const std::vector<Primitive>& now, const Operation& operation,
                                  Following following) {
  const Eigen::Vector3d centre = shape_centre(now);
  std::vector<PartEdit> edits;
  for (std::size_t part = 0; part < now.size(); ++part)
    edits.push_back(of_whole(now[part], operation, static_cast<int>(part), centre, following));
  return edits;
}

Primitive changed(Primitive primitive, const PartEdit& edit) {
  const auto change = [&](auto& points, Eigen::VectorXd* radii) {
    const auto count = static_cast<int>(3 * points.rows());
    for (std::size_t i = 0; i < edit.values.size(); ++i) {
      const int value = edit.values[i];
      const double by = edit.changes(static_cast<Eigen::Index>(i));
      if (value < count)
        points(value / 3, value % 3) += by;
      else
        (*radii)(value - count) += by;
    }
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    change(cuboid->corners, nullptr);
  } else {
    auto& cylinder = std::get<GeneralizedCylinder>(primitive);
    change(cylinder.centres, &cylinder.radii);
    cylinder.rotation = edit.rotation * cylinder.rotation;
  }
  return primitive;
}

}  // namespace stackabilization::detail
