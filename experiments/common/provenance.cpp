#include "common/provenance.h"

#include <fstream>

#include "revision.h"

namespace stackabilization::experiments {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> entries(const Provenance& provenance) {
  return {{"program", provenance.program},
          {"options", provenance.options},
          {"threads", std::to_string(provenance.threads)},
          {"processor", processor()},
          {"compiler", __VERSION__},
          {"version", STACKABILIZATION_VERSION},
          {"revision", STACKABILIZATION_REVISION}};
}

}  // namespace stackabilization::experiments
