#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "io/formats/bytes.h"
#include "io/formats/formats.h"
#include "io/formats/shape_builder.h"
#include "mesh/point_index.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t facet_size = 50;
constexpr std::size_t preamble_size = header_size + sizeof(std::uint32_t);

/// Corners with equal coordinates become one vertex.
class StlBuilder {
 public:
  explicit StlBuilder(const std::string& name) : builder_(name) {}

  ShapeBuilder& parts() { return builder_; }
  std::int64_t face_count() const { return builder_.face_count(); }

  void add_corner(const Eigen::Vector3d& point) {
    const std::int32_t vertex = index_.insert(point);
    if (vertex == builder_.vertex_count()) {
      const Eigen::Vector3d& stored = index_.points().back();
      builder_.add_vertex(stored.x(), stored.y(), stored.z());
    }
    triangle_[corner_++] = vertex;
    if (corner_ < 3) return;
    builder_.add_face(triangle_);
    corner_ = 0;
  }

 private:
  ShapeBuilder builder_;
  PointIndex index_;
  std::array<std::int32_t, 3> triangle_{};
  std::size_t corner_ = 0;
};

class AsciiReader {
 public:
  explicit AsciiReader(const Source& source) : cursor_(source), builder_(source.name) {}

  Shape read() {
    for (std::string keyword = next_keyword(); !keyword.empty(); keyword = next_keyword()) {
      if (keyword != "solid") cursor_.fail_expected("'solid'", keyword);
      const std::string name = cursor_.rest_of_line();
      cursor_.require_utf8(name);
      builder_.parts().begin_part(name);
      read_facets();
    }
    return builder_.parts().finish();
  }

 private:
  std::string next_keyword() { return lower_case(cursor_.token_of_any_line()); }

  void expect(const char* keyword) {
    const std::string found = next_keyword();
    if (found != keyword) cursor_.fail(std::string("expected '") + keyword + "', found " + described(found));
  }

  static std::string described(const std::string& token) {
    return token.empty() ? "the end of the file" : in_quotes(token);
  }

  void read_facets() {
    for (std::string keyword = next_keyword(); keyword != "endsolid"; keyword = next_keyword()) {
      if (keyword != "facet") cursor_.fail("expected 'facet' or 'endsolid', found " + described(keyword));
      // The stated normal is ignored: the order of the corners decides.
      cursor_.next_line();
      expect("outer");
      expect("loop");
      for (int corner = 0; corner < 3; ++corner) {
        expect("vertex");
        const double x = cursor_.number("the x coordinate as a finite number");
        const double y = cursor_.number("the y coordinate as a finite number");
        const double z = cursor_.number("the z coordinate as a finite number");
        builder_.add_corner({x, y, z});
      }
      expect("endloop");
      expect("endfacet");
    }
    cursor_.rest_of_line();
  }

  TextCursor cursor_;
  StlBuilder builder_;
};

Shape read_binary_stl(const Source& source) {
  const char* facet = source.bytes.data() + preamble_size;
  const char* const end = source.bytes.data() + source.bytes.size();
  StlBuilder builder(source.name);
  for (; facet < end; facet += facet_size)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      Eigen::Vector3d point;
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[static_cast<Eigen::Index>(axis)] =
            load<float>(facet + sizeof(float) * (3 * corner + axis), std::endian::little);
      if (!point.allFinite())
        throw InputError(source.name + ": triangle " + std::to_string(builder.face_count()) +
                         " has a coordinate that is not a finite number");
      builder.add_corner(point);
    }
  return builder.parts().finish();
}

/// Zero for a degenerate triangle. Scaled first, so that it cannot overflow.
Eigen::Vector3d unit_normal(const Shape& shape, Eigen::Index t) {
  const double scale =
      std::max({shape.corner(t, 0).cwiseAbs().maxCoeff(), shape.corner(t, 1).cwiseAbs().maxCoeff(),
                shape.corner(t, 2).cwiseAbs().maxCoeff()});
  if (scale == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = shape.corner(t, 0) / scale;
  const Eigen::Vector3d a = (shape.corner(t, 1) / scale - origin).stableNormalized();
  const Eigen::Vector3d b = (shape.corner(t, 2) / scale - origin).stableNormalized();
  return a.cross(b).stableNormalized();
}

std::string write_ascii_stl(const Shape& shape) {
  std::string text;
  const auto append_vector = [&text](const char* keyword, const Eigen::Vector3d& vector) {
    text += keyword;
    for (int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, vector[axis]);
    }
    text += '\n';
  };
  const std::vector<std::vector<Eigen::Index>> members = triangles_by_part(shape);
  for (std::size_t part = 0; part < members.size(); ++part) {
    const std::string name = printable_name(shape.part_names[part]);
    text += "solid " + name + "\n";
    for (const Eigen::Index t : members[part]) {
      append_vector("facet normal", unit_normal(shape, t));
      text += "outer loop\n";
      for (int corner = 0; corner < 3; ++corner) append_vector("vertex", shape.corner(t, corner));
      text += "endloop\nendfacet\n";
    }
    text += "endsolid " + name + "\n";
  }
  return text;
}

std::string write_binary_stl(const Shape& shape) {
  std::string bytes = "binary STL by Stackabilization";
  bytes.resize(header_size, ' ');
  append_little(bytes, static_cast<std::uint32_t>(shape.triangle_count()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d normal = unit_normal(shape, t);
    for (int axis = 0; axis < 3; ++axis) append_little(bytes, static_cast<float>(normal[axis]));
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        append_little(bytes, to_single(shape.vertices(shape.triangles(t, corner), axis), "binary STL"));
    append_little(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < preamble_size) return false;
  const auto facets = load<std::uint32_t>(bytes.data() + header_size, std::endian::little);
  return bytes.size() == preamble_size + facet_size * std::size_t{facets};
}

Shape read_stl(const Source& source) {
  // Binary files may begin with "solid" too, so the size decides first.
  if (is_binary_stl(source.bytes)) return read_binary_stl(source);
  const std::size_t start = source.bytes.find_first_not_of(" \t\r\n");
  if (start != std::string_view::npos && lower_case(source.bytes.substr(start, 5)) == "solid")
    return AsciiReader(source).read();
  if (source.bytes.size() < preamble_size)
    throw InputError(source.name + ": expected an STL file, found neither 'solid' nor a binary header of " +
                     std::to_string(preamble_size) + " bytes");
  const auto facets = load<std::uint32_t>(source.bytes.data() + header_size, std::endian::little);
  throw InputError(source.name + ": byte 80 states " + std::to_string(facets) +
                   " triangles, expected a file of " +
                   std::to_string(preamble_size + facet_size * std::size_t{facets}) + " bytes, found " +
                   std::to_string(source.bytes.size()));
}

std::string write_stl(const Shape& shape, Encoding encoding) {
  return encoding == Encoding::ascii ? write_ascii_stl(shape) : write_binary_stl(shape);
}

}  // namespace stackabilization
