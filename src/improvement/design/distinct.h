#pragma once

#include <compare>
#include <string>
#include <vector>

#include "stackabilization/improvement/design.h"

namespace stackabilization::detail {

/// What an edit takes hold of and what it does to it, without amounts; alike for parts that symmetries tie
/// together.
struct Gesture {
  int part_class = 0;
  int handle_kind = 0, index = 0;
  int operation = 0;        ///< alternative of Operation
  int x = 0, y = 0, z = 0;  ///< coarse direction of a move, axis of a turn; up or down for a scaling
  int falloff = 0;

  auto operator<=>(const Gesture&) const = default;
};

/// Tells solutions apart.
class Distinctness {
 public:
  explicit Distinctness(const StructuredShape& rest);

  /// What the edits of a design do: sorted, each once.
  std::vector<Gesture> gestures(const std::vector<Edit>& edits) const;
  /// See best_first.
  bool differ(const Design& a, const Design& b) const;

 private:
  Gesture gesture(const Edit& edit) const;

  const StructuredShape& rest_;
  std::vector<int> part_class_;
};

}  // namespace stackabilization::detail
