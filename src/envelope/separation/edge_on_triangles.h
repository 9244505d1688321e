#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {

/// The triangles of a tree that are edge-on and so share no columns of positive width with anything; none in
/// closed semantics, where width does not matter. Each is decided on first use, in rational arithmetic where
/// the filter cannot tell: a wall along r is met once per neighbour.
class EdgeOnTriangles {
 public:
  EdgeOnTriangles(const std::vector<TreeTriangle>& triangles, const Projection& projection)
      : triangles_(triangles), projection_(projection) {}

  /// `seen`: the triangle with this index, projected.
  bool contains(std::int32_t index, const ProjectedTriangle& seen) {
    if (!seen.possibly_edge_on() || projection_.semantics == ContactSemantics::closed) return false;
    if (states_.empty()) states_.assign(triangles_.size(), State::unknown);
    State& state = states_[index];
    if (state == State::unknown)
      state = is_edge_on(triangles_[index], projection_.shear) ? State::yes : State::no;
    return state == State::yes;
  }

 private:
  enum class State : char { unknown, yes, no };

  const std::vector<TreeTriangle>& triangles_;
  const Projection& projection_;
  std::vector<State> states_;
};

}  // namespace stackabilization::detail
