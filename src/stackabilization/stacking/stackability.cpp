#include "stackabilization/stacking/stackability.h"

#include <tbb/parallel_invoke.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization {

struct StackabilitySolver::Data {
  Data(const Shape& given, const StackabilityOptions& chosen) : shape(given), options(chosen) {
    tbb::parallel_invoke([this] { tree.emplace(shape); }, [this] { hull.emplace(shape); });
    box_volume = measure_volume();
  }

  double measure_volume() const {
    const OrientedBox box =
        options.boxes == BoxModel::oriented ? minimal_oriented_box(*hull) : axis_aligned_box(hull->points());
    const double thinnest = 2 * box.half_extents.minCoeff(), largest = hull->points().cwiseAbs().maxCoeff();
    if (thinnest > tolerance::rounding * largest) return box.volume();
    if (options.flat_shapes == FlatShapes::measure) return 0;
    throw InputError("the shape is flat: its box has no volume, so its stackability is undefined");
  }

  /// V(M, r) / h(M, r)
  double base_area(const Direction& direction) const {
    if (options.boxes == BoxModel::oriented) return hull->minimal_rectangle_area(direction);
    const OrientedBox box = frame_box(hull->points(), direction);
    return 4 * box.half_extents.x() * box.half_extents.y();
  }

  Enclosure enclosure(const Direction& direction, std::optional<double> abandon_above) const {
    return separation_enclosure(*tree, *tree, direction, {options.semantics, abandon_above});
  }

  Shape shape;
  StackabilityOptions options;
  std::optional<SeparationTree> tree;
  std::optional<HullSupport> hull;
  double box_volume = 0;
};

namespace {

/// Where nothing blocks, the copies slide into each other and f_max is 0.
double translation(const Enclosure& enclosure, const Direction& direction) {
  if (enclosure.upper == -std::numeric_limits<double>::infinity()) return 0;
  return (enclosure.lower + enclosure.upper) / 2 * direction.length();
}

}  // namespace

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
  return *measure_if_above(direction, -std::numeric_limits<double>::infinity());
}

std::optional<Stackability> StackabilitySolver::measure_if_above(const Direction& direction,
                                                                 double threshold) const {
  if (threshold > 1) return std::nullopt;
  const double area = data_->base_area(direction);
  std::optional<double> abandon_above;
  if (std::isfinite(threshold)) {
    const double limit = (1 - threshold) * data_->box_volume / (area * direction.length());
    abandon_above = limit * (1 + tolerance::rounding);
  }
  const Enclosure enclosure = data_->enclosure(direction, abandon_above);
  if (enclosure.abandoned) return std::nullopt;

  Stackability result;
  result.direction = direction.vector();
  result.f_max = translation(enclosure, direction);
  result.extent = data_->hull->extent(direction);
  result.box_volume = data_->box_volume;
  result.stack_box_volume = result.extent * area;
  result.value = data_->box_volume > 0 ? 1 - result.f_max * area / data_->box_volume
                                       : std::numeric_limits<double>::quiet_NaN();
  if (result.value < threshold) return std::nullopt;
  return result;
}

Stackability stackability(const Shape& shape, const Direction& direction,
                          const StackabilityOptions& options) {
  return StackabilitySolver(shape, options).measure(direction);
}

}  // namespace stackabilization
