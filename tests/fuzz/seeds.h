#pragma once

#include <string>
#include <vector>

#include "improvement/search/search_state.h"

namespace stackabilization::fuzz {

/// A good input to start from.
struct Seed {
  std::string target;  ///< "obj" for the target fuzz_obj
  std::string name;    ///< of its file, unlike the others of its target
  std::string bytes;
};

/// At least one for every target.
std::vector<Seed> seeds();

/// What the saved searches of the target search_state belong to.
detail::SearchTask search_task();

}  // namespace stackabilization::fuzz
