#include "stacking/draft/pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "envelope/contacts/clip.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr std::size_t max_pairs = 1 << 16;

/// Largest outlines that are united first, and that hide smaller ones.
constexpr std::size_t few = 8;

/// Returns the outlines from the largest to the smallest, without those in one of the first few.
std::vector<ConvexPolygon> largest_first(std::vector<ConvexPolygon> outlines) {
  std::stable_sort(outlines.begin(), outlines.end(), [](const ConvexPolygon& a, const ConvexPolygon& b) {
    return outline_area(a) > outline_area(b);
  });
  std::vector<ConvexPolygon> kept;
  for (ConvexPolygon& outline : outlines) {
    const auto end = kept.begin() + static_cast<std::ptrdiff_t>(std::min(few, kept.size()));
    if (std::none_of(kept.begin(), end, [&](const ConvexPolygon& one) { return contains(one, outline); }))
      kept.push_back(std::move(outline));
  }
  return kept;
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
    kept = clipped(
        kept, [&](const Eigen::Vector3d& p) { return across.dot(p - from); },
        [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t) {
          return Eigen::Vector3d(a + t * (b - a));
        });
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
  std::vector<ConvexPolygon> outlines;
  for (const Piece& piece : pieces) outlines.push_back(outline(piece));
  outlines = largest_first(std::move(outlines));
  // A union takes quadratic time, and the largest few often cover all.
  for (std::size_t count = few; count < outlines.size(); count *= 2) {
    const auto end = outlines.begin() + static_cast<std::ptrdiff_t>(count);
    if (union_area({outlines.begin(), end}) >= whole_ * (1 - tolerance::relative)) return 1;
  }
  return std::min(1.0, union_area(outlines) / whole_);
}

void Pieces::sort_largest_first(std::vector<Piece>& pieces) const {
  std::vector<std::pair<double, Piece>> with_area;
  for (Piece& piece : pieces) with_area.emplace_back(outline_area(outline(piece)), std::move(piece));
  std::stable_sort(with_area.begin(), with_area.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < pieces.size(); ++k) pieces[k] = std::move(with_area[k].second);
}

bool Pieces::is_within(const Piece& piece, const std::vector<Piece>& others) const {
  const ConvexPolygon inner = outline(piece);
  const auto end = others.begin() + static_cast<std::ptrdiff_t>(std::min(few, others.size()));
  return std::any_of(others.begin(), end,
                     [&](const Piece& other) { return contains(outline(other), inner); });
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
