#include <algorithm>
#include <charconv>
#include <limits>
#include <vector>

#include "io/formats/formats.h"
#include "io/formats/shape_builder.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : bytes_(source.bytes),
        name_(source.name),
        cursor_(source, TextCursor::Backslash::continues_line),
        builder_(source.name) {}

  Shape read() {
    while (cursor_.next_line()) {
      const std::string_view keyword = cursor_.token();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f")
        read_face();
      else if (keyword == "g")
        open_group();
      else if (keyword == "o")
        open_object();
    }
    check_forward_references();
    const bool has_faces = !corners_.empty();  // those of the last one
    if (!has_faces && bytes_.find('\0') != std::string_view::npos)
      throw InputError(name_ + " holds no mesh: it is not text, but binary or UTF-16");
    return builder_.finish();
  }

 private:
  /// A corner used before its vertex is defined, to be checked at the end.
  struct ForwardReference {
    std::int64_t line;
    std::int64_t vertex;
  };

  void read_vertex() {
    const double x = cursor_.number("the x coordinate as a finite number");
    const double y = cursor_.number("the y coordinate as a finite number");
    const double z = cursor_.number("the z coordinate as a finite number");
    builder_.add_vertex(x, y, z);
  }

  void read_face() {
    corners_.clear();
    for (std::string_view corner = cursor_.token(); !corner.empty() && corner[0] != '#';
         corner = cursor_.token())
      corners_.push_back(vertex_of(corner));
    if (corners_.size() < 3)
      cursor_.fail("expected a face with at least three corners, found " + std::to_string(corners_.size()));
    builder_.add_face(corners_);
  }

  /// 0-based vertex of "a", "a/b", "a//c" or "a/b/c".
  std::int32_t vertex_of(std::string_view corner) {
    std::int64_t index = 0;
    const char* const end = corner.data() + corner.size();
    const auto [stop, error] = std::from_chars(corner.data(), end, index);
    const bool is_corner =
        error == std::errc() && (stop == end || *stop == '/') &&
        std::all_of(stop, end, [](char c) { return c == '/' || c == '-' || (c >= '0' && c <= '9'); });
    if (!is_corner) cursor_.fail_expected("a face corner such as 3 or 3/1/2", corner);
    const std::int64_t vertex = index > 0 ? index - 1 : builder_.vertex_count() + index;
    if (index == 0 || vertex < 0 || vertex >= std::numeric_limits<std::int32_t>::max())
      fail_missing(cursor_.line(), index);
    if (vertex >= builder_.vertex_count()) forward_references_.push_back({cursor_.line(), vertex});
    return static_cast<std::int32_t>(vertex);
  }

  [[noreturn]] void fail_missing(std::int64_t line, std::int64_t index) const {
    cursor_.fail_at(line, "expected a vertex between 1 and " + std::to_string(builder_.vertex_count()) +
                              ", found " + std::to_string(index));
  }

  void check_forward_references() const {
    for (const ForwardReference& reference : forward_references_)
      if (reference.vertex >= builder_.vertex_count()) fail_missing(reference.line, reference.vertex + 1);
  }

  void open_object() {
    const std::string name = cursor_.rest_of_line();
    cursor_.require_utf8(name);
    if (name.empty()) return;
    object_ = name;
    builder_.continue_part(name);
  }

  void open_group() {
    const std::string name = cursor_.rest_of_line();
    cursor_.require_utf8(name);
    if (name.empty()) return;
    builder_.continue_part(object_.empty() || object_ == name ? name : object_ + "/" + name);
  }

  std::string_view bytes_;
  std::string name_;
  TextCursor cursor_;
  ShapeBuilder builder_;
  std::string object_;
  std::vector<std::int32_t> corners_;
  std::vector<ForwardReference> forward_references_;
};

}  // namespace

Shape read_obj(const Source& source) {
  return ObjReader(source).read();
}

std::string write_obj(const Shape& shape) {
  std::string text;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, shape.vertices(v, axis));
    }
    text += '\n';
  }
  std::int32_t open_part = -1;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
    if (part != open_part)
      text += "g " + printable_name(shape.part_names[static_cast<std::size_t>(part)]) + "\n";
    open_part = part;
    text += 'f';
    for (int corner = 0; corner < 3; ++corner) {
      text += ' ';
      append_integer(text, std::int64_t{shape.triangles(t, corner)} + 1);
    }
    text += '\n';
  }
  return text;
}

}  // namespace stackabilization
