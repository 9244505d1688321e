#include <bit>

#include "io/formats/bytes.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

template <class Number>
void append(std::string& bytes, Number value, std::endian order) {
  std::string little;
  append_little(little, value);
  if (order == std::endian::big) std::reverse(little.begin(), little.end());
  bytes += little;
}

/// A unit square with every kind of property around what matters, in binary.
std::string odd_binary_ply(std::endian order) {
  std::string bytes =
      std::string("ply\nformat ") +
      (order == std::endian::big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\ncomment odd\nobj_info odd\nelement material 1\nproperty list uchar double numbers\n"
      "property short last\nelement vertex 4\nproperty uchar red\nproperty float x\nproperty double y\n"
      "property list ushort int extra\nproperty int8 z\nelement face 1\nproperty list uint8 float uv\n"
      "property list ushort uint vertex_index\nproperty float32 quality\nelement edge 1\n"
      "property int vertex1\nend_header\n";
  bytes += '\2';
  for (const double value : {1.0, 2.0}) append(bytes, value, order);
  append(bytes, std::int16_t{-3}, order);
  for (int v = 0; v < 4; ++v) {
    bytes += '\7';
    append(bytes, v == 1 || v == 2 ? 1.5f : 0.0f, order);
    append(bytes, v >= 2 ? 0.1 : 0.0, order);
    append(bytes, static_cast<std::uint16_t>(v), order);
    for (int i = 0; i < v; ++i) append(bytes, std::int32_t{i}, order);
    bytes += static_cast<char>(-5);
  }
  bytes += '\1';
  append(bytes, 0.25f, order);
  append(bytes, std::uint16_t{4}, order);
  for (std::uint32_t corner = 0; corner < 4; ++corner) append(bytes, corner, order);
  append(bytes, 1.0f, order);
  append(bytes, std::int32_t{3}, order);
  return bytes;
}

std::string ascii_ply(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

}  // namespace

TEST_CASE("PLY round trips to the bit, with parts, in both encodings") {
  const Shape shape = two_tetrahedra();
  CHECK(same_shape(round_trip(shape, Format::ply, Encoding::binary), shape));
  CHECK(same_shape(round_trip(shape, Format::ply, Encoding::ascii), shape));
}

TEST_CASE("PLY skips properties and elements that it does not need, in both byte orders") {
  const Shape little = read_text(Format::ply, odd_binary_ply(std::endian::little));
  CHECK(little.triangle_count() == 2);
  CHECK(little.vertices.row(2) == Eigen::RowVector3d(1.5, 0.1, -5));
  CHECK(area_vector(little).isApprox(Eigen::Vector3d(0, 0, 0.15)));
  CHECK(same_shape(read_text(Format::ply, odd_binary_ply(std::endian::big)), little));
}

TEST_CASE("PLY ascii keeps the decimals of a float property and reads CRLF") {
  const std::string text = ascii_ply("0 0 0\n0.1 0 0\n0 1 0\n", "3 0 1 2");
  const Shape shape = read_text(Format::ply, text);
  CHECK(shape.vertices(1, 0) == 0.1);
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(same_shape(read_text(Format::ply, crlf), shape));
}

TEST_CASE("PLY ascii ignores values that a line has beyond the header") {
  const std::string plain = ascii_ply("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n");
  CHECK(same_shape(read_text(Format::ply, ascii_ply("0 0 0 7 7\n1 0 0 7\n\n0 1 0\n", "3 0 1 2 9 9 9\n")),
                   read_text(Format::ply, plain)));
}

TEST_CASE("PLY refuses what is damaged, with file and place") {
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(refusal(Format::ply, "plx\n") == "bad.file:1: expected 'ply' in the first line");
  CHECK(refusal(Format::ply, ascii_ply(vertices, "3 0 1 3\n")) ==
        "bad.file:13: face 0 refers to vertex 3 of 3");
  CHECK(refusal(Format::ply, ascii_ply(vertices, "2 0 1\n")) ==
        "bad.file:13: face 0 has 2 corners, expected at least 3");
  CHECK(refusal(Format::ply, ascii_ply("0 0 0\n1 0 inf\n", "")) ==
        "bad.file:11: expected a finite number, found 'inf'");
  const std::string whole = odd_binary_ply(std::endian::little);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    INFO("cut after " << length << " bytes");
    CHECK(refusal(Format::ply, whole.substr(0, length)).starts_with("bad.file"));
  }
}
