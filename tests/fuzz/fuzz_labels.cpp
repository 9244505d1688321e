#include <cstdint>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/labels.h"

using namespace stackabilization;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Triangles triangles(4, 3);
  triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  try {
    validate(with_labels(make_shape(Points::Identity(4, 3), triangles),
                         std::string_view(reinterpret_cast<const char*>(data), size), "fuzz"));
  } catch (const InputError&) {
  }
  return 0;
}
