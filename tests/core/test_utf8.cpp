#include "io/formats/zip.h"
#include "stackabilization/core/utf8.h"
#include "stackabilization/io/labels.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

/// "seat" in Latin-1, with an accent.
const std::string latin = "si\xe8ge", good = "si\xc3\xa8ge";

std::string triangle_of(Format format, const std::string& name) {
  if (format == Format::obj) return "v 0 0 0\nv 1 0 0\nv 0 1 0\ng " + name + "\nf 1 2 3\n";
  if (format == Format::stl)
    return "solid " + name +
           "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
           "0\nendloop\nendfacet\nendsolid\n";
  if (format == Format::ply)
    return "ply\nformat ascii 1.0\ncomment part " + name +
           "\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
           "property list uchar int vertex_indices\nproperty int part\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 "
           "1 2 0\n";
  if (format == Format::three_mf)
    return zip({{"3D/3dmodel.model",
                 "<model><resources><object id='1' name='" + name +
                     "'><mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/>"
                     "<vertex x='0' y='1' z='0'/></vertices><triangles><triangle v1='0' v2='1' v3='2'/>"
                     "</triangles></mesh></object></resources><build><item objectid='1'/></build></model>"}});
  return R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "name": ")" + name +
         R"("}], "meshes": [{"primitives":
      [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
      "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

}  // namespace

TEST_CASE("UTF-8 is what RFC 3629 says") {
  for (const char* text : {"", "plain", "\xc3\xa8", "\xe2\x82\xac", "\xf0\x9f\xaa\x91", "\xf4\x8f\xbf\xbf"})
    CHECK(is_utf8(text));
  for (const char* text :
       {"\xe8", "\x80", "\xc3", "\xc3(", "\xe2\x82", "\xf0\x9f\xaa", "\xc0\xaf", "\xe0\x80\xaf",
        "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\xff", "a\xfe"})
    CHECK(!is_utf8(text));
}

TEST_CASE("part names in other encodings are refused where they are read, with the place") {
  const std::vector<std::pair<Format, std::string>> places = {{Format::obj, "bad.file:4: "},
                                                              {Format::stl, "bad.file:1: "},
                                                              {Format::ply, "bad.file:3: "},
                                                              {Format::three_mf, "object at byte "},
                                                              {Format::gltf, "line 1"}};
  for (const auto& [format, place] : places) {
    CHECK(read_text(format, triangle_of(format, good)).part_names == std::vector<std::string>{good});
    const std::string words = refusal(format, triangle_of(format, latin));
    INFO(words);
    CHECK(words.starts_with("bad.file"));
    CHECK(words.find(place) != std::string::npos);
    if (format != Format::gltf)
      CHECK(words.find("expected a name in UTF-8, found 'si?ge'") != std::string::npos);
  }
}

TEST_CASE("labels in other encodings are refused, and so are shapes made with such names") {
  const Shape shape = read_text(Format::obj, triangle_of(Format::obj, good));
  CHECK(with_labels(shape, good + "\n", "labels").part_names == std::vector<std::string>{good});
  for (const std::string& text : {latin + "\n", "1\nlabels " + latin + "\n0 0\n"})
    CHECK(message_of<InputError>([&] { with_labels(shape, text, "labels"); }).find("in UTF-8") !=
          std::string::npos);
  Shape named = shape;
  named.part_names = {latin};
  CHECK(message_of<InputError>([&] { validate(named); }) == "the part name 'si?ge' is not UTF-8");
}
