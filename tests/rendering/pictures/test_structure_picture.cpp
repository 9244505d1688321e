#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "rendering/drawing/legend.h"
#include "rendering/scene/structure_scene.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/pictures.h"
#include "support/catch.h"
#include "support/picture_checks.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

const Colour green_joints{0.10, 0.66, 0.22};

OrientedBox box_of(const Shape& shape) {
  return axis_aligned_box(shape.vertices);
}

/// The table of five parts: its top a cuboid, its legs generalized cylinders, two mirror planes and four
/// joints, the last of them a line.
StructuredShape structured_table() {
  StructuredShape table{solids::table({}), {}};
  Structure& structure = table.structure;
  for (int part = 0; part < 5; ++part) {
    const OrientedBox box = box_of(extract_part(table.shape, part));
    Part entry{table.shape.part_names[static_cast<std::size_t>(part)], cuboid_of(box), {}};
    if (part > 0) {
      GeneralizedCylinder leg;
      leg.centres = box.centre.transpose().replicate(5, 1);
      leg.centres.col(2) = Eigen::VectorXd::LinSpaced(5, 0, 2 * box.half_extents.z());
      leg.radii = Eigen::VectorXd::Constant(5, box.half_extents.x());
      entry.primitive = leg;
    }
    structure.parts.push_back(entry);
  }
  const OrientedBox whole = box_of(table.shape);
  structure.diagonal = 2 * whole.half_extents.norm();
  structure.symmetries = {{SymmetryKind::reflection, whole.centre, Eigen::Vector3d::UnitX()},
                          {SymmetryKind::reflection, whole.centre, Eigen::Vector3d::UnitY()}};
  const auto centre = [&](int part) { return box_of(extract_part(table.shape, part)).centre; };
  for (int a = 1; a < 5; ++a)
    for (int b = a + 1; b < 5; ++b)
      for (const Symmetry& symmetry : structure.symmetries)
        if ((isometry_of(symmetry) * centre(a) - centre(b)).norm() < 1e-9)
          structure.relations.push_back({RelationType::symmetry, {a, b}, symmetry, {}, 0});
  for (int leg = 1; leg < 5; ++leg) {
    const Eigen::Vector3d end =
        centre(leg) + Eigen::Vector3d(0, 0, box_of(extract_part(table.shape, leg)).half_extents.z());
    Relation joint{RelationType::point_joint, {0, leg}, {}, end.transpose(), 0};
    if (leg == 4) {
      joint.type = RelationType::line_joint;
      joint.points = end.transpose().replicate(2, 1);
      joint.points(0, 0) -= 2;
    }
    structure.relations.push_back(joint);
  }
  return table;
}

Design unchanged(const StructuredShape& rest) {
  Design result{{}, {}, rest.shape};
  for (const Part& part : rest.structure.parts) result.primitives.push_back(part.primitive);
  return result;
}

double distance(const Colour& a, const Colour& b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

}  // namespace

TEST_CASE("parts that symmetries take onto each other, also by way of others, form one orbit of one colour") {
  const StructuredShape table = structured_table();
  REQUIRE(table.structure.relations.size() == 8);
  CHECK(detail::symmetry_orbits(table.structure) == std::vector<std::vector<int>>{{1, 2, 3, 4}, {0}});
  const std::vector<Colour> colours = detail::part_colours(table.structure);
  for (int leg = 2; leg < 5; ++leg) CHECK(distance(colours[1], colours[static_cast<std::size_t>(leg)]) == 0);
  CHECK(distance(colours[0], colours[1]) > 0.3);
}

TEST_CASE("no two of many orbits share a colour, and none is the colour of a joint") {
  Structure structure;
  structure.parts.resize(50);
  for (int pair = 0; pair < 16; ++pair)
    structure.relations.push_back({RelationType::symmetry, {2 * pair, 2 * pair + 1}, {}, {}, 0});
  const std::vector<Colour> colours = detail::part_colours(structure);
  for (std::size_t a = 0; a < colours.size(); ++a) {
    CHECK(distance(colours[a], green_joints) > 0.3);
    CHECK(distance(colours[a], palette::contact) > 0.3);
    for (std::size_t b = a + 1; b < colours.size(); ++b)
      CHECK((distance(colours[a], colours[b]) == 0) == (a < 32 && b == a + 1 && a % 2 == 0));
  }
}

TEST_CASE("balls and bars are closed and as large as asked for") {
  const Shape ball = detail::ball({1, 2, 3}, 0.5);
  for (Eigen::Index v = 0; v < ball.vertex_count(); ++v)
    CHECK((ball.vertices.row(v).transpose() - Eigen::Vector3d(1, 2, 3)).norm() == Approx(0.5));
  const Shape bar = detail::bar({0, 0, 0}, {0, 0, 4}, 0.25);
  CHECK(range_along(bar, Eigen::Vector3d::UnitZ()).length() == Approx(4));
  CHECK(range_along(bar, Eigen::Vector3d::UnitX()).length() <= 0.5 + 1e-12);
  CHECK(range_along(bar, Eigen::Vector3d::UnitX()).length() > 0.48);
  CHECK(range_along(detail::bar({1, 1, 1}, {1, 1, 1}, 0.25), Eigen::Vector3d::UnitZ()).length() ==
        Approx(0.5));
}

TEST_CASE("primitives are outlined by their edges and by their circles on the curve") {
  OrientedBox box;
  box.half_extents = {1, 2, 3};
  double length = 0;
  const std::vector<Points> edges = detail::outline(cuboid_of(box));
  for (const Points& edge : edges) length += (edge.row(1) - edge.row(0)).norm();
  CHECK(edges.size() == 12);
  CHECK(length == Approx(4 * (2 + 4 + 6)));
  CHECK(detail::faces(cuboid_of(box)).triangle_count() == 12);

  GeneralizedCylinder ring;
  ring.closed = true;
  ring.centres.resize(6, 3);
  for (int i = 0; i < 6; ++i)
    ring.centres.row(i) << std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0;
  ring.radii = Eigen::VectorXd::LinSpaced(6, 0.1, 0.2);
  const std::vector<Points> circles = detail::outline(ring);
  REQUIRE(circles.size() == 7);
  CHECK(circles[6].rows() == 7);
  CHECK(circles[6].row(0) == circles[6].row(6));
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index k = 0; k < circles[static_cast<std::size_t>(i)].rows(); ++k) {
      const Eigen::Vector3d arm =
          (circles[static_cast<std::size_t>(i)].row(k) - ring.centres.row(i)).transpose();
      CHECK(arm.norm() == Approx(ring.radii(i)));
      CHECK(std::abs(arm.dot(section_tangents(ring).row(i))) < 1e-12);
    }
  CHECK(detail::faces(ring).triangle_count() == 0);
}

TEST_CASE("a plane cuts a box in a rectangle, a hexagon, or not at all") {
  OrientedBox box;
  box.half_extents = {1, 1, 1};
  const Points square = detail::plane_in_box({0.25, 9, 9}, Eigen::Vector3d::UnitX(), box);
  REQUIRE(square.rows() == 5);
  CHECK(square.row(0) == square.row(4));
  for (int i = 0; i < 4; ++i) {
    CHECK(square(i, 0) == Approx(0.25));
    CHECK((square.row(i + 1) - square.row(i)).norm() == Approx(2));
  }
  const Points hexagon = detail::plane_in_box({0, 0, 0}, {1, 1, 1}, box);
  REQUIRE(hexagon.rows() == 7);
  for (int i = 0; i < 6; ++i) CHECK((hexagon.row(i + 1) - hexagon.row(i)).norm() == Approx(std::sqrt(2)));
  CHECK(detail::plane_in_box({0, 0, 2}, Eigen::Vector3d::UnitZ(), box).rows() == 0);
}

TEST_CASE("a legend stays in its place and counts what it leaves out") {
  std::vector<LegendEntry> entries;
  for (int k = 0; k < 40; ++k)
    entries.push_back({LegendMark::swatch, palette::input, "a part with a long name " + std::to_string(k)});
  entries[1].text = std::string(300, 'W');
  for (const double height : {25.0, 60.0, 200.0, 2000.0}) {
    Drawing drawing{600, 2020, detail::legend(entries, {10, 10, 580, height}, 14)};
    check_nothing_clipped(drawing);
    for (const DrawingElement& element : drawing.elements)
      if (const auto* text = std::get_if<Text>(&element)) CHECK(text->at.y() < 10 + height);
    CHECK(says(drawing, " more") == (height < 2000));
  }
  CHECK(detail::legend(entries, {0, 0, 600, 5}, 14).empty());
}

TEST_CASE("a structure shows its parts by orbit, its joints in green and red, and says what there is") {
  const StructuredShape table = structured_table();
  const StructurePictureOptions options{900, 620, "table.obj"};
  const Drawing drawing = structure_picture(table, options);
  check_nothing_clipped(drawing);
  for (const char* words :
       {"table.obj", "5 parts: 1 cuboid, 4 generalized cylinders", "4 symmetric pairs",
        "3 point joints, 1 line joint", "leg_1 and 3 like it", "top", "symmetry of the whole"})
    CHECK(says(drawing, words));
  const Image image = rasterize(drawing);
  const std::vector<Colour> colours = detail::part_colours(table.structure);
  CHECK(pixels_of(image, colours[1]) > 1000);
  CHECK(pixels_of(image, colours[0]) > 1000);
  CHECK(pixels_of(image, green_joints) > 40);
  CHECK(pixels_of(image, palette::contact) > 100);
  CHECK(png_bytes(image) == png_bytes(rasterize(structure_picture(table, options))));
  StructuredShape broken = table;
  broken.structure.parts.pop_back();
  CHECK_THROWS_AS(structure_picture(broken, options), InputError);
}

TEST_CASE("a structure without relations, or with very many parts, still fits its picture") {
  StructuredShape many;
  for (int k = 0; k < 90; ++k) {
    Shape cube = solids::moved(solids::box({1, 1, 1}), {1.5 * (k % 9), 1.5 * (k / 9), 0});
    cube.part_names = {"cube_" + std::to_string(k) + std::string(static_cast<std::size_t>(k), 'x')};
    many.structure.parts.push_back({cube.part_names[0], cuboid_of(box_of(cube)), {}});
    many.shape = k == 0 ? cube : concatenate(many.shape, cube);
  }
  many.structure.diagonal = 20;
  const Drawing drawing = structure_picture(many, {700, 500, ""});
  check_nothing_clipped(drawing);
  CHECK(says(drawing, " more"));
  CHECK(says(drawing, "0 symmetric pairs"));
}

TEST_CASE("before and after share one scale, and edited handles are red") {
  const StructuredShape table = structured_table();
  Design result = unchanged(table);
  DeformationPictureOptions options;
  options.title = "table.obj";
  options.notes = {"leg_1 move 0 0 0"};
  const Image none = rasterize(deformation_picture(table, result, {}, options));
  const int before = pixels_of(none, palette::input);
  CHECK(before > 10000);
  CHECK(std::abs(pixels_of(none, palette::output) - before) < before / 50);
  CHECK(pixels_of(none, palette::contact) == 0);

  result.shape = transformed(table.shape, 0.5 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  const Image halved = rasterize(deformation_picture(table, result, {}, options));
  const double area = 1.0 * pixels_of(halved, palette::output) / pixels_of(halved, palette::input);
  CHECK(area == Approx(0.25).epsilon(0.1));

  result = unchanged(table);
  for (const Handle& handle : {Handle{HandleKind::part, 2, 0}, Handle{HandleKind::face, 0, 5},
                               Handle{HandleKind::corner, 0, 3}, Handle{HandleKind::section, 3, 2},
                               Handle{HandleKind::point, 0, 7}, Handle{HandleKind::shape, 0, 0}}) {
    const Drawing drawing = deformation_picture(table, result, {handle}, options);
    check_nothing_clipped(drawing);
    CHECK(says(drawing, "what was edited"));
    CHECK(pixels_of(rasterize(drawing), palette::contact) > 40);
  }
  // Handles of another model, which nobody can show here.
  for (const Handle& handle : {Handle{HandleKind::wire, 0, 4}, Handle{HandleKind::section, 0, 3},
                               Handle{HandleKind::face, 1, 2}, Handle{HandleKind::section, 1, 99}})
    CHECK_NOTHROW(deformation_picture(table, result, {handle}, options));
}

TEST_CASE("a sheet shows where a design stands and what it could become, in rows and in one scale") {
  const StructuredShape table = structured_table();
  std::vector<DesignTile> tiles = {{table.shape, {}, {}, {}, {"now", "a note"}}};
  for (int k = 0; k < 4; ++k) tiles.push_back({table.shape, {}, {}, {}, {"number " + std::to_string(k)}});
  for (const Part& part : table.structure.parts) tiles[2].primitives.push_back(part.primitive);
  tiles[2].handles = {{HandleKind::face, 0, 5}};
  DesignSheetOptions options;
  options.title = "table.obj";
  options.columns = 3;
  const Drawing drawing = design_sheet(tiles, Direction(0, 0, 1), options);
  check_nothing_clipped(drawing);
  for (const char* words : {"table.obj", "now", "a note", "number 0", "number 3"})
    CHECK(says(drawing, words));
  const Image image = rasterize(drawing);
  const int yellow = pixels_of(image, palette::input);
  CHECK(yellow > 1000);
  CHECK(pixels_of(image, palette::output) > 3.5 * yellow);
  CHECK(pixels_of(image, palette::contact) > 40);
  options.columns = 5;
  const Drawing in_a_row = design_sheet(tiles, Direction(0, 0, 1), options);
  CHECK(in_a_row.height < drawing.height);
  // Other designs at rest are yellow too; a smaller one is drawn as large, since it has its own scale.
  tiles[3].at_rest = tiles[4].at_rest = true;
  tiles[4].shape.vertices *= 0.1;
  CHECK(pixels_of(rasterize(design_sheet(tiles, Direction(0, 0, 1), options)), palette::input) >
        2.9 * pixels_of(rasterize(in_a_row), palette::input));
  CHECK_THROWS_AS(design_sheet({}, Direction(0, 0, 1), options), UsageError);
  options.columns = 0;
  CHECK_THROWS_AS(design_sheet(tiles, Direction(0, 0, 1), options), UsageError);
}
