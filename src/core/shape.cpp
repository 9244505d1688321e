#include "stackabilization/core/shape.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "core/extract_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/core/utf8.h"

namespace stackabilization {

Shape make_shape(Points vertices, Triangles triangles) {
  Shape shape;
  shape.triangle_part.assign(static_cast<std::size_t>(triangles.rows()), 0);
  shape.vertices = std::move(vertices);
  shape.triangles = std::move(triangles);
  shape.part_names = {"part"};
  validate(shape);
  return shape;
}

namespace {

void validate_parts(const Shape& shape) {
  if (shape.triangle_part.size() != static_cast<std::size_t>(shape.triangle_count()))
    throw InputError("the shape needs one part index per triangle");
  std::set<std::string> names;
  for (const std::string& name : shape.part_names) {
    if (name.empty()) throw InputError("a part has an empty name");
    if (!is_utf8(name)) throw InputError("the part name " + in_quotes(name) + " is not UTF-8");
    if (!names.insert(name).second) throw InputError("the part name '" + name + "' occurs twice");
  }
  for (std::size_t t = 0; t < shape.triangle_part.size(); ++t)
    if (shape.triangle_part[t] < 0 || shape.triangle_part[t] >= shape.part_count())
      throw InputError("triangle " + std::to_string(t) + " belongs to a part that does not exist");
}

/// Largest absolute coordinate of the vertex. `triangle` uses it.
double checked_magnitude(const Shape& shape, std::int32_t vertex, Eigen::Index triangle) {
  const auto fail = [&](const std::string& flaw) {
    throw InputError("vertex " + std::to_string(vertex) + " of triangle " + std::to_string(triangle) + " " +
                     flaw);
  };
  if (!shape.vertices.row(vertex).allFinite()) fail("has a coordinate that is not a finite number");
  const double magnitude = shape.vertices.row(vertex).cwiseAbs().maxCoeff();
  if (magnitude > tolerance::max_coordinate) fail("has a coordinate beyond 10^60, choose another unit");
  return magnitude;
}

}  // namespace

void validate(const Shape& shape) {
  if (shape.triangle_count() == 0) throw InputError("the shape has no triangles");
  double magnitude = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::int32_t vertex = shape.triangles(t, corner);
      if (vertex < 0 || vertex >= shape.vertex_count())
        throw InputError("triangle " + std::to_string(t) + " refers to vertex " + std::to_string(vertex) +
                         " of " + std::to_string(shape.vertex_count()));
      magnitude = std::max(magnitude, checked_magnitude(shape, vertex, t));
    }
  if (magnitude > 0 && magnitude < tolerance::min_shape_size)
    throw InputError("no coordinate of the shape exceeds 10^-60, choose another unit");
  validate_parts(shape);
}

namespace {

/// Returns the listed triangles with the vertices that they use, renumbered in their old order, as one part.
/// The cost is linear in the length of the list.
Shape subset(const Shape& shape, const std::vector<Eigen::Index>& triangles, const std::string& name) {
  std::vector<std::int32_t> used;
  used.reserve(3 * triangles.size());
  for (const Eigen::Index t : triangles)
    for (int corner = 0; corner < 3; ++corner) used.push_back(shape.triangles(t, corner));
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());

  Shape result;
  result.unit = shape.unit;
  result.vertices.resize(static_cast<Eigen::Index>(used.size()), 3);
  for (std::size_t v = 0; v < used.size(); ++v)
    result.vertices.row(static_cast<Eigen::Index>(v)) = shape.vertices.row(used[v]);
  result.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      result.triangles(static_cast<Eigen::Index>(i), corner) = static_cast<std::int32_t>(
          std::lower_bound(used.begin(), used.end(), shape.triangles(triangles[i], corner)) - used.begin());
  result.part_names = {name};
  result.triangle_part.assign(triangles.size(), 0);
  return result;
}

}  // namespace

Range range_along(const Shape& shape, const Eigen::Vector3d& axis) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const double along = axis.dot(shape.corner(t, corner));
      range.low = std::min(range.low, along);
      range.high = std::max(range.high, along);
    }
  return range;
}

Shape extract_part(const Shape& shape, Eigen::Index part) {
  if (part < 0 || part >= shape.part_count()) throw UsageError("there is no part " + std::to_string(part));
  std::vector<Eigen::Index> members;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (shape.triangle_part[static_cast<std::size_t>(t)] == part) members.push_back(t);
  return subset(shape, members, shape.part_names[static_cast<std::size_t>(part)]);
}

std::vector<Shape> extract_parts(const Shape& shape) {
  std::vector<std::vector<Eigen::Index>> members(shape.part_names.size());
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    members[static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)])].push_back(t);
  std::vector<Shape> parts;
  parts.reserve(members.size());
  for (std::size_t part = 0; part < members.size(); ++part)
    parts.push_back(subset(shape, members[part], shape.part_names[part]));
  return parts;
}

Shape concatenate(const Shape& a, const Shape& b) {
  if (a.vertex_count() + b.vertex_count() > std::numeric_limits<std::int32_t>::max())
    throw UsageError("the joined shape would have more vertices than can be indexed");
  Shape result = a;
  result.vertices.conservativeResize(a.vertex_count() + b.vertex_count(), 3);
  result.vertices.bottomRows(b.vertex_count()) = b.vertices;
  result.triangles.conservativeResize(a.triangle_count() + b.triangle_count(), 3);
  result.triangles.bottomRows(b.triangle_count()) =
      b.triangles.array() + static_cast<std::int32_t>(a.vertex_count());
  std::set<std::string> taken(a.part_names.begin(), a.part_names.end());
  for (const std::string& name : b.part_names) {
    std::string unique = name;
    for (int copy = 2; !taken.insert(unique).second; ++copy) unique = name + "_" + std::to_string(copy);
    result.part_names.push_back(unique);
  }
  for (const std::int32_t part : b.triangle_part)
    result.triangle_part.push_back(part + static_cast<std::int32_t>(a.part_count()));
  return result;
}

Shape transformed(const Shape& shape, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation) {
  if (!linear.allFinite() || !translation.allFinite()) throw UsageError("a transform needs finite numbers");
  Shape result = shape;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    result.vertices.row(v) = (linear * shape.vertices.row(v).transpose() + translation).transpose();
  return result;
}

double metres_per_unit(Unit unit) {
  switch (unit) {
    case Unit::micrometre:
      return 0.000001;
    case Unit::millimetre:
      return 0.001;
    case Unit::centimetre:
      return 0.01;
    case Unit::inch:
      return 0.0254;
    case Unit::foot:
      return 0.3048;
    case Unit::metre:
    case Unit::unknown:
      break;
  }
  return 1;
}

std::string unit_symbol(Unit unit) {
  switch (unit) {
    case Unit::micrometre:
      return "um";
    case Unit::millimetre:
      return "mm";
    case Unit::centimetre:
      return "cm";
    case Unit::inch:
      return "in";
    case Unit::foot:
      return "ft";
    case Unit::metre:
      return "m";
    case Unit::unknown:
      break;
  }
  return "";
}

}  // namespace stackabilization
