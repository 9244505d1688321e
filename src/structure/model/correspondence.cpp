#include "structure/model/correspondence.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/transformed_points.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using Assignment = std::vector<int>;

/// The relabellings of a box: axis a goes to axis `order[a]`, turned around where bit a of `flips` is set.
/// The one that changes nothing comes first.
std::vector<Assignment> box_assignments() {
  std::vector<Assignment> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int flips = 0; flips < 8; ++flips) {
      Assignment corners(8, 0);
      for (int k = 0; k < 8; ++k)
        for (int a = 0; a < 3; ++a)
          corners[static_cast<std::size_t>(k)] |= ((k ^ flips) >> a & 1)
                                                  << order[static_cast<std::size_t>(a)];
      all.push_back(corners);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

/// Both ways along an open curve; every start and both ways around a closed one.
std::vector<Assignment> curve_assignments(int count, bool closed) {
  std::vector<Assignment> all;
  for (int start = 0; start < (closed ? count : 1); ++start)
    for (const int step : {1, -1}) {
      const int first = closed || step == 1 ? start : count - 1;
      Assignment sections(static_cast<std::size_t>(count));
      for (int k = 0; k < count; ++k)
        sections[static_cast<std::size_t>(k)] = (first + step * k + count) % count;
      all.push_back(sections);
    }
  return all;
}

double sum_of_squares(const Points& image, const Points& target, const Assignment& assignment, double most) {
  double sum = 0;
  for (Eigen::Index k = 0; k < image.rows() && sum < most; ++k)
    sum += (image.row(k) - target.row(assignment[static_cast<std::size_t>(k)])).squaredNorm();
  return sum;
}

}  // namespace

std::vector<int> control_correspondence(const Primitive& a, const Primitive& b,
                                        const Eigen::Isometry3d& map) {
  const Points from = control_points(a), target = control_points(b);
  if (a.index() != b.index() || from.rows() != target.rows()) return {};
  std::vector<Assignment> candidates;
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&a)) {
    if (cylinder->closed != std::get<GeneralizedCylinder>(b).closed) return {};
    candidates = curve_assignments(static_cast<int>(from.rows()), cylinder->closed);
  } else {
    candidates = box_assignments();
  }

  const Points image = detail::transformed(from, map);
  const Eigen::RowVector3d middle = target.colwise().mean();
  // Assignments that differ by rounding only are equally good (flat boxes, cubes): the first of them counts.
  const double rounding = tolerance::relative * (target.rowwise() - middle).squaredNorm();
  Assignment best;
  double least = std::numeric_limits<double>::infinity();
  for (Assignment& candidate : candidates) {
    const double sum = sum_of_squares(image, target, candidate, least);
    if (sum < least - rounding || best.empty()) {
      least = sum;
      best = std::move(candidate);
    }
  }
  return best;
}

std::vector<int> inverse_order(const std::vector<int>& order) {
  std::vector<int> back(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    back[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  return back;
}

std::vector<int> composed_order(const std::vector<int>& first, const std::vector<int>& second) {
  std::vector<int> both;
  for (const int i : first) both.push_back(second[static_cast<std::size_t>(i)]);
  return both;
}

}  // namespace stackabilization
