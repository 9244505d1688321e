#include <algorithm>
#include <cmath>
#include <set>

#include "deformation/iwires/wire_modes.h"
#include "deformation/iwires/wire_network.h"
#include "deformation/iwires/wire_turns.h"
#include "support/catch.h"
#include "support/symmetric_solids.h"

namespace stackabilization::wire_network_test {

using namespace detail;

namespace {

const Eigen::Vector3d size(1, 2, 3);
const Shape box = solids::box(-size / 2, size / 2);

Symmetry mirror(const Eigen::Vector3d& axis) {
  return {SymmetryKind::reflection, {0, 0, 0}, axis, 2};
}
const std::vector<Symmetry> mirrors_xy = {mirror({1, 0, 0}), mirror({0, 1, 0})};

WireNetwork network_of(const Shape& shape, const std::vector<Symmetry>& symmetries = {},
                       double link_distance = 0) {
  WireAnalysisOptions options;
  options.symmetries = symmetries;
  return wire_network(shape, analysed_wires(shape, feature_curves(shape), options), link_distance, 1e-6);
}

/// Row of the wire whose centre is nearest to `centre`.
int wire_at(const WireNetwork& network, const Eigen::Vector3d& centre) {
  const auto& wires = network.structure.wires;
  const auto nearest = std::min_element(wires.begin(), wires.end(), [&](const Wire& a, const Wire& b) {
    return (a.centre - centre).norm() < (b.centre - centre).norm();
  });
  return static_cast<int>(nearest - wires.begin());
}

/// Axis of the box along which a wire goes.
int along(const WireNetwork& network, int wire) {
  Eigen::Index axis = 0;
  network.axes[static_cast<std::size_t>(wire)].cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

Wire wire_of_form(WireForm form, double length, const Eigen::Vector3d& axis) {
  Wire wire;
  wire.form = form;
  wire.length = length;
  wire.axis = axis;
  return wire;
}

}  // namespace

TEST_CASE("the corners of a box are the nodes of its twelve wires, three at each") {
  const WireNetwork network = network_of(box);
  REQUIRE(network.vertices.size() == 8);
  CHECK(std::is_sorted(network.vertices.begin(), network.vertices.end()));
  CHECK(network.diagonal == Approx(size.norm()).epsilon(1e-14));
  CHECK(network.mean_length == Approx(2).epsilon(1e-14));
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(network.points[i] == box.vertices.row(network.vertices[i]).transpose());
    REQUIRE(network.wires_at[i].size() == 3);
    CHECK(std::is_sorted(network.wires_at[i].begin(), network.wires_at[i].end()));
    std::set<int> directions;
    for (const int k : network.wires_at[i]) {
      directions.insert(along(network, k));
      const std::vector<int>& nodes = network.nodes[static_cast<std::size_t>(k)];
      CHECK(std::find(nodes.begin(), nodes.end(), static_cast<int>(i)) != nodes.end());
    }
    CHECK(directions.size() == 3);
  }
  CHECK(network.links.empty());
}

TEST_CASE(
    "axes are exactly parallel in their classes and exact images of each other, where the mesh is not") {
  const WireNetwork network = network_of(solids::noisy(box, 1e-4, 5), mirrors_xy);
  REQUIRE(network.structure.parallel.size() == 3);
  REQUIRE(network.structure.symmetric.size() == 24);
  double largest = 0;
  for (std::size_t k = 0; k < 12; ++k) {
    const auto first = static_cast<std::size_t>(
        network.structure.parallel[static_cast<std::size_t>(network.class_of[k])].front());
    CHECK(network.axes[k].cross(network.axes[first]).norm() == 0);
    CHECK(network.axes[k].norm() == Approx(1).epsilon(1e-15));
    CHECK(network.axes[k].dot(network.structure.wires[k].axis) > 1 - 1e-6);
    largest = std::max(largest, (network.axes[k] - network.structure.wires[k].axis).norm());
  }
  CHECK(largest > 1e-6);  // there was something to do
  for (const WireSymmetry& pair : network.structure.symmetric) {
    const Eigen::Matrix3d q =
        isometry_of(network.structure.symmetries[static_cast<std::size_t>(pair.symmetry)]).linear();
    const Eigen::Vector3d image = q * network.axes[static_cast<std::size_t>(pair.wire)];
    CHECK(image.cross(network.axes[static_cast<std::size_t>(pair.image)]).norm() < 1e-15);
  }
}

TEST_CASE("vertices link to the nearest point of wires that are not joined to theirs") {
  const Shape both = concatenate(solids::box({1, 1, 1}), solids::box({1.1, 0.2, 0.28}, {2.1, 0.7, 0.6}));
  CHECK(network_of(both, {}, 0.2).links.empty());
  // Of the corners of the second box two are within sqrt(0.05) of the edge x = 1, y = 0 of the first.
  const WireNetwork network = network_of(both, {}, 0.23);
  REQUIRE(network.links.size() == 2);
  for (const WireLink& link : network.links) {
    const Eigen::Vector3d from = network.points[static_cast<std::size_t>(link.node)];
    CHECK(from.x() == 1.1);
    CHECK(from.y() == 0.2);
    CHECK((link.point - Eigen::Vector3d(1, 0, from.z())).norm() < 1e-14);
    CHECK(link.other == wire_at(network, {1, 0, 0.5}));
    CHECK(network.wires_at[static_cast<std::size_t>(link.node)].front() == link.wire);
    CHECK(link.slides);
  }
  // From beside a corner the nearest point is that corner, an end of its wires.
  const WireNetwork corner =
      network_of(concatenate(solids::box({1, 1, 1}), solids::box({1.1, 1.1, 1.1}, {2, 2, 2})), {}, 0.2);
  REQUIRE(corner.links.size() == 2);
  for (const WireLink& link : corner.links) CHECK_FALSE(link.slides);
}

TEST_CASE("images of a wire are reached once, with the linear part that takes it there") {
  const WireNetwork network = network_of(box, mirrors_xy);
  for (int k = 0; k < 12; ++k) {
    const std::vector<WireImage> images = images_of(network.structure, k);
    // Along z the four edges are images of one; along x the mirror x keeps each edge.
    CHECK(images.size() == (along(network, k) == 2 ? 4u : 2u));
    CHECK(images.front().wire == k);
    CHECK(images.front().linear == Eigen::Matrix3d::Identity());
    std::set<int> wires;
    for (const WireImage& image : images) {
      wires.insert(image.wire);
      CHECK((image.linear * network.structure.wires[static_cast<std::size_t>(k)].centre -
             network.structure.wires[static_cast<std::size_t>(image.wire)].centre)
                .norm() < 1e-14);
    }
    CHECK(wires.size() == images.size());
  }
  CHECK(images_of(network_of(box).structure, 3).size() == 1);
}

TEST_CASE("a junction goes to the mean of where its wires take it, or where one of them does") {
  const WireNetwork network = network_of(box);
  solids::Random random(3);
  std::vector<Eigen::Affine3d> maps;
  for (int k = 0; k < 12; ++k) maps.emplace_back(Eigen::Translation3d(random.in_cube()));
  const std::vector<Eigen::Vector3d> mean = node_positions(network, maps, -1),
                                     exact = node_positions(network, maps, 5);
  for (std::size_t i = 0; i < 8; ++i) {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    for (const int k : network.wires_at[i]) shift += maps[static_cast<std::size_t>(k)].translation() / 3;
    CHECK((mean[i] - network.points[i] - shift).norm() < 1e-14);
    const bool on_it =
        std::find(network.wires_at[i].begin(), network.wires_at[i].end(), 5) != network.wires_at[i].end();
    CHECK(exact[i] == (on_it ? Eigen::Vector3d(maps[5] * network.points[i]) : mean[i]));
  }
}

TEST_CASE("wires may change as their forms allow, each mode a change of half their length") {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3;
  WireStructure structure;
  structure.wires = {wire_of_form(WireForm::straight, 4, axis), wire_of_form(WireForm::circular, 5, axis),
                     wire_of_form(WireForm::planar, 6, axis),
                     wire_of_form(WireForm::spatial, 8, Eigen::Vector3d::Zero())};
  const WireModes modes = wire_modes(structure, {axis, axis, axis, Eigen::Vector3d::Zero()}, {});
  CHECK(modes.variables == 3 * 4 + 1 + 1 + 4 + 9);
  REQUIRE(modes.of_wire.size() == 4);
  const Eigen::Matrix3d onto = axis * axis.transpose();
  REQUIRE(modes.of_wire[0].size() == 1);
  CHECK(modes.of_wire[0][0].matrix.isApprox(2.0 / 4 * onto, 1e-14));
  REQUIRE(modes.of_wire[1].size() == 1);
  CHECK(modes.of_wire[1][0].matrix.isApprox(2.0 / 5 * (Eigen::Matrix3d::Identity() - onto), 1e-14));
  // All linear maps of the plane, and of space: an orthogonal basis of them.
  for (const std::size_t k : {2u, 3u}) {
    REQUIRE(modes.of_wire[k].size() == (k == 2 ? 4u : 9u));
    const double length = structure.wires[k].length;
    for (std::size_t i = 0; i < modes.of_wire[k].size(); ++i) {
      if (k == 2)
        CHECK((modes.of_wire[k][i].matrix * axis).norm() +
                  (modes.of_wire[k][i].matrix.transpose() * axis).norm() <
              1e-14);
      for (std::size_t j = 0; j < modes.of_wire[k].size(); ++j)
        CHECK((modes.of_wire[k][i].matrix.transpose() * modes.of_wire[k][j].matrix).trace() ==
              Approx(i == j ? 4 / (length * length) : 0).margin(1e-14));
    }
  }
}

TEST_CASE("wires of equal size share it, unless they turn or one circle alone is scaled") {
  const WireNetwork network = network_of(box, mirrors_xy);
  const auto variables = [](const WireNetwork& of, const WireEdit& edit) {
    return wire_modes(of.structure, of.axes, edit).variables -
           3 * static_cast<int>(of.structure.wires.size());
  };
  const auto edit = [](WireMotion motion) { return WireEdit{.wire = 0, .motion = motion}; };
  CHECK(variables(network, edit(WireMotion::move)) == 3);
  CHECK(variables(network, edit(WireMotion::scale)) == 3);
  // In turns mirror images only: four edges along z, two and two along x, two and two along y.
  CHECK(variables(network, edit(WireMotion::turn)) == 1 + 2 + 2);
  CHECK(variables(network_of(box), edit(WireMotion::turn)) == 12);

  const WireNetwork cylinder = network_of(solids::cylinder(1, 2, 24));
  REQUIRE(cylinder.structure.wires.size() == 2);
  CHECK(variables(cylinder, edit(WireMotion::move)) == 1);
  CHECK(variables(cylinder, edit(WireMotion::scale)) == 2);
  const WireNetwork mirrored =
      network_of(solids::moved(solids::cylinder(1, 2, 24), {0, 0, -1}), {mirror({0, 0, 1})});
  CHECK(variables(mirrored, edit(WireMotion::scale)) == 1);
}

TEST_CASE("a turn goes to parallel wires, and mirrored to the images") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  const WireNetwork plain = network_of(box);
  const int edited = wire_at(plain, {0.5, 1, 0});  // along z
  const std::vector<Eigen::Matrix3d> turns = spread_turn(plain, edited, turn);
  for (int k = 0; k < 12; ++k)
    CHECK(turns[static_cast<std::size_t>(k)] ==
          (along(plain, k) == 2 ? turn : Eigen::Matrix3d(Eigen::Matrix3d::Identity())));

  const WireNetwork mirrored = network_of(box, mirrors_xy);
  const std::vector<Eigen::Matrix3d> images = spread_turn(mirrored, wire_at(mirrored, {0.5, 1, 0}), turn);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Matrix3d q = Eigen::Vector3d(x, y, 1).asDiagonal();
      const int wire = wire_at(mirrored, {0.5 * x, y, 0});
      CHECK((images[static_cast<std::size_t>(wire)] - q * turn * q).norm() < 1e-15);
    }
}

}  // namespace stackabilization::wire_network_test
