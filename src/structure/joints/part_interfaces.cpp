#include "structure/joints/part_interfaces.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/segment_triangle.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// Largest additional distance, beyond the smallest one, of the points that define the position of a joint;
/// fraction of the reach.
constexpr double place_share = 0.25;

/// An edge of one surface that comes within reach of a triangle of the other.
struct Meeting {
  int side;  ///< whose edge it is
  int edge, triangle;
  Approach approach;

  auto order() const { return std::tie(side, edge, triangle); }
};

class InterfaceFinder {
 public:
  InterfaceFinder(const PartSurface& a, const PartSurface& b, const InterfaceOptions& options)
      : surfaces_{&a, &b},
        options_(options),
        resolution_(tolerance::relative * std::max(a.size(), b.size())) {}

  std::vector<PartInterface> run() {
    for (int side = 0; side < 2; ++side) find_meetings(side);
    std::sort(meetings_.begin(), meetings_.end(),
              [](const Meeting& a, const Meeting& b) { return a.order() < b.order(); });
    first_vertex_[0] = meetings_.size();
    first_vertex_[1] = first_vertex_[0] + surfaces_[0]->points().size();
    sets_ = DisjointSets(first_vertex_[1] + surfaces_[1]->points().size());
    join_pieces();
    for (int side = 0; side < 2; ++side) {
      inside_[side].assign(surfaces_[side]->points().size(), false);
      join_inside(side);
      spread_inside(side);
    }
    return spots();
  }

 private:
  const PartSurface& mine(int side) const { return *surfaces_[side]; }
  const PartSurface& other(int side) const { return *surfaces_[1 - side]; }
  const Eigen::Vector3d& point(int side, int vertex) const {
    return surfaces_[side]->points()[static_cast<std::size_t>(vertex)];
  }
  const PartSurface::Edge& edge(int side, int row) const {
    return surfaces_[side]->edges()[static_cast<std::size_t>(row)];
  }
  std::size_t vertex_set(int side, int vertex) const {
    return first_vertex_[side] + static_cast<std::size_t>(vertex);
  }

  Segment segment(int side, int row) const {
    const auto& [u, v] = edge(side, row).vertices;
    return {point(side, u), point(side, v)};
  }
  Corners corners(int side, int row) const {
    const std::array<int, 3>& t = surfaces_[side]->triangles()[static_cast<std::size_t>(row)];
    return {point(side, t[0]), point(side, t[1]), point(side, t[2])};
  }

  template <std::size_t n>
  static void add_box(std::vector<Box>& boxes, const std::array<Eigen::Vector3d, n>& points, double margin,
                      int row, const PartSurface& near, double reach) {
    Eigen::Vector3d low = points[0], high = points[0];
    for (const Eigen::Vector3d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if ((low.array() - reach > near.highest().array()).any() ||
        (high.array() + reach < near.lowest().array()).any())
      return;
    low.array() -= margin;
    high.array() += margin;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), row);
  }

  void find_meetings(int side) {
    std::vector<Box> edges, triangles;
    for (std::size_t e = 0; e < mine(side).edges().size(); ++e)
      add_box(edges, segment(side, static_cast<int>(e)), options_.reach, static_cast<int>(e), other(side),
              options_.reach);
    for (std::size_t t = 0; t < other(side).triangles().size(); ++t)
      add_box(triangles, corners(1 - side, static_cast<int>(t)), 0, static_cast<int>(t), mine(side),
              options_.reach);
    nearest_.assign(mine(side).edges().size(), Meeting{side, -1, -1, {options_.reach, 0, 0}});
    CGAL::box_intersection_d(edges.begin(), edges.end(), triangles.begin(), triangles.end(),
                             [&](const Box& e, const Box& t) { meet(side, e.info(), t.info()); });
    for (const Meeting& one : nearest_)
      if (one.edge >= 0) meetings_.push_back(one);
  }

  /// Examines an edge and a triangle. For a short edge, its touching triangles and its nearest triangle
  /// suffice.
  void meet(int side, int row, int triangle) {
    const Segment ends = segment(side, row);
    const Corners corner = corners(1 - side, triangle);
    const Eigen::Vector3d middle = (ends[0] + ends[1]) / 2;
    const double length = (ends[1] - ends[0]).norm();
    const bool is_short = length <= options_.reach;
    Meeting& nearest = nearest_[static_cast<std::size_t>(row)];
    const double most = is_short ? std::max(nearest.approach.distance, resolution_) : options_.reach;
    if ((nearest_on_triangle(middle, corner) - middle).norm() > most + length / 2) return;
    const Meeting found{side, row, triangle, approach(ends, corner, resolution_)};
    const double distance = found.approach.distance;
    if (distance > most) return;
    if (!is_short || touches(found))
      meetings_.push_back(found);
    else if (nearest.edge < 0 ||
             std::tie(distance, triangle) < std::tie(nearest.approach.distance, nearest.triangle))
      nearest = found;
  }

  bool is_small(int side, int row) const {
    const Corners c = corners(side, row);
    return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()}) <= options_.reach;
  }

  /// Joins meetings. The portion of a triangle within reach of another triangle is convex. Neighbouring
  /// portions share a piece of an edge. Meetings therefore belong together when they concern the same two
  /// triangles, or the same small triangle.
  void join_pieces() {
    std::vector<std::pair<std::uint64_t, std::size_t>> pieces;
    constexpr auto any = static_cast<std::uint64_t>(std::numeric_limits<std::uint32_t>::max());
    const auto is_small_one = [&](int side) {
      std::vector<bool> small(surfaces_[side]->triangles().size());
      for (std::size_t t = 0; t < small.size(); ++t) small[t] = is_small(side, static_cast<int>(t));
      return small;
    };
    const std::array<std::vector<bool>, 2> small = {is_small_one(0), is_small_one(1)};
    for (std::size_t m = 0; m < meetings_.size(); ++m) {
      const Meeting& one = meetings_[m];
      for (const int t : edge(one.side, one.edge).triangles) {
        const std::array<int, 2> rows =
            one.side == 0 ? std::array{t, one.triangle} : std::array{one.triangle, t};
        const auto a = static_cast<std::uint64_t>(rows[0]), b = static_cast<std::uint64_t>(rows[1]);
        const bool small_a = small[0][a], small_b = small[1][b];
        if (small_a) pieces.emplace_back(a << 32 | any, m);
        if (small_b) pieces.emplace_back(any << 32 | b, m);
        if (!small_a && !small_b) pieces.emplace_back(a << 32 | b, m);
      }
    }
    std::sort(pieces.begin(), pieces.end());
    for (std::size_t k = 1; k < pieces.size(); ++k)
      if (pieces[k].first == pieces[k - 1].first) sets_.join(pieces[k].second, pieces[k - 1].second);
  }

  /// Meetings on one edge: rows [begin, end).
  struct EdgeRange {
    std::size_t begin, end;
  };
  std::map<int, EdgeRange> meetings_by_edge(int side) const {
    std::map<int, EdgeRange> ranges;
    for (std::size_t m = 0; m < meetings_.size(); ++m) {
      if (meetings_[m].side != side) continue;
      ranges.try_emplace(meetings_[m].edge, EdgeRange{m, m}).first->second.end = m + 1;
    }
    return ranges;
  }

  bool touches(const Meeting& meeting) const { return meeting.approach.distance <= resolution_; }

  /// Joins the meetings along every stretch of an edge, between crossings, that runs inside the other
  /// surface.
  void join_inside(int side) {
    for (const auto& [row, range] : meetings_by_edge(side)) {
      std::vector<double> places = {0, 1};
      for (std::size_t m = range.begin; m < range.end; ++m)
        if (touches(meetings_[m]))
          places.insert(places.end(), {meetings_[m].approach.low, meetings_[m].approach.high});
      if (places.size() == 2) continue;
      touched_[side].push_back(row);
      std::sort(places.begin(), places.end());
      const Segment ends = segment(side, row);
      const double smallest = resolution_ / (ends[1] - ends[0]).norm();
      for (std::size_t k = 1; k < places.size(); ++k) {
        const double low = places[k - 1], high = places[k];
        if (high - low <= smallest || lies_on_surface(range, low, high)) continue;
        const Eigen::Vector3d middle = ends[0] + (low + high) / 2 * (ends[1] - ends[0]);
        if (other(side).contains(middle)) join_stretch(side, row, range, {low, high});
      }
    }
  }

  bool lies_on_surface(const EdgeRange& range, double low, double high) const {
    for (std::size_t m = range.begin; m < range.end; ++m) {
      const Approach& one = meetings_[m].approach;
      if (touches(meetings_[m]) && one.low <= low && one.high >= high) return true;
    }
    return false;
  }

  void join_stretch(int side, int row, const EdgeRange& range, const std::array<double, 2>& stretch) {
    const auto& [u, v] = edge(side, row).vertices;
    std::vector<std::size_t> members;
    for (std::size_t m = range.begin; m < range.end; ++m)
      if (meetings_[m].approach.high >= stretch[0] && meetings_[m].approach.low <= stretch[1])
        members.push_back(m);
    for (const auto& [vertex, is_end] : {std::pair(u, stretch[0] <= 0), std::pair(v, stretch[1] >= 1)}) {
      if (!is_end) continue;
      inside_[side][static_cast<std::size_t>(vertex)] = true;
      members.push_back(vertex_set(side, vertex));
    }
    for (const std::size_t member : members) sets_.join(members[0], member);
  }

  /// Propagates from vertices known to be inside over edges that do not cross the other surface. A shell that
  /// does not touch the other surface is inside or outside as a whole. Where the other surface is open,
  /// "inside" is an estimate: points beyond its box are not inside.
  void spread_inside(int side) {
    const std::size_t count = mine(side).points().size();
    std::vector<bool> is_touched(mine(side).edges().size(), false);
    for (const int row : touched_[side]) is_touched[static_cast<std::size_t>(row)] = true;
    DisjointSets shells(count), whole(count);
    for (std::size_t e = 0; e < is_touched.size(); ++e) {
      const auto [u, v] = mine(side).edges()[e].vertices;
      whole.join(static_cast<std::size_t>(u), static_cast<std::size_t>(v));
      if (!is_touched[e]) shells.join(static_cast<std::size_t>(u), static_cast<std::size_t>(v));
    }
    std::vector<bool> root_inside(count, false), meets(count, false);
    for (const int row : touched_[side])
      meets[whole.root(static_cast<std::size_t>(edge(side, row).vertices[0]))] = true;
    for (const Meeting& one : meetings_)  // a crossing of the other's edges is a meeting as well
      if (one.side != side && touches(one))
        meets[whole.root(static_cast<std::size_t>(
            mine(side).triangles()[static_cast<std::size_t>(one.triangle)][0]))] = true;
    for (std::size_t v = 0; v < count; ++v) {
      if (inside_[side][v]) root_inside[shells.root(v)] = true;
      if (whole.root(v) == v && !meets[v] && other(side).is_closed() && in_box(side, v))
        root_inside[shells.root(v)] = other(side).contains(mine(side).points()[v]);
    }
    for (std::size_t v = 0; v < count; ++v)
      if (!in_box(side, v)) root_inside[shells.root(v)] = false;
    for (std::size_t v = 0; v < count; ++v)
      if (root_inside[shells.root(v)]) {
        inside_[side][v] = true;
        sets_.join(vertex_set(side, static_cast<int>(v)), vertex_set(side, static_cast<int>(shells.root(v))));
      }
    for (std::size_t m = 0; m < meetings_.size(); ++m) {  // what comes near from inside
      if (meetings_[m].side != side || is_touched[static_cast<std::size_t>(meetings_[m].edge)]) continue;
      const int vertex = edge(side, meetings_[m].edge).vertices[0];
      if (inside_[side][static_cast<std::size_t>(vertex)]) sets_.join(m, vertex_set(side, vertex));
    }
  }

  bool in_box(int side, std::size_t vertex) const {
    const Eigen::Vector3d& p = mine(side).points()[vertex];
    return (p.array() >= other(side).lowest().array()).all() &&
           (p.array() <= other(side).highest().array()).all();
  }

  struct Region {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> gaps;  ///< of the points
    Eigen::AlignedBox3d box;

    void add(const Eigen::Vector3d& p, double gap) {
      points.push_back(p);
      gaps.push_back(gap);
      box.extend(p);
    }
  };

  std::vector<PartInterface> spots() {
    std::map<std::size_t, Region> by_root;
    for (std::size_t m = 0; m < meetings_.size(); ++m) {
      const Meeting& one = meetings_[m];
      const Segment ends = segment(one.side, one.edge);
      Region& region = by_root[sets_.root(m)];
      for (const double place : {one.approach.low, one.approach.high}) {
        const Eigen::Vector3d p = ends[0] + place * (ends[1] - ends[0]);
        region.add((p + nearest_on_triangle(p, corners(1 - one.side, one.triangle))) / 2,
                   one.approach.distance);
      }
    }
    for (int side = 0; side < 2; ++side)
      for (std::size_t v = 0; v < inside_[side].size(); ++v)
        if (inside_[side][v])
          by_root[sets_.root(vertex_set(side, static_cast<int>(v)))].add(mine(side).points()[v], 0);
    std::vector<Region> regions;
    for (auto& [root, region] : by_root) regions.push_back(std::move(region));
    return merged(regions);
  }

  bool are_near(const Region& a, const Region& b) const {
    const double limit = options_.separate;
    if (a.box.exteriorDistance(b.box) > limit) return false;
    for (const Eigen::Vector3d& p : a.points) {
      if (b.box.exteriorDistance(p) > limit) continue;
      for (const Eigen::Vector3d& q : b.points)
        if ((p - q).norm() <= limit) return true;
    }
    return false;
  }

  std::vector<PartInterface> merged(const std::vector<Region>& regions) const {
    DisjointSets groups(regions.size());
    for (std::size_t i = 0; i < regions.size(); ++i)
      for (std::size_t j = i + 1; j < regions.size(); ++j)
        if (groups.root(i) != groups.root(j) && are_near(regions[i], regions[j])) groups.join(i, j);
    std::vector<PartInterface> result;
    for (std::size_t root = 0; root < regions.size(); ++root) {
      if (groups.root(root) != root) continue;
      Region all;
      for (std::size_t i = root; i < regions.size(); ++i)
        if (groups.root(i) == root)
          for (std::size_t k = 0; k < regions[i].points.size(); ++k)
            all.add(regions[i].points[k], regions[i].gaps[k]);
      result.push_back(place_of(all));
    }
    return result;
  }

  /// Points slightly farther than the nearest ones count when they make the region longer or wider. Elsewhere
  /// they would only depend on the triangulation beside the contact.
  PartInterface place_of(const Region& region) const {
    const double slack = place_share * options_.reach;
    const double gap = *std::min_element(region.gaps.begin(), region.gaps.end());
    const PrincipalExtents nearest = spread_within(region, gap + resolution_),
                           near = spread_within(region, gap + slack);
    const bool is_all = ((near.deviations - nearest.deviations).array() <= slack).all();
    return {is_all ? nearest : near, gap};
  }

  PrincipalExtents spread_within(const Region& region, double most) const {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t k = 0; k < region.points.size(); ++k)
      if (region.gaps[k] <= most) kept.push_back(region.points[k]);
    Points points(static_cast<Eigen::Index>(kept.size()), 3);
    for (std::size_t k = 0; k < kept.size(); ++k)
      points.row(static_cast<Eigen::Index>(k)) = kept[k].transpose();
    return principal_extents(points, resolution_);
  }

  std::array<const PartSurface*, 2> surfaces_;
  InterfaceOptions options_;
  double resolution_;  ///< model units
  std::vector<Meeting> meetings_;
  std::vector<Meeting> nearest_;  ///< per edge of the side that is being looked at; no edge (-1): none yet
  std::array<std::size_t, 2> first_vertex_{};  ///< sets: meetings, then vertices of both sides
  DisjointSets sets_{0};
  std::array<std::vector<bool>, 2> inside_;  ///< per vertex
  std::array<std::vector<int>, 2> touched_;  ///< edges that touch or cross the other surface
};

}  // namespace

std::vector<PartInterface> part_interfaces(const PartSurface& a, const PartSurface& b,
                                           const InterfaceOptions& options) {
  return InterfaceFinder(a, b, options).run();
}

}  // namespace stackabilization::detail
