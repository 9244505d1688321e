#include "io/formats/formats.h"
#include "io/formats/zip.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

const std::string tetrahedron_xml =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/><triangle v1='0' "
    "v2='1' v3='3'/>"
    "<triangle v1='1' v2='2' v3='3'/><triangle v1='0' v2='3' v3='2'/></triangles></mesh>";

std::string model(const std::string& resources, const std::string& items,
                  const std::string& attributes = "") {
  return "<?xml version='1.0'?><model " + attributes + "><resources>" + resources + "</resources><build>" +
         items + "</build></model>";
}

Shape read_model(const std::string& xml) {
  return read_text(Format::three_mf, zip({{"3D/3dmodel.model", xml}}));
}

std::string model_refusal(const std::string& xml) {
  return refusal(Format::three_mf, zip({{"3D/3dmodel.model", xml}}));
}

}  // namespace

TEST_CASE("3MF round trips to the bit, with parts and unit") {
  Shape shape = two_tetrahedra();
  shape.part_names[0] = "a <&> \"b\" \xC3\xA4";
  for (const Unit unit :
       {Unit::micrometre, Unit::millimetre, Unit::centimetre, Unit::metre, Unit::inch, Unit::foot}) {
    shape.unit = unit;
    const Shape back = round_trip(shape, Format::three_mf);
    CHECK(same_corners(back, shape));
    CHECK(same_parts(back, shape));
    CHECK(back.unit == unit);
  }
}

TEST_CASE("3MF of the same shape has the same bytes") {
  CHECK(shape_bytes(cube(), Format::three_mf) == shape_bytes(cube(), Format::three_mf));
}

TEST_CASE("3MF places objects and components") {
  const std::string resources =
      "<object id='1' name='t'>" + tetrahedron_xml +
      "</object><object id='2'><components><component objectid='1'/>"
      "<component objectid='1' transform='2 0 0 0 3 0 0 0 4 10 20 30'/></components></object>";
  const Shape shape = read_model(
      model(resources, "<item objectid='2' transform='0 1 0 -1 0 0 0 0 1 0 0 100'/>", "unit='inch'"));
  CHECK(shape.unit == Unit::inch);
  CHECK(shape.part_names == std::vector<std::string>{"t", "t_2"});
  // Row vectors: (x, y, z) goes to (2x+10, 3y+20, 4z+30), then to (-y, x, z+100).
  CHECK(shape.vertices.row(1) == Eigen::RowVector3d(0, 1, 100));
  CHECK(shape.vertices.row(5) == Eigen::RowVector3d(-20, 12, 130));
  CHECK(shape.vertices.row(7) == Eigen::RowVector3d(-20, 10, 134));
  CHECK(solids::signed_volume(extract_part(shape, 1)) == Approx(4));
}

TEST_CASE("3MF mirrored objects stay oriented outward") {
  const Shape shape = read_model(model("<object id='1'>" + tetrahedron_xml + "</object>",
                                       "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 0'/>"));
  CHECK(solids::signed_volume(shape) == Approx(1.0 / 6));
  CHECK(shape.part_names[0] == "object_1");
  CHECK(shape.unit == Unit::millimetre);
}

TEST_CASE("3MF follows its relationships and paths to other models") {
  const std::string relationships =
      "<Relationships><Relationship Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel' "
      "Target='/a/b.model' Id='r'/></Relationships>";
  const std::string root =
      model("<object id='5'><components><component objectid='1' p:path='/3D/o.model'/></components></object>",
            "<item objectid='5'/>",
            "requiredextensions='p' "
            "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06'");
  const std::string other = model("<object id='1' name='far'>" + tetrahedron_xml + "</object>", "");
  const Shape shape = read_text(
      Format::three_mf, zip({{"_rels/.rels", relationships}, {"a/b.model", root}, {"3D/o.model", other}}));
  CHECK(shape.part_names == std::vector<std::string>{"far"});
  CHECK(refusal(Format::three_mf, zip({{"_rels/.rels", relationships}, {"a/b.model", root}})) ==
        "bad.file: expected the entry '3D/o.model' in the archive");
}

TEST_CASE("3MF refuses what is damaged, with file and place") {
  CHECK(refusal(Format::three_mf, "PK nothing") ==
        "bad.file: expected a zip archive, found none or a damaged one");
  CHECK(refusal(Format::three_mf, zip({{"a", "b"}})) ==
        "bad.file: expected the entry '3D/3dmodel.model' in the archive");
  CHECK(model_refusal("<model").starts_with("bad.file: 3D/3dmodel.model: byte "));
  CHECK(model_refusal(model("", "")) == "bad.file holds no mesh: it has no faces");
  CHECK(model_refusal(model("", "<item objectid='3'/>")) ==
        "bad.file: expected an object 3 in '3D/3dmodel.model'");
  CHECK(model_refusal(model("<object id='1'><components><component objectid='1'/><component objectid='1'/>"
                            "</components></object>",
                            "<item objectid='1'/>"))
            .find("nested without end") != std::string::npos);
  CHECK(model_refusal(model("", "", "requiredextensions='b' xmlns:b='urn:beams'")) ==
        "bad.file: 3D/3dmodel.model: the file requires the extension 'b', which is not supported");
  CHECK(model_refusal(
            model("<object id='1'><mesh><vertices><vertex x='0' y='0'/></vertices></mesh></object>", ""))
            .find("expected a finite number as z, found ''") != std::string::npos);
  const std::string bytes = shape_bytes(cube(), Format::three_mf);
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    CHECK(refusal(Format::three_mf, bytes.substr(0, length)).starts_with("bad.file: "));
}

TEST_CASE("3MF components that multiply beyond reason are refused") {
  std::string resources = "<object id='0'>" + tetrahedron_xml + "</object>";
  for (int level = 1; level <= 40; ++level) {
    const std::string inner = "<component objectid='" + std::to_string(level - 1) + "'/>";
    resources +=
        "<object id='" + std::to_string(level) + "'><components>" + inner + inner + "</components></object>";
  }
  CHECK(model_refusal(model(resources, "<item objectid='40'/>")) ==
        "bad.file: the components make more than 100000 objects");
}
