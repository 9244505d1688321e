#include "stacking/direction/candidates.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/angles.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

constexpr std::size_t hull_normals = 16;     ///< at most so many
constexpr std::size_t surface_normals = 12;  ///< at most so many
constexpr std::size_t crossed = 8;           ///< of each kind are paired for directions along two faces

using Lines = std::vector<Eigen::Vector3d>;

bool same_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return detail::on_one_line(a, b, tolerance::relative);
}

/// Appends unit vectors, up to `limit`, whose lines are neither in `known` nor in `lines`.
void append(const Lines& from, std::size_t limit, const Lines& known, Lines& lines) {
  for (const Eigen::Vector3d& vector : from) {
    if (limit == 0) return;
    if (vector.isZero(0)) continue;
    const Eigen::Vector3d unit = vector.normalized();
    const auto repeats = [&](const Eigen::Vector3d& line) { return same_line(line, unit); };
    if (std::any_of(known.begin(), known.end(), repeats) || std::any_of(lines.begin(), lines.end(), repeats))
      continue;
    lines.push_back(unit);
    --limit;
  }
}

Lines columns(const Eigen::Matrix3d& axes) {
  return {axes.col(0), axes.col(1), axes.col(2)};
}

/// Eigenvectors of the covariance of the surface, each triangle by its area.
Lines principal_axes(const Shape& shape) {
  const detail::SurfaceMoments moments(shape, shape.corner(0, 0));
  if (!(moments.area() > 0)) return {};
  return columns(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.covariance()).eigenvectors());
}

Lines rows(const Points& vectors) {
  Lines lines(vectors.rows());
  for (Eigen::Index i = 0; i < vectors.rows(); ++i) lines[i] = vectors.row(i).transpose();
  return lines;
}

/// Cells on the surface of a cube around the origin, an odd number across so that the axes are at cell
/// centres.
class NormalCells {
 public:
  NormalCells() : sums_(3 * across * across, Eigen::Vector3d::Zero()) {}

  /// Adds a normal; opposite normals count as one.
  void add(const Eigen::Vector3d& vector) {
    int axis = 0;
    const double largest = vector.cwiseAbs().maxCoeff(&axis);
    if (largest == 0) return;
    const Eigen::Vector3d outward = vector[axis] < 0 ? Eigen::Vector3d(-vector) : vector;
    const auto cell = [&](double x) {
      return std::min(across - 1, static_cast<int>((x / largest + 1) / 2 * across));
    };
    sums_[(axis * across + cell(outward[(axis + 1) % 3])) * across + cell(outward[(axis + 2) % 3])] +=
        outward;
  }
  /// Returns the sums of the cells, largest first.
  Lines fullest(std::size_t count) const {
    Lines sorted;
    for (const Eigen::Vector3d& sum : sums_)
      if (!sum.isZero(0)) sorted.push_back(sum);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.squaredNorm() > b.squaredNorm(); });
    sorted.resize(std::min(count, sorted.size()));
    return sorted;
  }

 private:
  static constexpr int across = 61;  ///< cells of about one and a half degrees
  Lines sums_;
};

Lines normals_of_surface(const Shape& shape) {
  NormalCells cells;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) cells.add(detail::area_vector(shape, t));
  return cells.fullest(2 * surface_normals);
}

Lines first(const Lines& lines, std::size_t count) {
  return {lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min(count, lines.size()))};
}

}  // namespace

CandidateDirections candidate_directions(const StackabilitySolver& solver) {
  CandidateDirections result;
  append(columns(Eigen::Matrix3d::Identity()), 3, {}, result.main);
  const OrientedBox box =
      solver.options().boxes == BoxModel::oriented ? solver.box() : minimal_oriented_box(solver.hull());
  append(columns(box.axes), 3, {}, result.main);
  append(principal_axes(solver.shape()), 3, {}, result.main);

  const Lines of_hull = rows(solver.hull().face_normals()), of_surface = normals_of_surface(solver.shape());
  append(of_hull, hull_normals, result.main, result.others);
  append(of_surface, surface_normals, result.main, result.others);
  Lines important, along;
  append(first(of_hull, crossed), crossed, {}, important);
  append(first(of_surface, crossed), crossed, {}, important);
  for (std::size_t i = 0; i < important.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!same_line(important[i], important[j])) along.push_back(important[i].cross(important[j]));
  append(along, along.size(), result.main, result.others);
  return result;
}

}  // namespace stackabilization
