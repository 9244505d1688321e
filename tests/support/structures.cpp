#include "support/structures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization::structures {

namespace {

/// Circles of `around` points across the tangents of the sections, joined; open ends closed with fans.
Shape tube(const GeneralizedCylinder& cylinder, int around) {
  const auto n = static_cast<int>(cylinder.centres.rows());
  const Points tangents = section_tangents(cylinder);
  Shape shape;
  shape.vertices.resize(n * around + (cylinder.closed ? 0 : 2), 3);
  Eigen::Vector3d side = tangents.row(0).transpose().unitOrthogonal();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d t = tangents.row(i).transpose();
    side = (side - side.dot(t) * t).normalized();
    for (int k = 0; k < around; ++k) {
      const Eigen::Vector2d p = solids::circle_point(k, around);
      shape.vertices.row(i * around + k) =
          cylinder.centres.row(i) + cylinder.radii(i) * (p.x() * side + p.y() * t.cross(side)).transpose();
    }
  }
  std::vector<Eigen::RowVector3i> triangles;
  for (int i = 0; i < (cylinder.closed ? n : n - 1); ++i)
    for (int k = 0; k < around; ++k) {
      const int a = i * around, b = (i + 1) % n * around, l = (k + 1) % around;
      triangles.emplace_back(a + k, a + l, b + l);
      triangles.emplace_back(a + k, b + l, b + k);
    }
  if (!cylinder.closed) {
    shape.vertices.row(n * around) = cylinder.centres.row(0);
    shape.vertices.row(n * around + 1) = cylinder.centres.row(n - 1);
    for (int k = 0; k < around; ++k) {
      const int l = (k + 1) % around, last = (n - 1) * around;
      triangles.emplace_back(n * around, l, k);
      triangles.emplace_back(n * around + 1, last + k, last + l);
    }
  }
  shape.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    shape.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return make_shape(std::move(shape.vertices), std::move(shape.triangles));
}

class Assembly {
 public:
  int add_box(const std::string& name, const Eigen::Vector3d& low, const Eigen::Vector3d& high, int levels) {
    Shape box = solids::box(low, high);
    for (int level = 0; level < levels; ++level) box = solids::subdivided(box);
    return add(name, box, cuboid_of({(low + high) / 2, Eigen::Matrix3d::Identity(), (high - low) / 2}));
  }

  int add(const std::string& name, const Shape& shape, const Primitive& primitive) {
    structured_.shape = parts().empty() ? solids::named(shape, name)
                                        : concatenate(structured_.shape, solids::named(shape, name));
    parts().push_back({name, primitive, {}});
    return static_cast<int>(parts().size()) - 1;
  }

  void mirror(std::vector<int> of, const Eigen::Vector3d& axis) {
    Relation relation;
    relation.type = of.size() == 1 ? RelationType::self_symmetry : RelationType::symmetry;
    relation.parts = std::move(of);
    relation.symmetry.axis = axis;
    structured_.structure.relations.push_back(relation);
  }

  void joint(int a, int b, const Points& points) {
    Relation relation;
    relation.type = points.rows() == 1 ? RelationType::point_joint : RelationType::line_joint;
    relation.parts = {a, b};
    relation.points = points;
    structured_.structure.relations.push_back(relation);
  }

  StructuredShape done() {
    const Points& v = structured_.shape.vertices;
    structured_.structure.diagonal = (v.colwise().maxCoeff() - v.colwise().minCoeff()).norm();
    return std::move(structured_);
  }

 private:
  std::vector<Part>& parts() { return structured_.structure.parts; }
  StructuredShape structured_;
};

StructuredShape table_of(int levels, bool lines) {
  Assembly table;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const int top = table.add_box("top", {-4, -4, 5.5}, {4, 4, 6}, levels);
  std::vector<int> legs, bars;
  const std::vector<Eigen::Vector2d> corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d middle(3.5 * corners[k].x(), 3.5 * corners[k].y(), 0), half(0.4, 0.4, 0);
    legs.push_back(table.add_box("leg_" + std::to_string(k + 1), middle - half,
                                 middle + half + Eigen::Vector3d(0, 0, 5.5), levels));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d a = 3.5 * corners[k], b = 3.5 * corners[(k + 1) % 4];
    const Eigen::Vector3d low(std::min(a.x(), b.x()) + 0.4 * (a.x() != b.x()) - 0.2 * (a.x() == b.x()),
                              std::min(a.y(), b.y()) + 0.4 * (a.y() != b.y()) - 0.2 * (a.y() == b.y()), 2);
    const Eigen::Vector3d high(std::max(a.x(), b.x()) - 0.4 * (a.x() != b.x()) + 0.2 * (a.x() == b.x()),
                               std::max(a.y(), b.y()) - 0.4 * (a.y() != b.y()) + 0.2 * (a.y() == b.y()), 2.4);
    bars.push_back(table.add_box("bar_" + std::to_string(k + 1), low, high, levels));
  }
  table.mirror({top}, x);
  table.mirror({top}, y);
  table.mirror({legs[0], legs[1]}, x);
  table.mirror({legs[2], legs[3]}, x);
  table.mirror({legs[0], legs[3]}, y);
  table.mirror({legs[1], legs[2]}, y);
  table.mirror({bars[0], bars[2]}, y);
  table.mirror({bars[1], bars[3]}, x);
  for (const int k : {0, 2}) table.mirror({bars[static_cast<std::size_t>(k)]}, x);
  for (const int k : {1, 3}) table.mirror({bars[static_cast<std::size_t>(k)]}, y);
  for (std::size_t k = 0; k < 4; ++k)
    table.joint(top, legs[k], Eigen::RowVector3d(3.5 * corners[k].x(), 3.5 * corners[k].y(), 5.5));
  for (std::size_t k = 0; k < 4; ++k)
    for (const std::size_t end : {k, (k + 1) % 4}) {
      const Eigen::Vector2d inwards = (corners[k] + corners[(k + 1) % 4]) / 2 - corners[end];
      const Eigen::Vector2d at = 3.5 * corners[end] + 0.4 * inwards.normalized();
      const Eigen::Vector3d place(at.x(), at.y(), 2.2), half(0, 0, lines ? 0.2 : 0);
      Points points(lines ? 2 : 1, 3);
      points.row(0) = place - half;
      points.row(points.rows() - 1) = place + half;
      table.joint(bars[k], legs[end], points);
    }
  return table.done();
}

}  // namespace

GeneralizedCylinder straight_cylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius,
                                      int sections) {
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(sections, 3);
  for (int i = 0; i < sections; ++i)
    cylinder.centres.row(i) = (a + static_cast<double>(i) / (sections - 1) * (b - a)).transpose();
  cylinder.radii.setConstant(sections, radius);
  return cylinder;
}

GeneralizedCylinder arc_cylinder(double arc_radius, double radius, double from, double to, int sections) {
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(sections, 3);
  for (int i = 0; i < sections; ++i) {
    const double angle = from + (to - from) * i / (sections - 1);
    cylinder.centres.row(i) << arc_radius * std::cos(angle), 0, arc_radius * std::sin(angle);
  }
  cylinder.radii.setConstant(sections, radius);
  return cylinder;
}

GeneralizedCylinder ring_cylinder(double ring_radius, double radius, int sections) {
  GeneralizedCylinder cylinder;
  cylinder.closed = true;
  cylinder.centres.resize(sections, 3);
  for (int i = 0; i < sections; ++i) {
    const Eigen::Vector2d p = ring_radius * solids::circle_point(i, sections);
    cylinder.centres.row(i) << p.x(), p.y(), 0;
  }
  cylinder.radii.setConstant(sections, radius);
  return cylinder;
}

Cuboid cuboid(const std::vector<Primitive>& primitives, int part) {
  return std::get<Cuboid>(primitives[static_cast<std::size_t>(part)]);
}

GeneralizedCylinder cylinder(const std::vector<Primitive>& primitives, int part) {
  return std::get<GeneralizedCylinder>(primitives[static_cast<std::size_t>(part)]);
}

int part_named(const StructuredShape& structured, const std::string& name) {
  const std::vector<std::string>& names = structured.shape.part_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::invalid_argument("there is no part " + name);
  return static_cast<int>(found - names.begin());
}

StructuredShape box_alone(const Eigen::Vector3d& size) {
  Assembly assembly;
  assembly.add_box("box", -size / 2, size / 2, 2);
  return assembly.done();
}

StructuredShape tube_alone(const GeneralizedCylinder& cylinder, int around) {
  Assembly assembly;
  assembly.add("tube", tube(cylinder, around), cylinder);
  return assembly.done();
}

StructuredShape table(int levels) {
  return table_of(levels, false);
}

StructuredShape table_with_line_joints() {
  return table_of(1, true);
}

StructuredShape board_with_screw() {
  Assembly assembly;
  const int board = assembly.add_box("board", {-5, -5, -0.5}, {5, 5, 0.5}, 1),
            screw = assembly.add_box("screw", {-0.05, -0.05, 0.5}, {0.05, 0.05, 0.6}, 0);
  assembly.joint(board, screw, Eigen::RowVector3d(0, 0, 0.5));
  return assembly.done();
}

StructuredShape rough_stool() {
  Assembly stool;
  const int top = stool.add_box("top", {-5, -5, 15}, {5, 5, 16}, 1);
  std::vector<int> legs;
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}) {
    const auto number = static_cast<int>(legs.size()) + 1;
    const GeneralizedCylinder leg = straight_cylinder({x, y, 0}, {x, y, 15}, 0.5, 24);
    legs.push_back(stool.add("leg_" + std::to_string(number), tube(leg, 11 + number), leg));
    stool.joint(top, legs.back(), Eigen::RowVector3d(x, y, 15));
  }
  stool.mirror({top}, Eigen::Vector3d::UnitX());
  stool.mirror({top}, Eigen::Vector3d::UnitY());
  for (const std::size_t k : {0u, 2u}) {
    stool.mirror({legs[k], legs[k + 1]}, Eigen::Vector3d::UnitX());
    stool.mirror({legs[k], legs[(k + 3) % 4]}, Eigen::Vector3d::UnitY());
  }
  return stool.done();
}

StructuredShape leg_and_apron() {
  Assembly assembly;
  const int top = assembly.add_box("top", {-5, -5, 10}, {5, 5, 11}, 0),
            leg = assembly.add_box("leg", {-0.4, -0.4, 0}, {0.4, 0.4, 10}, 0),
            apron = assembly.add_box("apron", {0.4, -0.2, 9}, {5, 0.2, 10}, 0);
  assembly.joint(top, leg, Eigen::RowVector3d(0, 0, 10));
  assembly.joint(leg, apron, Eigen::RowVector3d(0.4, 0, 9.5));
  assembly.joint(top, apron, Eigen::RowVector3d(4.9, 0, 10));
  return assembly.done();
}

StructuredShape ladder() {
  Assembly ladder;
  const GeneralizedCylinder left = straight_cylinder({-5, 0, 0}, {-3, 0, 16}, 0.4, 33),
                            right = straight_cylinder({5, 0, 0}, {3, 0, 16}, 0.4, 33);
  const int a = ladder.add("leg_left", tube(left, 12), left),
            b = ladder.add("leg_right", tube(right, 12), right);
  ladder.mirror({a, b}, Eigen::Vector3d::UnitX());
  for (int k = 1; k <= 7; ++k) {
    const Eigen::Vector3d end(5 - 0.25 * k, 0, 2 * k), other(-end.x(), 0, end.z());
    const GeneralizedCylinder rung = straight_cylinder(other, end, 0.2, 9);
    const int c = ladder.add("rung_" + std::to_string(k), tube(rung, 12), rung);
    ladder.mirror({c}, Eigen::Vector3d::UnitX());
    ladder.joint(a, c, other.transpose());
    ladder.joint(b, c, end.transpose());
  }
  return ladder.done();
}

StructuredShape trestle(bool shelf) {
  Assembly trestle;
  const GeneralizedCylinder left = straight_cylinder({-4, 0, 0}, {-2, 0, 10}, 0.4, 21),
                            right = straight_cylinder({4, 0, 0}, {2, 0, 10}, 0.4, 21),
                            rung = straight_cylinder({-3.2, 0, 4}, {3.2, 0, 4}, 0.2, 9);
  const int a = trestle.add("leg_left", tube(left, 12), left),
            b = trestle.add("leg_right", tube(right, 12), right),
            c = trestle.add("rung", tube(rung, 12), rung);
  trestle.mirror({a, b}, Eigen::Vector3d::UnitX());
  trestle.mirror({c}, Eigen::Vector3d::UnitX());
  trestle.joint(a, c, Eigen::RowVector3d(-3.2, 0, 4));
  trestle.joint(b, c, Eigen::RowVector3d(3.2, 0, 4));
  if (shelf) {
    const int d = trestle.add_box("shelf", {-2.85, -0.3, 5.5}, {2.85, 0.3, 6}, 1);
    trestle.mirror({d}, Eigen::Vector3d::UnitX());
    trestle.joint(a, d, Eigen::RowVector3d(-2.85, 0, 5.75));
    trestle.joint(b, d, Eigen::RowVector3d(2.85, 0, 5.75));
  }
  return trestle.done();
}

StructuredShape slats_on_rails(bool skewed) {
  Assembly rack;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  std::vector<int> slats, rails;
  for (int k = 0; k < 5; ++k) {
    const double middle = 2.0 * k - 4;
    slats.push_back(
        rack.add_box("slat_" + std::to_string(k + 1), {-10, middle - 0.6, 0}, {10, middle + 0.6, 0.5}, 1));
  }
  for (const double side : {-8.0, 8.0})
    rails.push_back(
        rack.add_box(side < 0 ? "rail_1" : "rail_2", {side - 0.5, -5, -1}, {side + 0.5, 5, 0}, 1));
  for (const int slat : slats) rack.mirror({slat}, x);
  rack.mirror(rails, x);
  if (!skewed) {
    rack.mirror({slats[0], slats[4]}, y);
    rack.mirror({slats[1], slats[3]}, y);
    for (const int part : {slats[2], rails[0], rails[1]}) rack.mirror({part}, y);
  }
  for (std::size_t k = 0; k < slats.size(); ++k)
    for (std::size_t side = 0; side < 2; ++side)
      rack.joint(slats[k], rails[side],
                 Eigen::RowVector3d(side == 0 ? -8 : 8, 2.0 * static_cast<double>(k) - 4, 0));
  return rack.done();
}

StructuredShape mug(int around) {
  Assembly mug;
  const GeneralizedCylinder body = straight_cylinder({0, 0, 0}, {0, 0, 10}, 4, 11);
  GeneralizedCylinder handle = arc_cylinder(3, 0.4, -std::numbers::pi / 2, std::numbers::pi / 2, 13);
  handle.centres.rowwise() += Eigen::RowVector3d(4, 0, 5);
  const int a = mug.add("body", tube(body, around), body),
            b = mug.add("handle", tube(handle, around), handle);
  mug.mirror({a}, Eigen::Vector3d::UnitY());
  mug.mirror({b}, Eigen::Vector3d::UnitY());
  mug.joint(a, b, Eigen::RowVector3d(4, 0, 2));
  mug.joint(a, b, Eigen::RowVector3d(4, 0, 8));
  return mug.done();
}

StructuredShape post_with_ring() {
  Assembly assembly;
  const GeneralizedCylinder post = straight_cylinder({3, 0, 0}, {9, 0, 0}, 0.5, 5),
                            ring = ring_cylinder(3, 0.3, 16);
  const int a = assembly.add("post", tube(post, 12), post), b = assembly.add("ring", tube(ring, 12), ring);
  assembly.mirror({a}, Eigen::Vector3d::UnitY());
  assembly.mirror({b}, Eigen::Vector3d::UnitY());
  assembly.joint(a, b, Eigen::RowVector3d(3, 0, 0));
  return assembly.done();
}

}  // namespace stackabilization::structures
