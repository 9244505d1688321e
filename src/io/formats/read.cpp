#include "stackabilization/io/read.h"

#include <utility>

#include "io/formats/formats.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/labels.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization {

namespace {

using Folder = std::optional<std::filesystem::path>;

Shape read_in_file_axes(const Source& source, Format format, const Folder& folder) {
  switch (format) {
    case Format::obj:
      return read_obj(source);
    case Format::off:
      return read_off(source);
    case Format::ply:
      return read_ply(source);
    case Format::stl:
      return read_stl(source);
    case Format::three_mf:
      return read_three_mf(source);
    case Format::gltf:
      return read_gltf(source, folder);
    case Format::vtp:
      break;
  }
  throw InputError(source.name + ": VTP files are only written, expected one of " +
                   std::string(readable_extensions()));
}

void turn_up_to_z(Points& points, Axis up) {
  // Negated as 0 - a, which gives no negative zeros.
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Eigen::RowVector3d p = points.row(v);
    if (up == Axis::x) points.row(v) << 0 - p.z(), p.y(), p.x();
    if (up == Axis::y) points.row(v) << p.x(), 0 - p.z(), p.y();
  }
}

Shape read_source(const Source& source, Format format, const Folder& folder, const ReadOptions& options) {
  Shape shape = read_in_file_axes(source, format, folder);
  const Axis up = options.up.value_or(format == Format::gltf ? Axis::y : Axis::z);
  if (up != Axis::z) turn_up_to_z(shape.vertices, up);
  if (options.unit) shape.unit = *options.unit;
  if (options.labels) shape = with_labels(std::move(shape), *options.labels);
  try {
    validate(shape);
  } catch (const InputError& error) {
    throw InputError(source.name + ": " + error.what());
  }
  return shape;
}

}  // namespace

Shape read_shape(const std::filesystem::path& path, const ReadOptions& options) {
  if (path.empty()) throw InputError("expected the name of a mesh file, found an empty one");
  const bool is_standard_input = path == "-";
  // The extension is judged before the content, so that a wrong name costs nothing.
  std::optional<Format> format = options.format;
  const std::string name = is_standard_input ? "standard input" : path.string();
  std::error_code ignored;
  if (!format && !is_standard_input && !std::filesystem::is_directory(path, ignored))
    format = format_of_extension(path);
  const std::string bytes = read_file(path);
  if (!format) format = sniff_format(bytes);
  if (!format)
    throw InputError(name + ": the content is of no known kind, expected a mesh as in " +
                     std::string(readable_extensions()));
  return read_source({bytes, name}, *format, path.parent_path(), options);
}

Shape read_shape(std::string_view bytes, Format format, const std::string& name, const ReadOptions& options) {
  return read_source({bytes, name}, format, std::nullopt, options);
}

}  // namespace stackabilization
