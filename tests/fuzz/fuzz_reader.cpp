// One libFuzzer target per format: FUZZ_FORMAT is a member of Format.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/inspect.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/write.h"

using namespace stackabilization;

/// A file is refused with an InputError or gives a valid shape, which the formats without loss write and read
/// back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const Shape shape = read_shape(bytes, Format::FUZZ_FORMAT, "fuzz");
    validate(shape);
    report(inspect(shape));
    const Shape back = read_shape(shape_bytes(shape, Format::ply), Format::ply, "back");
    if (back.triangles != shape.triangles || back.vertices != shape.vertices) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
