#include "stacking/place/place_gap.h"

#include <algorithm>
#include <cmath>

#include "core/index.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {
namespace {

/// Rectangles for the bound of a cell, for the value at a place, and for both to begin with.
constexpr std::size_t cell_blocks = 1 << 12;
constexpr std::size_t place_blocks = 1 << 16;
constexpr std::size_t first_blocks = 1 << 6;
/// Samples along each side of the box of the shape.
constexpr int samples_across = 32;
/// Rectangles narrower than this fraction of the places of a cell are not cut further: the bounds over them
/// are those of the places.
constexpr double finest_of_cell = 0.25;
/// The same, as a fraction of the shape, where there is one place.
constexpr double finest_of_shape = 1.0 / (1 << 20);

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

PlaceGap::PlaceGap(PlaceBounds& bounds, PlaceGoal goal, double floor, const Range& area)
    : bounds_(bounds), goal_(goal), floor_(floor), area_(area) {}

double PlaceGap::low(const PlaceCell& cell, const LinearBound& lift, double enough) {
  const PlanarBox& whole = bounds_.box_of_shape();
  const double turn = 2 * cell.half_turn * whole.radius();
  Query query{cell, lift, finest_of_cell * std::max({cell.box.width(), cell.box.height(), turn})};
  add(query, whole);
  for (std::size_t count = first_blocks;; count *= 2) {
    const bool more = refine(query, count);
    const Range found = value(query);
    // No finer rectangles show more than the upper end.
    if (found.low >= enough || found.high < enough || !more || count >= cell_blocks) return found.low;
    sort_by_doubt(query, found);
  }
}

double PlaceGap::estimate(const LocalPlace& place, double lift) {
  const PlaceCell cell{{place.x, place.x, place.y, place.y}, place.yaw, 0};
  const PlanarBox& shape = bounds_.box_of_shape();
  double sum = 0;
  int count = 0;
  for (int j = 0; j < samples_across; ++j)
    for (int i = 0; i < samples_across; ++i) {
      const double x = shape.x_low + (i + 0.5) / samples_across * shape.width(),
                   y = shape.y_low + (j + 0.5) / samples_across * shape.height();
      const FacingBound facing = bounds_.facing(cell, {x, x, y, y});
      const bool over_floor = goal_ == PlaceGoal::volume;
      if (!(over_floor ? facing.own : facing.difference).possibly_covered()) continue;
      double high = facing.difference.high;
      if (over_floor) high = std::max(high, facing.own.high + floor_);
      sum += lift - high;
      ++count;
    }
  return count > 0 ? sum / count : infinity;
}

Range PlaceGap::at(const LocalPlace& place, double lift, double accuracy, double enough) {
  const PlaceCell cell{{place.x, place.x, place.y, place.y}, place.yaw, 0};
  Query query{cell, {lift, {0, 0}}, 0};
  add(query, bounds_.box_of_shape());
  for (std::size_t count = first_blocks;; count *= 2) {
    const bool more = refine(query, count);
    const Range found = value(query);
    if (found.low >= enough) return {found.low, infinity};
    if (found.length() <= accuracy || !more || count >= place_blocks) return found;
    sort_by_doubt(query, found);
  }
}

void PlaceGap::add(Query& query, const PlanarBox& box) {
  const FacingBound facing = bounds_.facing(query.cell, box);
  const bool over_floor = goal_ == PlaceGoal::volume;
  const HeightBound& counted = over_floor ? facing.own : facing.difference;
  if (!counted.possibly_covered()) return;
  Block block;
  block.box = box;
  block.area = box.width() * box.height();
  block.certain = counted.certainly_covered();
  // Of u - l, or of max(u, floor) - l.
  double low = facing.difference.covered_low;
  LinearBound high{facing.difference.high, {0, 0}};
  if (over_floor && !facing.all_faced) {
    low = facing.own.covered_low + floor_;
    high.centre = std::max(high.centre, facing.own.high + floor_);
  } else if (block.certain) {
    const auto [mean_low, mean_high] = bounds_.mean_difference(query.cell, box);
    low = std::max(low, mean_low.centre - mean_low.spread(query.cell));
    if (mean_high.centre < high.centre) high = mean_high;
  }
  block.gap = {query.lift.centre - high.centre, query.lift.slope - high.slope};
  block.gap_low = std::max(0.0, block.gap.centre - block.gap.spread(query.cell));
  if (block.gap.centre < block.gap_low) block.gap = {block.gap_low, {0, 0}};
  block.gap_high = std::max(block.gap_low, query.lift.centre - low);
  const PlanarBox& shape = bounds_.box_of_shape();
  const double finest = std::max(query.finest, finest_of_shape * std::max(shape.width(), shape.height()));
  if (std::max(box.width(), box.height()) <= finest) {
    query.settled.push_back(block);
    return;
  }
  block.doubt = doubt(query, block);
  query.heap.push_back(block);
  std::push_heap(query.heap.begin(), query.heap.end());
}

double PlaceGap::doubt(const Query& query, const Block& block) const {
  if (block.certain) return block.area * (block.gap_high - block.gap_low);
  // Where it is open whether the area is large enough, that comes first.
  if (query.mean.high == infinity) return block.area * bounds_.size();
  return block.area * std::max(block.gap_high - query.mean.low, query.mean.high - block.gap_low);
}

void PlaceGap::sort_by_doubt(Query& query, const Range& mean) {
  query.mean = mean;
  for (Block& block : query.heap) block.doubt = doubt(query, block);
  std::make_heap(query.heap.begin(), query.heap.end());
}

bool PlaceGap::refine(Query& query, std::size_t count) {
  while (query.heap.size() + query.settled.size() < count) {
    if (query.heap.empty() || query.heap.front().doubt == 0) return false;
    std::pop_heap(query.heap.begin(), query.heap.end());
    const PlanarBox box = query.heap.back().box;
    query.heap.pop_back();
    for (const PlanarBox& quarter : box.quarters()) add(query, quarter);
  }
  return true;
}

/// The least and the largest mean over all that is certain and any share of each of the others: those with
/// the least gap first, as long as they make the mean less, or the area is too small; for the largest mean
/// the other way.
Range PlaceGap::value(const Query& query) const {
  std::vector<Block> blocks = query.heap;
  blocks.insert(blocks.end(), query.settled.begin(), query.settled.end());
  const auto others = std::partition(blocks.begin(), blocks.end(), [](const Block& b) { return b.certain; });
  double certain_area = 0, all_area = 0;
  Range certain{0, 0};
  LinearBound sum;
  for (auto block = blocks.begin(); block != blocks.end(); ++block) {
    all_area += block->area;
    if (block >= others) continue;
    certain_area += block->area;
    certain.low += block->area * block->gap_low;
    certain.high += block->area * block->gap_high;
    sum.centre += block->area * block->gap.centre;
    sum.slope += block->area * block->gap.slope;
  }
  certain.low = std::max(certain.low, sum.centre - sum.spread(query.cell));
  if (all_area * (1 + tolerance::relative) < area_.low || all_area == 0) return {infinity, infinity};
  const auto extreme = [&](double total, double sign, double Block::*gap) {
    std::sort(others, blocks.end(),
              [&](const Block& a, const Block& b) { return sign * a.*gap < sign * b.*gap; });
    double area = certain_area;
    for (auto block = others; block != blocks.end(); ++block) {
      const bool wanted = area == 0 || sign * (*block).*gap < sign * total / area;
      const double share = std::min(block->area, (wanted ? area_.high : area_.low) - area);
      if (!(share > 0)) break;
      total += share * (*block).*gap;
      area += share;
    }
    return total / area;
  };
  const double low = extreme(certain.low, 1, &Block::gap_low) * (1 - tolerance::relative);
  // For the mean gap, a place counts where the overlap is certainly large enough.
  if (goal_ == PlaceGoal::gap && certain_area < area_.low) return {low, infinity};
  return {low, extreme(certain.high, -1, &Block::gap_high) * (1 + tolerance::relative)};
}

}  // namespace stackabilization::detail
