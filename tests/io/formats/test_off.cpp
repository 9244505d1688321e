#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

TEST_CASE("OFF round trips to the bit, in one part") {
  const Shape shape = two_tetrahedra();
  const Shape back = round_trip(shape, Format::off);
  CHECK(back.vertices == shape.vertices);
  CHECK(back.triangles == shape.triangles);
  CHECK(back.part_names == std::vector<std::string>{"part"});
}

TEST_CASE("OFF keywords, comments, colours and polygons") {
  const Shape expected = read_text(Format::off, "OFF\n4 1 4\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n");
  CHECK(expected.triangle_count() == 2);
  CHECK(area_vector(expected) == Eigen::Vector3d(0, 0, 4));
  const std::string body = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n";
  for (const std::string& text :
       {"OFF 4 1 0\n" + body, "# c\n\nOFF # c\n# c\n4 1\n\n" + body, "OFF\r\n4 1 0\r\n" + body,
        std::string("COFF\n4 1 0\n0 0 0 255 0 0 1\n2 0 0 1 1 1 1\n2 2 0 1 1 1 1\n0 2 0 1 1 1 1\n4 0 1 2 3 "
                    "0.5 0.5 0.5"),
        std::string("NOFF\n4 1 0\n0 0 0 0 0 1\n2 0 0 0 0 1\n2 2 0 0 0 1\n0 2 0 0 0 1\n4 0 1 2 3\n")})
    CHECK(same_shape(read_text(Format::off, text), expected));
}

TEST_CASE("OFF refuses what is damaged, with file and line") {
  CHECK(refusal(Format::off, "OFF BINARY\nxyz") ==
        "bad.file:1: binary OFF is not supported, expected a text file");
  CHECK(refusal(Format::off, "4OFF\n") == "bad.file:1: expected the keyword OFF, COFF or NOFF, found '4OFF'");
  CHECK(refusal(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") ==
        "bad.file:6: expected a vertex between 0 and 2, found 3");
  CHECK(refusal(Format::off, "OFF\n999999999 1 0\n0 0 0\n") ==
        "bad.file:2: expected the number of vertices, found 999999999, more than the file has room for");
  CHECK(refusal(Format::off, "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n") == "bad.file holds points but no faces");
}
