#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write.h"
#include "stackabilization/io/write_file.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// The number of a process that is no more.
pid_t ended_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  int status = 0;
  waitpid(child, &status, 0);
  return child;
}

}  // namespace

TEST_CASE("every format is written and read by its extension, in either case") {
  const ScratchFolder folder("write");
  for (const char* name : {"a.obj", "a.OFF", "a.ply", "a.Stl", "a.3mf", "a.glb"}) {
    const std::filesystem::path path = folder.path() / name;
    write_shape(cube(1.5), path);
    CHECK(same_corners(read_shape(path), cube(1.5)));
  }
  CHECK(entries(folder.path()) == 6);
}

TEST_CASE("a written file keeps the permissions of the one it replaces") {
  const ScratchFolder folder("permissions");
  const std::filesystem::path file = folder.path() / "a.txt";
  for (const unsigned mode : {0600u, 0644u, 0755u}) {
    std::ofstream(file) << "old";
    std::filesystem::permissions(file, static_cast<std::filesystem::perms>(mode));
    write_file_atomically(file, "new");
    CHECK(static_cast<unsigned>(std::filesystem::status(file).permissions()) == mode);
    CHECK(read_file(file) == "new");
  }
}

TEST_CASE("a written file replaces the old one whole, through links too") {
  const ScratchFolder folder("replace");
  const std::filesystem::path file = folder.path() / "a.txt";
  write_file_atomically(file, "a long first content");
  std::filesystem::create_symlink(file, folder.path() / "link.txt");
  write_file_atomically(folder.path() / "link.txt", "second");
  CHECK(read_file(file) == "second");
  CHECK(std::filesystem::is_symlink(folder.path() / "link.txt"));
  CHECK(entries(folder.path()) == 2);
  CHECK_NOTHROW(write_file_atomically("/dev/null", "x"));
}

TEST_CASE("what killed writers left goes with the next write of the same file, and nothing else does") {
  const ScratchFolder folder("leftovers");
  const std::string ended = std::to_string(ended_process()), parent = std::to_string(getppid());
  const std::string ours = std::to_string(getpid());
  for (const std::string& name :
       {"a.txt." + ended + ".tmp", "a.txt." + ours + ".tmp", "a.txt." + parent + ".tmp",
        "b.txt." + ended + ".tmp", std::string("a.txt.tmp"), std::string("a.txt.0.tmp"), "a.txt." + ended,
        "a.txt." + ended + "x.tmp"})
    std::ofstream(folder.path() / name) << "half";
  write_file_atomically(folder.path() / "a.txt", "whole");
  CHECK(read_file(folder.path() / "a.txt") == "whole");
  CHECK(!std::filesystem::exists(folder.path() / ("a.txt." + ended + ".tmp")));
  CHECK(!std::filesystem::exists(folder.path() / ("a.txt." + ours + ".tmp")));
  CHECK(entries(folder.path()) == 7);  // that of a living writer is there too
}

TEST_CASE("temporary names say whose they are") {
  CHECK(target_of_temporary("a.obj.4711.tmp") == "a.obj");
  CHECK(target_of_temporary("a.1.2.tmp") == "a.1");
  for (const char* name : {"a.obj", "a.tmp", "a.obj.tmp", ".12.tmp", "a.-3.tmp", "a.0.tmp", "a..tmp",
                           "a.99999999999999999999.tmp", "a.12.tmp2", "", ".tmp"})
    CHECK(!target_of_temporary(name));
}

TEST_CASE("what cannot be written is refused and leaves nothing behind") {
  const ScratchFolder folder("refuse");
  CHECK_THROWS_AS(write_file_atomically(folder.path(), "x"), OutputError);
  CHECK_THROWS_AS(write_file_atomically(folder.path() / "no" / "a.obj", "x"), OutputError);
  CHECK_THROWS_AS(write_file_atomically("/dev/full", "x"), OutputError);
  CHECK_THROWS_AS(write_shape(cube(), folder.path() / "a.xyz"), UsageError);
  CHECK_THROWS_AS(write_shape(cube(), folder.path() / "a.gltf"), UsageError);
  CHECK_THROWS_AS(write_shape(cube(), "-"), UsageError);
  CHECK_THROWS_AS(write_shape(Shape(), folder.path() / "a.obj"), InputError);
  CHECK_THROWS_AS(write_shape(cube(1e50), folder.path() / "a.stl"), OutputError);
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("the up axis of a file is turned to z exactly") {
  Points vertices(3, 3);
  vertices << 1, 2, 3, 0.1, 0, 0, 0, 0.7, 0;
  const std::string text =
      shape_bytes(make_shape(vertices, (Triangles(1, 3) << 0, 1, 2).finished()), Format::obj);
  ReadOptions options;
  options.unit = Unit::inch;
  for (const auto& [up, expected] :
       {std::pair(Axis::x, Eigen::RowVector3d(-3, 2, 1)), std::pair(Axis::y, Eigen::RowVector3d(1, -3, 2)),
        std::pair(Axis::z, Eigen::RowVector3d(1, 2, 3))}) {
    options.up = up;
    const Shape shape = read_text(Format::obj, text, options);
    CHECK(shape.vertices.row(0) == expected);
    CHECK_FALSE(std::signbit(shape.vertices(1, 1)));
    CHECK(shape.unit == Unit::inch);
    // A rotation, not a mirror image.
    const Eigen::Matrix3d corners = shape.vertices;
    CHECK(corners.determinant() == Approx(Eigen::Matrix3d(vertices).determinant()));
  }
}

TEST_CASE("VTP states its points, triangles and parts") {
  const std::string ascii = shape_bytes(two_tetrahedra(), Format::vtp, {{}, Encoding::ascii});
  CHECK(ascii.find("NumberOfPoints=\"8\"") != std::string::npos);
  CHECK(ascii.find("NumberOfPolys=\"8\"") != std::string::npos);
  CHECK(ascii.find("123456789.12345679") != std::string::npos);
  CHECK(ascii.find("0 0 0\n0 1 1\n1 1 \n</DataArray>") != std::string::npos);
  const std::string raw = shape_bytes(two_tetrahedra(), Format::vtp);
  const std::size_t start = raw.find("\n_") + 2;
  // Four arrays, each after the 64-bit number of its bytes.
  CHECK(raw.find("\n</AppendedData>") - start == 4 * 8 + 8 * 3 * 8 + 8 * 3 * 8 + 8 * 8 + 8 * 4);
  CHECK(raw.substr(start, 8) == std::string("\xC0\0\0\0\0\0\0\0", 8));
}

TEST_CASE("part names on one line survive line breaks in them") {
  Shape shape = cube();
  shape.part_names = {"a\nf 1 2 3"};
  CHECK(round_trip(shape, Format::obj).part_names == std::vector<std::string>{"a_f 1 2 3"});
  CHECK(round_trip(shape, Format::ply).part_names == std::vector<std::string>{"a_f 1 2 3"});
}
