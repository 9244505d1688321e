#define BOOST_ALLOW_DEPRECATED_HEADERS  // of which Boost.Geometry 1.74 itself includes one
#include "stackabilization/deformation/gap_scaling.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "deformation/model/vertex_constraints.h"
#include "mesh/clip.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

namespace {

namespace index = boost::geometry::index;
using PlanePoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using PlaneBox = boost::geometry::model::box<PlanePoint>;
using Entry = std::pair<PlaneBox, Eigen::Index>;
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Heights that triangles reach in narrow columns along the third axis. Rays would miss walls that are
/// upright but for rounding.
class Columns {
 public:
  Columns(const Points& points, const Triangles& triangles, double half_width)
      : points_(points), triangles_(triangles), half_width_(half_width) {
    std::vector<Entry> entries;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      const Eigen::Matrix3d corners = points({triangles(t, 0), triangles(t, 1), triangles(t, 2)}, Eigen::all);
      const Eigen::RowVector3d low = corners.colwise().minCoeff(), high = corners.colwise().maxCoeff();
      entries.emplace_back(PlaneBox({low(0), low(1)}, {high(0), high(1)}), t);
    }
    tree_ = Tree(entries);
  }

  /// Returns the height of the highest point of the triangles within half the width of point `row`, not below
  /// that point.
  double top(Eigen::Index row) const {
    const Eigen::Vector3d q = points_.row(row);
    double top = q.z();
    const PlaneBox column({q.x() - half_width_, q.y() - half_width_},
                          {q.x() + half_width_, q.y() + half_width_});
    tree_.query(index::intersects(column), boost::make_function_output_iterator([&](const Entry& entry) {
                  std::vector<Eigen::Vector3d> polygon;
                  for (int k = 0; k < 3; ++k) polygon.push_back(points_.row(triangles_(entry.second, k)));
                  for (int axis = 0; axis < 2; ++axis) {
                    const double low = q(axis) - half_width_, high = q(axis) + half_width_;
                    polygon = detail::clipped(polygon, [&](const auto& p) { return high - p(axis); });
                    polygon = detail::clipped(polygon, [&](const auto& p) { return p(axis) - low; });
                  }
                  for (const Eigen::Vector3d& p : polygon) top = std::max(top, p.z());
                }));
    return top;
  }

 private:
  using Tree = index::rtree<Entry, index::quadratic<16>>;

  const Points& points_;
  const Triangles& triangles_;
  double half_width_;
  Tree tree_;
};

class GapScaling : public CarriedModel {
 public:
  GapScaling(StructuredShape structured, const Direction& direction);

  DeformationKind kind() const override { return DeformationKind::gap_scaling; }
  std::vector<Handle> handles() const override { return {{HandleKind::shape, 0, 0}}; }
  Eigen::Vector3d centre(const Handle& handle) const override {
    require_shape(handle);
    return centre_;
  }

 private:
  MovedVertices moved(const std::vector<Edit>& edits,
                      const DeformationConstraints& constraints) const override;
  static void require_shape(const Handle& handle) {
    if (handle.kind != HandleKind::shape)
      throw UsageError("the gap function can be scaled for the shape as a whole only");
  }
  double factor_of(const Edit& edit) const;

  Eigen::Vector3d up_, centre_;
  /// Depth of each vertex below the upper envelope, model units; 0 for vertices that no triangle uses.
  Eigen::VectorXd depth_;
};

GapScaling::GapScaling(StructuredShape structured, const Direction& direction)
    : CarriedModel(std::move(structured)),
      up_(direction.unit()),
      depth_(Eigen::VectorXd::Zero(rest().shape.vertex_count())) {
  const detail::WeldedMesh places = detail::weld(rest().shape);
  const OrientedBox box = axis_aligned_box(places.points);
  centre_ = box.centre;
  const Frame frame = frame_of(direction);
  Eigen::Matrix3d axes;
  axes << frame.u, frame.v, frame.w;
  const Points local = (places.points.rowwise() - centre_.transpose()) * axes;
  const Columns columns(local, places.triangles, tolerance::rounding * places.points.cwiseAbs().maxCoeff());
  Eigen::VectorXd depths(local.rows());
  // A vertex is on the envelope (depth 0) when its depth is within rounding and within the slope across the
  // width of the column.
  const double none = tolerance::relative * 2 * box.half_extents.norm();
  tbb::parallel_for(Eigen::Index{0}, local.rows(), [&](Eigen::Index p) {
    const double depth = columns.top(p) - local(p, 2);
    depths(p) = depth > none ? depth : 0;
  });
  for (std::size_t v = 0; v < places.of_vertex.size(); ++v)
    if (places.of_vertex[v] >= 0) depth_(static_cast<Eigen::Index>(v)) = depths(places.of_vertex[v]);
}

double GapScaling::factor_of(const Edit& edit) const {
  validate(edit);
  require_shape(edit.handle);
  const Scale* scale = std::get_if<Scale>(&edit.operation);
  if (!scale || !scale->along || scale->along->normalized().cross(up_).norm() > tolerance::relative)
    throw UsageError("the gap function can be scaled along its own direction only");
  return scale->factor;
}

MovedVertices GapScaling::moved(const std::vector<Edit>& edits,
                                const DeformationConstraints& constraints) const {
  double factor = 1;
  for (const Edit& edit : edits) factor *= factor_of(edit);
  const Shape& shape = rest().shape;
  Points vertices = shape.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    if (depth_(v) > 0) vertices.row(v) += (1 - factor) * depth_(v) * up_.transpose();
  return constrain(shape, std::move(vertices), constraints, fixed_vertices(shape, constraints));
}

}  // namespace

std::unique_ptr<DeformationModel> gap_scaling(StructuredShape rest, const Direction& direction) {
  validate(rest.shape);
  return std::make_unique<GapScaling>(std::move(rest), direction);
}

}  // namespace stackabilization
