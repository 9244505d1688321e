#include "io/formats/shape_builder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/formats/triangulate.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

constexpr std::size_t max_indices = std::numeric_limits<std::int32_t>::max();

/// Cutting a polygon by ears is quadratic; this keeps the worst file within seconds.
constexpr std::size_t max_corners = 100000;

}  // namespace

void ShapeBuilder::reserve(std::size_t vertices, std::size_t faces) {
  coordinates_.reserve(3 * vertices);
  corners_.reserve(3 * faces);
  face_sizes_.reserve(faces);
  face_parts_.reserve(faces);
}

std::int32_t ShapeBuilder::add_vertex(double x, double y, double z) {
  const std::size_t index = coordinates_.size() / 3;
  if (index >= max_indices) throw InputError(name_ + " has more vertices than can be indexed");
  coordinates_.insert(coordinates_.end(), {x, y, z});
  return static_cast<std::int32_t>(index);
}

void ShapeBuilder::continue_part(const std::string& name) {
  open_name_ = name.empty() ? "part" : name;
  open_as_new_ = false;
  open_part_ = -1;
}

void ShapeBuilder::begin_part(const std::string& name) {
  continue_part(name);
  open_as_new_ = true;
}

std::int32_t ShapeBuilder::current_part() {
  if (open_part_ >= 0) return open_part_;
  std::string unique = open_name_;
  if (open_as_new_)
    while (part_of_name_.contains(unique))
      unique = open_name_ + "_" + std::to_string(++copies_of_name_[open_name_] + 1);
  const auto [entry, is_new] =
      part_of_name_.try_emplace(unique, static_cast<std::int32_t>(part_names_.size()));
  if (is_new) part_names_.push_back(unique);
  return open_part_ = entry->second;
}

void ShapeBuilder::add_face(std::span<const std::int32_t> corners) {
  if (corners.size() > max_corners)
    throw InputError(name_ + ": face " + std::to_string(face_count()) + " has " +
                     std::to_string(corners.size()) + " corners, expected at most " +
                     std::to_string(max_corners));
  if (corners_.size() + corners.size() > max_indices)
    throw InputError(name_ + " has more faces than can be indexed");
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  face_sizes_.push_back(static_cast<std::int32_t>(corners.size()));
  face_parts_.push_back(current_part());
}

Shape ShapeBuilder::finish() {
  if (face_sizes_.empty())
    throw InputError(
        name_ + (coordinates_.empty() ? " holds no mesh: it has no faces" : " holds points but no faces"));
  Shape shape;
  shape.vertices = Eigen::Map<const Points>(coordinates_.data(), vertex_count(), 3);
  coordinates_ = {};
  const std::size_t triangle_count = corners_.size() - 2 * face_sizes_.size();
  shape.triangles.resize(static_cast<Eigen::Index>(triangle_count), 3);
  shape.triangle_part.reserve(triangle_count);
  shape.part_names = std::move(part_names_);

  std::int32_t* next_triangle = shape.triangles.data();
  const std::int32_t* corner = corners_.data();
  for (std::size_t face = 0; face < face_sizes_.size(); ++face) {
    const auto size = static_cast<std::size_t>(face_sizes_[face]);
    const std::span<const std::int32_t> polygon(corner, size);
    if (size == 3)
      next_triangle = std::copy(polygon.begin(), polygon.end(), next_triangle);
    else
      for (const auto& triangle : triangulate(shape.vertices, polygon))
        next_triangle = std::copy(triangle.begin(), triangle.end(), next_triangle);
    shape.triangle_part.insert(shape.triangle_part.end(), size - 2, face_parts_[face]);
    corner += size;
  }
  return shape;
}

}  // namespace stackabilization
