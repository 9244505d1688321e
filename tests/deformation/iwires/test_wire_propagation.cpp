#include <algorithm>
#include <cmath>
#include <limits>

#include "deformation/iwires/wire_propagation.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization::wire_propagation_test {

using namespace detail;

namespace {

const Eigen::Vector3d size(1, 2, 3);
const Shape box = solids::box(-size / 2, size / 2);

WireNetwork network_of(const Shape& shape, const std::vector<Symmetry>& symmetries = {}) {
  WireAnalysisOptions options;
  options.symmetries = symmetries;
  return wire_network(shape, analysed_wires(shape, feature_curves(shape), options), 0, 1e-6);
}

WireMaps rest_of(const WireNetwork& network) {
  return WireMaps(network.structure.wires.size(), Eigen::Affine3d::Identity());
}

int wire_at(const WireNetwork& network, const Eigen::Vector3d& centre) {
  const auto& wires = network.structure.wires;
  const auto nearest = std::min_element(wires.begin(), wires.end(), [&](const Wire& a, const Wire& b) {
    return (a.centre - centre).norm() < (b.centre - centre).norm();
  });
  return static_cast<int>(nearest - wires.begin());
}

WireEdit moved(int wire, const Eigen::Vector3d& by) {
  return {.wire = wire, .motion = WireMotion::move, .by = by};
}
WireEdit scaled(int wire, double factor) {
  return {.wire = wire, .motion = WireMotion::scale, .factor = factor};
}

std::vector<Eigen::Vector3d> nodes_after(const WireNetwork& network, const PropagatedWires& result) {
  return node_positions(network, result.maps, -1);
}

/// Where wires meet they stay together, equal lengths stay equal, directions are kept.
void check_relations(const WireNetwork& network, const PropagatedWires& result) {
  CHECK(result.excess <= 1);
  const std::vector<Eigen::Vector3d> nodes = nodes_after(network, result);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int k : network.wires_at[i])
      CHECK((result.maps[static_cast<std::size_t>(k)] * network.points[i] - nodes[i]).norm() < 1e-9);
  for (std::size_t k = 0; k < result.maps.size(); ++k)
    CHECK((result.maps[k].linear() * network.axes[k]).cross(network.axes[k]).norm() < 1e-12);
  for (const std::vector<int>& group : network.structure.congruent)
    for (const int k : group)
      CHECK((result.maps[static_cast<std::size_t>(k)].linear() * network.axes[static_cast<std::size_t>(k)])
                .norm() == Approx((result.maps[static_cast<std::size_t>(group.front())].linear() *
                                   network.axes[static_cast<std::size_t>(group.front())])
                                      .norm())
                               .epsilon(1e-12));
}

}  // namespace

TEST_CASE("no edit, no change") {
  const WireNetwork network = network_of(box);
  const PropagatedWires result = propagate(network, rest_of(network), moved(3, {0, 0, 0}), {});
  for (const Eigen::Affine3d& map : result.maps)
    CHECK((map.matrix() - Eigen::Matrix4d::Identity()).norm() < 1e-12);
  CHECK(result.excess < 1e-3);
}

TEST_CASE("an edge that moves across stretches its box to it, and leaves the faces behind") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  const PropagatedWires result = propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), {});
  check_relations(network, result);
  const std::vector<Eigen::Vector3d> nodes = nodes_after(network, result);
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d& p = network.points[i];
    CHECK((nodes[i] - p - Eigen::Vector3d(p.x() > 0 ? 0.2 : 0, 0, 0)).norm() < 1e-9);
  }
}

TEST_CASE("along itself an edge takes the whole box along") {
  // All edges of its class keep its length, so both faces across it go where its ends go.
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  const PropagatedWires result = propagate(network, rest_of(network), moved(edge, {0, 0, 0.3}), {});
  check_relations(network, result);
  for (const Eigen::Affine3d& map : result.maps)
    CHECK((map.matrix() - Eigen::Affine3d(Eigen::Translation3d(0, 0, 0.3)).matrix()).norm() < 1e-9);
}

TEST_CASE("a scaled edge scales those of its class about the middle, and no others") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  for (const double factor : {0.5, 1.5}) {
    const PropagatedWires result = propagate(network, rest_of(network), scaled(edge, factor), {});
    check_relations(network, result);
    const std::vector<Eigen::Vector3d> nodes = nodes_after(network, result);
    for (std::size_t i = 0; i < 8; ++i)
      CHECK((nodes[i] - network.points[i].cwiseProduct(Eigen::Vector3d(1, 1, factor))).norm() < 1e-9);
  }
}

TEST_CASE("edits add up along the maps of the wires") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  const PropagatedWires half = propagate(network, rest_of(network), moved(edge, {0.1, 0, 0}), {}),
                        twice = propagate(network, half.maps, moved(edge, {0.1, 0, 0}), {}),
                        once = propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), {});
  for (std::size_t k = 0; k < once.maps.size(); ++k)
    CHECK((twice.maps[k].matrix() - once.maps[k].matrix()).norm() < 1e-9);
}

TEST_CASE("an edit that moves images under a symmetry moves them as images") {
  const Symmetry mirror{SymmetryKind::reflection, {0, 0, 0}, {1, 0, 0}, 2};
  const WireNetwork network = network_of(box, {mirror});
  const int edge = wire_at(network, {0.5, 1, 0});
  const PropagatedWires result = propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), {});
  check_relations(network, result);
  const std::vector<Eigen::Vector3d> nodes = nodes_after(network, result);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK((nodes[i] - network.points[i].cwiseProduct(Eigen::Vector3d(1.4, 1, 1))).norm() < 1e-9);
}

TEST_CASE("what propagates does not depend on the pose") {
  const Eigen::Matrix3d rotation = solids::random_rotation(3);
  const Eigen::Vector3d shift(4, -2, 7), by(0.2, 0.1, -0.15);
  const WireNetwork rest = network_of(box), posed = network_of(transformed(box, rotation, shift));
  const Eigen::Vector3d centre(0.5, 1, 0);
  const PropagatedWires a = propagate(rest, rest_of(rest), moved(wire_at(rest, centre), by), {}),
                        b = propagate(posed, rest_of(posed),
                                      moved(wire_at(posed, rotation * centre + shift), rotation * by), {});
  const std::vector<Eigen::Vector3d> at_rest = nodes_after(rest, a), in_pose = nodes_after(posed, b);
  REQUIRE(at_rest.size() == in_pose.size());
  for (std::size_t i = 0; i < at_rest.size(); ++i)
    CHECK((rotation * at_rest[i] + shift - in_pose[i]).norm() < 1e-8);
}

TEST_CASE("held vertices stay, and an edit that would move them is impossible") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  const auto vertex_at = [&](double x) {
    for (std::size_t i = 0; i < 8; ++i)
      if (network.points[i].x() == x && network.points[i].y() == 1) return network.vertices[i];
    return -1;
  };
  WireHolds holds;
  holds.vertices = {vertex_at(-0.5)};
  const PropagatedWires result = propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), holds);
  check_relations(network, result);
  holds.vertices = {vertex_at(0.5)};  // on the edge itself
  const PropagatedWires refused = propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), holds);
  CHECK(refused.excess > 1);
  CHECK(refused.violation > 0);
  CHECK(refused.missed.cause == RefusalCause::fixed_wire);
}

TEST_CASE("with a held height edges may move across it, but not along it") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  WireHolds holds;
  holds.height = Eigen::Vector3d::UnitZ();
  check_relations(network, propagate(network, rest_of(network), moved(edge, {0.2, 0, 0}), holds));
  CHECK(propagate(network, rest_of(network), moved(edge, {0, 0, 0.2}), holds).excess > 1);
  CHECK(propagate(network, rest_of(network), scaled(edge, 1.2), holds).excess > 1);
  holds.height = Eigen::Vector3d::UnitX();
  check_relations(network, propagate(network, rest_of(network), scaled(edge, 1.2), holds));
}

TEST_CASE("an edge that is scaled to nothing, or inside out, is impossible") {
  const WireNetwork network = network_of(box);
  for (const double factor : {1e-4, 0.0, -1.0}) {
    const PropagatedWires result = propagate(network, rest_of(network), scaled(2, factor), {});
    CHECK(result.excess == std::numeric_limits<double>::infinity());
    CHECK(result.missed.cause == RefusalCause::collapsed_wire);
    CHECK(result.missed.index == 2);
    for (const Eigen::Affine3d& map : result.maps) CHECK(map.matrix() == Eigen::Matrix4d::Identity());
  }
}

TEST_CASE("when one edge turns, its class turns, and the box becomes a parallelepiped") {
  const WireNetwork network = network_of(box);
  const int edge = wire_at(network, {0.5, 1, 0});
  WireEdit edit;
  edit.wire = edge;
  edit.motion = WireMotion::turn;
  edit.linear = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const PropagatedWires result = propagate(network, rest_of(network), edit, {});
  CHECK(result.excess <= 1);
  const Eigen::Vector3d turned = edit.linear * Eigen::Vector3d::UnitZ();
  const std::vector<Eigen::Vector3d> nodes = nodes_after(network, result);
  for (std::size_t k = 0; k < result.maps.size(); ++k) {
    const std::vector<int>& ends = network.nodes[k];
    const Eigen::Vector3d way =
        (nodes[static_cast<std::size_t>(ends.back())] - nodes[static_cast<std::size_t>(ends.front())])
            .normalized();
    if (std::abs(network.axes[k].z()) > 0.5)
      CHECK(way.cross(turned).norm() < 1e-9);
    else
      CHECK(way.cross(network.axes[k]).norm() < 1e-9);
  }
}

}  // namespace stackabilization::wire_propagation_test
