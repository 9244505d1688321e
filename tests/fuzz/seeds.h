#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
inline constexpr std::uint64_t search_task = 7;
inline constexpr int search_queues = 2;

}  // namespace stackabilization::fuzz
