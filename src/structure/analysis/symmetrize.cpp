#include "structure/analysis/symmetrize.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "core/transformed_points.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/analysis/consistent_symmetries.h"
#include "structure/model/correspondence.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

void set_control_points(Primitive& primitive, const Points& points) {
  if (auto* cuboid = std::get_if<Cuboid>(&primitive))
    cuboid->corners = points;
  else
    std::get<GeneralizedCylinder>(primitive).centres = points;
}

const Eigen::VectorXd* radii_of(const Primitive& primitive) {
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  return cylinder ? &cylinder->radii : nullptr;
}

/// Returns the image of a primitive. The corners of a mirrored cuboid are renamed, so that a right-handed box
/// stays right-handed.
Primitive image_of(const Primitive& primitive, const Eigen::Isometry3d& map) {
  Primitive image = primitive;
  Points points = transformed(control_points(primitive), map);
  if (std::holds_alternative<Cuboid>(primitive) && map.linear().determinant() < 0)
    for (Eigen::Index k = 0; k < 8; k += 2) points.row(k).swap(points.row(k + 1));
  set_control_points(image, points);
  return image;
}

/// Mean of primitives of one kind and size, each mapped by its correspondence to the first one.
class Mean {
 public:
  explicit Mean(const Primitive& first)
      : first_(first),
        points_(Points::Zero(control_points(first).rows(), 3)),
        radii_(Eigen::VectorXd::Zero(points_.rows())) {}

  /// Adds the image of `primitive` under `map`.
  void add(const Primitive& primitive, const Eigen::Isometry3d& map) {
    const std::vector<int> to = control_correspondence(primitive, first_, map);
    const Points image = transformed(control_points(primitive), map);
    for (std::size_t k = 0; k < to.size(); ++k) {
      points_.row(to[k]) += image.row(static_cast<Eigen::Index>(k));
      if (const Eigen::VectorXd* radii = radii_of(primitive))
        radii_(to[k]) += (*radii)(static_cast<Eigen::Index>(k));
    }
    ++count_;
  }

  Primitive mean() const {
    Primitive result = first_;
    set_control_points(result, points_ / count_);
    if (auto* cylinder = std::get_if<GeneralizedCylinder>(&result)) cylinder->radii = radii_ / count_;
    return result;
  }

 private:
  const Primitive& first_;
  Points points_;
  Eigen::VectorXd radii_;
  int count_ = 0;
};

double miss(const Primitive& from, const Primitive& target, const Eigen::Isometry3d& map) {
  const std::vector<int> to = control_correspondence(from, target, map);
  if (to.empty()) return std::numeric_limits<double>::infinity();
  const Points image = transformed(control_points(from), map), points = control_points(target);
  double most = 0;
  for (std::size_t k = 0; k < to.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    most = std::max(most, (image.row(row) - points.row(to[k])).norm());
    if (const Eigen::VectorXd* radii = radii_of(from))
      most = std::max(most, std::abs((*radii)(row) - (*radii_of(target))(to[k])));
  }
  return most;
}

/// Rotates `axes` by the smallest rotation that makes one of them `direction`. The axes in `fixed` stay.
void align_axis(Eigen::Matrix3d& axes, std::vector<int>& fixed, const Eigen::Vector3d& direction) {
  int nearest = -1;
  for (int a = 0; a < 3; ++a)
    if (std::count(fixed.begin(), fixed.end(), a) == 0 &&
        (nearest < 0 || std::abs(axes.col(a).dot(direction)) > std::abs(axes.col(nearest).dot(direction))))
      nearest = a;
  for (const int a : fixed)
    if (std::abs(axes.col(a).dot(direction)) > tolerance::relative) return;
  if (nearest < 0) return;
  const Eigen::Vector3d wanted = std::copysign(1.0, axes.col(nearest).dot(direction)) * direction;
  axes = (Eigen::Quaterniond::FromTwoVectors(axes.col(nearest), wanted).toRotationMatrix() * axes).eval();
  axes.col(nearest) = wanted;
  fixed.push_back(nearest);
}

/// Returns a box with the same extents, rotated into the mirror planes of `group`. A square box fits a round
/// plate at any angle.
Cuboid aligned(const Cuboid& cuboid, const std::vector<Eigen::Isometry3d>& group) {
  OrientedBox box = nearest_box(cuboid);
  std::vector<int> fixed;
  for (const Eigen::Isometry3d& map : group) {
    // A reflection maps the normal of its plane to the opposite direction, and leaves all orthogonal
    // directions unchanged.
    const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - map.linear()) / 2;
    if (std::abs(across.trace() - 1) > tolerance::relative || map.linear().determinant() > 0) continue;
    Eigen::Index column = 0;
    across.diagonal().maxCoeff(&column);
    align_axis(box.axes, fixed, across.col(column).normalized());
  }
  return cuboid_of(box);
}

class Symmetrizer {
 public:
  explicit Symmetrizer(Structure& structure) : structure_(structure) {}

  std::optional<Contradiction> run() {
    make_consistent(structure_);
    OrbitsOrContradiction found = find_orbits(structure_);
    if (found.contradiction) return found.contradiction;
    for (const Orbit& orbit : found.orbits) symmetrize(orbit);
    return check(found.orbits);
  }

  void symmetrize(const Orbit& orbit);

 private:
  Part& part(int row) { return structure_.parts[static_cast<std::size_t>(row)]; }

  /// Returns the mean over the group. A box that is not aligned with the planes is first rotated into them.
  Primitive made_symmetric(const Primitive& primitive, const Orbit& orbit, bool boxes) const {
    const auto average = [&](const Primitive& one) {
      Mean mean(one);
      for (const Eigen::Isometry3d& map : orbit.group) mean.add(one, map);
      Primitive result = mean.mean();
      if (boxes) result = cuboid_of(nearest_box(std::get<Cuboid>(result)));
      return result;
    };
    const Primitive mean = average(primitive);
    if (!boxes) return average(mean);
    // Averaging shrinks a rotated box slightly. A rotation keeps its size, but may move its corners farther.
    const Primitive turned = average(aligned(std::get<Cuboid>(primitive), orbit.group));
    const bool turn =
        worst_miss(mean, orbit) > limit() || distance(turned, primitive) <= 1.5 * distance(mean, primitive);
    return average(turn ? turned : mean);
  }

  /// Returns the largest displacement of a control point.
  static double distance(const Primitive& a, const Primitive& b) {
    return (control_points(a) - control_points(b)).rowwise().norm().maxCoeff();
  }

  static double worst_miss(const Primitive& primitive, const Orbit& orbit) {
    double worst = 0;
    for (const Eigen::Isometry3d& map : orbit.group) worst = std::max(worst, miss(primitive, primitive, map));
    return worst;
  }

  double error(int row, std::size_t kind) const {
    const PrimitiveFit& fit = structure_.parts[static_cast<std::size_t>(row)].fit;
    return kind == 0 ? fit.cuboid_error
                     : fit.cylinder_error.value_or(std::numeric_limits<double>::infinity());
  }

  /// Gives the parts of an orbit primitives of the same kind and number of sections. The kind is the one with
  /// the smaller sum of errors. The best primitive of this kind is copied to the other parts.
  void unify_kinds(const Orbit& orbit) {
    std::vector<std::size_t> best_of_kind;
    std::size_t winner = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t kind : {std::size_t{0}, std::size_t{1}}) {
      if (std::none_of(orbit.parts.begin(), orbit.parts.end(),
                       [&](int row) { return part(row).primitive.index() == kind; }))
        continue;
      double sum = 0;
      for (const int row : orbit.parts) sum += error(row, kind);
      if (sum < least || best_of_kind.empty()) least = sum, winner = kind;
      best_of_kind.push_back(kind);
    }
    std::size_t best = orbit.parts.size();
    for (std::size_t k = 0; k < orbit.parts.size(); ++k)
      if (part(orbit.parts[k]).primitive.index() == winner &&
          (best == orbit.parts.size() || error(orbit.parts[k], winner) < error(orbit.parts[best], winner)))
        best = k;
    const Primitive model = part(orbit.parts[best]).primitive;
    for (std::size_t k = 0; k < orbit.parts.size(); ++k) {
      const Eigen::Isometry3d map = orbit.from_first[k] * orbit.from_first[best].inverse();
      Primitive& primitive = part(orbit.parts[k]).primitive;
      if (control_correspondence(model, primitive, map).empty()) primitive = image_of(model, map);
    }
  }

  /// Returns the bound of rounding errors, model units.
  double limit() const {
    double largest = structure_.diagonal;
    for (const Part& one : structure_.parts)
      largest = std::max(largest, control_points(one.primitive).cwiseAbs().maxCoeff());
    return tolerance::symmetrized * largest;
  }

  /// Returns the first violated relation, and the first violated relation of every other orbit.
  std::optional<Contradiction> check(const std::vector<Orbit>& orbits) const {
    std::vector<int> orbit_of(structure_.parts.size(), -1);
    for (std::size_t k = 0; k < orbits.size(); ++k)
      for (const int part : orbits[k].parts) orbit_of[static_cast<std::size_t>(part)] = static_cast<int>(k);
    std::set<int> contradicting;
    std::optional<Contradiction> first;
    const double most = limit();
    for (std::size_t r = 0; r < structure_.relations.size(); ++r) {
      const Relation& relation = structure_.relations[r];
      if (relation.type != RelationType::symmetry && relation.type != RelationType::self_symmetry) continue;
      const int orbit = orbit_of[static_cast<std::size_t>(relation.parts.front())];
      if (contradicting.contains(orbit)) continue;
      const int row = static_cast<int>(r);
      const std::string reason = broken(relation, row, most);
      if (reason.empty()) continue;
      contradicting.insert(orbit);
      if (!first) first = Contradiction{{row}, reason};
      first->dispensable.push_back(row);
    }
    return first;
  }

  /// Returns why a symmetry relation is violated; empty when it holds.
  std::string broken(const Relation& relation, int row, double most) const {
    if (symmetry_residual(structure_, relation) > most)
      return describe(structure_, row) +
             " cannot hold exactly between primitives of this kind, together with the other symmetries of "
             "these parts";
    for (const int one : relation.parts) try {
        validate(structure_.parts[static_cast<std::size_t>(one)].primitive, "");
      } catch (const InputError&) {
        return describe(structure_, row) + " leaves nothing of the primitive";
      }
    return {};
  }

  Structure& structure_;
};

void Symmetrizer::symmetrize(const Orbit& orbit) {
  unify_kinds(orbit);
  const bool boxes = std::all_of(orbit.parts.begin(), orbit.parts.end(), [&](int row) {
    const auto* cuboid = std::get_if<Cuboid>(&part(row).primitive);
    return cuboid && is_box(*cuboid);
  });
  const Primitive first = part(orbit.parts[0]).primitive;
  Mean mean(first);
  for (std::size_t k = 0; k < orbit.parts.size(); ++k)
    mean.add(part(orbit.parts[k]).primitive, orbit.from_first[k].inverse());
  const Primitive ideal = made_symmetric(mean.mean(), orbit, boxes);

  for (std::size_t k = 0; k < orbit.parts.size(); ++k) {
    Primitive& old = part(orbit.parts[k]).primitive;
    const std::vector<int> to = control_correspondence(ideal, old, orbit.from_first[k]);
    const Points image = transformed(control_points(ideal), orbit.from_first[k]);
    Points points = image;
    for (std::size_t i = 0; i < to.size(); ++i) {
      points.row(to[i]) = image.row(static_cast<Eigen::Index>(i));
      if (auto* cylinder = std::get_if<GeneralizedCylinder>(&old))
        cylinder->radii(to[i]) = (*radii_of(ideal))(static_cast<Eigen::Index>(i));
    }
    set_control_points(old, points);
  }
}

}  // namespace

std::optional<Contradiction> try_symmetrize(Structure& structure) {
  return Symmetrizer(structure).run();
}

void make_symmetric(Structure& structure, const Orbit& orbit) {
  Symmetrizer(structure).symmetrize(orbit);
}

double symmetry_residual(const Structure& structure, const Relation& relation) {
  return miss(structure.parts[static_cast<std::size_t>(relation.parts.front())].primitive,
              structure.parts[static_cast<std::size_t>(relation.parts.back())].primitive,
              isometry_of(relation.symmetry));
}

}  // namespace stackabilization::detail

namespace stackabilization {

void symmetrize(Structure& structure) {
  Structure ideal = structure;
  if (const auto contradiction = detail::try_symmetrize(ideal)) throw InputError(contradiction->reason);
  structure = std::move(ideal);
}

}  // namespace stackabilization
