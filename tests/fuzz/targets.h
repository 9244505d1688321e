#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stackabilization::fuzz {

/// A fuzz target as a function, for builds without libFuzzer. It aborts, or lets an exception out, for an
/// input that the program takes badly.
struct Target {
  std::string name;
  int (*run)(const std::uint8_t* data, std::size_t size);
};

/// All of them; targets.cpp.in is their list.
std::vector<Target> targets();

}  // namespace stackabilization::fuzz
