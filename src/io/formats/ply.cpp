#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "io/formats/bytes.h"
#include "io/formats/formats.h"
#include "io/formats/ply_header.h"
#include "io/formats/shape_builder.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using namespace ply;

/// Values of an ascii body. Every element begins a line; some programs leave more values on it than the
/// header states.
class AsciiBody {
 public:
  explicit AsciiBody(TextCursor cursor) : cursor_(std::move(cursor)) {}

  void begin_element() {
    if (!cursor_.next_content_line()) fail("expected a value, found the end of the file");
  }

  double value(Scalar) {
    const std::string_view token = cursor_.token_of_any_line();
    const std::optional<double> number = parse_number(token);
    if (!number)
      fail("expected a finite number, found " + (token.empty() ? "the end of the file" : in_quotes(token)));
    return *number;
  }
  void skip(Scalar, std::int64_t count) {
    for (; count > 0; --count)
      if (cursor_.token_of_any_line().empty()) fail("expected a value, found the end of the file");
  }
  std::size_t remaining() const { return cursor_.remaining(); }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  TextCursor cursor_;
};

/// Values of a binary body.
class BinaryBody {
 public:
  BinaryBody(const Source& source, const char* start, std::endian order)
      : name_(source.name),
        first_(source.bytes.data()),
        position_(start),
        end_(source.bytes.data() + source.bytes.size()),
        order_(order) {}

  void begin_element() {}
  double value(Scalar type) {
    const char* const at = take(size_of(type));
    switch (type) {
      case Scalar::int8:
        return load<std::int8_t>(at, order_);
      case Scalar::uint8:
        return load<std::uint8_t>(at, order_);
      case Scalar::int16:
        return load<std::int16_t>(at, order_);
      case Scalar::uint16:
        return load<std::uint16_t>(at, order_);
      case Scalar::int32:
        return load<std::int32_t>(at, order_);
      case Scalar::uint32:
        return load<std::uint32_t>(at, order_);
      case Scalar::float32:
        return load<float>(at, order_);
      case Scalar::float64:
        break;
    }
    return load<double>(at, order_);
  }
  void skip(Scalar type, std::int64_t count) {
    // The caller has bounded the count by the size of the file, so the product cannot overflow.
    take(size_of(type) * static_cast<std::size_t>(count));
  }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(name_ + ": byte " + std::to_string(position_ - first_) + ": " + message);
  }

 private:
  const char* take(std::size_t size) {
    if (size > remaining()) fail("expected more values, found the end of the file");
    return std::exchange(position_, position_ + size);
  }

  const std::string& name_;
  const char* first_;
  const char* position_;
  const char* end_;
  std::endian order_;
};

template <class Body>
class BodyReader {
 public:
  BodyReader(const Header& header, Body body, const std::string& name)
      : header_(header), body_(std::move(body)), builder_(name) {}

  Shape read() {
    for (const Element& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else
        skip_elements(element);
    }
    return builder_.finish();
  }

 private:
  /// Every element takes a byte or more, so that larger counts are lies.
  void check_count(const Element& element) const {
    if (element.count == 0) return;
    if (element.properties.empty()) body_.fail("element " + in_quotes(element.name) + " has no properties");
    if (static_cast<std::uint64_t>(element.count) > body_.remaining())
      body_.fail("the header states " + std::to_string(element.count) + " of element " +
                 in_quotes(element.name) + ", more than the file has room for");
  }

  std::int64_t integer(Scalar type, const char* what) {
    const double value = body_.value(type);
    constexpr double largest = 9007199254740992;  // Up to 2^53 a double holds every integer.
    if (!(std::abs(value) <= largest) || value != std::floor(value))
      body_.fail(std::string("expected ") + what + ", found a number that is no integer");
    return static_cast<std::int64_t>(value);
  }

  std::int64_t list_size(const Property& property) {
    const std::int64_t size = integer(*property.count_type, "the length of a list");
    if (size < 0 || static_cast<std::uint64_t>(size) > body_.remaining())
      body_.fail("expected the length of a list, found " + std::to_string(size));
    return size;
  }

  void skip_elements(const Element& element) {
    for (std::int64_t i = 0; i < element.count; ++i) {
      body_.begin_element();
      for (const Property& property : element.properties) skip(property);
    }
  }

  void skip(const Property& property) {
    body_.skip(property.type, property.count_type ? list_size(property) : 1);
  }

  void read_vertices(const Element& element) {
    std::array<std::size_t, 3> where{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const char* const names[] = {"x", "y", "z"};
      where[axis] = element.find(names[axis]);
      if (where[axis] == Element::absent || element.properties[where[axis]].count_type)
        body_.fail(std::string("expected the vertex property '") + names[axis] + "' in the header");
    }
    builder_.reserve(static_cast<std::size_t>(element.count), 0);
    for (std::int64_t v = 0; v < element.count; ++v) {
      body_.begin_element();
      std::array<double, 3> point{};
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        bool is_coordinate = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (i == where[axis]) {
            point[axis] = body_.value(element.properties[i].type);
            is_coordinate = true;
          }
        if (!is_coordinate) skip(element.properties[i]);
      }
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
        body_.fail("vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
      builder_.add_vertex(point[0], point[1], point[2]);
    }
  }

  void read_faces(const Element& element) {
    std::size_t indices = element.find("vertex_indices");
    if (indices == Element::absent) indices = element.find("vertex_index");
    if (element.count == 0) return;
    if (indices == Element::absent || !element.properties[indices].count_type)
      body_.fail("expected the face property list 'vertex_indices' in the header");
    std::size_t part = element.find("part");
    if (header_.part_names.empty() || (part != Element::absent && element.properties[part].count_type))
      part = Element::absent;
    for (std::int64_t f = 0; f < element.count; ++f) {
      body_.begin_element();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == indices)
          read_corners(element.properties[i], f);
        else if (i == part)
          open_part(integer(element.properties[i].type, "the part of a face"));
        else
          skip(element.properties[i]);
      }
      builder_.add_face(corners_);
    }
  }

  void read_corners(const Property& property, std::int64_t face) {
    const Element* const vertices = header_.find("vertex");
    const std::int64_t vertex_count = vertices ? vertices->count : 0;
    const std::int64_t size = list_size(property);
    if (size < 3)
      body_.fail("face " + std::to_string(face) + " has " + std::to_string(size) +
                 " corners, expected at least 3");
    corners_.clear();
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t vertex = integer(property.type, "the vertex of a face corner");
      if (vertex < 0 || vertex >= vertex_count)
        body_.fail("face " + std::to_string(face) + " refers to vertex " + std::to_string(vertex) + " of " +
                   std::to_string(vertex_count));
      corners_.push_back(static_cast<std::int32_t>(vertex));
    }
  }

  void open_part(std::int64_t part) {
    if (part < 0 || part >= static_cast<std::int64_t>(header_.part_names.size()))
      body_.fail("a face belongs to part " + std::to_string(part) + " of " +
                 std::to_string(header_.part_names.size()));
    builder_.continue_part(header_.part_names[static_cast<std::size_t>(part)]);
  }

  const Header& header_;
  Body body_;
  ShapeBuilder builder_;
  std::vector<std::int32_t> corners_;
};

std::string ply_header(const Shape& shape, const char* format) {
  std::string text = std::string("ply\nformat ") + format + " 1.0\n";
  for (const std::string& name : shape.part_names) text += "comment part " + printable_name(name) + "\n";
  return text + "element vertex " + std::to_string(shape.vertex_count()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(shape.triangle_count()) +
         "\nproperty list uchar int vertex_indices\nproperty int part\nend_header\n";
}

}  // namespace

Shape read_ply(const Source& source) {
  TextCursor cursor(source);
  const Header header = read_header(cursor);
  if (!header.order) return BodyReader(header, AsciiBody(cursor), source.name).read();
  return BodyReader(header, BinaryBody(source, cursor.next_line_start(), *header.order), source.name).read();
}

std::string write_ply(const Shape& shape, Encoding encoding) {
  const bool ascii = encoding == Encoding::ascii;
  std::string bytes = ply_header(shape, ascii ? "ascii" : "binary_little_endian");
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis) {
      const double value = shape.vertices(v, axis);
      if (!ascii) {
        append_little(bytes, value);
        continue;
      }
      append_number(bytes, value);
      bytes += axis < 2 ? ' ' : '\n';
    }
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
    bytes += ascii ? '3' : '\3';
    for (const std::int32_t value :
         {shape.triangles(t, 0), shape.triangles(t, 1), shape.triangles(t, 2), part}) {
      if (!ascii) {
        append_little(bytes, value);
        continue;
      }
      bytes += ' ';
      append_integer(bytes, value);
    }
    if (ascii) bytes += '\n';
  }
  return bytes;
}

}  // namespace stackabilization