#include "stacking/draft/pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "mesh/clip.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr std::size_t max_pairs = 1 << 16;

/// Largest outlines that are united first, and that hide smaller ones.
constexpr std::size_t few = 8;

/// Sorts outlines, or what has them, from the largest to the smallest.
template <class Item, class OutlineOf>
void sort_largest_first(std::vector<Item>& items, const OutlineOf& outline_of) {
  std::vector<std::pair<double, Item>> with_area;
  for (Item& item : items) {
    const double area = outline_area(outline_of(item));
    with_area.emplace_back(area, std::move(item));
  }
  std::stable_sort(with_area.begin(), with_area.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < items.size(); ++k) items[k] = std::move(with_area[k].second);
}

/// Returns whether an outline lies in one of the first few of others.
bool is_in_first(const ConvexPolygon& outline, const std::vector<ConvexPolygon>& others) {
  const auto end = others.begin() + static_cast<std::ptrdiff_t>(std::min(few, others.size()));
  return std::any_of(others.begin(), end, [&](const ConvexPolygon& one) { return contains(one, outline); });
}

}  // namespace

Piece common_part(const Piece& piece, const Piece& other, const Eigen::Vector3d& along) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : other) centre += corner / static_cast<double>(other.size());
  Piece kept = piece;
  for (std::size_t c = 0; c < other.size() && !kept.empty(); ++c) {
    const Eigen::Vector3d& from = other[c];
    Eigen::Vector3d across = along.cross(other[(c + 1) % other.size()] - from);
    if (across.dot(centre - from) < 0) across = -across;
    kept = clipped(kept, [&](const Eigen::Vector3d& p) { return across.dot(p - from); });
  }
  return kept;
}

Pieces::Pieces(const Piece& triangle, const Eigen::Vector3d& along)
    : frame_(frame_of(Direction(along))), whole_(outline_area(outline(triangle))) {}

ConvexPolygon Pieces::outline(const Piece& piece) const {
  ConvexPolygon outline;
  for (const Eigen::Vector3d& corner : piece) outline.emplace_back(frame_.to_local(corner).head<2>());
  return outline;
}

double Pieces::share(const std::vector<Piece>& pieces) const {
  if (!(whole_ > 0)) return 0;
  std::vector<ConvexPolygon> outlines, kept;
  for (const Piece& piece : pieces) outlines.push_back(outline(piece));
  sort_largest_first(outlines, [](const ConvexPolygon& one) -> const ConvexPolygon& { return one; });
  for (ConvexPolygon& one : outlines)
    if (!is_in_first(one, kept)) kept.push_back(std::move(one));
  // A union takes quadratic time, and the largest few often cover all.
  for (std::size_t count = few; count < kept.size(); count *= 2) {
    const auto end = kept.begin() + static_cast<std::ptrdiff_t>(count);
    if (union_area({kept.begin(), end}) >= whole_ * (1 - tolerance::relative)) return 1;
  }
  return std::min(1.0, union_area(kept) / whole_);
}

void Pieces::move_those(std::vector<Piece>& from, std::vector<Piece>& to,
                        const std::function<bool(const Piece&)>& condition) const {
  std::vector<ConvexPolygon> known;
  for (const Piece& piece : to) known.push_back(outline(piece));
  sort_largest_first(from, [this](const Piece& piece) { return outline(piece); });
  std::erase_if(from, [&](const Piece& piece) {
    ConvexPolygon own = outline(piece);
    if (is_in_first(own, known)) return true;
    if (!condition(piece)) return false;
    known.push_back(std::move(own));
    to.push_back(piece);
    return true;
  });
}

bool Pieces::cover_all(const std::vector<Piece>& pieces) const {
  return !pieces.empty() && share(pieces) >= 1 - tolerance::relative;
}

std::vector<Piece> Pieces::common(std::vector<Piece> some, std::vector<Piece> others, bool& complete) const {
  if (some.empty() || others.empty()) return {};
  if (cover_all(some)) return others;
  if (cover_all(others)) return some;
  if (some.size() > max_pairs / others.size()) {
    complete = false;
    return {};
  }
  std::vector<Piece> both;
  for (const Piece& one : some)
    for (const Piece& other : others)
      if (Piece part = common_part(one, other, frame_.w); part.size() > 2) both.push_back(std::move(part));
  return both;
}

}  // namespace stackabilization::detail
