#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "fuzz/seeds.h"
#include "improvement/search/search_state.h"
#include "stackabilization/core/errors.h"

using namespace stackabilization;

/// A saved search is refused with an InputError or is valid, and then its text is a fixed point of reading
/// and writing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read = [](const std::string& text) {
    return detail::read_state({text, "state"}, fuzz::search_task());
  };
  try {
    const std::vector<std::string> parts = fuzz::search_task().rest.shape.part_names;
    const std::string text = detail::text_of(read({reinterpret_cast<const char*>(data), size}), parts);
    if (detail::text_of(read(text), parts) != text) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
