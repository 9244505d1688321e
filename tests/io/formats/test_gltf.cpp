#include <fstream>

#include "io/formats/bytes.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

/// Four positions of a tetrahedron (floats) and 12 indices (bytes), 60 bytes.
const std::string buffer = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAIBAAEDAQIDAAMC";

std::string gltf(const std::string& nodes,
                 const std::string& uri = "data:application/octet-stream;base64," + buffer,
                 const std::string& count = "12") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"t","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
      {"bufferView":1,"componentType":5121,"count":)" +
         count +
         R"(,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
    "buffers":[{"byteLength":60,"uri":")" +
         uri + R"("}]})";
}

}  // namespace

TEST_CASE("GLB keeps floats, parts and the z axis") {
  Shape shape = concatenate(cube(1.5), solids::moved(cube(2), {5, 6, 7.25}));
  const Shape back = round_trip(shape, Format::gltf);
  CHECK(same_corners(back, shape));
  CHECK(same_parts(back, shape));
}

TEST_CASE("GLB counts in metres, whatever the unit of the shape") {
  const std::vector<std::pair<Unit, double>> metres = {
      {Unit::unknown, 1},       {Unit::metre, 1},     {Unit::centimetre, 1e-2}, {Unit::millimetre, 1e-3},
      {Unit::micrometre, 1e-6}, {Unit::inch, 0.0254}, {Unit::foot, 0.3048}};
  for (const auto& [unit, factor] : metres) {
    Shape shape = solids::moved(cube(250), {5, 6, 7.25});
    shape.unit = unit;
    const Shape back = round_trip(shape, Format::gltf);
    CHECK(back.unit == Unit::metre);
    REQUIRE(back.triangle_count() == shape.triangle_count());
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k)
        CHECK((back.corner(t, k) - factor * shape.corner(t, k)).norm() <=
              1e-6 * factor * shape.corner(t, k).norm());
  }
}

TEST_CASE("glTF applies the transforms of its nodes and turns y up to z up") {
  const Shape shape =
      read_text(Format::gltf,
                gltf(R"([{"children":[1],"translation":[10,0,0]},{"mesh":0,"name":"n","scale":[2,3,4]}])"));
  CHECK(shape.part_names == std::vector<std::string>{"n"});
  CHECK(shape.unit == Unit::metre);
  CHECK(shape.vertices.row(1) == Eigen::RowVector3d(12, 0, 0));
  CHECK(shape.vertices.row(2) == Eigen::RowVector3d(10, 0, 3));
  CHECK(shape.vertices.row(3) == Eigen::RowVector3d(10, -4, 0));
  ReadOptions as_is;
  as_is.up = Axis::z;
  const Shape unturned =
      read_text(Format::gltf, gltf(R"([{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,9,1]}])"), as_is);
  CHECK(unturned.vertices.row(1) == Eigen::RowVector3d(0, 1, 9));
  CHECK(unturned.vertices.row(2) == Eigen::RowVector3d(-1, 0, 9));
}

TEST_CASE("glTF mirrored nodes stay oriented outward") {
  const Shape shape = read_text(Format::gltf, gltf(R"([{"mesh":0,"scale":[-1,1,1]}])"));
  double volume = 0;
  for (Eigen::Index t = 0; t < 4; ++t)
    volume += shape.corner(t, 0).dot(shape.corner(t, 1).cross(shape.corner(t, 2))) / 6;
  CHECK(volume == Approx(1.0 / 6));
}

TEST_CASE("glTF finds buffers beside the file, and only there") {
  const ScratchFolder folder("gltf");
  const std::filesystem::path path = folder.path() / "t.gltf";
  std::ofstream(path) << gltf(R"([{"mesh":0}])", "t.bin");
  CHECK_THROWS_AS(read_shape(path), InputError);
  const Shape inside = read_text(Format::gltf, gltf(R"([{"mesh":0}])"));
  std::string bytes;
  for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})
    bytes.append(reinterpret_cast<const char*>(&value), 4);
  bytes += std::string("\0\2\1\0\1\3\1\2\3\0\3\2", 12);
  std::ofstream(folder.path() / "t.bin", std::ios::binary) << bytes;
  CHECK(same_shape(read_shape(path), inside));
  CHECK(refusal(Format::gltf, gltf(R"([{"mesh":0}])", "t.bin"))
            .starts_with("bad.file: expected a glTF 2.0 file"));
}

TEST_CASE("GLB is read although its JSON ends off a word") {
  std::string bytes = shape_bytes(cube(), Format::gltf);
  const auto json_size = load<std::uint32_t>(bytes.data() + 12, std::endian::little);
  for (std::uint32_t spaces = 1; spaces <= 3; ++spaces) {
    std::string header = bytes.substr(0, 8);
    append_little(header, static_cast<std::uint32_t>(bytes.size()) + spaces);
    append_little(header, json_size + spaces);
    const std::string longer =
        header + bytes.substr(16, 4 + json_size) + std::string(spaces, ' ') + bytes.substr(20 + json_size);
    CHECK(same_shape(read_text(Format::gltf, longer), read_text(Format::gltf, bytes)));
  }
}

TEST_CASE("glTF refuses what is damaged, with file and place") {
  CHECK(refusal(Format::gltf,
                gltf(R"([{"mesh":0}])", "data:application/octet-stream;base64," + buffer, "13")) ==
        "bad.file: accessor 1 states 13 elements, its buffer view has room for 12");
  CHECK(refusal(Format::gltf, gltf(R"([{"mesh":1}])")) == "bad.file: expected a mesh below 1, found 1");
  CHECK(refusal(Format::gltf, gltf(R"([{"children":[0]}])")) ==
        "bad.file: node 0 has several parents or is nested without end, expected a tree");
  CHECK(refusal(Format::gltf, gltf(R"([{}])")) == "bad.file holds no mesh: it has no faces");
  CHECK(refusal(Format::gltf, "{\"a\":" + std::string(100000, '[')) ==
        "bad.file: its JSON is nested without end");
  CHECK(refusal(Format::gltf, "{").starts_with("bad.file: expected a glTF 2.0 file"));
  const std::string bytes = shape_bytes(cube(), Format::gltf);
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    CHECK(refusal(Format::gltf, bytes.substr(0, length)).starts_with("bad.file"));
}

TEST_CASE("glTF refuses every number that cannot be one, where it stands") {
  const std::string good = gltf(R"([{"mesh":0}])");
  REQUIRE(read_text(Format::gltf, good).triangle_count() == 4);
  const auto with = [&good](const std::string& old_text, const std::string& new_text) {
    const std::size_t at = good.find(old_text);
    REQUIRE(at != std::string::npos);
    return good.substr(0, at) + new_text + good.substr(at + old_text.size());
  };
  // Each place with what is read wrong, or not at all, when it is not looked at.
  const std::vector<std::pair<std::string, std::string>> places = {
      {R"("bufferView":1)", R"("bufferView":)"},
      {R"("componentType":5121)", R"("componentType":)"},
      {R"("count":12)", R"("count":)"},
      {R"("byteOffset":48)", R"("byteOffset":)"},
      {R"("byteLength":12)", R"("byteLength":)"},
      {R"("byteLength":60)", R"("byteLength":)"},
      {R"("indices":1)", R"("indices":)"},
      {R"("POSITION":0)", R"("POSITION":)"},
      {R"("scene":0)", R"("scene":)"},
      {R"([{"mesh":0}])", R"([{"mesh":)"},
      {R"("byteLength":48)", R"("byteLength":48,"byteStride":)"}};
  for (const auto& [old_text, key] : places)
    for (const std::string value :
         {"-4", "1.5", "1e300", "18446744073709551615", "4294967296", "\"1\"", "null", "[0]", "true"}) {
      INFO(key << value);
      const std::string text = with(old_text, key + value + (old_text.ends_with("}]") ? "}]" : ""));
      const std::string words = refusal(Format::gltf, text);
      INFO(words);
      // So many bytes could be there; in this file there are not.
      const bool could_be = key.find("byte") != std::string::npos &&
                            key.find("Stride") == std::string::npos && value == "4294967296";
      if (could_be)
        CHECK(words.starts_with("bad.file"));
      else
        CHECK(words.starts_with("bad.file: /"));
      CHECK((could_be || words.find(": expected a whole number from ") != std::string::npos));
    }
  CHECK(refusal(Format::gltf, with(R"("byteOffset":48)", R"("byteOffset":-4)")) ==
        "bad.file: /bufferViews/1/byteOffset: expected a whole number from 0 to 9007199254740992, found -4");
}

TEST_CASE("glTF refuses transforms that are none") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0])",
       "/nodes/0/matrix: expected 16 numbers, found a list of 15"},
      {R"("matrix":[1e300,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1])",
       "/nodes/0/matrix/0: expected a number of magnitude"},
      {R"("translation":[0,0])", "/nodes/0/translation: expected 3 numbers"},
      {R"("translation":[0,0,"NaN"])", "/nodes/0/translation/2: expected a number"},
      {R"("rotation":[0,0,0,0])", "node 0 has a rotation of no length"},
      {R"("scale":7)", "/nodes/0/scale: expected 3 numbers, found 7"}};
  for (const auto& [transform, words] : cases) {
    const std::string found = refusal(Format::gltf, gltf(R"([{"mesh":0,)" + transform + "}]"));
    INFO(found);
    CHECK(found.find(words) != std::string::npos);
  }
}

TEST_CASE("glTF accessors stay inside their buffer views") {
  std::string text = gltf(R"([{"mesh":0}])");
  text.replace(text.find(R"("byteLength":48)"), 15, R"("byteLength":47)");
  CHECK(refusal(Format::gltf, text) ==
        "bad.file: accessor 0 states 4 elements, its buffer view has room for 3");
  text = gltf(R"([{"mesh":0}])");
  text.replace(text.find(R"("byteLength":48)"), 15, R"("byteLength":48,"byteStride":8)");
  CHECK(refusal(Format::gltf, text) ==
        "bad.file: accessor 0 has elements of 12 bytes, which do not fit the stride of its buffer view");
  text = gltf(R"([{"mesh":0}])");
  text.replace(text.find(R"("byteLength":12)"), 15, R"("byteLength":13)");
  CHECK(refusal(Format::gltf, text) == "bad.file: buffer view 1 goes beyond its buffer of 60 bytes");
}
