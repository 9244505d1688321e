#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// What a person looks at in a changed object. docs/quality.md defines every measure and gives the reason for
/// its limit.
enum class QualityMeasure {
  self_intersection,  ///< pairs of triangles of one part that intersect and were apart at rest
  collision,          ///< pairs of parts that intersect and were apart at rest
  piercing,           ///< increase of the depth to which touching parts enter each other, of the diagonal
  joints,             ///< increase of the gap between joined parts, of the diagonal
  symmetry,           ///< increase of the violation of a symmetry of the whole, of the diagonal
  creases,            ///< length of new creases in what was smooth, of the diagonal
  straightness,       ///< distance of a straight centre line from straight, of its length
  bending,            ///< largest change of the turn of a centre line at one place, degrees
  section,            ///< loss of roundness of a round cross-section, of its width
  profile,            ///< unevenness of the change of the radius along a part, of the radius
  flatness,           ///< distance of a flat face from its plane beyond what is seen, of its width
  parallelism,        ///< angle between faces of a part that were parallel, degrees
  size,               ///< smallest ratio of a size of a part to that at rest, or its inverse
  small_part,         ///< ratio of smallest to largest stretch of a part too small to be deformed
  thickness,          ///< smallest ratio of a thickness to that at rest
  lean,               ///< increase of the lean of a leg or post beyond 15 degrees, degrees
  seat,               ///< smallest ratio of area or height of a seat or table top to that at rest
  tilt,               ///< change of the tilt of a seat or table top, degrees
  height,             ///< change of the height, of the height
  feet,               ///< largest rise of a foot above the ground, of the diagonal
};

/// Number of measures.
inline constexpr std::size_t quality_measure_count = 20;

/// Returns the name of a measure: that of its enumerator with "-" for "_".
std::string name_of(QualityMeasure measure);

/// Returns the measure of this name; nothing for another word.
std::optional<QualityMeasure> quality_measure_of(const std::string& name);

/// Returns the unit of a measure as the comments of QualityMeasure name it: "pairs of triangles", "pairs of
/// parts", "of the diagonal", "of the length", "degrees", "of the width", "of the radius", "of rest" or
/// "of the height".
std::string unit_of(QualityMeasure measure);

/// Returns whether a measure is a ratio with a lower limit. All others have an upper limit.
bool has_lower_limit(QualityMeasure measure);

/// Returns the value of an unchanged object: 1 for a ratio, 0 otherwise.
double ideal_value(QualityMeasure measure);

/// Limit of every measure. The defaults are in improvement/tolerances.h.
class QualityLimits {
 public:
  QualityLimits();  ///< the defaults
  /// Returns the limit of a measure.
  double operator[](QualityMeasure measure) const { return limits_[static_cast<std::size_t>(measure)]; }
  /// Returns the limit of a measure, to be changed.
  double& operator[](QualityMeasure measure) { return limits_[static_cast<std::size_t>(measure)]; }

  /// Removes the limit of a measure.
  void relax(QualityMeasure measure);
  /// Returns whether the measure has a limit.
  bool is_limited(QualityMeasure measure) const;

  /// Returns whether the limits are the same.
  bool operator==(const QualityLimits&) const = default;

 private:
  std::array<double, quality_measure_count> limits_;
};

/// Throws UsageError, naming the measure, for a limit that is not a number, negative, or above 1 for a ratio.
void validate(const QualityLimits& limits);

/// One measure of one changed object.
struct QualityValue {
  QualityMeasure measure = QualityMeasure::self_intersection;  ///< what was measured
  double value = 0;  ///< the worst value anywhere; ideal_value where nothing can be measured
  int part = -1;     ///< part where it is worst; -1: none, or the whole object
  int other = -1;    ///< second part, for collision, piercing and joints; else -1
};

/// Returns whether the value keeps its limit, with tolerance::relative of slack.
bool is_within(const QualityValue& value, const QualityLimits& limits);

/// Returns the share of the limit that a value uses: 0 for the ideal value, 1 at the limit, more beyond it. 0
/// without a limit; where the limit is the ideal value, 1 + the distance from it.
double share_of_limit(const QualityValue& value, const QualityLimits& limits);

/// Measures what a person looks at: a changed object against the same object at rest. All measures are taken
/// on the mesh, whatever changed it; the primitives of the structure only say what is elongated. Every
/// measure of an unchanged object has its ideal value, and those of a moved, turned (about the upright axis)
/// or uniformly scaled one within rounding, but for those of symmetries, whose planes are fixed in space.
///
/// Const, deterministic, safe from any number of threads.
class QualityMeter {
 public:
  /// Prepares everything that depends on the object at rest alone. `up`: direction against gravity. Throws
  /// InputError under the conditions of `validate(rest)`.
  explicit QualityMeter(StructuredShape rest, const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());
  QualityMeter(QualityMeter&&) noexcept;
  QualityMeter& operator=(QualityMeter&&) noexcept;
  ~QualityMeter();

  /// Takes all measures, in the order of QualityMeasure. Throws UsageError when `now` does not have the
  /// triangles and parts of the object at rest.
  std::vector<QualityValue> measure(const Shape& now) const;
  /// Takes the measures from symmetry to feet: those that ask for no intersections of triangles.
  /// Much faster than `measure`. Throws as `measure`.
  std::vector<QualityValue> measure_parts(const Shape& now) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace stackabilization
