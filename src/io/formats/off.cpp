#include <algorithm>
#include <vector>

#include "io/formats/formats.h"
#include "io/formats/shape_builder.h"

namespace stackabilization {

namespace {

class OffReader {
 public:
  explicit OffReader(const Source& source) : cursor_(source), builder_(source.name) {}

  Shape read() {
    read_keyword();
    const std::int64_t vertices = read_count("the number of vertices");
    const std::int64_t faces = read_count("the number of faces");
    builder_.reserve(static_cast<std::size_t>(vertices), static_cast<std::size_t>(faces));
    for (std::int64_t v = 0; v < vertices; ++v) read_vertex(v, vertices);
    for (std::int64_t f = 0; f < faces; ++f) read_face(f, faces);
    return builder_.finish();
  }

 private:
  /// [ST][C][N]OFF, perhaps with the counts on the same line. Four-dimensional and binary files are refused.
  void read_keyword() {
    if (!cursor_.next_content_line()) cursor_.fail("expected the keyword OFF, found the end of the file");
    std::string_view keyword = cursor_.token();
    for (const std::string_view prefix : {"ST", "C", "N"})
      if (keyword.starts_with(prefix)) keyword.remove_prefix(prefix.size());
    if (keyword != "OFF") cursor_.fail_expected("the keyword OFF, COFF or NOFF", keyword);
    counts_ = cursor_.token();
    if (counts_ == "BINARY") cursor_.fail("binary OFF is not supported, expected a text file");
    if (!counts_.empty() && counts_[0] != '#') return;
    if (!cursor_.next_content_line())
      cursor_.fail("expected the number of vertices, found the end of the file");
    counts_ = cursor_.token();
  }

  /// Every vertex and face takes more than one byte, so that larger counts are lies.
  std::int64_t read_count(const char* what) {
    const std::optional<std::int64_t> count = parse_integer(counts_);
    if (!count || *count < 0) cursor_.fail_expected(what, counts_);
    if (static_cast<std::uint64_t>(*count) > cursor_.remaining())
      cursor_.fail(std::string("expected ") + what + ", found " + std::to_string(*count) +
                   ", more than the file has room for");
    counts_ = cursor_.token();
    return *count;
  }

  void read_vertex(std::int64_t index, std::int64_t count) {
    if (!cursor_.next_content_line())
      cursor_.fail("expected " + std::to_string(count) + " vertices, found the end of the file after " +
                   std::to_string(index));
    const double x = cursor_.number("the x coordinate as a finite number");
    const double y = cursor_.number("the y coordinate as a finite number");
    const double z = cursor_.number("the z coordinate as a finite number");
    builder_.add_vertex(x, y, z);
  }

  void read_face(std::int64_t index, std::int64_t count) {
    if (!cursor_.next_content_line())
      cursor_.fail("expected " + std::to_string(count) + " faces, found the end of the file after " +
                   std::to_string(index));
    const std::int64_t size = cursor_.integer("the number of corners of a face");
    if (size < 3) cursor_.fail("expected a face with at least three corners, found " + std::to_string(size));
    corners_.clear();
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t vertex = cursor_.integer("the vertex of a face corner");
      if (vertex < 0 || vertex >= builder_.vertex_count())
        cursor_.fail("expected a vertex between 0 and " + std::to_string(builder_.vertex_count() - 1) +
                     ", found " + std::to_string(vertex));
      corners_.push_back(static_cast<std::int32_t>(vertex));
    }
    builder_.add_face(corners_);
  }

  TextCursor cursor_;
  ShapeBuilder builder_;
  std::string_view counts_;
  std::vector<std::int32_t> corners_;
};

}  // namespace

Shape read_off(const Source& source) {
  return OffReader(source).read();
}

std::string write_off(const Shape& shape) {
  std::string text =
      "OFF\n" + std::to_string(shape.vertex_count()) + " " + std::to_string(shape.triangle_count()) + " 0\n";
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis) {
      append_number(text, shape.vertices(v, axis));
      text += axis < 2 ? ' ' : '\n';
    }
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    text += '3';
    for (int corner = 0; corner < 3; ++corner) {
      text += ' ';
      append_integer(text, shape.triangles(t, corner));
    }
    text += '\n';
  }
  return text;
}

}  // namespace stackabilization
