#include "stackabilization/improvement/contact_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/index.h"
#include "deformation/model/straight_curve.h"
#include "improvement/contacts/contact_handles.h"
#include "improvement/contacts/contact_symmetry.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/model/nearest_box.h"

namespace stackabilization {

namespace {

using namespace detail;
using Role = ContactHandle::Role;

/// A contact is off the centre of a handle beyond this fraction of the way from the centre to the outside.
constexpr double off_centre = 0.25;
/// Least and largest size of an edit that clears the other part, in steps. Below the least one the edit would
/// creep out of the contact in tiny steps.
constexpr double min_steps = 0.2, max_steps = 6;

/// Sizes of tapers, in steps of a scaling.
constexpr std::array<double, 3> taper_sizes = {0.5, 1, 2};

/// A direction is across r if the absolute value of its cosine to r is at most this.
constexpr double across_r = 0.1;
/// A further size tried, as a multiple of the size that just clears the other part.
constexpr double reserve = 1.5;

void check(const ContactEditOptions& options) {
  const auto& multiples = options.multiples;
  const auto fits = [&](double m) { return m > 0 && m * options.scale_step < 1; };
  if (!(options.move_step > 0) || !std::isfinite(options.move_step))
    throw UsageError("the step of a move must be above 0");
  if (!(options.scale_step > 0 && options.scale_step < 1))
    throw UsageError("the step of a scaling must be between 0 and 1");
  if (multiples.empty() || !std::all_of(multiples.begin(), multiples.end(), fits))
    throw UsageError("multiples of steps must be above 0, and times the step of a scaling below 1");
  if (options.max_regions < 1) throw UsageError("at least one contact region must be looked at");
}

/// Collects the edits of one situation.
class ContactEditor {
 public:
  ContactEditor(const ContactSituation& situation, const ContactEditOptions& options)
      : situation_(situation),
        options_(options),
        frame_(contact_frame(situation, std::max(options.contacts.band, tolerance::relative))),
        symmetry_(symmetric_structure(situation)),
        extended_(options.family != EditFamily::paper),
        multiples_(extended_ ? options.multiples : std::vector<double>{1}),
        diagonal_(situation.rest.structure.diagonal) {
    std::sort(multiples_.begin(), multiples_.end());
  }

  std::vector<ContactEdit> run() {
    for (const int row : different_regions(situation_.regions, symmetry_, options_.max_regions))
      for (const ContactSide& side : contact_sides(situation_, row, frame_)) look_at(side);
    if (options_.family == EditFamily::smooth && situation_.capabilities.edits_primitives) taper_whole();
    return std::move(edits_);
  }

 private:
  static Structure symmetric_structure(const ContactSituation& situation) {
    Structure structure = situation.rest.structure;
    if (!situation.capabilities.edits_symmetric_parts) structure.relations.clear();
    return structure;
  }

  void look_at(const ContactSide& side) {
    for (const ContactHandle& handle : contact_handles(situation_, side, frame_, options_)) {
      if (handle.leans()) {
        move_sideways(side, handle);
        continue;
      }
      move_along(side, handle);
      if (handle.of_plate) {
        if (handle.role == Role::end) move_edge(side, handle);
        continue;
      }
      if (side.region.type != ContactType::ring) move_sideways(side, handle);
      if (handle.handle.kind == HandleKind::section || handle.handle.kind == HandleKind::wire ||
          handle.handle.kind == HandleKind::face)
        scale_in_place(side, handle);
      if (handle.role == Role::whole)
        for (const Eigen::Vector3d& axis : {frame_.u, frame_.v, frame_.w}) scale_whole(side, handle, axis);
    }
  }

  /// Tapers the whole shape, for the sake of the largest region.
  void taper_whole() {
    if (situation_.regions.empty()) return;
    const ContactRegion& region = situation_.regions.front();
    for (const double size : taper_sizes)
      for (const double sign : {-1.0, 1.0})
        for (const Edit& edit :
             tapers(frame_, situation_.design.primitives, 1 + sign * size * options_.scale_step))
          edits_.push_back({edit,
                            region.type,
                            0,
                            true,
                            {sign < 0 ? EditEffect::narrower : EditEffect::wider, true, region.upper_part}});
  }

  void add(const ContactSide& side, const ContactHandle& handle, const Operation& operation,
           EditEffect effect, bool leaning = false) {
    ContactEdit edit{{handle.handle, operation, handle.falloff},
                     side.region.type,
                     side.row,
                     side.of_lower_copy,
                     {effect, leaning, side.other == side.part ? -1 : side.other}};
    if (options_.family == EditFamily::smooth &&
        !is_smooth(edit.edit, situation_.design.primitives[detail::at(side.part)]))
      return;
    const bool known = std::any_of(edits_.begin(), edits_.end(),
                                   [&](const ContactEdit& other) { return same(other.edit, edit.edit); });
    if (!known) edits_.push_back(std::move(edit));
  }

  bool same(const Edit& a, const Edit& b) const {
    if (!(a.handle == b.handle) || a.falloff != b.falloff || a.operation.index() != b.operation.index())
      return false;
    if (const auto* move = std::get_if<Move>(&a.operation))
      return (move->by - std::get<Move>(b.operation).by).norm() <= tolerance::relative * diagonal_;
    if (const auto* lean = std::get_if<Lean>(&a.operation)) {
      const Lean& before = std::get<Lean>(b.operation);
      return lean->axis == before.axis && (lean->by - before.by).norm() <= tolerance::relative * diagonal_;
    }
    const Scale &one = std::get<Scale>(a.operation), &other = std::get<Scale>(b.operation);
    return std::abs(one.factor - other.factor) <= tolerance::relative &&
           one.along.has_value() == other.along.has_value() &&
           (!one.along || one.along->cross(*other.along).norm() <= tolerance::relative);
  }

  /// Returns the multiples of `step` below `enough`, and `enough` itself.
  std::vector<double> sizes(double step, std::optional<double> enough) const {
    if (enough) enough = std::max(*enough, min_steps * step);
    std::vector<double> result;
    for (const double m : multiples_)
      if (!enough || m * step < *enough) result.push_back(m * step);
    if (enough) result.push_back(*enough);
    return result;
  }

  void move_along(const ContactSide& side, const ContactHandle& handle) {
    if (side.region.type == ContactType::ring && !extended_) return;
    if (handle.role == Role::end || side.on_end || frame_.on_end(handle.range(frame_.w))) return;
    const Eigen::Vector3d along = side.of_lower_copy ? Eigen::Vector3d(-frame_.w) : frame_.w;
    const auto allowed = symmetry_.allowed_move(side.part, handle.centre, along);
    if (!allowed) return;
    const double step = options_.move_step * extent(along);
    std::vector<double> chosen = sizes(step, std::nullopt);
    if (extended_) chosen.insert(chosen.begin(), chosen.front() / 2);
    for (const double size : chosen)
      add(side, handle, Move{size * *allowed}, side.of_lower_copy ? EditEffect::down : EditEffect::up);
  }

  double extent(const Eigen::Vector3d& axis) const {
    return range_along(situation_.rest.shape, axis).length();
  }

  /// Returns how far the handle must move along `along` to clear the other part, with the contact band as
  /// margin.
  double way_out(const ContactSide& side, const ContactHandle& handle, const Eigen::Vector3d& along) {
    return range_of_part(side.other, along).high - handle.range(along).low +
           options_.contacts.band * extent(along);
  }

  Range range_of_part(int part, const Eigen::Vector3d& axis) {
    const auto found = points_.try_emplace(part);
    if (found.second) found.first->second = part_points(situation_.design.shape, part);
    const Eigen::VectorXd heights = found.first->second * axis;
    return {heights.minCoeff(), heights.maxCoeff()};
  }

  void move_sideways(const ContactSide& side, const ContactHandle& handle) {
    for (const ContactWay& way : ways_out(side, frame_, tolerance::same_symmetry * diagonal_)) {
      const auto allowed = symmetry_.allowed_move(side.part, handle.centre, way.along);
      if (!allowed) continue;
      if (handle.leans() && std::abs(allowed->dot(frame_.w)) > tolerance::relative) continue;
      const double step = options_.move_step * extent(way.along);
      std::vector<double> chosen = sizes(step, std::nullopt);
      if (extended_ && side.other != side.part) {
        const double out = way_out(side, handle, way.along);
        const bool shorter = out <= way_out(side, handle, -way.along) + tolerance::relative * diagonal_;
        if (!shorter && handle.role != Role::nearest) continue;
        if (!shorter)
          chosen.resize(1);
        else if (out >= min_steps * step && out <= max_steps * step)
          chosen = with_reserve(sizes(step, out), out);
      }
      for (const double size : chosen) {
        const Eigen::Vector3d by = size / handle.lean_share * *allowed;
        add(side, handle, handle.leans() ? Operation(Lean{by, handle.lean_axis}) : Move{by}, way.effect,
            handle.leans() || handle.falloff == Falloff::linear);
      }
    }
  }

  /// Moves an edge face of a plate inwards, away from the contact.
  void move_edge(const ContactSide& side, const ContactHandle& handle) {
    const Eigen::Vector3d inwards = -handle.normal;
    const auto allowed = symmetry_.allowed_move(side.part, handle.centre, inwards);
    if (!allowed || std::abs(inwards.dot(frame_.w)) > across_r) return;
    double innermost = handle.centre.dot(inwards);
    for (const ContactPolygon& polygon : side.region.polygons)
      innermost =
          std::max(innermost,
                   ((side.of_lower_copy ? polygon.upper_points : polygon.lower_points) * inwards).maxCoeff());
    const double step = options_.move_step * extent(inwards);
    const double enough = innermost - handle.centre.dot(inwards) + options_.contacts.band * extent(inwards);
    const bool near = enough <= max_steps * step;
    for (const double size : near ? with_reserve(sizes(step, enough), enough) : sizes(step, std::nullopt))
      add(side, handle, Move{size * *allowed}, EditEffect::edge_inwards);
  }

  /// Adds a size beyond `enough`: joints that yield undo part of an edit.
  static std::vector<double> with_reserve(std::vector<double> sizes, double enough) {
    sizes.push_back(std::max(reserve * enough, sizes.back()));
    return sizes;
  }

  /// Returns whether scaling the handle matters at the contact: `offset` from its centre is large enough
  /// against `reach`, the distance from the centre to its outside.
  static bool is_off(const Eigen::Vector3d& offset, double reach) {
    return offset.norm() >= off_centre * reach;
  }

  void scale_in_place(const ContactSide& side, const ContactHandle& handle) {
    const bool ring = side.region.type == ContactType::ring;
    const Eigen::Vector3d offset = side.centre - handle.centre;
    const Eigen::Vector3d across = offset - offset.dot(handle.normal) * handle.normal;
    if (!ring) {
      if (!extended_ || handle.normal.isZero()) return;
      const double reach =
          handle.radius > 0
              ? handle.radius
              : (handle.points.rowwise() - handle.centre.transpose()).rowwise().norm().minCoeff();
      if (!is_off(across, reach)) return;
    }
    const bool bulge = handle.radius > 0 && handle.falloff == Falloff::gaussian;
    for (const double sign : {-1.0, 1.0})
      for (const double m : multiples_) {
        if ((bulge || (sign > 0 && !ring)) && m > multiples_.front()) break;
        add(side, handle, Scale{1 + sign * m * options_.scale_step, std::nullopt},
            sign < 0 ? EditEffect::narrower : EditEffect::wider);
      }
  }

  void scale_whole(const ContactSide& side, const ContactHandle& whole, const Eigen::Vector3d& axis) {
    const bool ring = side.region.type == ContactType::ring, upright = axis == frame_.w;
    const Range own = whole.range(axis);
    if (upright && frame_.on_end(own)) return;
    const auto allowed = symmetry_.allowed_axis(side.part, axis);
    if (!allowed) return;
    const double offset = (side.centre - whole.centre).dot(axis);
    if ((upright || !ring) && !is_off(offset * axis, own.length() / 2)) return;
    if (side.region.type == ContactType::line && !upright &&
        std::abs(axis.dot(side.region.long_axis)) > std::sqrt(0.5))
      return;
    const std::optional<double> enough = upright ? std::nullopt : enough_shrinking(side, whole, axis);
    for (const double size : sizes(options_.scale_step, enough))
      add(side, whole, Scale{1 - size, *allowed}, upright ? EditEffect::flatter : EditEffect::narrower);
    if (!upright)
      add(side, whole, Scale{1 + multiples_.front() * options_.scale_step, *allowed}, EditEffect::wider);
  }

  /// Returns the fraction by which a part must shrink along `axis` to clear the other part beside it.
  std::optional<double> enough_shrinking(const ContactSide& side, const ContactHandle& whole,
                                         const Eigen::Vector3d& axis) {
    if (side.other == side.part) return std::nullopt;
    const Eigen::Vector3d outwards =
        (side.centre - whole.centre).dot(axis) < 0 ? Eigen::Vector3d(-axis) : axis;
    const double middle = whole.centre.dot(outwards);
    const double reach = whole.range(outwards).high - middle;
    const double free =
        range_of_part(side.other, outwards).low - options_.contacts.band * extent(axis) - middle;
    const double size = 1 - free / reach;
    if (!(size >= min_steps * options_.scale_step) || size > max_steps * options_.scale_step || size >= 1)
      return std::nullopt;
    return size;
  }

  const ContactSituation& situation_;
  const ContactEditOptions& options_;
  ContactFrame frame_;
  ContactSymmetry symmetry_;
  bool extended_;
  std::vector<double> multiples_;
  double diagonal_;
  std::map<int, Points> points_;  ///< corners per part, see `part_points`
  std::vector<ContactEdit> edits_;
};

/// Returns the only edit of gap scaling.
std::vector<ContactEdit> gap_scalings(const ContactSituation& situation, const ContactEditOptions& options) {
  std::vector<ContactEdit> edits;
  if (situation.regions.empty()) return edits;
  const Scale scale{1 - options.scale_step, situation.direction.unit()};
  edits.push_back(
      {{{HandleKind::shape, 0, 0}, scale}, situation.regions.front().type, 0, true, {EditEffect::squash}});
  return edits;
}

}  // namespace

bool is_smooth(const Edit& edit, const Primitive& primitive) {
  const Handle& handle = edit.handle;
  if (handle.kind == HandleKind::part || std::holds_alternative<Taper>(edit.operation)) return true;
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive))
    return handle.kind == HandleKind::section && detail::is_straight(*cylinder) &&
           edit.falloff == Falloff::linear &&
           (handle.index == 0 || handle.index == cylinder->centres.rows() - 1);
  if (handle.kind != HandleKind::face) return false;
  const OrientedBox box = nearest_box(std::get<Cuboid>(primitive));
  const Eigen::Index axis = handle.index / 2;
  const double width = std::max(box.half_extents((axis + 1) % 3), box.half_extents((axis + 2) % 3));
  if (box.half_extents(axis) >= tolerance::quality::elongated * width) return true;
  const auto* move = std::get_if<Move>(&edit.operation);
  return move && move->by.cross(box.axes.col(axis)).norm() <= tolerance::same_symmetry * move->by.norm();
}

std::string describe(const EditReason& reason, const std::vector<std::string>& part_names) {
  constexpr std::array words = {"down",
                                "up",
                                "outwards",
                                "inwards",
                                "sideways",
                                "edge inwards",
                                "narrower",
                                "wider",
                                "flatter",
                                "everything below squashed upwards",
                                "makes up for the others"};
  const std::string word = words.at(static_cast<std::size_t>(reason.effect));
  if (reason.effect == EditEffect::squash || reason.effect == EditEffect::compensation) return word;
  return (reason.leaning ? "leaning " : "") + word + ", away from " +
         (reason.away_from < 0 ? "the next copy" : "'" + part_names.at(at(reason.away_from)) + "'");
}

std::vector<ContactEdit> contact_edits(const ContactSituation& situation, const ContactEditOptions& options) {
  check(options);
  if (situation.capabilities.edits_along_one_direction) return gap_scalings(situation, options);
  return ContactEditor(situation, options).run();
}

}  // namespace stackabilization
