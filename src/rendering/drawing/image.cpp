#include "stackabilization/rendering/image.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

std::uint8_t byte(double component) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(component, 0.0, 1.0)));
}

}  // namespace

Image::Image(int columns, int rows, const Colour& background) : width(columns), height(rows) {
  constexpr int largest = 16384;
  if (columns < 1 || columns > largest || rows < 1 || rows > largest)
    throw UsageError("a picture must be 1 to 16384 pixels wide and high");
  bytes.resize(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) set_pixel(x, y, background);
}

std::array<std::uint8_t, 3> Image::pixel(int x, int y) const {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {bytes[at], bytes[at + 1], bytes[at + 2]};
}

void Image::set_pixel(int x, int y, const Colour& colour) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  bytes[at] = byte(colour.red);
  bytes[at + 1] = byte(colour.green);
  bytes[at + 2] = byte(colour.blue);
}

std::string png_bytes(const Image& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y)  // VTK counts rows from the bottom
    std::copy_n(image.bytes.data() + row_bytes * static_cast<std::size_t>(y), row_bytes,
                static_cast<std::uint8_t*>(data->GetScalarPointer(0, image.height - 1 - y, 0)));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(9);
  writer->Write();
  vtkUnsignedCharArray* encoded = writer->GetResult();
  if (encoded == nullptr || writer->GetErrorCode() != 0)
    throw RenderError("the PNG picture could not be encoded");
  return {reinterpret_cast<const char*>(encoded->GetPointer(0)),
          static_cast<std::size_t>(encoded->GetNumberOfValues())};
}

}  // namespace stackabilization
