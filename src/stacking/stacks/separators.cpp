#include "stackabilization/stacking/separators.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/bounding_diagonal.h"
#include "envelope/contacts/planar_union.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Collects prisms between polygons on a copy and the same columns on the copy above.
class PrismBuilder {
 public:
  /// Polygons of at most `no_area`, such as those of walls that rounding tilts, have no prism.
  PrismBuilder(const Direction& direction, double lift, double no_area)
      : frame_(frame_of(direction)), lift_(lift * frame_.w.transpose()), no_area_(no_area) {}

  /// The next prism begins a new part.
  void begin_part() { new_part_ = true; }

  void add(const ContactPolygon& polygon) {
    const double area = signed_area(outline_of(polygon.upper_points, frame_));
    if (std::abs(area) <= no_area_) return;
    if (new_part_) shape_.part_names.push_back("region_" + std::to_string(shape_.part_names.size() + 1));
    new_part_ = false;
    const auto count = static_cast<std::int32_t>(polygon.upper_points.rows());
    const auto first = static_cast<std::int32_t>(corners_.size());
    for (std::int32_t k = 0; k < count; ++k)
      corners_.emplace_back(polygon.upper_points.row(area > 0 ? k : count - 1 - k));
    for (std::int32_t k = 0; k < count; ++k)
      corners_.emplace_back(polygon.lower_points.row(area > 0 ? k : count - 1 - k) + lift_);
    for (std::int32_t k = 2; k < count; ++k) {
      add_triangle(first, first + k, first + k - 1);
      add_triangle(first + count, first + count + k - 1, first + count + k);
    }
    for (std::int32_t k = 0; k < count; ++k) {
      const std::int32_t next = (k + 1) % count;
      add_triangle(first + k, first + next, first + count + next);
      add_triangle(first + k, first + count + next, first + count + k);
    }
  }

  Shape result(Unit unit) && {
    shape_.unit = unit;
    shape_.vertices.resize(static_cast<Eigen::Index>(corners_.size()), 3);
    for (std::size_t k = 0; k < corners_.size(); ++k)
      shape_.vertices.row(static_cast<Eigen::Index>(k)) = corners_[k];
    shape_.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      shape_.triangles.row(static_cast<Eigen::Index>(t)) = triangles_[t];
    return std::move(shape_);
  }

 private:
  void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    triangles_.emplace_back(a, b, c);
    shape_.triangle_part.push_back(static_cast<std::int32_t>(shape_.part_names.size()) - 1);
  }

  Frame frame_;
  Eigen::RowVector3d lift_;
  double no_area_;
  bool new_part_ = true;
  Shape shape_;
  std::vector<Eigen::RowVector3d> corners_;
  std::vector<Eigen::Matrix<std::int32_t, 1, 3>> triangles_;
};

}  // namespace

Shape separators(const Shape& shape, const Direction& direction, const SeparatorOptions& options) {
  if (!(options.layer > 0)) throw UsageError("separators need a layer thicker than 0");
  const SeparationTree tree(shape);
  const Separation found =
      separation(tree, tree, direction, {.semantics = options.semantics, .abandon_above = std::nullopt});
  if (found.blocked && !(options.lift > found.length))
    throw UsageError("separators need a lift above f_max, which leaves a gap");
  ContactOptions contact;
  contact.semantics = options.semantics;
  const double extent = range_along(shape, direction.unit()).length();
  contact.band = extent > 0 ? std::min(1.0, options.layer / extent) : 1;
  PrismBuilder prisms(direction, options.lift, tolerance::relative * std::pow(bounding_diagonal(shape), 2));
  for (const ContactRegion& region : contact_regions({shape, tree, direction, found}, contact).regions) {
    prisms.begin_part();
    for (const ContactPolygon& polygon : region.polygons) prisms.add(polygon);
  }
  return std::move(prisms).result(shape.unit);
}

}  // namespace stackabilization
