#include "envelope/separation/separation_over_cone.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {
namespace {

/// Which side of a triangle is seen along the direction of a projection: 1 or -1, or 0 where rounding hides
/// it. The projected area of a triangle with normal n is n.r / |r_k|, for r_k > 0.
int side_seen(const ProjectedTriangle& triangle, const Projection& projection) {
  if (triangle.possibly_edge_on()) return 0;
  return (triangle.area > 0) == (projection.shear.sign > 0) ? 1 : -1;
}

struct SeenPair {
  const ProjectedTriangle& upper;
  const ProjectedTriangle& lower;
};

/// Returns a lower bound of the separation of two triangles along one direction, in units of r; -inf where
/// they have no common columns. Where the filter cannot tell whether it is the demand, as when an edge of one
/// is exactly in line with one of the other, it is decided in rational arithmetic.
double shown_along(const Projection& projection, double scale, const SeenPair& pair, double demand) {
  const PairBounds bounds = bound_pair(pair.upper, pair.lower, projection, {-infinity, 0});
  // Twice downwards: for the low part of the height and for the quotient.
  const double certain = std::nextafter(std::nextafter(bounds.low.high, -infinity) / scale, -infinity);
  if (certain >= demand || !(std::nextafter(bounds.high.high, infinity) >= demand * scale)) return certain;
  const auto exact =
      exact_maximum(*pair.upper.source, *pair.lower.source, projection.shear, projection.semantics);
  return exact ? std::nextafter(exact->to_double(), -infinity) : -infinity;
}

double size_seen(const ProjectedNode& node) {
  return node.x_high - node.x_low + node.y_high - node.y_low + node.h_high - node.h_low;
}

}  // namespace

SeparationOverCone::SeparationOverCone(const SeparationTree& tree, const std::vector<Direction>& edges,
                                       ContactSemantics semantics)
    : tree_(tree.data()), node_bound_(tree_.magnitude) {
  edges_.reserve(edges.size());
  for (const Direction& edge : edges) {
    const Projection projection(edge, tree_.magnitude, semantics);
    edges_.push_back(
        {projection, std::abs(projection.shear.r[projection.shear.k]), ProjectedNodes(tree_.nodes)});
  }
}

/// Nothing where the pair shows less than the demand along some edge.
std::optional<SeparationOverCone::Pair> SeparationOverCone::pair(std::int32_t upper, std::int32_t lower,
                                                                 double demand) {
  double room = infinity;
  for (Edge& edge : edges_) {
    const DoubleDouble below{std::nextafter(demand * edge.scale, -infinity), 0};
    const DoubleDouble high =
        node_bound_(edge.nodes.get(upper, edge.projection), edge.nodes.get(lower, edge.projection), below);
    if (high <= below) return std::nullopt;
    room = std::min(room, high.high / edge.scale - demand);
  }
  return Pair{room, upper, lower};
}

std::optional<double> SeparationOverCone::at_least(double demand, std::int64_t max_node_pairs) {
  stack_.clear();
  if (const auto roots = pair(0, 0, demand)) stack_.push_back(*roots);
  for (std::int64_t examined = 0; !stack_.empty() && examined < max_node_pairs; ++examined) {
    const Pair next = stack_.back();
    stack_.pop_back();
    const TreeNode &upper = tree_.nodes[next.upper], &lower = tree_.nodes[next.lower];
    if (upper.count == 0 || lower.count == 0)
      split(next, demand);
    else if (const auto shown = leaves(upper, lower, demand))
      return shown;
  }
  return std::nullopt;
}

/// Puts the halves of the wider node on the stack, the half with more room on top.
void SeparationOverCone::split(const Pair& whole, double demand) {
  const TreeNode &upper = tree_.nodes[whole.upper], &lower = tree_.nodes[whole.lower];
  Edge& edge = edges_.front();
  const bool split_upper =
      lower.count > 0 || (upper.count == 0 && size_seen(edge.nodes.get(whole.upper, edge.projection)) >=
                                                  size_seen(edge.nodes.get(whole.lower, edge.projection)));
  const auto half = [&](int i) {
    return split_upper ? pair(upper.first + i, whole.lower, demand)
                       : pair(whole.upper, lower.first + i, demand);
  };
  std::optional<Pair> first = half(0), second = half(1);
  if (first && second && first->room < second->room) std::swap(first, second);
  if (second) stack_.push_back(*second);
  if (first) stack_.push_back(*first);
}

std::optional<double> SeparationOverCone::leaves(const TreeNode& upper, const TreeNode& lower,
                                                 double demand) const {
  double best = -infinity;
  for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a)
    for (std::int32_t b = lower.first; b < lower.first + lower.count; ++b)
      best = std::max(best, shown_by(tree_.triangles[a], tree_.triangles[b], demand));
  if (best >= demand) return best;
  return std::nullopt;
}

/// Returns the bound that two triangles show, or less than the demand.
double SeparationOverCone::shown_by(const TreeTriangle& upper, const TreeTriangle& lower,
                                    double demand) const {
  double shown = infinity;
  int upper_side = 0, lower_side = 0;
  for (const Edge& edge : edges_) {
    const ProjectedTriangle above(upper, edge.projection), beneath(lower, edge.projection);
    const int sides[] = {side_seen(above, edge.projection), side_seen(beneath, edge.projection)};
    if (sides[0] == 0 || sides[1] == 0 || sides[0] * upper_side < 0 || sides[1] * lower_side < 0)
      return -infinity;
    upper_side = sides[0];
    lower_side = sides[1];
    shown = std::min(shown, shown_along(edge.projection, edge.scale, {above, beneath}, demand));
    if (!(shown >= demand)) return -infinity;
  }
  return shown;
}

}  // namespace stackabilization::detail
