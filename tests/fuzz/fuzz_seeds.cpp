#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/seeds.h"

using namespace stackabilization;

/// Marked triangles are refused with an InputError or are triangles of the shape, each at most once.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Triangles triangles(4, 3);
  triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  try {
    std::vector<int> marked(4);
    for (const PartSeeds& part : parse_seeds({reinterpret_cast<const char*>(data), size}, "fuzz",
                                             make_shape(Points::Identity(4, 3), triangles)))
      for (const std::int32_t triangle : part.triangles)
        if (part.name.empty() || ++marked.at(static_cast<std::size_t>(triangle)) > 1) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
