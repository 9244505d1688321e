#include "common/provenance.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "revision.h"
#include "stackabilization/shape/errors.h"

namespace stackabilization::experiments {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

std::string provenance_lines(const Provenance& provenance) {
  std::string lines = "# program: " + provenance.program + "\n# arguments:";
  for (const std::string& argument : provenance.arguments) lines += " " + argument;
  lines += "\n# threads: " + std::to_string(provenance.threads) + "\n# processor: " + processor() +
           "\n# compiler: " __VERSION__ "\n# version: " STACKABILIZATION_VERSION
           "\n# revision: " STACKABILIZATION_REVISION "\n";
  return lines;
}

std::string file_hash(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be opened for reading");
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (auto byte = std::istreambuf_iterator<char>(file); byte != std::istreambuf_iterator<char>(); ++byte)
    hash = (hash ^ static_cast<unsigned char>(*byte)) * 0x100000001b3U;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace stackabilization::experiments
