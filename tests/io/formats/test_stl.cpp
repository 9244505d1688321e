#include <limits>

#include "io/formats/bytes.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

}  // namespace

TEST_CASE("Binary STL keeps floats, order and orientation, and welds") {
  const Shape shape = cube(1.5);
  const Shape back = round_trip(shape, Format::stl);
  CHECK(back.vertex_count() == 8);
  CHECK(same_corners(back, shape));
}

TEST_CASE("Ascii STL round trips to the bit, with solids as parts") {
  const Shape shape = two_tetrahedra();
  const Shape back = round_trip(shape, Format::stl, Encoding::ascii);
  CHECK(same_corners(back, shape));
  CHECK(same_parts(back, shape));
}

TEST_CASE("Binary STL may begin with the word solid") {
  std::string bytes = shape_bytes(cube(), Format::stl);
  bytes.replace(0, 9, "solid abc");
  CHECK(same_corners(read_text(Format::stl, bytes), cube()));
}

TEST_CASE("Ascii STL welds equal coordinates, also -0 and 0, and tells solids of one name apart") {
  const std::string solid = "solid a b\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                            facet("-0 0 -0", "0 1 0", "-1 0 0.0e5") + "endsolid a b\n";
  const Shape shape =
      read_text(Format::stl, solid + "SOLID\n" + facet("0 0 0", "1 0 0", "0 0 1") + "ENDSOLID\n" + solid);
  CHECK(shape.vertex_count() == 5);
  CHECK(shape.part_names == std::vector<std::string>{"a b", "part", "a b_2"});
  CHECK(shape.triangle_part == std::vector<std::int32_t>{0, 0, 1, 2, 2});
}

TEST_CASE("STL refuses what is damaged, with file and place") {
  const std::string whole = shape_bytes(cube(), Format::stl);
  CHECK(refusal(Format::stl, whole.substr(0, 300)) ==
        "bad.file: byte 80 states 12 triangles, expected a file of 684 bytes, found 300");
  std::string nan_bytes;
  append_little(nan_bytes, std::numeric_limits<float>::quiet_NaN());
  std::string not_a_number = whole;
  not_a_number.replace(84 + 50 * 7 + 12, 4, nan_bytes);
  CHECK(refusal(Format::stl, not_a_number) ==
        "bad.file: triangle 7 has a coordinate that is not a finite number");
  CHECK(refusal(Format::stl, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n") ==
        "bad.file:4: expected the z coordinate as a finite number, found the end of the line");
  CHECK(refusal(Format::stl, "solid a\n" + facet("0 0 0", "1 0 0", "0 1 0")) ==
        "bad.file:8: expected 'facet' or 'endsolid', found the end of the file");
  CHECK(refusal(Format::stl, "solid a\nendsolid a\n") == "bad.file holds no mesh: it has no faces");
  CHECK(refusal(Format::stl, "hello").starts_with("bad.file: expected an STL file"));
}

TEST_CASE("Formats of single precision refuse what does not fit") {
  Shape shape = cube(1e39);
  CHECK_THROWS_AS(shape_bytes(shape, Format::stl), OutputError);
  CHECK_THROWS_AS(shape_bytes(shape, Format::gltf), OutputError);
  CHECK(same_corners(round_trip(shape, Format::stl, Encoding::ascii), shape));
}
