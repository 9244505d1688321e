#include <tuple>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

/// Status 3, one sentence that names the file, no result written.
void check_unusable(const TemporaryFolder& folder, std::vector<std::string> arguments,
                    const std::string& name) {
  arguments.insert(arguments.end(), {"--json", folder / "result.json"});
  check_refused(folder, arguments, 3, name);
}

std::string with_zeros(std::string text, std::size_t count) {
  return text + std::string(count, '\0');
}

/// Name and bytes of files that are no usable mesh.
std::vector<std::pair<std::string, std::string>> bad_files() {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
  return {
      {"empty.obj", ""},
      {"empty.off", ""},
      {"empty.ply", ""},
      {"empty.stl", ""},
      {"empty.3mf", ""},
      {"empty.glb", ""},
      {"text.obj", "this is no mesh\n"},
      {"no_faces.obj", triangle},
      {"zero_index.obj", triangle + "f 0 1 2\n"},
      {"large_index.obj", triangle + "f 1 2 4\n"},
      {"negative_index.obj", triangle + "f -1 -2 -4\n"},
      {"word_index.obj", triangle + "f 1 2 three\n"},
      {"two_corners.obj", triangle + "f 1 2\n"},
      {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"inf.obj", "v inf 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"overflow.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"short_vertex.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"binary.obj", with_zeros("v 0 0 0", 200)},
      {"wrong_word.off", "OOF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"lying.off", "OFF\n1000000000 1000000000 0\n0 0 0\n"},
      {"negative.off", "OFF\n-3 1 0\n"},
      {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
      {"no_end.ply", ply},
      {"no_z.ply",
       ply + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n3 0 1 2\n"},
      {"lying.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float "
       "y\nproperty float z\nelement face 2000000000\nproperty list uchar int vertex_indices\nend_header\n"},
      {"format.ply", "ply\nformat poetry 1.0\nend_header\n"},
      {"lying.stl", with_zeros("", 80) + "\xff\xff\xff\x7f" + with_zeros("", 50)},
      {"short.stl", with_zeros("", 83)},
      {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"},
      {"words.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex a b c\nendloop\nendfacet\nendsolid\n"},
      {"no_zip.3mf", "PK is how a zip begins, but this one goes on in English"},
      {"cut.glb", std::string("glTF\x02\x00\x00\x00\xff\xff\x00\x00", 12)},
      {"no_json.gltf", "{ \"asset\": "},
      {"picture.png", "\x89PNG\r\n"},
      {"no_extension", "v 0 0 0\n"},
  };
}

}  // namespace

TEST_CASE("files that are no usable mesh end with 3 and one sentence that names them") {
  const TemporaryFolder folder;
  const auto files = bad_files();
  REQUIRE(files.size() >= 30);
  for (const auto& [name, bytes] : files) check_unusable(folder, {"measure", folder.file(name, bytes)}, name);
}

TEST_CASE("what is wrong with a file is said in plain words") {
  const TemporaryFolder folder;
  std::string utf16 = "\xff\xfe";
  for (const char c : std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")) utf16 += {c, '\0'};
  const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
      {"utf16.obj", utf16, "holds no mesh: it is not text, but binary or UTF-16"},
      {"binary.obj", with_zeros("a header", 80) + with_zeros("solid", 60), "it is not text"},
      {"cut.gltf", "{ \"asset\":\n {", "its JSON is malformed at line 2, column "},
      {"empty.gltf", "", "it is too short"}};
  for (const auto& [name, bytes, words] : cases) {
    const Outcome outcome = run_program({"inspect", folder.file(name, bytes)});
    INFO(outcome.err);
    CHECK(outcome.status == 3);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK(outcome.err.find("exception") == std::string::npos);
  }
  CHECK(run_program({"inspect", ""}).err ==
        "stackabilize: expected the name of a mesh file, found an empty one\n");
}

TEST_CASE("files that are not there, folders and bad labels end with 3") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.obj", solids::box({1, 2, 3}));
  check_unusable(folder, {"inspect", folder / "missing.obj"}, "missing.obj");
  std::filesystem::create_directory(folder.path() / "folder.obj");
  check_unusable(folder, {"inspect", folder / "folder.obj"}, "folder.obj");
  check_unusable(folder, {"inspect", box, "--labels", folder / "missing.txt"}, "missing.txt");
  check_unusable(folder, {"inspect", box, "--labels", folder.file("few.txt", "a\nb\n")}, "few.txt");
  check_unusable(folder, {"inspect", box, "--format", "stl"}, "box.obj");
  check_unusable(folder, {"inspect", "-"}, "standard input");
  check_unusable(folder, {"stack", box, "--into", folder / "missing.obj"}, "missing.obj");
}

TEST_CASE("a flat shape has no stackability, and every command that needs one says so") {
  const TemporaryFolder folder;
  const std::string sheet = folder.file("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const std::string command : {"search", "map", "stack"}) {
    check_unusable(folder, {command, sheet}, "sheet.obj");
    check_unusable(folder, {command, sheet}, "no volume");
  }
  for (const std::string command : {"inspect", "measure"}) CHECK(run_program({command, sheet}).status == 0);
}
