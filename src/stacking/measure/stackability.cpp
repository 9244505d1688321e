#include "stackabilization/stacking/stackability.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "mesh/used_vertices.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/clearance.h"

namespace stackabilization {

namespace {

constexpr double unlimited = -std::numeric_limits<double>::infinity();

/// Returns V(M). Throws InputError when it is 0, unless the options allow it.
double checked_volume(double volume, FlatShapes flat_shapes) {
  if (volume > 0 || flat_shapes == FlatShapes::measure) return volume;
  throw InputError("the shape is flat: its box has no volume, so its stackability is undefined");
}

void require_air(double value, const std::string& what) {
  if (!std::isfinite(value) || value < 0)
    throw UsageError("the " + what + " must be a finite length of at least 0");
}

void validate(const StackabilityOptions& options) {
  require_air(options.clearance, "clearance");
  require_air(options.play, "play");
}

/// Returns f_max without clearance and play: 0 where nothing blocks, since the copies then slide into each
/// other.
double translation(const Enclosure& enclosure, const Direction& direction) {
  if (enclosure.upper == -std::numeric_limits<double>::infinity()) return 0;
  return (enclosure.lower + enclosure.upper) / 2 * direction.length();
}

double translation(const Separation& separation) {
  return separation.blocked ? separation.length : 0;
}

/// Returns f_max with the clearance and play of the options. `touching`: f_max without them.
double with_air(const Shape& shape, const Direction& direction, double touching,
                const StackabilityOptions& options) {
  if (options.play > 0) {
    PlayOptions play;
    play.play = options.play;
    play.semantics = options.semantics;
    touching = translation(separation_with_play(shape, shape, direction, play));
  }
  return touching + options.clearance;
}

/// Returns the f_max in units of r beyond which S is below `threshold`. Air never raises S, so the limit
/// holds without it.
std::optional<double> translation_limit(const Stackability& boxes, const Direction& direction,
                                        double threshold) {
  if (!std::isfinite(threshold)) return std::nullopt;
  return boxes.translation_for(threshold) / direction.length() * (1 + tolerance::rounding);
}

/// Returns the measures for f_max = `touching` without air, unless S is below `threshold`.
std::optional<Stackability> measured_above(const Stackability& boxes, const Shape& shape,
                                           const Direction& direction, double touching,
                                           const StackabilityOptions& options, double threshold) {
  Stackability result = boxes.with_f_max(touching);
  if (result.value < threshold) return std::nullopt;
  result = boxes.with_f_max(with_air(shape, direction, touching, options));
  if (result.value < threshold) return std::nullopt;
  return result;
}

/// V(M) of the `frame` model: the volume of the box along the file's axes around the points, 0 when its
/// thickness is within rounding.
double frame_volume(const OrientedBox& box, const Points& points) {
  const double thinnest = 2 * box.half_extents.minCoeff(), largest = points.cwiseAbs().maxCoeff();
  return thinnest > tolerance::rounding * largest ? box.volume() : 0;
}

OrientedBox model_box(const HullSupport& hull, BoxModel model) {
  return model == BoxModel::frame ? axis_aligned_box(hull.points()) : minimal_oriented_box(hull);
}

/// Returns V(M). `box`: box of the hull in that model.
double model_box_volume(const OrientedBox& box, const HullSupport& hull, BoxModel model) {
  if (model == BoxModel::frame) return frame_volume(box, hull.points());
  return hull.dimension() == 3 ? box.volume() : 0;
}

}  // namespace

double Stackability::lean_degrees() const {
  return std::atan2(direction.head<2>().norm(), direction.z()) * 180 / std::numbers::pi;
}

double Stackability::value_at(double f) const {
  return box_volume > 0 ? 1 - f * base / box_volume : std::numeric_limits<double>::quiet_NaN();
}

Stackability Stackability::with_f_max(double f) const {
  Stackability result = *this;
  result.f_max = f;
  result.value = value_at(f);
  return result;
}

double box_volume(const HullSupport& hull, BoxModel model) {
  return model_box_volume(model_box(hull, model), hull, model);
}

struct StackabilitySolver::Data {
  Data(const Shape& given, const StackabilityOptions& options) : shape(given) {
    tbb::parallel_invoke([this] { tree.emplace(shape); }, [this] { hull.emplace(shape); });
    box = model_box(*hull, options.boxes);
    volume = checked_volume(model_box_volume(box, *hull, options.boxes), options.flat_shapes);
  }

  /// Returns the terms of the boxes; f_max and S are not set.
  Stackability boxes(const Direction& direction, BoxModel model) const {
    Stackability terms;
    terms.direction = direction.vector();
    terms.box_volume = volume;
    terms.extent = hull->extent(direction);
    if (model == BoxModel::oriented) {
      terms.base = hull->minimal_rectangle_area(direction);
    } else {
      const OrientedBox along = frame_box(hull->points(), direction);
      terms.base = 4 * along.half_extents.x() * along.half_extents.y();
    }
    return terms;
  }

  Shape shape;
  std::optional<SeparationTree> tree;
  std::optional<HullSupport> hull;
  OrientedBox box;
  double volume = 0;
};

StackabilitySolver::StackabilitySolver(const Shape& shape, const StackabilityOptions& options)
    : options_(options) {
  validate(shape);
  validate(options);
  data_ = std::make_shared<const Data>(shape, options);
}

StackabilitySolver::StackabilitySolver(std::shared_ptr<const Data> data, const StackabilityOptions& options)
    : data_(std::move(data)), options_(options) {
  validate(options);
}

StackabilitySolver StackabilitySolver::with_play(double play) const {
  StackabilityOptions options = options_;
  options.play = play;
  return StackabilitySolver(data_, options);
}

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
  return options_;
}
const OrientedBox& StackabilitySolver::box() const {
  return data_->box;
}
double StackabilitySolver::box_volume() const {
  return data_->volume;
}

Separation StackabilitySolver::separation(const Direction& direction) const {
  return stackabilization::separation(*data_->tree, *data_->tree, direction,
                                      {options_.semantics, std::nullopt});
}

Stackability StackabilitySolver::measure(const Direction& direction) const {
  return *measure_if_above(direction, unlimited);
}

std::optional<Stackability> StackabilitySolver::measure_if_above(const Direction& direction,
                                                                 double threshold) const {
  std::int64_t node_pairs = 0;
  return measure_if_above(direction, threshold, node_pairs);
}

std::optional<Stackability> StackabilitySolver::measure_if_above(const Direction& direction, double threshold,
                                                                 std::int64_t& node_pairs) const {
  node_pairs = 0;
  if (threshold > 1) return std::nullopt;
  const Stackability boxes = data_->boxes(direction, options_.boxes);
  const Enclosure enclosure =
      separation_enclosure(*data_->tree, *data_->tree, direction,
                           {options_.semantics, translation_limit(boxes, direction, threshold)});
  node_pairs = enclosure.work.node_pairs;
  if (enclosure.abandoned) return std::nullopt;
  return measured_above(boxes, data_->shape, direction, translation(enclosure, direction), options_,
                        threshold);
}

ExactStackability StackabilitySolver::measure_exact(const Direction& direction) const {
  const Separation exact = separation(direction);
  const double f_max = with_air(data_->shape, direction, translation(exact), options_);
  return {data_->boxes(direction, options_.boxes).with_f_max(f_max), exact};
}

namespace {

/// Boxes of a shape along one direction. The box of the file needs no hull. The minimal box, by far the most
/// expensive one, is computed last.
class BoxesAlong {
 public:
  BoxesAlong(const Shape& shape, const Direction& direction, const StackabilityOptions& options)
      : options_(options) {
    terms_.direction = direction.vector();
    if (options.boxes == BoxModel::oriented) {
      hull_.emplace(shape);
      terms_.extent = hull_->extent(direction);
      terms_.base = hull_->minimal_rectangle_area(direction);
      const double aligned = axis_aligned_box(hull_->points()).volume();
      terms_.box_volume = std::min(aligned, terms_.extent * terms_.base) * (1 + tolerance::relative);
    } else {
      const Points points = used_vertices(shape);
      const OrientedBox along = frame_box(points, direction);
      terms_.extent = 2 * along.half_extents.z();
      terms_.base = 4 * along.half_extents.x() * along.half_extents.y();
      terms_.box_volume = checked_volume(frame_volume(axis_aligned_box(points), points), options.flat_shapes);
    }
  }

  /// Returns the terms with an upper bound for V(M); f_max and S are not set.
  const Stackability& bound() const { return terms_; }

  Stackability exact() const {
    Stackability terms = terms_;
    if (hull_) terms.box_volume = checked_volume(box_volume(*hull_, options_.boxes), options_.flat_shapes);
    return terms;
  }

 private:
  StackabilityOptions options_;
  std::optional<HullSupport> hull_;
  Stackability terms_;
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
  validate(options);
  std::optional<SeparationTree> tree;
  std::optional<BoxesAlong> boxes;
  tbb::parallel_invoke([&] { tree.emplace(shape); }, [&] { boxes.emplace(shape, direction, options); });
  const Enclosure enclosure = separation_enclosure(
      *tree, *tree, direction, {options.semantics, translation_limit(boxes->bound(), direction, threshold)});
  if (enclosure.abandoned) return std::nullopt;
  return measured_above(boxes->exact(), shape, direction, translation(enclosure, direction), options,
                        threshold);
}

ExactStackability measure_exact(const Shape& shape, const SeparationTree& tree, const Direction& direction,
                                const StackabilityOptions& options) {
  validate(shape);
  validate(options);
  Separation exact;
  Stackability boxes;
  tbb::parallel_invoke(
      [&] {
        exact = separation(tree, tree, direction, {options.semantics, std::nullopt});
      },
      [&] { boxes = BoxesAlong(shape, direction, options).exact(); });
  return {boxes.with_f_max(with_air(shape, direction, translation(exact), options)), exact};
}

}  // namespace stackabilization
