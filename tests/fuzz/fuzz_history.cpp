#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/history.h"

using namespace stackabilization;

/// A project with a history is refused with an InputError or is valid, and then its text is a fixed point of
/// reading and writing, and every node has edits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Project project = project_with_history({reinterpret_cast<const char*>(data), size}, "fuzz");
    const std::string text = project_text(project);
    if (project_text(project_with_history(text, "back")) != text) std::abort();
    for (std::size_t k = 0; k < project.history.nodes.size(); ++k)
      static_cast<void>(edits_to(project.history, static_cast<int>(k)));
  } catch (const InputError&) {
  }
  return 0;
}
