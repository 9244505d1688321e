#include "stackabilization/structure/fitting.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "stackabilization/core/errors.h"
#include "structure/fitting/canonical_pose.h"
#include "structure/fitting/closed_part.h"
#include "structure/fitting/curve_skeleton.h"
#include "structure/fitting/cylinder_sections.h"
#include "structure/fitting/part_box.h"
#include "structure/fitting/revolution_axis.h"
#include "structure/model/fit_error.h"

namespace stackabilization {

namespace {

constexpr int min_sections = 4;

/// Error up to which a box or a straight axis represents a part well, so that a skeleton is not tried;
/// fraction of the diagonal.
constexpr double max_held_error = 0.01;

/// Factor by which the error of the next cylinder must improve. Another straight axis than the longest needs
/// a small improvement, a more complex curve needs a clear one.
constexpr double other_axis = 0.95;
constexpr double other_curve = 0.8;
constexpr double wrapped_curve = 0.6;  // the finer points of a wrapped surface are not the part's
constexpr double other_kind = 0.85;    // between a panel and a flat curved tube, the panel

/// Smallest length of a cylinder along another axis of the box than the longest, fraction of its largest
/// radius. Flatter parts are plates, and a box represents them as well.
constexpr double min_length = 0.5;

struct FittedCylinder {
  GeneralizedCylinder cylinder;
  double error = 0;  ///< model units
  std::string note;
};

/// Tries cylinders, the simplest curves first.
class CylinderFit {
 public:
  CylinderFit(const detail::FitSurface& part, const OrientedBox& box, int sections)
      : part_(part), box_(box), sections_(sections) {}

  std::optional<FittedCylinder> best(double box_error) {
    const double enough = max_held_error * 2 * box_.half_extents.norm();
    if (const std::optional<detail::AxisLine> axis = detail::revolution_axis(part_)) {
      offer(detail::straight_cylinder(part_.shape, *axis, sections_, detail::SectionRadius::outermost),
            other_axis, "along its axis of revolution");
      offer(detail::ring_cylinder(part_, *axis, sections_), other_curve,
            "a ring about its axis of revolution");
      if (best_) return std::move(best_);
    }
    for (const int k : detail::axes_by_length(box_)) offer_straight(k);
    if (box_error > enough && !(best_ && best_->error <= enough)) follow_skeleton();
    return std::move(best_);
  }

 private:
  void offer(std::optional<GeneralizedCylinder> cylinder, double share, const std::string& note) {
    if (!cylinder) return;
    const double enough = best_ ? share * best_->error : std::numeric_limits<double>::infinity();
    const double error = detail::fit_error(*cylinder, part_, enough);
    if (best_ && !(error < enough)) return;
    best_ = FittedCylinder{std::move(*cylinder), error, note};
  }

  void offer_straight(int k) {
    auto cylinder = detail::straight_cylinder(part_.shape, {box_.centre, box_.axes.col(k)}, sections_,
                                              detail::SectionRadius::mean);
    if (cylinder && best_ && 2 * box_.half_extents(k) < min_length * cylinder->radii.maxCoeff()) return;
    offer(std::move(cylinder), other_axis, "along an axis of its box");
    if (const std::optional<detail::AxisLine> line =
            detail::middle_line(part_.shape, {box_.centre, box_.axes.col(k)}, sections_))
      offer(detail::straight_cylinder(part_.shape, *line, sections_, detail::SectionRadius::mean), other_axis,
            "along the middle of its outlines");
  }

  void follow_skeleton() {
    const detail::CanonicalPose pose = detail::canonical_pose(part_.shape, box_);
    const std::optional<detail::ClosedPart> closed = detail::closed_part(pose.part);
    const std::optional<detail::Skeleton> skeleton =
        closed ? detail::curve_skeleton(closed->surface) : std::nullopt;
    std::optional<detail::Curve> curve = skeleton ? detail::main_curve(*skeleton) : std::nullopt;
    if (!curve) {
      if (best_) best_->note += ", for its skeleton is no single curve";
      return;
    }
    curve->points = pose.to_model(curve->points);
    offer(detail::curved_cylinder(part_, *curve, sections_), closed->wrapped ? wrapped_curve : other_curve,
          closed->wrapped ? "along the curve skeleton of a surface wrapped around it"
                          : "along its curve skeleton");
  }

  const detail::FitSurface& part_;
  const OrientedBox& box_;
  int sections_;
  std::optional<FittedCylinder> best_;
};

}  // namespace

FittedPrimitive fit_primitive(const Shape& part, const FitOptions& options) {
  if (options.sections < min_sections)
    throw UsageError("a generalized cylinder needs at least 4 cross-sections, not " +
                     std::to_string(options.sections));
  const detail::FitSurface surface(part);
  const detail::PartBox box = detail::part_box(surface);
  const double diagonal = 2 * box.box.half_extents.norm();

  FittedPrimitive fitted{.primitive = cuboid_of(box.box), .fit = {}};
  const double box_error = detail::fit_error(box.box, surface);
  fitted.fit.cuboid_error = box_error / diagonal;
  std::optional<FittedCylinder> cylinder;
  if (!box.flat) cylinder = CylinderFit(surface, box.box, options.sections).best(box_error);
  if (cylinder) fitted.fit.cylinder_error = cylinder->error / diagonal;

  if (options.kind == PrimitiveKind::cylinder && !cylinder)
    throw UsageError("a flat part has no generalized cylinder: it has no extent across its plane");
  const bool round = options.kind ? options.kind == PrimitiveKind::cylinder
                                  : cylinder && cylinder->error < other_kind * box_error;
  if (round) {
    fitted.primitive = std::move(cylinder->cylinder);
    fitted.fit.note = cylinder->note;
  } else if (box.thickened) {
    fitted.fit.note = "thickened to a thousandth of its diagonal";
  }
  return fitted;
}

}  // namespace stackabilization
