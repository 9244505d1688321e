#include "stackabilization/improvement/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "improvement/quality/creases.h"
#include "improvement/quality/part_contacts.h"
#include "improvement/quality/part_forms.h"
#include "improvement/quality/whole_form.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization {

namespace {

namespace limits = tolerance::quality;

struct MeasureWords {
  const char *name, *unit;
  bool ratio;
  double limit;
};

/// In the order of QualityMeasure.
constexpr std::array<MeasureWords, quality_measure_count> measure_words = {{
    {"self-intersection", "pairs of triangles", false, limits::max_self_intersection},
    {"collision", "pairs of parts", false, limits::max_collision},
    {"piercing", "of the diagonal", false, limits::max_piercing},
    {"joints", "of the diagonal", false, limits::max_joints},
    {"symmetry", "of the diagonal", false, limits::max_symmetry},
    {"creases", "of the diagonal", false, limits::max_creases},
    {"straightness", "of the length", false, limits::max_straightness},
    {"bending", "degrees", false, limits::max_bending},
    {"section", "of the width", false, limits::max_section},
    {"profile", "of the radius", false, limits::max_profile},
    {"flatness", "of the width", false, limits::max_flatness},
    {"parallelism", "degrees", false, limits::max_parallelism},
    {"size", "of rest", true, limits::min_size},
    {"small-part", "of rest", true, limits::min_small_part},
    {"thickness", "of rest", true, limits::min_thickness},
    {"lean", "degrees", false, limits::max_lean},
    {"seat", "of rest", true, limits::min_seat},
    {"tilt", "degrees", false, limits::max_tilt},
    {"height", "of the height", false, limits::max_height},
    {"feet", "of the diagonal", false, limits::max_feet},
}};

const MeasureWords& words_for(QualityMeasure measure) {
  return measure_words.at(static_cast<std::size_t>(measure));
}

StructuredShape validated(StructuredShape rest) {
  validate(rest);
  return rest;
}

}  // namespace

std::string name_of(QualityMeasure measure) {
  return words_for(measure).name;
}

std::optional<QualityMeasure> quality_measure_of(const std::string& name) {
  for (std::size_t k = 0; k < quality_measure_count; ++k)
    if (name == measure_words[k].name) return static_cast<QualityMeasure>(k);
  return std::nullopt;
}

std::string unit_of(QualityMeasure measure) {
  return words_for(measure).unit;
}

bool has_lower_limit(QualityMeasure measure) {
  return words_for(measure).ratio;
}

double ideal_value(QualityMeasure measure) {
  return has_lower_limit(measure) ? 1 : 0;
}

QualityLimits::QualityLimits() {
  for (std::size_t k = 0; k < quality_measure_count; ++k) limits_[k] = measure_words[k].limit;
}

void QualityLimits::relax(QualityMeasure measure) {
  (*this)[measure] = has_lower_limit(measure) ? 0 : std::numeric_limits<double>::infinity();
}

bool QualityLimits::is_limited(QualityMeasure measure) const {
  return has_lower_limit(measure) ? (*this)[measure] > 0 : std::isfinite((*this)[measure]);
}

void validate(const QualityLimits& limits) {
  for (std::size_t k = 0; k < quality_measure_count; ++k) {
    const auto measure = static_cast<QualityMeasure>(k);
    const double limit = limits[measure];
    if (std::isnan(limit) || limit < 0)
      throw UsageError("the limit of " + name_of(measure) + " must be a number of at least 0");
    if (has_lower_limit(measure) && limit > 1)
      throw UsageError("the limit of " + name_of(measure) + " is a ratio and cannot exceed 1");
  }
}

bool is_within(const QualityValue& value, const QualityLimits& limits) {
  return has_lower_limit(value.measure) ? value.value >= limits[value.measure] - tolerance::relative
                                        : value.value <= limits[value.measure] + tolerance::relative;
}

double share_of_limit(const QualityValue& value, const QualityLimits& limits) {
  if (!limits.is_limited(value.measure)) return 0;
  const double ideal = ideal_value(value.measure), used = std::abs(value.value - ideal),
               allowed = std::abs(limits[value.measure] - ideal);
  if (allowed > 0) return used / allowed;
  return used > tolerance::relative ? 1 + used : 0;
}

struct QualityMeter::Data {
  Data(StructuredShape shape, const Eigen::Vector3d& up)
      : rest(validated(std::move(shape))),
        welded(detail::weld(rest.shape)),
        contacts(rest),
        creases(rest.shape, welded, rest.structure.diagonal),
        parts(rest, welded, Direction(up).unit()),
        whole(rest, welded, parts, Direction(up).unit()) {}

  StructuredShape rest;
  detail::WeldedMesh welded;
  detail::PartContacts contacts;
  detail::Creases creases;
  detail::PartForms parts;
  detail::WholeForm whole;

  void require_match(const Shape& now) const {
    if (now.vertex_count() != rest.shape.vertex_count() || now.triangles != rest.shape.triangles ||
        now.triangle_part != rest.shape.triangle_part)
      throw UsageError("the quality of a change needs the triangles and parts of the object at rest");
  }

  void append_forms(const Shape& now, std::vector<QualityValue>& values) const {
    values.push_back(whole.symmetry(now));
    const std::vector<detail::AffineMap> maps = parts.maps(now);
    values.push_back(creases.measure(now, maps));
    for (const QualityValue& value : parts.measure(now, maps)) values.push_back(value);
    for (const QualityValue& value : whole.function(now)) values.push_back(value);
  }
};

QualityMeter::QualityMeter(StructuredShape rest, const Eigen::Vector3d& up)
    : data_(std::make_unique<const Data>(std::move(rest), up)) {}
QualityMeter::QualityMeter(QualityMeter&&) noexcept = default;
QualityMeter& QualityMeter::operator=(QualityMeter&&) noexcept = default;
QualityMeter::~QualityMeter() = default;

std::vector<QualityValue> QualityMeter::measure(const Shape& now) const {
  data_->require_match(now);
  std::vector<QualityValue> values = data_->contacts.measure(now);
  data_->append_forms(now, values);
  return values;
}

std::vector<QualityValue> QualityMeter::measure_parts(const Shape& now) const {
  data_->require_match(now);
  std::vector<QualityValue> values;
  data_->append_forms(now, values);
  return values;
}

}  // namespace stackabilization
