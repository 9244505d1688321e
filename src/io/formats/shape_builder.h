#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Collects what a reader finds and makes a Shape of it. Parts come into being with their first face.
class ShapeBuilder {
 public:
  /// `name` is the file in messages.
  explicit ShapeBuilder(const std::string& name) : name_(name) {}

  /// Room for that many; the caller has checked them against the size of the file.
  void reserve(std::size_t vertices, std::size_t faces);

  /// Coordinates must be finite. Throws InputError when there are more vertices than can be indexed.
  std::int32_t add_vertex(double x, double y, double z);
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(coordinates_.size() / 3); }

  /// Following faces belong to the part of this name, which may have been open before. Empty means "part".
  void continue_part(const std::string& name);
  /// Following faces belong to a part of their own, called `name`, or `name`_2 and so on where that is taken.
  void begin_part(const std::string& name);

  /// A polygon of at least three corners. Indices may be checked as late as just before `finish`.
  void add_face(std::span<const std::int32_t> corners);
  std::int64_t face_count() const { return static_cast<std::int64_t>(face_sizes_.size()); }

  /// Cuts polygons into triangles and gives everything away. Throws InputError when there is no face.
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
  std::map<std::string, int> copies_of_name_;  ///< Numbers tried so far, so that many equal names stay cheap.
  std::string open_name_ = "part";
  bool open_as_new_ = false;
  std::int32_t open_part_ = -1;  ///< Index of the open part once it has a face.
};

}  // namespace stackabilization
