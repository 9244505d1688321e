#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stackabilization::experiments {

/// Where numbers come from: every output of an experiment begins with it.
struct Provenance {
  std::string program;
  std::string options;  ///< all options that bear on the numbers, defaults included, seeds too
  int threads = 1;
};

/// Pairs of key and value: program, options, threads, processor, compiler, library version and revision.
std::vector<std::pair<std::string, std::string>> entries(const Provenance& provenance);

}  // namespace stackabilization::experiments
