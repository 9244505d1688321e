#include "improvement/quality/whole_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/angles.h"
#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/surface_index.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/model/nearest_box.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

namespace {

constexpr int marks_of_whole = 600;
/// Largest tilt of a seat at rest, as a cosine.
constexpr double level = 0.985;

/// Returns whether a primitive is a bar, such as a rung or a rail, whose upper face is no seat.
bool is_bar(const Primitive& primitive) {
  const auto* cuboid = std::get_if<Cuboid>(&primitive);
  if (!cuboid) return false;
  Eigen::Vector3d sides = nearest_box(*cuboid).half_extents;
  std::sort(sides.begin(), sides.end());
  return sides(2) >= tolerance::quality::elongated * sides(1) &&
         sides(1) <= tolerance::quality::bar_width * sides(0);
}

/// Returns whether no relation of the parts has a symmetry, while relations have others in its place: the
/// diagonals of a square, and with them its quarter turns, since a square table may become a rectangular one.
bool may_be_lost(const Symmetry& symmetry, const Structure& structure) {
  if (symmetry.kind == SymmetryKind::revolution) return false;
  bool other = false;
  for (const Relation& relation : structure.relations) {
    const bool reflects =
        relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
    if (!reflects || relation.symmetry.kind != SymmetryKind::reflection) continue;
    const Symmetry& plane = relation.symmetry;
    const double cosine = std::abs(plane.axis.dot(symmetry.axis));
    const double offset = std::abs(plane.axis.dot(plane.point - symmetry.point)) / structure.diagonal;
    if (offset > tolerance::quality::same_plane) continue;
    if (symmetry.kind == SymmetryKind::reflection && cosine >= tolerance::aligned) return false;
    other = other || (symmetry.kind == SymmetryKind::reflection
                          ? relation.type == RelationType::symmetry
                          : cosine * cosine <= 1 - tolerance::aligned * tolerance::aligned);
  }
  return other;
}

/// Finds the images of marks under symmetries. Where surfaces of several parts touch, an image lies on the
/// part on which most images of its part lie.
class Counterparts {
 public:
  explicit Counterparts(const Shape& shape)
      : shape_(shape), rows_(triangles_of_parts(shape)), surface_(shape), surfaces_(rows_.size()) {
    for (std::size_t part = 0; part < rows_.size(); ++part) {
      const Shape alone = extracted(shape, rows_[part]);
      if (surface_graph(alone).areas.sum() > 0) surfaces_[part].emplace(alone);
    }
  }

  /// `mapped`: one column per mark.
  std::vector<SurfacePoint> images(const SurfaceMarks& marks, const Eigen::Matrix3Xd& mapped) const {
    std::vector<SurfacePoint> images;
    std::map<int, std::map<int, int>> votes;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      images.push_back(surface_.nearest(mapped.col(static_cast<Eigen::Index>(k))));
      ++votes[part_of(marks.triangles[k])][part_of(images.back().triangle)];
    }
    for (std::size_t k = 0; k < marks.size(); ++k) {
      const std::map<int, int>& of_part = votes[part_of(marks.triangles[k])];
      const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
      const int part = std::max_element(of_part.begin(), of_part.end(), fewer)->first;
      if (part_of(images[k].triangle) == part) continue;
      images[k] = surfaces_[at(part)]->nearest(mapped.col(static_cast<Eigen::Index>(k)));
      images[k].triangle = rows_[at(part)][at(images[k].triangle)];
    }
    return images;
  }

 private:
  int part_of(std::int32_t triangle) const { return shape_.triangle_part[at(triangle)]; }

  const Shape& shape_;
  std::vector<std::vector<std::int32_t>> rows_;
  SurfaceIndex surface_;
  std::vector<std::optional<SurfaceIndex>> surfaces_;  ///< per part; none without area
};

}  // namespace

WholeForm::WholeForm(const StructuredShape& rest, const WeldedMesh& welded, const PartForms& parts,
                     const Eigen::Vector3d& up)
    : up_(up),
      diagonal_(rest.structure.diagonal),
      height_(range_along(rest.shape, up).length()),
      walk_(rest.shape, welded) {
  find_symmetric_marks(rest);
  find_seats(rest, parts);
  find_feet(rest.shape, welded);
}

void WholeForm::find_symmetric_marks(const StructuredShape& rest) {
  if (rest.structure.symmetries.empty()) return;
  std::vector<std::int32_t> all(static_cast<std::size_t>(rest.shape.triangle_count()));
  std::iota(all.begin(), all.end(), 0);
  marks_ = marks_on(rest.shape, all, marks_of_whole);
  if (marks_.size() == 0) return;
  for (const std::vector<std::int32_t>& part : triangles_of_parts(rest.shape))
    marks_.append(outermost_vertices(rest.shape, part));
  const Counterparts counterparts(rest.shape);
  const Points places = marks_.on(rest.shape);
  const double reach = tolerance::quality::touching * diagonal_;
  for (const Symmetry& symmetry : rest.structure.symmetries) {
    if (may_be_lost(symmetry, rest.structure)) continue;
    SymmetricMarks entry{isometry_of(symmetry), {}, {}, {}};
    const std::vector<SurfacePoint> images = counterparts.images(marks_, entry.map * places.transpose());
    for (std::size_t k = 0; k < images.size(); ++k) {
      if (images[k].distance > reach) continue;
      entry.marks.push_back(static_cast<Eigen::Index>(k));
      entry.images.append(rest.shape, images[k].triangle, images[k].point);
      entry.distances.push_back(images[k].distance);
    }
    symmetric_.push_back(std::move(entry));
  }
}

QualityValue WholeForm::symmetry(const Shape& now) const {
  QualityValue worst{QualityMeasure::symmetry};
  const Points places = marks_.on(now);
  for (const SymmetricMarks& entry : symmetric_) {
    const Points images = entry.images.on(now);
    for (std::size_t k = 0; k < entry.marks.size(); ++k) {
      const Eigen::Vector3d image = entry.map * places.row(entry.marks[k]).transpose();
      const Eigen::Vector3d place = images.row(static_cast<Eigen::Index>(k));
      const auto beyond_rest = [&](double distance) { return (distance - entry.distances[k]) / diagonal_; };
      const double direct = (image - place).norm();
      if (beyond_rest(direct) <= worst.value) continue;
      // The triangles on both sides need not be symmetric, so the image may lie beside its own triangle.
      const double off = beyond_rest(std::min(direct, walk_.distance(now, image, entry.images.triangles[k])));
      if (off <= worst.value) continue;
      worst.value = off;
      worst.part = now.triangle_part[at(marks_.triangles[static_cast<std::size_t>(entry.marks[k])])];
    }
  }
  return worst;
}

double WholeForm::tilt_of(const FlatFace& face, const Shape& shape) const {
  return angle_between_lines(face.area_vector(shape), up_);
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

void WholeForm::find_seats(const StructuredShape& rest, const PartForms& parts) {
  const Shape& shape = rest.shape;
  const Eigen::Vector3d u = up_.unitOrthogonal(), v = up_.cross(u);
  const double footprint = range_along(shape, u).length() * range_along(shape, v).length();
  const double ground = range_along(shape, up_).low;
  for (int part = 0; part < static_cast<int>(shape.part_count()); ++part) {
    if (is_bar(rest.structure.parts[at(part)].primitive)) continue;
    for (const FlatFace& face : parts.faces(part)) {
      const Eigen::Vector3d area = face.area_vector(shape);
      Seat seat{part, face, std::abs(area.dot(up_)), height_of(face, shape, ground), tilt_of(face, shape)};
      const bool faces_up = detail::area_vector(shape, face.triangles.front()).dot(up_) > 0;
      if (!faces_up || std::cos(seat.tilt) < level ||
          seat.area < tolerance::quality::seat_share * footprint ||
          !(seat.height > tolerance::quality::seat_height * height_))
        continue;
      seats_.push_back(std::move(seat));
    }
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
