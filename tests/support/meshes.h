#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/write.h"
#include "support/messages.h"

namespace stackabilization::test {

/// Two tetrahedra, parts "left leg" and "right", whose coordinates need all 17 digits or none.
inline Shape two_tetrahedra() {
  Shape shape;
  shape.vertices.resize(8, 3);
  shape.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1,  //
      0.1, 1.0 / 3, 2e-300, 0.1 + 0.2, 1e30, -7, 1e-5, 123456789.123456789, 3, -0.25, 1e22,
      4503599627370497.5;
  shape.triangles.resize(8, 3);
  shape.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6;
  shape.part_names = {"left leg", "right"};
  shape.triangle_part = {0, 0, 0, 0, 1, 1, 1, 1};
  return shape;
}

/// The cube [0, edge]^3, closed, oriented outward, one part.
inline Shape cube(double edge = 1) {
  Points vertices(8, 3);
  for (int v = 0; v < 8; ++v) vertices.row(v) << (v & 1) * edge, (v >> 1 & 1) * edge, (v >> 2 & 1) * edge;
  Triangles triangles(12, 3);
  triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3,
      7, 1, 7, 5;
  return make_shape(vertices, triangles);
}

inline Shape read_text(Format format, const std::string& text, const ReadOptions& options = {}) {
  return read_shape(text, format, "test", options);
}

/// Writes and reads back, in memory.
inline Shape round_trip(const Shape& shape, Format format, Encoding encoding = Encoding::binary) {
  return read_shape(shape_bytes(shape, format, {{}, encoding}), format, "test");
}

/// The same coordinates at the same corners of the same triangles, whatever the vertices are called.
inline bool same_corners(const Shape& a, const Shape& b) {
  if (a.triangle_count() != b.triangle_count()) return false;
  for (Eigen::Index t = 0; t < a.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (a.corner(t, corner) != b.corner(t, corner)) return false;
  return true;
}

inline bool same_parts(const Shape& a, const Shape& b) {
  return a.part_names == b.part_names && a.triangle_part == b.triangle_part;
}

inline bool same_shape(const Shape& a, const Shape& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && same_parts(a, b) && a.unit == b.unit;
}

/// Sum of the triangles' area vectors.
inline Eigen::Vector3d area_vector(const Shape& shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    sum += (shape.corner(t, 1) - shape.corner(t, 0)).cross(shape.corner(t, 2) - shape.corner(t, 0)) / 2;
  return sum;
}

/// The message of the InputError that reading ends in.
inline std::string refusal(Format format, const std::string& bytes, const std::string& name = "bad.file") {
  return message_of<InputError>([&] { read_shape(bytes, format, name); });
}

/// An empty folder of its own for a test, removed at the end.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name)
      : path_(std::filesystem::path(STACKABILIZATION_BINARY_DIR) / ("scratch_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace stackabilization::test
