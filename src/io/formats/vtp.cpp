#include <bit>

#include "io/formats/bytes.h"
#include "io/formats/formats.h"

namespace stackabilization {

namespace {

/// XML of VTK PolyData (VTK File Formats, Kitware), version 1.0: UInt64 lengths before appended arrays.
class VtpWriter {
 public:
  explicit VtpWriter(Encoding encoding) : encoding_(encoding) {}

  std::string write(const Shape& shape) {
    const std::string point_count = std::to_string(shape.vertex_count());
    const std::string triangle_count = std::to_string(shape.triangle_count());
    text_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
        point_count + "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
        triangle_count + "\">\n<Points>\n";
    append_array("Float64", "Points", 3,
                 std::vector<double>(shape.vertices.data(), shape.vertices.data() + shape.vertices.size()));
    text_ += "</Points>\n<Polys>\n";
    append_array(
        "Int64", "connectivity", 1,
        std::vector<std::int64_t>(shape.triangles.data(), shape.triangles.data() + shape.triangles.size()));
    std::vector<std::int64_t> offsets;
    for (std::int64_t t = 1; t <= shape.triangle_count(); ++t) offsets.push_back(3 * t);
    append_array("Int64", "offsets", 1, offsets);
    text_ += "</Polys>\n<CellData Scalars=\"part\">\n";
    append_array("Int32", "part", 1, shape.triangle_part);
    text_ += "</CellData>\n</Piece>\n</PolyData>\n";
    if (encoding_ == Encoding::binary)
      text_ += "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n";
    return text_ + "</VTKFile>\n";
  }

 private:
  template <class Number>
  void append_array(const char* type, const char* name, int components, const std::vector<Number>& values) {
    text_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
             std::to_string(components) + "\" format=\"";
    if (encoding_ == Encoding::ascii)
      append_ascii(values);
    else
      append_raw(values);
  }

  template <class Number>
  void append_ascii(const std::vector<Number>& values) {
    text_ += "ascii\">\n";
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_floating_point_v<Number>)
        append_number(text_, values[i]);
      else
        append_integer(text_, values[i]);
      text_ += i % 3 == 2 ? '\n' : ' ';
    }
    text_ += "\n</DataArray>\n";
  }

  template <class Number>
  void append_raw(const std::vector<Number>& values) {
    text_ += "appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    append_little(appended_, static_cast<std::uint64_t>(values.size() * sizeof(Number)));
    for (const Number value : values) append_little(appended_, value);
  }

  Encoding encoding_;
  std::string text_;
  std::string appended_;
};

}  // namespace

std::string write_vtp(const Shape& shape, Encoding encoding) {
  return VtpWriter(encoding).write(shape);
}

}  // namespace stackabilization
