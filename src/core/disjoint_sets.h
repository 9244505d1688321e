#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace stackabilization {

/// A partition of 0, ..., count - 1 that starts with singletons. Union-find with path halving; the root of a
/// set is its smallest member.
class DisjointSets {
 public:
  /// Creates `count` sets of one member each.
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Returns the smallest member of the set of `member`.
  std::size_t root(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  /// Unites the sets of `a` and `b`.
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// Returns the number of sets; O(members).
  std::size_t count() const {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i;
    return roots;
  }

  /// Returns the number of the set of every member. Sets are numbered 0, 1, ... in the order of their
  /// smallest members.
  std::vector<std::int32_t> numbers() {
    std::vector<std::int32_t> numbers(parent_.size());
    std::int32_t next = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) numbers[i] = root(i) == i ? next++ : numbers[root(i)];
    return numbers;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace stackabilization
