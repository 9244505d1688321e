#include "stacking/draft/wall_sections.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

PlaneSection plane_section(const Eigen::Vector3d& along, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double s = along.dot(a), t = along.dot(b);
  return s < t ? PlaneSection{s, t, a.z(), b.z()} : PlaneSection{t, s, b.z(), a.z()};
}

namespace {

/// Returns where the envelope of sections over [from, to], each of which covers it, has its corners: the
/// upper one for `sign` 1, the lower one for -1.
std::vector<double> envelope_corners(const std::vector<PlaneSection>& sections, double from, double to,
                                     double sign) {
  std::vector<double> corners{from};
  const auto rise = [&](const PlaneSection& one) {
    return sign * (one.height_to - one.height_from) / (one.to - one.from);
  };
  double s = from;
  const PlaneSection* top = nullptr;
  for (const PlaneSection& one : sections)
    if (!top || std::pair(sign * one.at(s), rise(one)) > std::pair(sign * top->at(s), rise(*top))) top = &one;
  while (top) {
    const PlaneSection* next = nullptr;
    double where = to;
    for (const PlaneSection& one : sections) {
      if (!(rise(one) > rise(*top))) continue;
      const double crossing = s + sign * (top->at(s) - one.at(s)) / (rise(one) - rise(*top));
      if (crossing < where || (next && crossing == where && rise(one) > rise(*next))) {
        where = std::max(s, crossing);
        next = &one;
      }
    }
    if (next) corners.push_back(s = where);
    top = next;
  }
  corners.push_back(to);
  return corners;
}

}  // namespace

std::vector<Trapezoid> area_between(std::vector<PlaneSection> sections) {
  std::erase_if(sections, [](const PlaneSection& one) { return !(one.from < one.to); });
  std::sort(sections.begin(), sections.end(), [](const PlaneSection& a, const PlaneSection& b) {
    return std::tie(a.from, a.to, a.height_from, a.height_to) <
           std::tie(b.from, b.to, b.height_from, b.height_to);
  });
  std::vector<double> ends;
  for (const PlaneSection& one : sections) ends.insert(ends.end(), {one.from, one.to});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Trapezoid> found;
  std::vector<PlaneSection> open;
  std::size_t next = 0;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double from = ends[k - 1], to = ends[k];
    std::erase_if(open, [from](const PlaneSection& one) { return one.to <= from; });
    for (; next < sections.size() && sections[next].from <= from; ++next) open.push_back(sections[next]);
    if (open.size() < 2) continue;
    std::vector<double> corners = envelope_corners(open, from, to, 1);
    const std::vector<double> lower = envelope_corners(open, from, to, -1);
    corners.insert(corners.end(), lower.begin(), lower.end());
    std::sort(corners.begin(), corners.end());
    const auto range = [&open](double s) {
      Range heights{open.front().at(s), open.front().at(s)};
      for (const PlaneSection& one : open)
        heights = {std::min(heights.low, one.at(s)), std::max(heights.high, one.at(s))};
      return heights;
    };
    for (std::size_t c = 1; c < corners.size(); ++c)
      if (corners[c - 1] < corners[c]) {
        const Range left = range(corners[c - 1]), right = range(corners[c]);
        found.push_back({corners[c - 1], corners[c], left.low, right.low, left.high, right.high});
      }
  }
  return found;
}

}  // namespace stackabilization::detail
