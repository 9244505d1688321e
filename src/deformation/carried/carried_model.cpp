#include "stackabilization/deformation/carried_model.h"

#include <utility>

#include "core/bounding_diagonal.h"
#include "deformation/carried/carried_primitives.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Returns the lengths of the three sides of a triangle.
Eigen::Array3d side_lengths(const Points& vertices, const Triangles& triangles, Eigen::Index triangle) {
  Eigen::Array3d lengths;
  for (int k = 0; k < 3; ++k)
    lengths(k) =
        (vertices.row(triangles(triangle, k)) - vertices.row(triangles(triangle, (k + 1) % 3))).norm();
  return lengths;
}

/// Returns the first triangle of which a side has shrunk, compared with its other sides, to less than
/// tolerance::collapse of what it was.
std::optional<Refusal> collapsed_triangle(const Shape& rest, const Points& vertices) {
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t) {
    const Eigen::Array3d before = side_lengths(rest.vertices, rest.triangles, t);
    if (before.minCoeff() <= tolerance::relative * before.maxCoeff()) continue;
    const Eigen::Array3d factors = side_lengths(vertices, rest.triangles, t) / before;
    if (!(factors.minCoeff() >= tolerance::collapse * factors.maxCoeff()))
      return Refusal{.cause = RefusalCause::collapsed_triangle, .index = static_cast<int>(t)};
  }
  return std::nullopt;
}

}  // namespace

struct CarriedModel::Data {
  explicit Data(StructuredShape structured) : rest(std::move(structured)), primitives(rest) {}

  StructuredShape rest;
  detail::CarriedPrimitives primitives;
};

StructuredShape unstructured(Shape shape) {
  validate(shape);
  StructuredShape result{std::move(shape), {}};
  result.structure.diagonal = bounding_diagonal(result.shape);
  return result;
}

CarriedModel::CarriedModel(StructuredShape rest) : data_(std::make_shared<const Data>(std::move(rest))) {}

const StructuredShape& CarriedModel::rest() const {
  return data_->rest;
}

DeformationResult CarriedModel::edited(const Design& now, const Edit& edit,
                                       const DeformationConstraints& constraints) const {
  std::vector<Edit> edits = now.edits;
  edits.push_back(edit);
  MovedVertices moved = this->moved(edits, constraints);
  if (!moved.refusal) moved.refusal = collapsed_triangle(data_->rest.shape, moved.vertices);
  if (moved.refusal) return {std::move(moved.refusal), now};
  DeformationResult result{std::nullopt, {std::move(edits), data_->primitives.at(moved.vertices), now.shape}};
  result.design.shape.vertices = std::move(moved.vertices);
  return result;
}

}  // namespace stackabilization
