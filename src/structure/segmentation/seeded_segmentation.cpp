#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "mesh/surface_index.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/segment_boundaries.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization {

namespace {

/// Returns the part of the seed of every triangle, -1 for triangles without a seed. Throws as `segmented`
/// does.
std::vector<std::int32_t> seeded_parts(const Shape& shape, const std::vector<PartSeeds>& seeds) {
  if (seeds.empty()) throw UsageError("there is no part: at least one part with a seed is needed");
  std::vector<std::int32_t> part(static_cast<std::size_t>(shape.triangle_count()), -1);
  for (std::size_t p = 0; p < seeds.size(); ++p) {
    if (seeds[p].triangles.empty()) throw UsageError("part \"" + seeds[p].name + "\" has no seed");
    for (const std::int32_t t : seeds[p].triangles) {
      if (t < 0 || t >= shape.triangle_count())
        throw UsageError("part \"" + seeds[p].name + "\" is seeded at triangle " + std::to_string(t) +
                         ", but triangles are numbered 0 to " + std::to_string(shape.triangle_count() - 1));
      std::int32_t& known = part[static_cast<std::size_t>(t)];
      if (known >= 0) throw UsageError("triangle " + std::to_string(t) + " is seeded twice");
      known = static_cast<std::int32_t>(p);
    }
  }
  return part;
}

/// Cost of crossing a concave edge of 90 degrees, fraction of the bounding-box diagonal. It is the same on
/// fine and coarse meshes, and the same for one bend and for many small ones.
constexpr double toll = 0.5;

/// Spreads the parts from their seeds to whatever is connected, nearest first.
void spread(const detail::SurfaceGraph& graph, std::vector<std::int32_t>& part) {
  using Front = std::tuple<double, std::int32_t, std::int32_t>;  // distance, part, triangle
  std::priority_queue<Front, std::vector<Front>, std::greater<>> queue;
  std::vector<double> distance(part.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < part.size(); ++t)
    if (part[t] >= 0) {
      distance[t] = 0;
      queue.push({0, part[t], static_cast<std::int32_t>(t)});
    }
  std::vector<char> settled(part.size(), 0);
  while (!queue.empty()) {
    const auto [reached, label, t] = queue.top();
    queue.pop();
    if (settled[static_cast<std::size_t>(t)]) continue;
    settled[static_cast<std::size_t>(t)] = 1;
    part[static_cast<std::size_t>(t)] = label;
    for (const std::int32_t l : graph.links_of[static_cast<std::size_t>(t)]) {
      const std::int32_t next = graph.across(l, t);
      const double step = (graph.centres.row(next) - graph.centres.row(t)).norm() +
                          toll * graph.diagonal * detail::concavity(graph.links[static_cast<std::size_t>(l)]);
      double& known = distance[static_cast<std::size_t>(next)];
      if (settled[static_cast<std::size_t>(next)] || reached + step > known) continue;
      known = reached + step;
      queue.push({known, label, next});
    }
  }
}

/// Gives components that no seed reached to the part of the labelled triangle nearest to one of theirs.
void adopt_the_rest(const Shape& shape, const detail::SurfaceGraph& graph, std::vector<std::int32_t>& part) {
  std::vector<std::int32_t> reached;
  double reached_area = 0;
  for (std::size_t t = 0; t < part.size(); ++t)
    if (part[t] >= 0) {
      reached.push_back(static_cast<std::int32_t>(t));
      reached_area += graph.areas(static_cast<Eigen::Index>(t));
    }
  if (reached.size() == part.size()) return;
  if (!(reached_area > 0)) {  // seeds on nothing but degenerate triangles: there is no surface to be near to
    std::replace(part.begin(), part.end(), -1, part[static_cast<std::size_t>(reached.front())]);
    return;
  }
  const std::vector<std::int32_t> component = detail::connected_components(detail::weld(shape));
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::int32_t part = 0;
  };
  std::vector<Nearest> nearest(component.size());
  const SurfaceIndex index(detail::extracted(shape, reached));
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (part[t] >= 0) continue;
    Nearest& best = nearest[static_cast<std::size_t>(component[t])];
    for (int corner = 0; corner < 3; ++corner) {
      const SurfacePoint found = index.nearest(shape.corner(static_cast<Eigen::Index>(t), corner));
      const std::int32_t owner =
          part[static_cast<std::size_t>(reached[static_cast<std::size_t>(found.triangle)])];
      if (found.distance < best.distance) best = {found.distance, owner};
    }
  }
  for (std::size_t t = 0; t < part.size(); ++t)
    if (part[t] < 0) part[t] = nearest[static_cast<std::size_t>(component[t])].part;
}

}  // namespace

Shape segment(const Shape& shape, const std::vector<PartSeeds>& seeds) {
  validate(shape);
  std::vector<std::int32_t> part = seeded_parts(shape, seeds);
  std::vector<char> is_seed(part.size());
  for (std::size_t t = 0; t < part.size(); ++t) is_seed[t] = part[t] >= 0;
  const detail::SurfaceGraph graph = detail::surface_graph(shape);
  spread(graph, part);
  adopt_the_rest(shape, graph, part);
  Shape result = shape;
  result.triangle_part = detail::with_smooth_boundaries(graph, std::move(part), is_seed);
  result.part_names.clear();
  for (const PartSeeds& part_seeds : seeds) result.part_names.push_back(part_seeds.name);
  validate(result);
  return result;
}

}  // namespace stackabilization
