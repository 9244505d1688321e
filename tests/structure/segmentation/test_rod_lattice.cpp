#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/rod_lattice.h"
#include "structure/segmentation/surface_graph.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

/// Two layers of rods of length 1, `count` each, that cross at right angles and touch; `thickness` thick.
Shape grid_of_rods(int count, double thickness) {
  Shape shape;
  for (int layer = 0; layer < 2; ++layer)
    for (int k = 0; k < count; ++k) {
      const double at = (k + 0.5) / count;
      Eigen::Vector3d low(0, at - thickness / 2, layer * thickness),
          high(1, at + thickness / 2, (layer + 1) * thickness);
      if (layer == 1) {
        std::swap(low.x(), low.y());
        std::swap(high.x(), high.y());
      }
      const Shape rod = solids::box(low, high);
      shape = shape.triangle_count() == 0 ? rod : concatenate(shape, rod);
    }
  shape.part_names = {"mesh"};
  shape.triangle_part.assign(shape.triangle_part.size(), 0);
  return shape;
}

/// Two rails and `count` rungs between them.
Shape ladder(int count) {
  Shape shape =
      concatenate(solids::box({0, 0, 0}, {0.02, 0.02, 1}), solids::box({0.3, 0, 0}, {0.32, 0.02, 1}));
  for (int k = 0; k < count; ++k) {
    const double z = (k + 0.5) / count;
    shape = concatenate(shape, solids::box({0.02, 0.005, z}, {0.3, 0.015, z + 0.01}));
  }
  shape.part_names = {"mesh"};
  shape.triangle_part.assign(shape.triangle_part.size(), 0);
  return shape;
}

bool is_net(const Shape& shape, const RodLatticeRule& rule = {}) {
  return is_rod_lattice(shape, connected_components(weld(shape)), rule);
}

}  // namespace

TEST_CASE("rods that cross eight others in the mean are a net, fewer are none") {
  CHECK(is_net(grid_of_rods(8, 0.01)));
  CHECK_FALSE(is_net(grid_of_rods(7, 0.01)));
  RodLatticeRule seven;
  seven.min_crossings = 7;
  CHECK(is_net(grid_of_rods(7, 0.01), seven));
  seven.min_wires = 15;
  CHECK_FALSE(is_net(grid_of_rods(7, 0.01), seven));
}

TEST_CASE("thick rods and the rungs of a ladder are parts of their own") {
  CHECK_FALSE(is_net(grid_of_rods(8, 0.06)));
  CHECK_FALSE(is_net(ladder(24)));
}

TEST_CASE("a net is one in every pose and at every scale, cut as finely as you like") {
  Shape net = grid_of_rods(9, 0.01);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Shape posed = net;
    posed.vertices = scale * net.vertices * turn.transpose();
    CHECK(is_net(posed));
  }
}

TEST_CASE("automatic segmentation leaves a net whole and takes a ladder apart") {
  const Shape net = segment(grid_of_rods(9, 0.01));
  CHECK(net.part_names == std::vector<std::string>{"mesh"});
  SegmentationOptions components;
  components.method = SegmentationMethod::components;
  CHECK(segment(grid_of_rods(9, 0.01), components).part_count() == 18);
  CHECK(segment(ladder(24)).part_count() == 26);
}
