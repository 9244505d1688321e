#include "deformation/controllers/mesh_transfer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/index.h"

namespace stackabilization::detail {

namespace {

bool equal(const Primitive& a, const Primitive& b) {
  if (const auto* cuboid = std::get_if<Cuboid>(&a)) return cuboid->corners == std::get<Cuboid>(b).corners;
  const auto &p = std::get<GeneralizedCylinder>(a), &q = std::get<GeneralizedCylinder>(b);
  return p.centres == q.centres && p.radii == q.radii && p.rotation.coeffs() == q.rotation.coeffs();
}

}  // namespace

MeshTransfer::MeshTransfer(const Shape& shape, const Rig& rig, Following following)
    : rest_(shape.vertices), parts_(rig.primitive_bindings.size()) {
  VertexShares shares = vertex_shares(shape, following == Following::smooth ? &rig.rest : nullptr);
  for (std::size_t v = 0; v < shares.of_vertex.size(); ++v)
    for (const auto& [part, share] : shares.of_vertex[v]) {
      parts_[at(part)].vertices.push_back(static_cast<int>(v));
      parts_[at(part)].shares.push_back(share);
    }
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    Points points(static_cast<Eigen::Index>(parts_[part].vertices.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) = rest_.row(parts_[part].vertices[static_cast<std::size_t>(i)]);
    parts_[part].bindings = rig.primitive_bindings[part].bind(points);
  }
  for (CarriedSeam& seam : shares.seams) {
    const PrimitiveBinding &attached = rig.primitive_bindings[at(seam.attached)],
                           &carrier = rig.primitive_bindings[at(seam.carrier)];
    Points points(static_cast<Eigen::Index>(seam.trimmed.size()), 3);
    for (std::size_t i = 0; i < seam.trimmed.size(); ++i)
      points.row(static_cast<Eigen::Index>(i)) = rest_.row(seam.trimmed[i].first);
    BoundSeam bound;
    bound.tip_on_attached = attached.bind(Eigen::Vector3d(seam.point + seam.axis));
    bound.point_on_attached = attached.bind(seam.point);
    bound.point_on_carrier = carrier.bind(seam.point);
    bound.on_attached = attached.bind(points);
    bound.on_carrier = carrier.bind(points);
    bound.seam = std::move(seam);
    seams_.push_back(std::move(bound));
  }
}

Points MeshTransfer::vertices(const Rig& rig, const std::vector<Primitive>& now) const {
  Points vertices = rest_;
  std::vector<char> rests(parts_.size());
  for (std::size_t part = 0; part < parts_.size(); ++part)
    rests[part] = equal(rig.primitive_bindings[part].rest(), now[part]);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (rests[part]) continue;
    const BoundPart& bound = parts_[part];
    const Points moved = rig.primitive_bindings[part].displacements(bound.bindings, now[part]);
    for (std::size_t i = 0; i < bound.vertices.size(); ++i)
      vertices.row(bound.vertices[i]) += bound.shares[i] * moved.row(static_cast<Eigen::Index>(i));
  }
  for (const BoundSeam& bound : seams_) {
    const CarriedSeam& seam = bound.seam;
    const auto moved = [&](int part, const std::vector<PointBinding>& bindings) -> Points {
      if (rests[at(part)]) return Points::Zero(static_cast<Eigen::Index>(bindings.size()), 3);
      return rig.primitive_bindings[at(part)].displacements(bindings, now[at(part)]);
    };
    if (rests[at(seam.attached)] && rests[at(seam.carrier)]) continue;
    const Points ends = moved(seam.attached, {bound.point_on_attached, bound.tip_on_attached});
    const Eigen::RowVector3d slide = ends.row(0) - moved(seam.carrier, {bound.point_on_carrier}).row(0);
    for (const auto& [vertex, share] : seam.around) vertices.row(vertex) += share * slide;
    // What is trimmed slides along the attached part, wherever that points now.
    const Eigen::RowVector3d axis = (seam.axis.transpose() + ends.row(1) - ends.row(0)).stableNormalized();
    const Points gaps =
        (moved(seam.carrier, bound.on_carrier) - moved(seam.attached, bound.on_attached)).rowwise() + slide;
    for (std::size_t i = 0; i < seam.trimmed.size(); ++i) {
      const auto& [vertex, share] = seam.trimmed[i];
      vertices.row(vertex) += share * gaps.row(static_cast<Eigen::Index>(i)).dot(axis) * axis;
    }
  }
  return vertices;
}

std::vector<BoundPoint> MeshTransfer::bound_points(int vertex) const {
  std::vector<BoundPoint> bound_points;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const BoundPart& bound = parts_[part];
    const auto found = std::lower_bound(bound.vertices.begin(), bound.vertices.end(), vertex);
    if (found == bound.vertices.end() || *found != vertex) continue;
    const auto i = static_cast<std::size_t>(found - bound.vertices.begin());
    bound_points.push_back(
        {static_cast<int>(part), bound.bindings[i], bound.shares[i] * Eigen::Matrix3d::Identity()});
  }
  const auto index_in = [&](const SharedVertices& vertices) -> std::optional<std::size_t> {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), std::pair(vertex, 0.0));
    if (found == vertices.end() || found->first != vertex) return std::nullopt;
    return static_cast<std::size_t>(found - vertices.begin());
  };
  for (const BoundSeam& bound : seams_) {
    const CarriedSeam& seam = bound.seam;
    Eigen::Matrix3d slides = Eigen::Matrix3d::Zero();
    if (const auto i = index_in(seam.around)) slides.diagonal().setConstant(seam.around[*i].second);
    if (const auto i = index_in(seam.trimmed)) {
      const Eigen::Vector3d axis = seam.axis.stableNormalized();
      const Eigen::Matrix3d along = seam.trimmed[*i].second * axis * axis.transpose();
      bound_points.push_back({seam.carrier, bound.on_carrier[*i], along});
      bound_points.push_back({seam.attached, bound.on_attached[*i], -along});
      slides += along;
    }
    if (slides.isZero(0)) continue;
    bound_points.push_back({seam.attached, bound.point_on_attached, slides});
    bound_points.push_back({seam.carrier, bound.point_on_carrier, -slides});
  }
  return bound_points;
}

}  // namespace stackabilization::detail
