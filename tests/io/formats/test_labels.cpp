#include <fstream>

#include "stackabilization/io/labels.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

/// Four triangles.
Shape tetrahedron() {
  return extract_part(two_tetrahedra(), 0);
}

std::string label_refusal(const std::string& text) {
  return message_of<InputError>([&] { with_labels(tetrahedron(), text, "bad.seg"); });
}

using Names = std::vector<std::string>;
using Parts = std::vector<std::int32_t>;

}  // namespace

TEST_CASE(".seg labels replace the parts, in any order, with or without names") {
  const Shape named =
      with_labels(tetrahedron(), "3\r\nlabels seat leg back\r\n2 1\r\n0 0\r\n3 0\r\n1 2\r\n", "a.seg");
  CHECK(named.part_names == Names{"seat", "leg", "back"});
  CHECK(named.triangle_part == Parts{0, 2, 1, 0});
  const Shape numbered = with_labels(tetrahedron(), "2\n0 0\n1 1\n2 1\n3 0", "a.seg");
  CHECK(numbered.part_names == Names{"part_0", "part_1"});
  CHECK(numbered.triangle_part == Parts{0, 1, 1, 0});
  CHECK(numbered.vertices == tetrahedron().vertices);
}

TEST_CASE("plain labels are names in order of use or numbers in order of size") {
  const Shape named = with_labels(tetrahedron(), "left leg\n# comment\nseat\n\nleft leg\nback", "a.txt");
  CHECK(named.part_names == Names{"left leg", "seat", "back"});
  CHECK(named.triangle_part == Parts{0, 1, 0, 2});
  const Shape numbered = with_labels(tetrahedron(), "7\n2\n7\n4\n", "a.txt");
  CHECK(numbered.part_names == Names{"part_2", "part_4", "part_7"});
  CHECK(numbered.triangle_part == Parts{2, 0, 2, 1});
}

TEST_CASE("labels are applied on reading") {
  const ScratchFolder folder("labels");
  std::ofstream(folder.path() / "a.txt") << "p\nq\nq\np\n";
  ReadOptions options;
  options.labels = folder.path() / "a.txt";
  const Shape shape = read_text(Format::obj, shape_bytes(tetrahedron(), Format::obj), options);
  CHECK(shape.triangle_part == Parts{0, 1, 1, 0});
  options.labels = folder.path() / "missing.seg";
  CHECK_THROWS_AS(read_text(Format::obj, shape_bytes(tetrahedron(), Format::obj), options), InputError);
}

TEST_CASE("labels that do not fit are refused, with file and line") {
  CHECK(label_refusal("") == "bad.seg: expected part labels, found none");
  CHECK(label_refusal("2\n0 0\n1 1\n2 1\n") == "bad.seg: triangle 3 has no label");
  CHECK(label_refusal("2\n0 0\n1 1\n2 1\n4 1\n") ==
        "bad.seg:5: expected a triangle between 0 and 3, found '4'");
  CHECK(label_refusal("2\n0 0\n1 2\n") == "bad.seg:3: expected a part between 0 and 1, found '2'");
  CHECK(label_refusal("2\n0 0\n0 1\n") == "bad.seg:3: triangle 0 has a label already");
  CHECK(label_refusal("0\n\xEF\xBB\xBF\n3") ==
        "bad.seg: expected one label for each of 4 triangles, found 3");
  CHECK(label_refusal("2\n0 0\n1\n") == "bad.seg:3: expected a triangle and its part, found '1'");
  CHECK(label_refusal("2\nlabels a\n0 0\n") == "bad.seg:2: expected 2 part names, found 1");
  CHECK(label_refusal("999999999999\n0 0\n") ==
        "bad.seg:1: expected the number of parts, found '999999999999'");
  CHECK(label_refusal("2\nlabels a a\n0 0\n1 1\n2 1\n3 1\n") ==
        "bad.seg:2: expected part names that differ from each other");
  CHECK(label_refusal("a\nb\n") == "bad.seg: expected one label for each of 4 triangles, found 2");
  CHECK(label_refusal("0\n1\n-1\n0\n") ==
        "bad.seg:3: expected a part index that is not negative, found '-1'");
}
