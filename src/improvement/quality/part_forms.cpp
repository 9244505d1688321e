#include "improvement/quality/part_forms.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.h"
#include "core/bounding_diagonal.h"
#include "core/index.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int thickness_samples = 1500;
/// Largest angle between the sheets of a wall, as a cosine.
constexpr double opposite = 0.9;
constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// Replaces a value by a worse one: a larger one, or a smaller one where the limit is a lower one.
void worsen(QualityValue& worst, double value, int part) {
  if (has_lower_limit(worst.measure) ? value < worst.value : value > worst.value) {
    worst.value = value;
    worst.part = part;
  }
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
}

}  // namespace

PartForms::PartForms(const StructuredShape& rest, const WeldedMesh& welded, const Eigen::Vector3d& up)
    : up_(up), visible_(tolerance::visible * bounding_diagonal(rest.shape)) {
  const Shape& shape = rest.shape;
  const std::vector<std::vector<std::int32_t>> rows = triangles_of_parts(shape);
  for (std::size_t part = 0; part < rows.size(); ++part) {
    Form form;
    static_cast<PartForm&>(form) = part_form(rest, part, rows[part]);
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : rows[part])
      for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
    form.small =
        !box.isEmpty() && box.diagonal().norm() < tolerance::quality::small_part * rest.structure.diagonal;
    if (form.line && form.line->is_straight() && !form.small)
      if (const double lean = lean_of(form.line->direction());
          lean <= tolerance::quality::max_lean_of_leg * degrees_per_radian)
        form.lean = std::max(lean, tolerance::quality::free_lean);
    form.faces = flat_faces(shape, welded, rows[part], tolerance::quality::face_share);
    form.parallel = parallel_faces(shape, form.faces);
    forms_.push_back(std::move(form));
  }
  ThicknessOptions options;
  options.probes = thickness_samples;
  const std::vector<ThicknessProbe> probes = thickness_probes(shape, options);
  std::vector<std::vector<ThicknessProbe>> of_part(forms_.size());
  for (const ThicknessProbe& probe : probes)
    of_part[at(shape.triangle_part[at(probe.near_triangle)])].push_back(probe);
  for (std::size_t part = 0; part < forms_.size(); ++part) {
    Form& form = forms_[part];
    remove_pairs_across_air(shape, form.faces, probes, form.parallel);
    keep_probes(shape, form, std::move(of_part[part]));
  }
}

void PartForms::keep_probes(const Shape& shape, Form& form, std::vector<ThicknessProbe> probes) {
  int walls = 0;  // probes that cross a wall, less those that cross the part
  for (ThicknessProbe& probe : probes) {
    // Solid members are as thick as wide: CentreLineChange::width.
    const bool through = form.line && probe.at_rest > form.line->radius();
    walls += through ? -1 : 1;
    if (through && form.line->is_straight()) continue;
    if (std::abs(unit_normal(shape, probe.near_triangle).dot(unit_normal(shape, probe.far_triangle))) >=
        opposite)
      probes_.push_back(std::move(probe));
  }
  form.hollow = walls > 0;
}

double PartForms::lean_of(const Eigen::Vector3d& line) const {
  return angle_between_lines(line, up_) * degrees_per_radian;
}

/// Returns the stretches of a part: along and across a straight one, so that leaning is none; along the main
/// axes of the map otherwise.
std::vector<double> PartForms::stretches(const Form& form, const AffineMap& map, double length) {
  std::vector<double> result;
  const auto append = [&](const Eigen::VectorXd& values) {
    result.insert(result.end(), values.begin(), values.end());
  };
  if (form.line && form.line->is_straight() && form.fit->rank() == 3) {
    const Eigen::Vector3d along = form.line->direction(), image = map.linear * along;
    result.push_back(length);
    const Eigen::Vector3d now = image.stableNormalized();
    Eigen::Matrix<double, 3, 2> across;
    across.col(0) = along.unitOrthogonal();
    across.col(1) = along.cross(across.col(0));
    const Eigen::Matrix<double, 3, 2> images = map.linear * across;
    append(singular_values(images - now * (now.transpose() * images)));
  } else {
    append(singular_values(form.fit->without_slide(map) * form.fit->axes().leftCols(form.fit->rank())));
  }
  return result;
}

void PartForms::measure_faces(const Shape& now, int part, std::vector<QualityValue>& values) const {
  const Form& form = forms_[at(part)];
  QualityValue &flatness = values[4], &parallelism = values[5];
  for (const FlatFace& face : form.faces) {
    const double farther = face.deviation_on(now) - face.deviation;
    worsen(flatness, (farther - visible_) / std::sqrt(face.area), part);
  }
  for (const ParallelFaces& pair : form.parallel) {
    const double angle = angle_between_lines(form.faces[pair.first].area_vector(now),
                                             form.faces[pair.second].area_vector(now));
    // Across a narrow face a turn is not seen.
    const double unseen = visible_ / std::min(form.faces[pair.first].width, form.faces[pair.second].width);
    worsen(parallelism, (angle - pair.angle - unseen) * degrees_per_radian, part);
  }
}

std::vector<AffineMap> PartForms::maps(const Shape& now) const {
  std::vector<AffineMap> result;
  for (const Form& form : forms_)
    result.push_back(form.fit ? form.fit->map(form.marks.on(now)) : AffineMap{});
  return result;
}

std::vector<QualityValue> PartForms::measure(const Shape& now, const std::vector<AffineMap>& maps) const {
  std::vector<QualityValue> values;
  for (const QualityMeasure measure :
       {QualityMeasure::straightness, QualityMeasure::bending, QualityMeasure::section,
        QualityMeasure::profile, QualityMeasure::flatness, QualityMeasure::parallelism, QualityMeasure::size,
        QualityMeasure::small_part, QualityMeasure::thickness, QualityMeasure::lean})
    values.push_back({measure, ideal_value(measure)});
  QualityValue &size = values[6], &small_part = values[7], &thinnest = values[8];
  for (int part = 0; part < static_cast<int>(forms_.size()); ++part) {
    const Form& form = forms_[at(part)];
    if (!form.fit || form.fit->rank() == 0) continue;
    const AffineMap& map = maps[at(part)];
    CentreLineChange change;
    if (form.line) change = form.line->change(now, map);
    const std::vector<double> stretched = stretches(form, map, change.length);
    const auto [least, most] = std::minmax_element(stretched.begin(), stretched.end());
    worsen(size, std::min(*least, 1 / *most), part);
    if (form.small) worsen(small_part, *least / *most, part);
    if (form.lean) worsen(values[9], lean_of(change.direction) - *form.lean, part);
    if (form.line && !form.small) {
      worsen(values[0], change.straightness, part);
      if (!form.hollow) worsen(thinnest, change.width, part);
      worsen(values[1], change.bending, part);
      worsen(values[2], change.section, part);
      worsen(values[3], change.profile, part);
    }
    measure_faces(now, part, values);
  }
  for (const ThicknessProbe& probe : probes_)
    worsen(thinnest, stackabilization::thickness(probe, now) / probe.at_rest,
           now.triangle_part[at(probe.near_triangle)]);
  return values;
}

}  // namespace stackabilization::detail
