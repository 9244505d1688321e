#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/project_file.h"

using namespace stackabilization;

/// A project is refused with an InputError or is valid, and then its text is a fixed point of reading and
/// writing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const StructuredShape project = project_of_text({reinterpret_cast<const char*>(data), size}, "fuzz");
    validate(project);
    const std::string text = project_text(project);
    if (project_text(project_of_text(text, "back")) != text) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
