#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/triangle_tree.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct CellHeights {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double height) {
    low = std::min(low, height);
    high = std::max(high, height);
  }
};

using LocalTriangle = std::array<Eigen::Vector3d, 3>;

double cross2(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Heights over q of a triangle whose projection is a segment: both ends of the column it fills there.
CellHeights heights_of_vertical(const LocalTriangle& corners, const Eigen::Vector3d& q) {
  const auto [x_low, x_high] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x()});
  const auto [y_low, y_high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
  const int axis = x_high - x_low >= y_high - y_low ? 0 : 1;
  const double s = axis == 0 ? std::clamp(q.x(), x_low, x_high) : std::clamp(q.y(), y_low, y_high);
  CellHeights range;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = corners[static_cast<std::size_t>(k)];
    const Eigen::Vector3d& b = corners[static_cast<std::size_t>((k + 1) % 3)];
    if (std::min(a[axis], b[axis]) > s || std::max(a[axis], b[axis]) < s) continue;
    if (a[axis] == b[axis]) {
      range.add(a.z());
      range.add(b.z());
    } else {
      range.add(std::lerp(a.z(), b.z(), (s - a[axis]) / (b[axis] - a[axis])));
    }
  }
  return range;
}

/// Heights over q of a triangle that the vertical line through q is known to meet.
CellHeights heights_over(const LocalTriangle& corners, const Eigen::Vector3d& q) {
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0], aq = q - corners[0];
  const double area = cross2(ab, ac);
  const double span = std::max({std::abs(ab.x()), std::abs(ab.y()), std::abs(ac.x()), std::abs(ac.y())});
  const double magnitude = std::max({corners[0].norm(), corners[1].norm(), corners[2].norm()});
  // Below this the sign of the area is the rounding of the frame coordinates: the triangle is vertical for
  // all we know.
  if (std::abs(area) <= tolerance::product_rounding * magnitude * span)
    return heights_of_vertical(corners, q);
  const double height = corners[0].z() + (cross2(aq, ac) * ab.z() + cross2(ab, aq) * ac.z()) / area;
  const auto [low, high] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
  CellHeights range;
  range.add(std::clamp(height, low, high));
  return range;
}

/// Returns rows of triangles, ascending; of triangles with the same three points in any order, the first one.
/// This code is separate from that of separations, since rays check separations.
std::vector<std::int32_t> distinct_triangles(const Shape& shape) {
  std::vector<std::pair<std::array<std::array<double, 3>, 3>, std::int32_t>> triangles;
  triangles.reserve(static_cast<std::size_t>(shape.triangle_count()));
  for (std::int32_t t = 0; t < shape.triangle_count(); ++t) {
    std::array<std::array<double, 3>, 3> corners;
    for (int k = 0; k < 3; ++k)
      Eigen::Vector3d::Map(corners[static_cast<std::size_t>(k)].data()) = shape.corner(t, k);
    std::sort(corners.begin(), corners.end());
    triangles.emplace_back(corners, t);
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<std::int32_t> rows;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    if (k == 0 || triangles[k].first != triangles[k - 1].first) rows.push_back(triangles[k].second);
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::vector<std::int32_t> rows_of_tree(const Shape& shape) {
  validate(shape);
  std::vector<std::int32_t> rows = distinct_triangles(shape);
  std::erase_if(rows, [&](std::int32_t t) {
    return are_collinear(shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2));
  });
  return rows;
}

}  // namespace

struct RayCaster::Data {
  Shape shape;
  detail::TriangleTree<Kernel> tree;  ///< of triangles with area, of those with the same points one
  double diagonal = 0;

  explicit Data(const Shape& source) : shape(source), tree(shape, rows_of_tree(shape)) {
    if (tree.rows().empty()) return;
    const CGAL::Bbox_3 box = tree.box();
    diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  }
};

RayCaster::RayCaster(const Shape& shape) : data_(std::make_unique<const Data>(shape)) {}
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;
RayCaster::~RayCaster() = default;

HeightField RayCaster::cast(const Direction& direction, const Window& window, std::int64_t max_hits) const {
  const Data& data = *data_;
  HeightField field = empty_height_field(data.shape, direction, window);
  if (data.tree.rows().empty()) return field;

  std::vector<LocalTriangle> local(data.tree.rows().size());
  CellHeights range;
  for (std::size_t k = 0; k < local.size(); ++k)
    for (int corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d& p = local[k][static_cast<std::size_t>(corner)];
      p = field.frame.to_local(data.shape.corner(data.tree.rows()[k], corner));
      range.add(p.z());
    }

  std::atomic<std::int64_t> all_hits = 0;
  const auto cast_row = [&](int j, std::vector<std::size_t>& hits) {
    for (int i = 0; i < window.columns && all_hits <= max_hits; ++i) {
      const Eigen::Vector2d sample = window.sample(i, j);
      // Overshooting by the diagonal keeps the segment long, so rounding its ends barely tilts it.
      const Eigen::Vector3d bottom(sample.x(), sample.y(), range.low - data.diagonal);
      const Eigen::Vector3d top(sample.x(), sample.y(), range.high + data.diagonal);
      hits.clear();
      data.tree.append_met(Kernel::Segment_3(detail::to_cgal<Kernel>(field.frame.to_world(bottom)),
                                             detail::to_cgal<Kernel>(field.frame.to_world(top))),
                           hits);
      all_hits += static_cast<std::int64_t>(hits.size());
      CellHeights column;
      for (const std::size_t k : hits) {
        const CellHeights heights = heights_over(local[k], bottom);
        column.add(heights.low);
        column.add(heights.high);
      }
      field.upper(i, j) = column.high;
      field.lower(i, j) = column.low;
    }
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, window.rows), [&](const tbb::blocked_range<int>& rows) {
    std::vector<std::size_t> hits;
    for (int j = rows.begin(); j < rows.end(); ++j) cast_row(j, hits);
  });
  if (all_hits > max_hits)
    throw InputError("the rays meet more than " + std::to_string(max_hits) + " triangles");
  return field;
}

HeightField height_field_by_rays(const Shape& shape, const Direction& direction, const Window& window) {
  return RayCaster(shape).cast(direction, window);
}

}  // namespace stackabilization
