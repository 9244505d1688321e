#include "stackabilization/stacking/stackability.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/used_vertices.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

constexpr double unlimited = -std::numeric_limits<double>::infinity();

/// V(M) > 0, or what the options say of shapes without.
double checked_volume(double volume, FlatShapes flat_shapes) {
  if (volume > 0 || flat_shapes == FlatShapes::measure) return volume;
  throw InputError("the shape is flat: its box has no volume, so its stackability is undefined");
}

/// What Eq. 3 needs of the boxes.
struct BoxTerms {
  double volume = 0;  ///< V(M)
  double base = 0;    ///< V(M, r) / h(M, r)
  double extent = 0;  ///< h(M, r)
};

/// Where nothing blocks, the copies slide into each other and f_max is 0.
double translation(const Enclosure& enclosure, const Direction& direction) {
  if (enclosure.upper == -std::numeric_limits<double>::infinity()) return 0;
  return (enclosure.lower + enclosure.upper) / 2 * direction.length();
}

/// f_max in units of r beyond which S is below `threshold`.
std::optional<double> translation_limit(const BoxTerms& boxes, const Direction& direction, double threshold) {
  if (!std::isfinite(threshold)) return std::nullopt;
  return (1 - threshold) * boxes.volume / (boxes.base * direction.length()) * (1 + tolerance::rounding);
}

/// Eq. 3
Stackability stackability_from(const BoxTerms& boxes, const Direction& direction, double f_max) {
  Stackability result;
  result.direction = direction.vector();
  result.f_max = f_max;
  result.extent = boxes.extent;
  result.box_volume = boxes.volume;
  result.stack_box_volume = boxes.extent * boxes.base;
  result.value =
      boxes.volume > 0 ? 1 - f_max * boxes.base / boxes.volume : std::numeric_limits<double>::quiet_NaN();
  return result;
}

/// V(M) of the `frame` model: a box is flat when rounding could have made it as thick as it is.
double frame_volume(const Points& points) {
  const OrientedBox box = axis_aligned_box(points);
  const double thinnest = 2 * box.half_extents.minCoeff(), largest = points.cwiseAbs().maxCoeff();
  return thinnest > tolerance::rounding * largest ? box.volume() : 0;
}

}  // namespace

double box_volume(const HullSupport& hull, BoxModel model) {
  if (model == BoxModel::frame) return frame_volume(hull.points());
  return hull.dimension() == 3 ? minimal_oriented_box(hull).volume() : 0;
}

struct StackabilitySolver::Data {
  Data(const Shape& given, const StackabilityOptions& chosen) : shape(given), options(chosen) {
    tbb::parallel_invoke([this] { tree.emplace(shape); }, [this] { hull.emplace(shape); });
    box_volume = checked_volume(stackabilization::box_volume(*hull, options.boxes), options.flat_shapes);
  }

  BoxTerms boxes(const Direction& direction) const {
    BoxTerms terms;
    terms.volume = box_volume;
    terms.extent = hull->extent(direction);
    if (options.boxes == BoxModel::oriented) {
      terms.base = hull->minimal_rectangle_area(direction);
    } else {
      const OrientedBox box = frame_box(hull->points(), direction);
      terms.base = 4 * box.half_extents.x() * box.half_extents.y();
    }
    return terms;
  }

  Shape shape;
  StackabilityOptions options;
  std::optional<SeparationTree> tree;
  std::optional<HullSupport> hull;
  double box_volume = 0;
};

StackabilitySolver::StackabilitySolver(const Shape& shape, const StackabilityOptions& options) {
  validate(shape);
  data_ = std::make_unique<const Data>(shape, options);
}

StackabilitySolver::StackabilitySolver(StackabilitySolver&&) noexcept = default;
StackabilitySolver& StackabilitySolver::operator=(StackabilitySolver&&) noexcept = default;
StackabilitySolver::~StackabilitySolver() = default;

const Shape& StackabilitySolver::shape() const {
  return data_->shape;
}
const SeparationTree& StackabilitySolver::tree() const {
  return *data_->tree;
}
const HullSupport& StackabilitySolver::hull() const {
  return *data_->hull;
}
const StackabilityOptions& StackabilitySolver::options() const {
  return data_->options;
}
double StackabilitySolver::box_volume() const {
  return data_->box_volume;
}

Separation StackabilitySolver::separation(const Direction& direction) const {
  return stackabilization::separation(*data_->tree, *data_->tree, direction,
                                      {data_->options.semantics, std::nullopt});
}

Stackability StackabilitySolver::measure(const Direction& direction) const {
  return *measure_if_above(direction, unlimited);
}

std::optional<Stackability> StackabilitySolver::measure_if_above(const Direction& direction,
                                                                 double threshold) const {
  if (threshold > 1) return std::nullopt;
  const BoxTerms boxes = data_->boxes(direction);
  const Enclosure enclosure =
      separation_enclosure(*data_->tree, *data_->tree, direction,
                           {data_->options.semantics, translation_limit(boxes, direction, threshold)});
  if (enclosure.abandoned) return std::nullopt;
  const Stackability result = stackability_from(boxes, direction, translation(enclosure, direction));
  if (result.value < threshold) return std::nullopt;
  return result;
}

namespace {

/// The boxes of a shape along one direction. The file's needs no hull; the minimal one, by far the most
/// expensive of all, is looked for last.
class BoxesAlong {
 public:
  BoxesAlong(const Shape& shape, const Direction& direction, const StackabilityOptions& options)
      : options_(options) {
    if (options.boxes == BoxModel::oriented) {
      hull_.emplace(shape);
      terms_.extent = hull_->extent(direction);
      terms_.base = hull_->minimal_rectangle_area(direction);
      const double aligned = axis_aligned_box(hull_->points()).volume();
      terms_.volume = std::min(aligned, terms_.extent * terms_.base) * (1 + tolerance::relative);
    } else {
      const Points points = used_vertices(shape);
      const OrientedBox along = frame_box(points, direction);
      terms_.extent = 2 * along.half_extents.z();
      terms_.base = 4 * along.half_extents.x() * along.half_extents.y();
      terms_.volume = checked_volume(frame_volume(points), options.flat_shapes);
    }
  }

  /// With an upper bound for V(M).
  const BoxTerms& bound() const { return terms_; }

  BoxTerms exact() const {
    BoxTerms terms = terms_;
    if (hull_) terms.volume = checked_volume(box_volume(*hull_, options_.boxes), options_.flat_shapes);
    return terms;
  }

 private:
  StackabilityOptions options_;
  std::optional<HullSupport> hull_;
  BoxTerms terms_;
};

}  // namespace

Stackability stackability(const Shape& shape, const Direction& direction,
                          const StackabilityOptions& options) {
  return *stackability_if_above(shape, direction, unlimited, options);
}

std::optional<Stackability> stackability_if_above(const Shape& shape, const Direction& direction,
                                                  double threshold, const StackabilityOptions& options) {
  if (threshold > 1) return std::nullopt;
  validate(shape);
  std::optional<SeparationTree> tree;
  std::optional<BoxesAlong> boxes;
  tbb::parallel_invoke([&] { tree.emplace(shape); }, [&] { boxes.emplace(shape, direction, options); });
  const Enclosure enclosure = separation_enclosure(
      *tree, *tree, direction, {options.semantics, translation_limit(boxes->bound(), direction, threshold)});
  if (enclosure.abandoned) return std::nullopt;
  const Stackability result = stackability_from(boxes->exact(), direction, translation(enclosure, direction));
  if (result.value < threshold) return std::nullopt;
  return result;
}

Stackability stackability_of_translation(const Shape& shape, const Direction& direction, double translation,
                                         const StackabilityOptions& options) {
  validate(shape);
  return stackability_from(BoxesAlong(shape, direction, options).exact(), direction, translation);
}

}  // namespace stackabilization
