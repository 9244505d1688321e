#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Collects the vertices, faces and parts of a file and builds a Shape. A part exists from its first face on.
class ShapeBuilder {
 public:
  /// `name`: name of the file in messages.
  explicit ShapeBuilder(const std::string& name) : name_(name) {}

  /// Reserves memory. Precondition: the caller checked the numbers against the size of the file.
  void reserve(std::size_t vertices, std::size_t faces);

  /// Adds a vertex and returns its index. Throws InputError when there are more vertices than can be indexed.
  /// Precondition: finite coordinates.
  std::int32_t add_vertex(double x, double y, double z);
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

  /// Assigns the following faces to the part of this name, new or existing. An empty name means "part".
  void continue_part(const std::string& name);
  /// Assigns the following faces to a new part `name`, or `name`_2 and so on when the name exists.
  void begin_part(const std::string& name);

  /// Adds a polygon of at least three corners. The indices are used only in `finish`.
  void add_face(std::span<const std::int32_t> corners);
  std::int64_t face_count() const { return static_cast<std::int64_t>(face_sizes_.size()); }

  /// Cuts polygons into triangles and returns the shape. The builder is empty afterwards. Throws InputError
  /// when there is no face.
  Shape finish();

 private:
  std::int32_t current_part();

  const std::string& name_;
  std::vector<double> coordinates_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int32_t> face_sizes_;
  std::vector<std::int32_t> face_parts_;
  std::vector<std::string> part_names_;
  std::map<std::string, std::int32_t> part_of_name_;
  std::map<std::string, int> copies_of_name_;  ///< numbers tried so far, so that many equal names stay cheap
  std::string open_name_ = "part";
  bool open_as_new_ = false;
  std::int32_t open_part_ = -1;  ///< index of the open part; -1 before its first face
};

}  // namespace stackabilization
