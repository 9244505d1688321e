#pragma once

#include <algorithm>

namespace stackabilization::test {

/// How often to repeat something random that a release build repeats `count` times. Builds with sanitizers
/// are slow, and look at each step, not at how many there are.
inline int repetitions(int count) {
  return std::max(1, count / STACKABILIZATION_SLOWDOWN);
}

}  // namespace stackabilization::test
