#include "structure/symmetry/symmetry_voting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace stackabilization::detail {

namespace {

constexpr int distance_bins = 16;
constexpr Eigen::Index voter_stride = 5;         // every fifth sample votes, with all others
constexpr double max_difference = 0.03;          // share of the area within any of the distances
constexpr double max_radius_difference = 0.05;   // difference of the distances from the centroid, own frame
constexpr double min_turn = 0.4;                 // radians
constexpr double min_pair_distance = 0.1;        // pairs nearer than this say little, own frame
constexpr double facing = 0.9;                   // cosine from which on normals count as agreeing
constexpr double weight_of_disagreeing = 0.2;    // noise spoils normals, so they do not veto
constexpr double cell = 0.12, bandwidth = 0.12;  // of unit normals and of offsets, own frame
constexpr std::size_t max_seeds = 60, max_peaks = 24;

/// Per sample the share of the surface within growing distances: a shape distribution (Osada et al. 2002)
/// seen from it.
using Signatures = Eigen::Matrix<float, Eigen::Dynamic, distance_bins, Eigen::RowMajor>;

Signatures signatures_of(const Points& points) {
  Signatures counts = Signatures::Zero(points.rows(), distance_bins);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = 0; j < points.rows(); ++j) {
      // Shared between two neighbouring bins, so that samples on a border do not jump.
      const double place =
          std::min((points.row(i) - points.row(j)).norm() * distance_bins, distance_bins - 1.0);
      const auto bin = static_cast<Eigen::Index>(place);
      const auto upper = static_cast<float>(place - static_cast<double>(bin));
      counts(i, bin) += 1 - upper;
      if (bin + 1 < distance_bins) counts(i, bin + 1) += upper;
    }
  for (int bin = 1; bin < distance_bins; ++bin) counts.col(bin) += counts.col(bin - 1);
  return counts / static_cast<float>(points.rows());
}

/// A point of the space of planes or axes: the unit normal, or axis, and the offset from the centroid. (n, d)
/// and (-n, -d) are the same plane.
struct Vote {
  Eigen::Vector4d place;
  double weight;
};

std::array<int, 4> cell_of(const Eigen::Vector4d& place) {
  std::array<int, 4> key;
  for (int k = 0; k < 4; ++k)
    key[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(place(k) / cell));
  return key;
}

struct Peak {
  Eigen::Vector4d place;
  double weight;
};

/// Fullest cells first, at the mean of their votes.
std::vector<Peak> fullest_cells(const std::vector<Vote>& votes) {
  std::map<std::array<int, 4>, Peak> cells;
  for (const Vote& vote : votes)
    for (const double sign : {1.0, -1.0}) {
      Peak& peak =
          cells.try_emplace(cell_of(sign * vote.place), Peak{Eigen::Vector4d::Zero(), 0}).first->second;
      peak.place += sign * vote.weight * vote.place;
      peak.weight += vote.weight;
    }
  std::vector<Peak> peaks;
  for (const auto& [key, peak] : cells) peaks.push_back({peak.place / peak.weight, peak.weight});
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.weight > b.weight; });
  if (peaks.size() > max_seeds) peaks.resize(max_seeds);
  return peaks;
}

/// Mean shift: moves to the mean of the surrounding votes, a few times.
Peak climbed(Peak peak, const std::vector<Vote>& votes) {
  for (int round = 0; round < 3; ++round) {
    Peak mean{Eigen::Vector4d::Zero(), 0};
    for (const Vote& vote : votes) {
      const double sign = vote.place.head<3>().dot(peak.place.head<3>()) < 0 ? -1 : 1;
      if ((sign * vote.place - peak.place).squaredNorm() > bandwidth * bandwidth) continue;
      mean.place += sign * vote.weight * vote.place;
      mean.weight += vote.weight;
    }
    if (!(mean.weight > 0)) break;
    peak = {mean.place / mean.weight, mean.weight};
    peak.place.head<3>().normalize();
  }
  return peak;
}

std::vector<Peak> peaks_of(const std::vector<Vote>& votes) {
  std::vector<Peak> peaks;
  for (const Peak& seed : fullest_cells(votes)) {
    const Peak peak = climbed(seed, votes);
    const bool known = std::any_of(peaks.begin(), peaks.end(), [&](const Peak& other) {
      const double sign = other.place.head<3>().dot(peak.place.head<3>()) < 0 ? -1 : 1;
      return (sign * other.place - peak.place).norm() < bandwidth / 2;
    });
    if (!known) peaks.push_back(peak);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.weight > b.weight; });
  if (peaks.size() > max_peaks) peaks.resize(max_peaks);
  return peaks;
}

/// Calls `visit(i, j)` for all pairs of dense samples that a symmetry may map onto each other.
template <typename Visit>
void for_each_pair(const Points& points, const Visit& visit) {
  const Signatures signatures = signatures_of(points);
  const Eigen::VectorXd radii = points.rowwise().norm();
  for (Eigen::Index i = 0; i < points.rows(); i += voter_stride)
    for (Eigen::Index j = 0; j < points.rows(); ++j)
      if (i != j && std::abs(radii(i) - radii(j)) <= max_radius_difference &&
          (signatures.row(i) - signatures.row(j)).cwiseAbs().maxCoeff() <= max_difference)
        visit(i, j);
}

/// Columns: towards the point, the normal across that, and their cross product; nothing where they hardly
/// differ.
std::optional<Eigen::Matrix3d> frame_of(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  if (point.norm() < min_pair_distance) return {};
  Eigen::Matrix3d frame;
  frame.col(0) = point.normalized();
  const Eigen::Vector3d across = normal - frame.col(0) * frame.col(0).dot(normal);
  if (across.norm() < 1 - facing) return {};
  frame.col(1) = across.normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

}  // namespace

std::vector<Symmetry> voted_reflections(const SymmetrySurface& surface, const SymmetryOptions& options) {
  const SurfaceSamples& samples = surface.dense;
  const double reach = cell / 2 + (1 - options.support) / 2;
  std::vector<Vote> votes;
  for_each_pair(samples.points, [&](Eigen::Index i, Eigen::Index j) {
    const Eigen::Vector3d a = samples.points.row(i), b = samples.points.row(j);
    if ((b - a).norm() < min_pair_distance) return;
    const Symmetry plane = bisector(a, b);
    const double offset = plane.axis.dot(plane.point);
    if (std::abs(offset) > reach) return;
    const Eigen::Vector3d image = isometry_of(plane).linear() * samples.normals.row(i).transpose();
    const bool agree = std::abs(image.dot(samples.normals.row(j))) >= facing;
    votes.push_back(
        {{plane.axis.x(), plane.axis.y(), plane.axis.z(), offset}, agree ? 1 : weight_of_disagreeing});
  });
  std::vector<Symmetry> planes;
  for (const Peak& peak : peaks_of(votes)) {
    const Eigen::Vector3d normal = peak.place.head<3>();
    planes.push_back({SymmetryKind::reflection, peak.place(3) * normal, normal, 2});
  }
  return planes;
}

std::vector<Symmetry> voted_axes(const SymmetrySurface& surface) {
  const SurfaceSamples& samples = surface.dense;
  std::vector<Vote> votes;
  for_each_pair(samples.points, [&](Eigen::Index i, Eigen::Index j) {
    const auto from = frame_of(samples.points.row(i), samples.normals.row(i));
    const auto to = frame_of(samples.points.row(j), samples.normals.row(j));
    if (!from || !to) return;
    if (std::abs((*from).col(0).dot(samples.normals.row(i)) - (*to).col(0).dot(samples.normals.row(j))) >
        1 - facing)
      return;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(*to * from->transpose()));
    if (turn.angle() < min_turn) return;
    votes.push_back({{turn.axis().x(), turn.axis().y(), turn.axis().z(), 0}, 1});
  });
  std::vector<Symmetry> axes;
  for (const Peak& peak : peaks_of(votes))
    axes.push_back({SymmetryKind::rotation, Eigen::Vector3d::Zero(), peak.place.head<3>(), 2});
  return axes;
}

}  // namespace stackabilization::detail
