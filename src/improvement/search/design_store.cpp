#include "improvement/search/design_store.h"

#include <string>
#include <variant>
#include <vector>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

constexpr std::size_t max_bytes = std::size_t{256} << 20;

/// Returns the approximate memory of a design, bytes.
std::size_t bytes_of(const Design& design) {
  const Shape& shape = design.shape;
  Eigen::Index bytes = shape.vertices.size() * static_cast<Eigen::Index>(sizeof(double)) +
                       shape.triangles.size() * static_cast<Eigen::Index>(sizeof(std::int32_t)) +
                       shape.triangle_count() * static_cast<Eigen::Index>(sizeof(std::int32_t));
  for (const Primitive& primitive : design.primitives)
    bytes += control_points(primitive).size() * static_cast<Eigen::Index>(2 * sizeof(double));
  return static_cast<std::size_t>(bytes) + design.edits.size() * sizeof(Edit) + sizeof(Design);
}

}  // namespace

std::shared_ptr<const Design> DesignStore::of(int node) {
  const auto row = rows_.find(node);
  if (row != rows_.end()) {
    kept_.splice(kept_.begin(), kept_, row->second);
    return row->second->design;
  }
  std::vector<int> missing = {node};
  while (tree_.node(missing.back()).parent >= 0 && !rows_.contains(tree_.node(missing.back()).parent))
    missing.push_back(tree_.node(missing.back()).parent);
  const DeformationModel& space = checker_.space();
  std::shared_ptr<const Design> design;
  if (const int ancestor = tree_.node(missing.back()).parent; ancestor >= 0) design = of(ancestor);
  for (; !missing.empty(); missing.pop_back()) {
    const SearchNode& now = tree_.node(missing.back());
    if (now.parent < 0) {
      design = keep(missing.back(), std::make_shared<const Design>(space.at_rest()));
      continue;
    }
    const auto constraints = deformation_constraints(checker_.requirements(), space.rest(),
                                                     Direction(tree_.node(now.parent).direction));
    DeformationResult outcome = space.edited(*design, now.edit, constraints);
    if (outcome.refusal)
      throw InputError("an edit of the saved search is refused now: " +
                       describe(*outcome.refusal, space.rest().structure));
    design = keep(missing.back(), std::make_shared<const Design>(std::move(outcome.design)));
  }
  return design;
}

void DesignStore::keep(int node, Design design) {
  keep(node, std::make_shared<const Design>(std::move(design)));
}

std::shared_ptr<const Design> DesignStore::keep(int node, std::shared_ptr<const Design> design) {
  kept_.push_front({node, design, bytes_of(*design)});
  rows_[node] = kept_.begin();
  bytes_ += kept_.front().bytes;
  while (bytes_ > max_bytes && kept_.size() > 1) {
    bytes_ -= kept_.back().bytes;
    rows_.erase(kept_.back().node);
    kept_.pop_back();
  }
  return design;
}

}  // namespace stackabilization::detail
