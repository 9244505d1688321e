#include "stackabilization/deformation/iwires_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/transformed_points.h"
#include "deformation/iwires/wire_propagation.h"
#include "deformation/iwires/wire_surface.h"
#include "deformation/model/vertex_constraints.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization {

namespace {

using detail::WireEdit;
using detail::WireHolds;
using detail::WireMaps;
using detail::WireMotion;
using detail::WireNetwork;
using detail::WireSurface;

WireStructure wires_of(const Shape& shape, const IWiresOptions& options) {
  if (!std::isfinite(options.link_distance) || options.link_distance < 0)
    throw UsageError("the link distance of wires must be finite and not negative");
  const std::vector<FeatureCurve> curves = feature_curves(shape, options.curves);
  if (curves.empty())
    throw InputError("no feature curve found: the surface has no boundary and no crease of more than " +
                     significant_text(options.curves.crease_angle, 3) +
                     " degrees that is long enough to hold on to");
  return analysed_wires(shape, curves, options.relations);
}

StructuredShape validated(StructuredShape rest) {
  validate(rest.shape);
  return rest;
}

Eigen::AlignedBox3d box_of(const Shape& shape) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
  return box;
}

Eigen::Matrix3d linear_of(const Operation& operation) {
  if (const auto* rotate = std::get_if<Rotate>(&operation))
    return Eigen::AngleAxisd(rotate->radians, rotate->axis.stableNormalized()).toRotationMatrix();
  const auto* scale = std::get_if<Scale>(&operation);
  if (scale == nullptr) return Eigen::Matrix3d::Identity();
  if (!scale->along) return scale->factor * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d axis = scale->along->stableNormalized();
  return Eigen::Matrix3d::Identity() + (scale->factor - 1) * axis * axis.transpose();
}

/// A point of the polygon of a wire, as a convex combination of two of its vertices.
struct OnWire {
  std::int32_t from, to;
  double share;  ///< weight of `to`
};

OnWire nearest_on(const Shape& rest, const Wire& wire, const Eigen::Vector3d& point) {
  const auto& vertices = wire.curve.vertices;
  OnWire best{vertices.front(), vertices.front(), 0};
  double least = (rest.vertices.row(vertices.front()).transpose() - point).squaredNorm();
  for (std::size_t i = 0; i + (wire.curve.closed ? 0 : 1) < vertices.size(); ++i) {
    const std::int32_t from = vertices[i], to = vertices[(i + 1) % vertices.size()];
    const Eigen::Vector3d a = rest.vertices.row(from), along = rest.vertices.row(to).transpose() - a;
    const double share = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (a + share * along - point).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = {from, to, share};
  }
  return best;
}

}  // namespace

std::vector<double> wire_symmetry_residuals(const Shape& rest, const WireStructure& structure,
                                            const Points& vertices) {
  const auto moved = [&](std::int32_t v) -> Eigen::Vector3d {
    return (vertices.row(v) - rest.vertices.row(v)).transpose();
  };
  std::vector<double> residuals;
  for (const WireSymmetry& pair : structure.symmetric) {
    const Eigen::Isometry3d map = isometry_of(structure.symmetries[static_cast<std::size_t>(pair.symmetry)]);
    double largest = 0;
    for (const std::int32_t v : structure.wires[static_cast<std::size_t>(pair.image)].curve.vertices) {
      const Eigen::Vector3d source = map.inverse() * Eigen::Vector3d(rest.vertices.row(v));
      const OnWire at = nearest_on(rest, structure.wires[static_cast<std::size_t>(pair.wire)], source);
      const Eigen::Vector3d expected =
          map.linear() * ((1 - at.share) * moved(at.from) + at.share * moved(at.to));
      largest = std::max(largest, (expected - moved(v)).norm());
    }
    residuals.push_back(largest);
  }
  return residuals;
}

struct IWiresModel::Data {
  double diagonal;
  WireNetwork network;
  WireSurface surface;
  Eigen::Vector3d centre;

  Data(const Shape& rest, const IWiresOptions& options)
      : diagonal(box_of(rest).diagonal().norm()),
        network(detail::wire_network(rest, wires_of(rest, options), options.link_distance * diagonal,
                                     options.relations.distance_tolerance * diagonal)),
        surface(rest, network, {}),
        centre(box_of(rest).center()) {}

  void check(const Handle& handle) const {
    if (handle.kind == HandleKind::shape) return;
    if (handle.kind != HandleKind::wire)
      throw UsageError("the wires of a shape and the shape itself can be edited here");
    if (handle.index < 0 || static_cast<std::size_t>(handle.index) >= network.structure.wires.size())
      throw UsageError("there is no wire " + std::to_string(handle.index) + ", the last one is " +
                       std::to_string(network.structure.wires.size() - 1));
  }

  void check(const Edit& edit) const {
    validate(edit, diagonal);
    check(edit.handle);
    if (std::holds_alternative<Taper>(edit.operation))
      throw UsageError("only controllers can taper the shape");
    if (std::holds_alternative<Lean>(edit.operation)) throw UsageError("only controllers can lean parts");
    if (const auto* scale = std::get_if<Scale>(&edit.operation); scale && scale->along)
      if (edit.handle.kind == HandleKind::wire)
        throw UsageError("wires are scaled in all directions: only the shape can be scaled along one");
  }
};

namespace {

/// State of a shape between edits: the positions of its wires, and an affine map of the whole, applied after
/// them.
class Editing {
 public:
  Editing(const WireNetwork& network, std::vector<std::int32_t> fixed,
          const DeformationConstraints& constraints)
      : structure_(network.structure),
        network_(network),
        fixed_(std::move(fixed)),
        constraints_(constraints),
        maps_(structure_.wires.size(), Eigen::Affine3d::Identity()),
        nodes_(network.points) {}

  std::optional<Refusal> edit_shape(const Operation& operation, const Eigen::Vector3d& centre) {
    const Eigen::Matrix3d linear = linear_of(operation);
    const Eigen::Vector3d about = whole_ * centre;
    Eigen::Affine3d step = Eigen::Affine3d::Identity();
    step.linear() = linear;
    step.translation() = about - linear * about;
    if (const auto* move = std::get_if<Move>(&operation)) step.translation() = move->by;
    whole_ = step * whole_;
    return check_symmetries();
  }

  std::optional<Refusal> edit_wire(int wire, const Operation& operation) {
    WireEdit edit{.wire = wire};
    const Eigen::Matrix3d inverse = whole_.linear().inverse();
    if (const auto* move = std::get_if<Move>(&operation)) {
      edit.by = inverse * move->by;
    } else if (const auto* scale = std::get_if<Scale>(&operation)) {
      edit.motion = WireMotion::scale;
      edit.factor = scale->factor;
    } else {
      edit.motion = WireMotion::turn;
      edit.linear = inverse * linear_of(operation) * whole_.linear();
    }
    const detail::PropagatedWires result = propagate(edit);
    if (!(result.excess <= 1)) {
      Refusal refusal = result.missed;
      refusal.amount = result.violation / network_.diagonal;
      return refusal;
    }
    maps_ = result.maps;
    nodes_ = detail::node_positions(network_, maps_, wire);
    return std::nullopt;
  }

  const std::vector<Eigen::Vector3d>& nodes() const { return nodes_; }
  const Eigen::Affine3d& whole() const { return whole_; }

 private:
  /// Propagates an edit. Holds the wires that define the kept extent, if possible.
  detail::PropagatedWires propagate(const WireEdit& edit) const {
    WireHolds holds{fixed_, {}};
    if (constraints_.keep_extent) {
      holds.height = (whole_.linear().transpose() * constraints_.keep_extent->unit()).normalized();
      const auto result = detail::propagate(network_, maps_, edit, holds);
      if (result.excess <= 1) return result;
      holds.height.reset();
    }
    return detail::propagate(network_, maps_, edit, holds);
  }

  std::optional<Refusal> check_symmetries() const {
    for (const WireSymmetry& pair : structure_.symmetric) {
      const Eigen::Matrix3d q =
          isometry_of(structure_.symmetries[static_cast<std::size_t>(pair.symmetry)]).linear();
      const Eigen::Matrix3d carried = whole_.linear() * q * whole_.linear().inverse();
      const double bend = (carried.transpose() * carried - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
      if (!(bend <= tolerance::relation))
        return Refusal{.cause = RefusalCause::wire_symmetry, .symmetry = pair.symmetry, .amount = bend};
    }
    return std::nullopt;
  }

  const WireStructure& structure_;
  const WireNetwork& network_;
  std::vector<std::int32_t> fixed_;
  const DeformationConstraints& constraints_;
  WireMaps maps_;
  std::vector<Eigen::Vector3d> nodes_;
  Eigen::Affine3d whole_ = Eigen::Affine3d::Identity();
};

std::optional<Refusal> broken_symmetry(const Shape& rest, const WireStructure& structure,
                                       const Points& vertices, double diagonal) {
  const std::vector<double> residuals = wire_symmetry_residuals(rest, structure, vertices);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (!(residuals[i] <= tolerance::relation * diagonal)) {
      const WireSymmetry& pair = structure.symmetric[i];
      return Refusal{.cause = RefusalCause::wire_image_of,
                     .index = pair.image,
                     .other = pair.wire,
                     .symmetry = pair.symmetry,
                     .amount = residuals[i] / diagonal};
    }
  return std::nullopt;
}

}  // namespace

IWiresModel::IWiresModel(StructuredShape rest, const IWiresOptions& options)
    : CarriedModel(validated(std::move(rest))),
      data_(std::make_unique<const Data>(this->rest().shape, options)) {}
IWiresModel::IWiresModel(IWiresModel&&) noexcept = default;
IWiresModel& IWiresModel::operator=(IWiresModel&&) noexcept = default;
IWiresModel::~IWiresModel() = default;

const WireStructure& IWiresModel::wires() const {
  return data_->network.structure;
}

std::vector<Handle> IWiresModel::handles() const {
  std::vector<Handle> handles = {{HandleKind::shape, 0, 0}};
  for (std::size_t k = 0; k < data_->network.structure.wires.size(); ++k)
    handles.push_back({HandleKind::wire, 0, static_cast<int>(k)});
  return handles;
}

Eigen::Vector3d IWiresModel::centre(const Handle& handle) const {
  data_->check(handle);
  if (handle.kind == HandleKind::shape) return data_->centre;
  return data_->network.structure.wires[static_cast<std::size_t>(handle.index)].centre;
}

std::vector<std::int32_t> IWiresModel::curve(const Handle& handle) const {
  data_->check(handle);
  if (handle.kind != HandleKind::wire) return {};
  const FeatureCurve& curve = wires().wires[static_cast<std::size_t>(handle.index)].curve;
  std::vector<std::int32_t> vertices(curve.vertices.begin(), curve.vertices.end());
  if (curve.closed) vertices.push_back(vertices.front());
  return vertices;
}

MovedVertices IWiresModel::moved(const std::vector<Edit>& edits,
                                 const DeformationConstraints& constraints) const {
  for (const Edit& edit : edits) data_->check(edit);
  const Shape& shape = rest().shape;
  const std::vector<std::int32_t> fixed = fixed_vertices(shape, constraints);
  Editing state(data_->network, fixed, constraints);
  bool wires_moved = false;
  for (const Edit& edit : edits) {
    const bool whole = edit.handle.kind == HandleKind::shape;
    wires_moved = wires_moved || !whole;
    std::optional<Refusal> refusal = whole ? state.edit_shape(edit.operation, data_->centre)
                                           : state.edit_wire(edit.handle.index, edit.operation);
    if (refusal) return {std::move(refusal), {}};
  }
  Points vertices = shape.vertices;
  if (wires_moved)
    vertices = fixed.empty() ? data_->surface.deformed(state.nodes())
                             : WireSurface(shape, data_->network, fixed).deformed(state.nodes());
  const Eigen::Affine3d& whole = state.whole();
  MovedVertices kept = constrain(shape, detail::transformed(vertices, whole), constraints, fixed);
  if (kept.refusal) return kept;
  const Eigen::Affine3d back = whole.inverse();
  const Points before = detail::transformed(kept.vertices, back);
  kept.refusal = broken_symmetry(shape, data_->network.structure, before, data_->network.diagonal);
  return kept;
}

}  // namespace stackabilization
