#include <fstream>

#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

struct BadFile {
  std::string name;  ///< The extension tells the format.
  std::string content;
  std::string place;  ///< What the message must contain, next to the file's name.
};

const std::string ply = "ply\nformat ascii 1.0\n";
const std::string ply_body =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";

std::vector<BadFile> bad_files() {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string stl = shape_bytes(cube(), Format::stl);
  const std::string glb = shape_bytes(cube(), Format::gltf);
  const std::string three_mf = shape_bytes(cube(), Format::three_mf);
  std::string lying_stl = stl;
  lying_stl.replace(80, 4, "\xff\xff\xff\x7f");
  std::string damaged_zip = three_mf;
  damaged_zip[three_mf.find("3dmodel.model") + 60] ^= 0x55;
  return {
      {"empty.obj", "", "no faces"},
      {"points.obj", v, "no faces"},
      {"lines.obj", v + "l 1 2 3\n", "no faces"},
      {"zero.obj", v + "f 0 1 2\n", ":4:"},
      {"beyond.obj", v + "f 1 2 4\n", ":4:"},
      {"before.obj", v + "f -1 -2 -4\n", ":4:"},
      {"huge_index.obj", v + "f 1 2 99999999999999999999\n", ":4:"},
      {"nan.obj", "v 0 0 0\nv nan 0 0\n", ":2:"},
      {"inf.obj", "v 0 -inf 0\n", ":1:"},
      {"overflow.obj", "v 0 0 1e999\n", ":1:"},
      {"huge.obj", "v 0 0 0\nv 1e61 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 of triangle 0"},
      {"tiny.obj", "v 0 0 0\nv 1e-61 0 0\nv 0 1e-61 0\nf 1 2 3\n", "10^-60"},
      {"short.obj", "v 0 0\n", ":1:"},
      {"letters.obj", "v a b c\n", ":1:"},
      {"comma.obj", "v 0,5 0 0\n", ":1:"},
      {"two.obj", v + "f 1 2\n", ":4:"},
      {"slash.obj", v + "f 1 /2 3\n", ":4:"},
      {"html.obj", "<html><body>404</body></html>\n", "no faces"},
      {"zeros.obj", std::string(1000, '\0'), "not text"},
      {"empty.off", "", ":1:"},
      {"binary.off", "OFF BINARY\n", "binary"},
      {"keyword.off", "MESH\n", ":1:"},
      {"lying.off", "OFF\n2000000000 2000000000 0\n", ":2:"},
      {"negative.off", "OFF\n-3 1 0\n", ":2:"},
      {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ":4:"},
      {"size.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n", ":6:"},
      {"empty.ply", "", ":1:"},
      {"format.ply", "ply\nformat utf8 1.0\n", ":2:"},
      {"header.ply", ply + "element vertex 3\n", ":3:"},
      {"type.ply", ply + "element vertex 3\nproperty quad x\n", ":4:"},
      {"axis.ply", ply + "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", "'z'"},
      {"lying.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
       "property float y\nproperty float z\nend_header\n",
       "4000000000"},
      {"endless.ply", ply + "element nothing 4000000000000\nend_header\n", "no properties"},
      {"cut.ply", ply + ply_body + "0 0 0\n1 0 0\n0 1 0\n3 0 1", "end of the file"},
      {"list.ply", ply + ply_body + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", ":13:"},
      {"half.ply", ply + ply_body + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", ":13:"},
      {"points.ply",
       ply + "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
       "no faces"},
      {"empty.stl", "", "STL"},
      {"cut.stl", stl.substr(0, stl.size() - 1), "byte 80"},
      {"lying.stl", lying_stl, "2147483647"},
      {"words.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", ":6:"},
      {"none.stl", "solid a\nendsolid a\n", "no faces"},
      {"text.3mf", "not a zip", "zip"},
      {"cut.3mf", three_mf.substr(0, three_mf.size() / 2), "zip"},
      {"damaged.3mf", damaged_zip, "3dmodel.model"},
      {"cut.glb", glb.substr(0, glb.size() / 2), "glTF"},
      {"empty.gltf", "{}", "glTF"},
      {"written_only.vtp", "<VTKFile/>", "only written"},
      {"picture.jpg", "\xff\xd8\xff", "'.jpg'"},
      {"no_extension", v + "f 1 2 3\n", "no extension"},
  };
}

std::string reading_message(const std::filesystem::path& path) {
  return message_of<InputError>([&] { read_shape(path); });
}

}  // namespace

TEST_CASE("every bad file ends in one sentence that names the file and the place") {
  const ScratchFolder folder("bad");
  REQUIRE(bad_files().size() >= 30);
  for (const BadFile& file : bad_files()) {
    const std::filesystem::path path = folder.path() / file.name;
    std::ofstream(path, std::ios::binary) << file.content;
    const std::string message = reading_message(path);
    INFO(file.name << ": " << message);
    CHECK(message.find(path.string()) == 0);
    CHECK(message.find(file.place, path.string().size()) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < path.string().size() + 200);
  }
}

TEST_CASE("files that are missing, folders or unreadable are refused") {
  const ScratchFolder folder("missing");
  CHECK(reading_message(folder.path() / "a.obj") ==
        (folder.path() / "a.obj").string() + " cannot be read: no such file");
  CHECK(reading_message(folder.path()) == folder.path().string() + " is a folder, expected a file");
  CHECK(reading_message("/dev/null/a.obj").starts_with("/dev/null/a.obj cannot be read: "));
  CHECK(reading_message("") != "accepted");
}

TEST_CASE("content tells the format where no extension does") {
  CHECK(sniff_format(shape_bytes(cube(), Format::obj)) == Format::obj);
  CHECK(sniff_format("# only a comment\nv 0 0 0\n") == Format::obj);
  CHECK(sniff_format(shape_bytes(cube(), Format::off)) == Format::off);
  CHECK(sniff_format(shape_bytes(cube(), Format::ply)) == Format::ply);
  CHECK(sniff_format(shape_bytes(cube(), Format::stl)) == Format::stl);
  CHECK(sniff_format(shape_bytes(cube(), Format::stl, {{}, Encoding::ascii})) == Format::stl);
  CHECK(sniff_format(shape_bytes(cube(), Format::three_mf)) == Format::three_mf);
  CHECK(sniff_format(shape_bytes(cube(), Format::gltf)) == Format::gltf);
  CHECK(sniff_format("{\"asset\":{}}") == Format::gltf);
  CHECK_FALSE(sniff_format("").has_value());
  CHECK_FALSE(sniff_format("\xff\xd8\xff").has_value());
}
