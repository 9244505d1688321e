#include <cstdint>
#include <string>
#include <string_view>

#include "io/formats/formats.h"
#include "stackabilization/core/errors.h"

using namespace stackabilization;

/// The XML inside a 3MF archive, which a fuzzer cannot reach through deflate and checksums.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string name = "fuzz";
  try {
    validate(read_three_mf_model({std::string_view(reinterpret_cast<const char*>(data), size), name}));
  } catch (const InputError&) {
  }
  return 0;
}
