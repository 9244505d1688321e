#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

using Names = std::vector<std::string>;

Shape read_obj_text(const std::string& text) {
  return read_text(Format::obj, text);
}

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ round trips to the bit, with parts") {
  const Shape shape = two_tetrahedra();
  CHECK(same_shape(round_trip(shape, Format::obj), shape));
}

TEST_CASE("OBJ reads every spelling of a face") {
  const Shape expected = read_obj_text(three_vertices + "f 1 2 3\n");
  REQUIRE(expected.triangles == (Triangles(1, 3) << 0, 1, 2).finished());
  for (const char* face :
       {"f 1/7 2/8 3/9", "f 1//4 2//5 3//6", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1", "f -3/-1 2 -1//-1",
        "f\t1   2\t3  ", "f 1 2 3 # comment", "f 1 \\\n2 \\\n 3", "f 1 2\\\r\n 3", "  f 1 2 3"})
    CHECK(same_shape(read_obj_text(three_vertices + face), expected));
}

TEST_CASE("OBJ line ends, comments and other statements do not matter") {
  const std::string text =
      "# comment\nmtllib a.mtl\nv 0 0 0 0.5 0.5 0.5\nv 1 0 0 1 1 1\nv 0 1 0\nvt 0 0\nvn 0 0 1\ns off\nusemtl "
      "red\n"
      "l 1 2\np 1\n\nf 1 2 3";
  const Shape expected = read_obj_text(text);
  CHECK(expected.triangle_count() == 1);
  CHECK(expected.vertices(1, 0) == 1);
  for (const std::string& line_end : {std::string("\r\n"), std::string("\r")}) {
    std::string changed;
    for (const char c : text) changed += c == '\n' ? line_end : std::string(1, c);
    CHECK(same_shape(read_obj_text(changed), expected));
  }
  CHECK(same_shape(read_obj_text("\xEF\xBB\xBF" + text), expected));
}

TEST_CASE("OBJ numbers are rounded to nearest, with three-digit exponents") {
  const Shape shape = read_obj_text(
      "v 1.5e+002 -2.5E-003 +7\nv 0.1 1e-400 -1e-999\nv 1e30 .5 5.\nv 2.2250738585072011e-308 1E+030 0\nf 1 "
      "2 3\n");
  CHECK(shape.vertices.row(0) == Eigen::RowVector3d(150, -0.0025, 7));
  CHECK(shape.vertices.row(1) == Eigen::RowVector3d(0.1, 0, 0));
  CHECK(shape.vertices.row(2) == Eigen::RowVector3d(1e30, 0.5, 5));
  CHECK(shape.vertices(3, 0) == 2.2250738585072011e-308);
}

TEST_CASE("OBJ parts are groups inside objects") {
  const std::string f = "f 1 2 3\n";
  const auto names = [&](const std::string& text) { return read_obj_text(three_vertices + text).part_names; };
  CHECK(names(f) == Names{"part"});
  CHECK(names("g a\n" + f + "g b\n" + f) == Names{"a", "b"});
  CHECK(names("g a b\n" + f) == Names{"a b"});
  CHECK(names("o chair\n" + f + "g leg\n" + f + "o table\n" + f + "g leg\n" + f) ==
        Names{"chair", "chair/leg", "table", "table/leg"});
  CHECK(names("o cup\ng cup\n" + f) == Names{"cup"});
  CHECK(names("g empty\ng a\n" + f) == Names{"a"});
  CHECK(names(f + "g a\n" + f) == Names{"part", "a"});
}

TEST_CASE("OBJ groups that open again go on, and a bare g is ignored") {
  const Shape shape =
      read_obj_text(three_vertices + "g a\nf 1 2 3\ng b\nf 2 3 1\ng\nf 3 1 2\ng a\nf 1 2 3\n");
  CHECK(shape.part_names == std::vector<std::string>{"a", "b"});
  CHECK(shape.triangle_part == std::vector<std::int32_t>{0, 1, 1, 0});
}

TEST_CASE("OBJ faces may come before their vertices, and unused vertices stay") {
  const Shape shape = read_obj_text("f 1 2 4\n" + three_vertices + "v 0 0 1\n");
  CHECK(shape.vertex_count() == 4);
  CHECK(shape.triangles(0, 2) == 3);
}

TEST_CASE("OBJ refuses what is damaged, with file and line") {
  CHECK(refusal(Format::obj, three_vertices + "f 1 2 0\n") ==
        "bad.file:4: expected a vertex between 1 and 3, found 0");
  CHECK(refusal(Format::obj, three_vertices + "f 1 2 4\n") ==
        "bad.file:4: expected a vertex between 1 and 3, found 4");
  CHECK(refusal(Format::obj, three_vertices + "\nf 1 2 -4\n") ==
        "bad.file:5: expected a vertex between 1 and 3, found -4");
  CHECK(refusal(Format::obj, "v 0 nan 0\n") ==
        "bad.file:1: expected the y coordinate as a finite number, found 'nan'");
  CHECK(refusal(Format::obj, three_vertices + "g a\\\nb\nf 1 2 x\n") ==
        "bad.file:6: expected a face corner such as 3 or 3/1/2, found 'x'");
  CHECK(refusal(Format::obj, three_vertices) == "bad.file holds points but no faces");
  CHECK(refusal(Format::obj, "") == "bad.file holds no mesh: it has no faces");
}
