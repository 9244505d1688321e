#include "generator/skin.h"

namespace stackabilization::models {

Skin::Skin(const std::vector<Ring>& rings) : segments_(rings.front().size()) {
  for (const Ring& ring : rings) add_ring(ring);
}

void Skin::join(std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < segments_; ++k) {
    const std::size_t next = (k + 1) % segments_;
    add_quad({id(i, k), id(i, next), id(j, next), id(j, k)});
  }
}

void Skin::cap(std::size_t i, int copies, End end) {
  const Ring ring(points_.begin() + static_cast<std::ptrdiff_t>(i * segments_),
                  points_.begin() + static_cast<std::ptrdiff_t>((i + 1) * segments_));
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : ring) centre += p / static_cast<double>(segments_);
  std::size_t outer = i;
  for (int copy = 1; copy <= copies; ++copy) {
    const double scale = 1 - static_cast<double>(copy) / (copies + 1);
    Ring smaller;
    for (const Eigen::Vector3d& p : ring) smaller.push_back(centre + scale * (p - centre));
    const std::size_t inner = add_ring(smaller);
    if (end == End::last)
      join(outer, inner);
    else
      join(inner, outer);
    outer = inner;
  }
  fans_.push_back({outer, centre, end});
}

Shape Skin::shape() const {
  std::vector<Eigen::Vector3d> points = points_;
  std::vector<Eigen::Vector3i> triangles = triangles_;
  for (const Fan& fan : fans_) {
    const int hub = static_cast<int>(points.size());
    points.push_back(fan.centre);
    for (std::size_t k = 0; k < segments_; ++k) {
      const int a = id(fan.ring, k), b = id(fan.ring, (k + 1) % segments_);
      triangles.emplace_back(hub, fan.end == End::last ? a : b, fan.end == End::last ? b : a);
    }
  }
  Points vertices(static_cast<Eigen::Index>(points.size()), 3);
  Triangles faces(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) vertices.row(static_cast<Eigen::Index>(v)) = points[v];
  for (std::size_t t = 0; t < triangles.size(); ++t) faces.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return make_shape(std::move(vertices), std::move(faces));
}

std::size_t Skin::add_ring(const Ring& ring) {
  points_.insert(points_.end(), ring.begin(), ring.end());
  return points_.size() / segments_ - 1;
}

void Skin::add_quad(const std::array<int, 4>& q) {
  const auto length = [&](int i, int j) {
    return (points_[static_cast<std::size_t>(i)] - points_[static_cast<std::size_t>(j)]).norm();
  };
  // Along the shorter diagonal; on a tie, as on the flanks of a lathe, rounding must not decide.
  if (length(q[1], q[3]) < 0.999 * length(q[0], q[2])) {
    triangles_.emplace_back(q[0], q[1], q[3]);
    triangles_.emplace_back(q[1], q[2], q[3]);
  } else {
    triangles_.emplace_back(q[0], q[1], q[2]);
    triangles_.emplace_back(q[0], q[2], q[3]);
  }
}

}  // namespace stackabilization::models
