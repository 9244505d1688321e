#include "deformation/arap/stitching_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "mesh/barycentric.h"
#include "mesh/surface_index.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

struct Shell {
  Shape surface;        ///< triangles with area; each has its own three vertices
  Triangles triangles;  ///< the same triangles, as rows of the welded vertices
  Eigen::AlignedBox3d box;
  std::optional<SurfaceIndex> index;
};

Shell shell_of(const WeldedMesh& places, const std::vector<Eigen::Index>& rows) {
  Shell shell;
  shell.triangles = places.triangles(rows, Eigen::all);
  const std::vector<std::int32_t> corners(shell.triangles.data(),
                                          shell.triangles.data() + shell.triangles.size());
  shell.surface.vertices = places.points(corners, Eigen::all);
  shell.surface.triangles.resize(shell.triangles.rows(), 3);
  for (std::int32_t k = 0; k < shell.surface.triangles.size(); ++k) {
    shell.surface.triangles(k / 3, k % 3) = k;
    shell.box.extend(shell.surface.vertices.row(k).transpose());
  }
  if (!rows.empty()) shell.index.emplace(shell.surface);
  return shell;
}

std::vector<Shell> separated(const WeldedMesh& places, const std::vector<std::int32_t>& shells) {
  std::vector<std::vector<Eigen::Index>> rows(
      static_cast<std::size_t>(*std::max_element(shells.begin(), shells.end())) + 1);
  for (Eigen::Index t = 0; t < places.triangles.rows(); ++t)
    if (places.area(t) > 0)
      rows[static_cast<std::size_t>(shells[static_cast<std::size_t>(places.triangles(t, 0))])].push_back(t);
  std::vector<Shell> out;
  for (const std::vector<Eigen::Index>& shell : rows) out.push_back(shell_of(places, shell));
  return out;
}

}  // namespace

std::vector<StitchingEdge> stitching_edges(const WeldedMesh& places, const std::vector<std::int32_t>& shells,
                                           double reach) {
  std::vector<StitchingEdge> stitches;
  if (std::all_of(shells.begin(), shells.end(), [](std::int32_t shell) { return shell == 0; }))
    return stitches;
  const std::vector<Shell> separate = separated(places, shells);
  for (std::size_t p = 0; p < shells.size(); ++p) {
    const Eigen::Vector3d point = places.points.row(static_cast<Eigen::Index>(p));
    for (std::size_t s = 0; s < separate.size(); ++s) {
      const Shell& other = separate[s];
      if (!other.index || static_cast<std::size_t>(shells[p]) == s ||
          other.box.exteriorDistance(point) > reach)
        continue;
      const SurfacePoint nearest = other.index->nearest(point);
      if (nearest.distance > reach) continue;
      const Eigen::Vector3d weights = barycentric_weights(other.surface, nearest.triangle, nearest.point);
      for (int k = 0; k < 3; ++k)
        if (weights(k) > tolerance::relative)
          stitches.push_back(
              {static_cast<std::int32_t>(p), other.triangles(nearest.triangle, k), weights(k)});
    }
  }
  return stitches;
}

}  // namespace stackabilization::detail
