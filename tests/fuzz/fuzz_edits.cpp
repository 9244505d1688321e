#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "apps/common/edit_grammar.h"
#include "stackabilization/core/errors.h"

using namespace stackabilization;

/// An edit is refused with a UsageError or is within all limits, and then its text is a fixed point of
/// parsing and writing, up to the rounding of angles.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::string> parts = {"body", "left leg", "a/face=1", "shape"};
  constexpr double diagonal = 5;
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const Edit edit = apps::parse_edit(text, parts, diagonal);
    validate(edit, diagonal);
    static_cast<void>(describe(edit, parts));
    const std::string again = apps::edit_text(edit, parts);
    if (apps::edit_text(apps::parse_edit(again, parts, diagonal), parts) != again) std::abort();
  } catch (const UsageError&) {
  }
  return 0;
}
