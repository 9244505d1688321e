#include "improvement/quality/whole_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int marks_of_whole = 600;
/// Largest tilt of a seat at rest, as a cosine.
constexpr double level = 0.985;

}  // namespace

WholeForm::WholeForm(const StructuredShape& rest, const WeldedMesh& welded, const PartForms& parts,
                     const Eigen::Vector3d& up)
    : up_(up), diagonal_(rest.structure.diagonal), height_(range_along(rest.shape, up).length()) {
  find_symmetric_marks(rest);
  find_seats(rest.shape, parts);
  find_feet(rest.shape, welded);
}

void WholeForm::find_symmetric_marks(const StructuredShape& rest) {
  if (rest.structure.symmetries.empty()) return;
  std::vector<std::int32_t> all(static_cast<std::size_t>(rest.shape.triangle_count()));
  std::iota(all.begin(), all.end(), 0);
  marks_ = marks_on(rest.shape, all, marks_of_whole);
  if (marks_.size() == 0) return;
  const SurfaceIndex surface(rest.shape);
  const Points places = marks_.on(rest.shape);
  for (const Symmetry& symmetry : rest.structure.symmetries) {
    SymmetricMarks entry{isometry_of(symmetry), {}, Eigen::VectorXd(places.rows())};
    for (Eigen::Index k = 0; k < places.rows(); ++k) {
      const SurfacePoint image = surface.nearest(entry.map * places.row(k).transpose());
      entry.images.append(rest.shape, image.triangle, image.point);
      entry.distances(k) = image.distance;
    }
    symmetric_.push_back(std::move(entry));
  }
}

QualityValue WholeForm::symmetry(const Shape& now) const {
  QualityValue worst{QualityMeasure::symmetry};
  const Points places = marks_.on(now);
  for (const SymmetricMarks& entry : symmetric_) {
    const Points images = entry.images.on(now);
    for (Eigen::Index k = 0; k < places.rows(); ++k) {
      const Eigen::Vector3d image = entry.map * places.row(k).transpose();
      const double off = ((image - images.row(k).transpose()).norm() - entry.distances(k)) / diagonal_;
      if (off <= worst.value) continue;
      worst.value = off;
      worst.part = now.triangle_part[at(marks_.triangles[static_cast<std::size_t>(k)])];
    }
  }
  return worst;
}

double WholeForm::tilt_of(const FlatFace& face, const Shape& shape) const {
  return angle_between_planes(face.area_vector(shape), up_);
}

double WholeForm::height_of(const FlatFace& face, const Shape& shape, double ground) const {
  double sum = 0, area = 0;
  for (const std::int32_t t : face.triangles) {
    const double weight = area_vector(shape, t).norm();
    sum += weight * up_.dot(shape.corner(t, 0) + shape.corner(t, 1) + shape.corner(t, 2)) / 3;
    area += weight;
  }
  return area > 0 ? sum / area - ground : 0;
}

void WholeForm::find_seats(const Shape& rest, const PartForms& parts) {
  const Eigen::Vector3d u = up_.unitOrthogonal(), v = up_.cross(u);
  const double footprint = range_along(rest, u).length() * range_along(rest, v).length();
  const double ground = range_along(rest, up_).low;
  for (int part = 0; part < static_cast<int>(rest.part_count()); ++part)
    for (const FlatFace& face : parts.faces(part)) {
      const Eigen::Vector3d area = face.area_vector(rest);
      Seat seat{part, face, std::abs(area.dot(up_)), height_of(face, rest, ground), tilt_of(face, rest)};
      const bool faces_up = detail::area_vector(rest, face.triangles.front()).dot(up_) > 0;
      if (!faces_up || std::cos(seat.tilt) < level ||
          seat.area < tolerance::quality::seat_share * footprint ||
          !(seat.height > tolerance::quality::seat_height * height_))
        continue;
      seats_.push_back(std::move(seat));
    }
}

double WholeForm::rise_of(const Foot& foot, const Shape& shape, double ground) const {
  double low = std::numeric_limits<double>::infinity();
  for (const Eigen::Index v : foot.vertices) low = std::min(low, up_.dot(shape.vertices.row(v).transpose()));
  return low - ground;
}

void WholeForm::find_feet(const Shape& rest, const WeldedMesh& welded) {
  const double ground = range_along(rest, up_).low, top = ground + tolerance::quality::foot_slab * height_;
  const auto is_low = [&](std::int32_t point) {
    return welded.points.row(point).dot(up_.transpose()) <= top;
  };
  DisjointSets sets(static_cast<std::size_t>(welded.points.rows()));
  const EdgeTable edges(welded.triangles);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    const TriangleSide& side = edges[edge].front();
    if (is_low(side.low) && is_low(side.high)) sets.join(at(side.low), at(side.high));
  }
  std::map<std::size_t, std::vector<Eigen::Index>> groups;
  for (std::int32_t point = 0; point < welded.points.rows(); ++point)
    if (is_low(point)) groups[sets.root(at(point))].push_back(welded.first_vertex[at(point)]);
  std::vector<int> part_of(static_cast<std::size_t>(rest.vertex_count()), -1);
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      part_of[at(rest.triangles(t, k))] = rest.triangle_part[static_cast<std::size_t>(t)];
  for (auto& [root, vertices] : groups) {
    Foot foot{part_of[static_cast<std::size_t>(vertices.front())], std::move(vertices), 0};
    foot.rise = rise_of(foot, rest, ground);
    feet_.push_back(std::move(foot));
  }
}

std::vector<QualityValue> WholeForm::function(const Shape& now) const {
  QualityValue seat{QualityMeasure::seat, 1}, tilt{QualityMeasure::tilt}, feet{QualityMeasure::feet};
  const Range range = range_along(now, up_);
  for (const Seat& one : seats_) {
    const double area = std::abs(one.face.area_vector(now).dot(up_)) / one.area;
    const double height = height_of(one.face, now, range.low) / one.height;
    const double ratio = std::min({area, height, height > 0 ? 1 / height : 0});
    if (ratio < seat.value) seat = {QualityMeasure::seat, ratio, one.part};
    const double turned = (tilt_of(one.face, now) - one.tilt) * 180 / std::numbers::pi;
    if (turned > tilt.value) tilt = {QualityMeasure::tilt, turned, one.part};
  }
  for (const Foot& foot : feet_) {
    const double rise = (rise_of(foot, now, range.low) - foot.rise) / diagonal_;
    if (rise > feet.value) feet = {QualityMeasure::feet, rise, foot.part};
  }
  const QualityValue height{QualityMeasure::height,
                            height_ > 0 ? std::abs(range.length() - height_) / height_ : 0};
  return {seat, tilt, height, feet};
}

}  // namespace stackabilization::detail
