#include <CLI/Error.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/common/program.h"
#include "stackabilization/core/errors.h"

using namespace stackabilization;

/// A command line, one argument per line, is parsed, but not run; or it is refused in words.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments(1);
  for (std::size_t k = 0; k < size; ++k)
    if (data[k] == '\n')
      arguments.emplace_back();
    else
      arguments.back() += static_cast<char>(data[k]);
  try {
    apps::Program().parse(arguments);
  } catch (const CLI::Error&) {
  } catch (const UsageError&) {
  }
  return 0;
}
