#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/gauss_arcs.h"
#include "support/catch.h"
#include "support/point_sets.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

std::vector<GaussArc> all_arcs(const HullSupport& hull) {
  return gauss_arcs(hull, [](const Eigen::Vector3d&) { return true; });
}

bool lies_within(const GaussArc& arc, const GaussArcTree::Node& node) {
  for (int k = 0; k <= 8; ++k)
    if (std::acos(std::clamp(arc.normal(arc.length * k / 8).dot(node.centre), -1.0, 1.0)) >
        node.radius + 1e-7)
      return false;
  return true;
}

}  // namespace

TEST_CASE("an arc joins the normals of two faces, or their opposites, and a hull edge supports all of it") {
  for (const Points& points : {point_sets::in_ball(40, 3), point_sets::box({1, 2, 3})}) {
    const HullSupport hull(points);
    const std::vector<GaussArc> arcs = all_arcs(hull);
    REQUIRE(static_cast<Eigen::Index>(arcs.size()) == hull.edges().rows());
    for (std::size_t e = 0; e < arcs.size(); ++e) {
      const GaussArc& arc = arcs[e];
      const Eigen::Vector3d from = hull.face_normals().row(arc.from), to = hull.face_normals().row(arc.to);
      const double sign = arc.start.dot(from) > 0 ? 1 : -1;
      CHECK(arc.start.isApprox(sign * from, 1e-12));
      CHECK(arc.normal(arc.length).isApprox(sign * to, 1e-9));
      const Eigen::VectorXd heights = hull.heights_along(sign * arc.normal(arc.length / 3));
      for (int end = 0; end < 2; ++end)
        CHECK(heights[hull.edges()(static_cast<Eigen::Index>(e), end)] == Approx(heights.maxCoeff()));
    }
  }
}

TEST_CASE("the arcs within 45 degrees of one axis are needless") {
  // A quarter circle between two axes leaves the 45 degrees around each of them in its middle.
  const HullSupport cube(point_sets::box({1, 1, 1}));
  CHECK(without_needless_arcs(all_arcs(cube), Eigen::Matrix3d::Identity()).size() == 12);
  // The double cone takes 1 - cos 45 of the sphere.
  const HullSupport ball(point_sets::on_sphere(2000, 4));
  const std::vector<GaussArc> arcs = all_arcs(ball),
                              left = without_needless_arcs(arcs, Eigen::Matrix3d::Identity());
  const double share = static_cast<double>(left.size()) / static_cast<double>(arcs.size());
  CHECK(share == Approx(std::numbers::sqrt2 / 2).margin(0.05));
}

TEST_CASE("a node of a tree of arcs holds those below it, and each arc is in one leaf") {
  const HullSupport hull(point_sets::in_ball(60, 8));
  const std::vector<GaussArc> arcs = all_arcs(hull);
  const GaussArcTree tree(arcs);
  std::vector<std::vector<int>> below(tree.nodes().size());
  std::vector<int> leaves(arcs.size());
  for (std::size_t n = tree.nodes().size(); n-- > 0;) {  // children follow their parents
    const GaussArcTree::Node& node = tree.nodes()[n];
    if (node.arc >= 0) {
      below[n] = {node.arc};
      ++leaves[static_cast<std::size_t>(node.arc)];
    } else {
      for (const int child : {node.left, node.right}) {
        const std::vector<int>& arcs_of_child = below[static_cast<std::size_t>(child)];
        below[n].insert(below[n].end(), arcs_of_child.begin(), arcs_of_child.end());
      }
    }
    for (const int arc : below[n]) CHECK(lies_within(arcs[static_cast<std::size_t>(arc)], node));
  }
  CHECK(below.front().size() == arcs.size());
  CHECK(std::all_of(leaves.begin(), leaves.end(), [](int count) { return count == 1; }));
  CHECK(GaussArcTree({}).nodes().empty());
}
