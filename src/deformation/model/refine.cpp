#include "stackabilization/deformation/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using Triangle = std::array<std::int32_t, 3>;

/// Bisection of edges, with midpoints shared by the triangles of an edge.
class Refinement {
 public:
  Refinement(const Shape& shape, double longest) : longest_(longest) {
    for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) vertices_.push_back(shape.vertices.row(v));
  }

  /// Appends the children of `triangle` after one bisection of its long edges: itself when it has none.
  void append_pieces(const Triangle& triangle, std::vector<Triangle>& out) {
    Triangle middle;  // midpoint of the edge after each corner; -1 where the edge is not cut
    for (std::size_t k = 0; k < 3; ++k) middle[k] = middle_of(triangle[k], triangle[(k + 1) % 3]);
    const auto cuts = std::count_if(middle.begin(), middle.end(), [](std::int32_t m) { return m >= 0; });
    // Start at the corner whose following edge is cut and, of two cut edges, whose preceding edge is not.
    std::size_t k = 0;
    while (cuts > 0 && cuts < 3 && !(middle[k] >= 0 && middle[(k + 2) % 3] < 0)) ++k;
    const std::int32_t a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
    const std::int32_t ab = middle[k], bc = middle[(k + 1) % 3], ca = middle[(k + 2) % 3];
    if (cuts == 0) {
      out.push_back(triangle);
    } else if (cuts == 1) {
      out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
    } else if (cuts == 2) {
      out.push_back({ab, b, bc});
      if (squared_length(a, bc) <= squared_length(ab, c))
        out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
      else
        out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
    } else {
      out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }

  const std::vector<Eigen::RowVector3d>& vertices() const { return vertices_; }

 private:
  double squared_length(std::int32_t a, std::int32_t b) const {
    return (vertices_[static_cast<std::size_t>(a)] - vertices_[static_cast<std::size_t>(b)]).squaredNorm();
  }

  std::int32_t middle_of(std::int32_t a, std::int32_t b) {
    if (!(squared_length(a, b) > longest_ * longest_)) return -1;
    const auto [known, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(vertices_.size()));
    if (is_new)
      vertices_.push_back((vertices_[static_cast<std::size_t>(a)] + vertices_[static_cast<std::size_t>(b)]) /
                          2);
    return known->second;
  }

  double longest_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles_;
};

}  // namespace

Shape refine(const Shape& shape, const RefineOptions& options) {
  validate(shape);
  if (!(std::isfinite(options.max_edge_length) && options.max_edge_length > 0))
    throw UsageError("the longest edge needs a positive number");
  const Points corners = shape.vertices(shape.triangles.reshaped(), Eigen::all);
  Refinement refinement(
      shape, options.max_edge_length * (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).norm());
  std::vector<Triangle> pending, next, done;
  std::vector<std::int32_t> parts;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    pending.assign(1, {shape.triangles(t, 0), shape.triangles(t, 1), shape.triangles(t, 2)});
    for (bool cut = true; cut; pending.swap(next)) {
      next.clear();
      for (const Triangle& triangle : pending) refinement.append_pieces(triangle, next);
      cut = next.size() > pending.size();
      if (static_cast<std::int64_t>(done.size() + next.size()) > options.max_triangles)
        throw UsageError("edges as short as that need more than " + std::to_string(options.max_triangles) +
                         " triangles");
    }
    done.insert(done.end(), pending.begin(), pending.end());
    parts.resize(done.size(), shape.triangle_part[static_cast<std::size_t>(t)]);
  }

  Shape out{Points(static_cast<Eigen::Index>(refinement.vertices().size()), 3),
            Triangles(static_cast<Eigen::Index>(done.size()), 3), shape.part_names, std::move(parts),
            shape.unit};
  for (Eigen::Index v = 0; v < out.vertex_count(); ++v)
    out.vertices.row(v) = refinement.vertices()[static_cast<std::size_t>(v)];
  for (Eigen::Index t = 0; t < out.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      out.triangles(t, k) = done[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
  return out;
}

}  // namespace stackabilization
