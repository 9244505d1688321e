#include "stackabilization/rendering/drawing.h"

#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization {
void write_drawing(const std::filesystem::path& path, const Drawing& drawing) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".png")
    write_file_atomically(path, png_bytes(rasterize(drawing)));
  else if (extension == ".svg")
    write_file_atomically(path, svg_text(drawing));
  else
    throw UsageError("a picture is written as .png or .svg, not as \"" + path.filename().string() + "\"");
}

}  // namespace stackabilization
