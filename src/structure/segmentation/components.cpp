#include "structure/segmentation/components.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "core/disjoint_sets.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/box_pairs.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

namespace {

/// Limit of the number of pairs of components that are tested for contact.
constexpr std::size_t max_pairs = 2'000'000;

/// Number of points at which the contact of one component is measured.
constexpr int contact_samples = 128;

struct Component {
  Shape shape;
  double area = 0;
  Eigen::AlignedBox3d box;
  SurfaceSamples samples;
  std::unique_ptr<SurfaceIndex> index;
  std::unique_ptr<HullSupport> hull;
};

Component component_of(const Shape& shape, const std::vector<std::int32_t>& rows) {
  Component component;
  component.shape = extracted(shape, rows);
  for (Eigen::Index t = 0; t < component.shape.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) component.box.extend(component.shape.corner(t, k));
    component.area += area_vector(component.shape, t).norm();
  }
  if (component.area > 0) component.samples = surface_samples(component.shape, contact_samples);
  return component;
}

bool inside(const HullSupport& hull, const Eigen::Vector3d& point, double reach) {
  for (Eigen::Index f = 0; f < hull.face_normals().rows(); ++f) {
    const Eigen::Vector3d n = hull.face_normals().row(f).transpose();
    if (n.dot(point) > (hull.points() * n).maxCoeff() + reach) return false;
  }
  return hull.face_normals().rows() > 0;
}

class ComponentMerger {
 public:
  ComponentMerger(std::vector<Component>& components, const ContactRule& rule, double reach)
      : components_(components), rule_(rule), reach_(reach) {}

  DisjointSets run() {
    const std::vector<Pair> pairs = candidates();
    prepare(pairs);
    std::vector<char> joins(pairs.size(), 0);
    tbb::parallel_for(std::size_t{0}, pairs.size(),
                      [&](std::size_t p) { joins[p] = are_one_part(pairs[p]); });
    DisjointSets sets(components_.size());
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (joins[p]) sets.join(pairs[p].small, pairs[p].large);
    return sets;
  }

 private:
  struct Pair {
    std::size_t small, large;
  };

  /// Returns the pairs of components whose boxes intersect, with enough of the smaller component inside the
  /// box of the larger one.
  std::vector<Pair> candidates() const;
  void prepare(const std::vector<Pair>& pairs);
  bool are_one_part(const Pair& pair) const;
  Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box) const {
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach_);
    return {box.min() - margin, box.max() + margin};
  }

  std::vector<Component>& components_;  ///< gets the indices and hulls that are needed
  ContactRule rule_;
  double reach_;
};

std::vector<ComponentMerger::Pair> ComponentMerger::candidates() const {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Component& component : components_)
    boxes.push_back(component.area > 0 ? component.box : Eigen::AlignedBox3d());
  const auto near = near_boxes(boxes, reach_, max_pairs);
  if (!near)
    throw InputError("more than " + std::to_string(max_pairs) +
                     " pairs of its connected components come near each other, by their boxes: contact is "
                     "looked for between at most so many pairs");
  std::vector<Pair> pairs;
  const double least = std::min(rule_.shared_area, rule_.inside) * contact_samples;
  for (const auto& [first, second] : *near) {
    const auto low = static_cast<std::size_t>(first), high = static_cast<std::size_t>(second);
    const Pair pair = components_[high].area > components_[low].area ? Pair{low, high} : Pair{high, low};
    const Points& points = components_[pair.small].samples.points;
    const Eigen::AlignedBox3d box = grown(components_[pair.large].box);
    int held = 0;
    for (Eigen::Index k = 0; k < points.rows(); ++k) held += box.contains(points.row(k).transpose().eval());
    if (held >= least) pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.small, a.large) < std::tie(b.small, b.large);
  });
  return pairs;
}

void ComponentMerger::prepare(const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) {
    Component& large = components_[pair.large];
    if (!large.index) large.index = std::make_unique<SurfaceIndex>(large.shape);
    if (!large.hull && components_[pair.small].area <= rule_.tiny * large.area)
      large.hull = std::make_unique<HullSupport>(large.shape);
  }
}

bool ComponentMerger::are_one_part(const Pair& pair) const {
  const Component &small = components_[pair.small], &large = components_[pair.large];
  const bool tiny = small.area <= rule_.tiny * large.area;
  int flush = 0, held = 0;
  bool touching = false;
  for (Eigen::Index k = 0; k < contact_samples; ++k) {
    const Eigen::Vector3d point = small.samples.points.row(k).transpose();
    const SurfacePoint nearest = large.index->nearest(point);
    if (nearest.distance <= reach_) {
      touching = true;
      const Eigen::Vector3d normal = small.samples.normals.row(k).transpose();
      flush += std::abs(unit_normal(large.shape, nearest.triangle).dot(normal)) >= tolerance::same_face;
    }
    if (tiny) held += inside(*large.hull, point, reach_);
  }
  return flush >= rule_.shared_area * contact_samples ||
         (tiny && touching && held >= rule_.inside * contact_samples);
}

/// Joins the sets without area to the set of the nearest component.
void attach_flat(DisjointSets& sets, const std::vector<Component>& components, const Shape& shape,
                 const std::vector<std::int32_t>& component) {
  std::vector<std::int32_t> rows;
  for (std::size_t t = 0; t < component.size(); ++t)
    if (components[static_cast<std::size_t>(component[t])].area > 0)
      rows.push_back(static_cast<std::int32_t>(t));
  if (rows.empty() || rows.size() == component.size()) return;
  const SurfaceIndex index(extracted(shape, rows));
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (components[c].area > 0) continue;
    const auto nearest = static_cast<std::size_t>(index.nearest(components[c].shape.corner(0, 0)).triangle);
    sets.join(c, static_cast<std::size_t>(component[static_cast<std::size_t>(rows[nearest])]));
  }
}

}  // namespace

std::vector<std::int32_t> merged_components(const Shape& shape, const ContactRule& rule) {
  const std::vector<std::int32_t> component = connected_components(weld(shape));
  const auto count = static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1;
  if (count == 1) return component;
  std::vector<std::vector<std::int32_t>> rows(count);
  for (std::size_t t = 0; t < component.size(); ++t)
    rows[static_cast<std::size_t>(component[t])].push_back(static_cast<std::int32_t>(t));
  std::vector<Component> components;
  Eigen::AlignedBox3d box;
  for (const auto& members : rows) {
    components.push_back(component_of(shape, members));
    box.extend(components.back().box);
  }
  DisjointSets sets = ComponentMerger(components, rule, rule.reach * box.diagonal().norm()).run();
  attach_flat(sets, components, shape, component);

  std::vector<std::int32_t> part(component.size()), number(count, -1);
  std::int32_t next = 0;
  for (std::size_t t = 0; t < component.size(); ++t) {
    std::int32_t& known = number[sets.root(static_cast<std::size_t>(component[t]))];
    if (known < 0) known = next++;
    part[t] = known;
  }
  return part;
}

}  // namespace stackabilization::detail
