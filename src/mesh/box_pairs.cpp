#include "stackabilization/mesh/box_pairs.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace stackabilization {

namespace {

/// Ends a search through pairs.
struct TooManyPairs {};

}  // namespace

std::optional<BoxPairs> near_boxes(const std::vector<Eigen::AlignedBox3d>& boxes, double reach,
                                   std::size_t max_pairs) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<Box> grown;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (boxes[k].isEmpty()) continue;
    const Eigen::Vector3d low = boxes[k].min() - Eigen::Vector3d::Constant(reach), high = boxes[k].max();
    grown.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                       static_cast<int>(k));
  }
  BoxPairs pairs;
  try {
    CGAL::box_self_intersection_d(grown.begin(), grown.end(), [&](const Box& a, const Box& b) {
      if (pairs.size() == max_pairs) throw TooManyPairs{};
      pairs.push_back(std::minmax(a.info(), b.info()));
    });
  } catch (const TooManyPairs&) {
    return std::nullopt;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace stackabilization
