#include "stackabilization/structure/joints.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"
#include "stackabilization/structure/contact_spots.h"
#include "stackabilization/structure/hull_spread.h"
#include "stackabilization/structure/part_surface.h"

namespace stackabilization {

namespace {

using detail::PartSurface;

void check(const JointOptions& options) {
  if (!(options.reach > 0) || !std::isfinite(options.reach)) throw UsageError("the reach of joints must be positive");
  if (!(options.line_aspect >= 1)) throw UsageError("the aspect of line joints must be at least 1");
  if (!(options.least_line >= 0)) throw UsageError("the shortest line joint must not be negative");
  if (!(options.separate >= 0)) throw UsageError("the distance of separate joints must not be negative");
}

double size_of(const Shape& shape) {
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) corners.push_back(shape.corner(t, k));
  return detail::enclosing_diameter(corners);
}

class JointFinder {
 public:
  JointFinder(const Shape& shape, const std::vector<Part>& parts, const JointOptions& options)
      : options_(options), size_(size_of(shape)), surfaces_(parts.size()) {
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
      surfaces_[k].emplace(extract_part(shape, static_cast<Eigen::Index>(k)), parts[k]);
    });
  }

  std::vector<Relation> run() const {
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t a = 0; a < surfaces_.size(); ++a)
      for (std::size_t b = a + 1; b < surfaces_.size(); ++b)
        if (may_meet(*surfaces_[a], *surfaces_[b])) pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
    std::vector<std::vector<Relation>> found(pairs.size());
    tbb::parallel_for(std::size_t{0}, pairs.size(),
                      [&](std::size_t k) { found[k] = joints_between(pairs[k].first, pairs[k].second); });
    std::vector<Relation> joints;
    for (std::vector<Relation>& some : found) joints.insert(joints.end(), some.begin(), some.end());
    return joints;
  }

 private:
  bool may_meet(const PartSurface& a, const PartSurface& b) const {
    const double reach = options_.reach * size_;
    return (a.lowest().array() - reach <= b.highest().array()).all() &&
           (b.lowest().array() - reach <= a.highest().array()).all();
  }

  std::vector<Relation> joints_between(int a, int b) const {
    const PartSurface &first = *surfaces_[static_cast<std::size_t>(a)], &second = *surfaces_[static_cast<std::size_t>(b)];
    const double smaller = std::min(first.size(), second.size());
    // Parts far smaller than the reach would meet everything around them.
    const double reach = std::min(options_.reach * size_, options_.separate * smaller);
    std::vector<Relation> joints;
    for (const detail::ContactSpot& spot : contact_spots(first, second, {reach, options_.separate * smaller}))
      joints.push_back(joint_at(spot, {a, b}, smaller));
    std::sort(joints.begin(), joints.end(), [](const Relation& one, const Relation& other) {
      return std::lexicographical_compare(one.points.data(), one.points.data() + one.points.size(), other.points.data(),
                                          other.points.data() + other.points.size());
    });
    return joints;
  }

  Relation joint_at(const detail::ContactSpot& spot, std::vector<int> parts, double smaller) const {
    const detail::HullSpread spread = detail::hull_spread(spot.points, tolerance::relative * size_);
    Relation joint;
    joint.parts = std::move(parts);
    joint.residual = spot.gap / size_;
    const bool is_line = spread.length(0) >= options_.line_aspect * spread.length(1) &&
                         spread.length(0) >= options_.least_line * smaller && spread.length(0) > 0;
    joint.type = is_line ? RelationType::line_joint : RelationType::point_joint;
    joint.points.resize(is_line ? 2 : 1, 3);
    for (int k = 0; k < joint.points.rows(); ++k)
      joint.points.row(k) =
          (spread.centre + (is_line ? spread.ranges(0, k) : 0) * spread.axes.col(0)).transpose();
    return joint;
  }

  JointOptions options_;
  double size_;
  std::vector<std::optional<PartSurface>> surfaces_;
};

}  // namespace

std::vector<Relation> find_joints(const Shape& shape, const std::vector<Part>& parts, const JointOptions& options) {
  check(options);
  if (parts.size() != shape.part_names.size()) throw UsageError("joints need one primitive for each part of the shape");
  return JointFinder(shape, parts, options).run();
}

}  // namespace stackabilization
