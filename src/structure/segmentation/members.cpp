#include "structure/segmentation/members.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "core/bounding_diagonal.h"
#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/surface_index.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/structure/fitting.h"
#include "structure/fitting/part_box.h"
#include "structure/segmentation/convex_regions.h"
#include "structure/segmentation/segment_boundaries.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

namespace {

using Pieces = std::vector<std::int32_t>;

std::int32_t piece_count(const Pieces& pieces) {
  return *std::max_element(pieces.begin(), pieces.end()) + 1;
}

/// Returns the error of the better primitive, fraction of the diagonal of the oriented box.
double relative_misfit(const PrimitiveFit& fit) {
  return std::min(fit.cuboid_error, fit.cylinder_error.value_or(std::numeric_limits<double>::infinity()));
}

/// Returns the root mean square distance between a part and the primitives of its pieces, model units.
double misfit(const Shape& part, const Pieces& pieces) {
  std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(piece_count(pieces)));
  for (std::size_t t = 0; t < pieces.size(); ++t)
    rows[static_cast<std::size_t>(pieces[t])].push_back(static_cast<std::int32_t>(t));
  Eigen::ArrayXd areas = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(rows.size())), errors = areas;
  tbb::parallel_for(Eigen::Index{0}, areas.size(), [&](Eigen::Index p) {
    const Shape piece = extracted(part, rows[static_cast<std::size_t>(p)]);
    areas(p) = surface_graph(piece).areas.sum();
    if (!(areas(p) > 0)) return;
    const double diagonal = 2 * part_box(FitSurface(piece)).box.half_extents.norm();
    errors(p) = relative_misfit(fit_primitive(piece).fit) * diagonal;
  });
  return std::sqrt((areas * errors.square()).sum() / areas.sum());
}

/// Returns whether the curve of a primitive is closed, as that of a frame of two legs and two rails is. Its
/// corners are round: the curve is smooth.
bool is_ring(const Primitive& primitive) {
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  return cylinder && cylinder->closed;
}

/// Returns whether a curve turns at a few corners, as that of a frame does, and not evenly.
bool has_corners(const Primitive& primitive, const MemberRule& rule) {
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  if (!cylinder || cylinder->closed) return false;
  const Points tangents = section_tangents(*cylinder);
  std::vector<double> turns;
  for (Eigen::Index i = 1; i < tangents.rows(); ++i)
    turns.push_back(std::acos(std::clamp(tangents.row(i).dot(tangents.row(i - 1)), -1.0, 1.0)));
  const double whole = std::accumulate(turns.begin(), turns.end(), 0.0);
  if (whole < rule.min_turn * std::numbers::pi / 180) return false;
  std::sort(turns.rbegin(), turns.rend());
  const auto quarter = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 4);
  return std::accumulate(turns.begin(), quarter, 0.0) >= rule.turn_at_corners * whole;
}

/// Returns the pieces with those of one set as one, numbered anew.
Pieces joined(const Pieces& pieces, DisjointSets& sets) {
  const std::vector<std::int32_t> numbers = sets.numbers();
  Pieces result;
  for (const std::int32_t piece : pieces) result.push_back(numbers[static_cast<std::size_t>(piece)]);
  return result;
}

/// Joins neighbouring pieces whose border is nowhere concave, or hardly, and more than a little of all
/// borders of one of them.
Pieces without_smooth_borders(const SurfaceGraph& graph, const Pieces& pieces, const MemberRule& rule) {
  struct Concavity {
    double length = 0, concave = 0;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Concavity> borders;
  std::vector<double> around(static_cast<std::size_t>(piece_count(pieces)), 0);
  for (const SurfaceLink& link : graph.links) {
    const auto [a, b] =
        std::minmax(pieces[static_cast<std::size_t>(link.a)], pieces[static_cast<std::size_t>(link.b)]);
    if (a == b) continue;
    Concavity& border = borders[{a, b}];
    border.length += link.length;
    border.concave += link.length * concavity(link);
    around[at(a)] += link.length;
    around[at(b)] += link.length;
  }
  DisjointSets sets(around.size());
  for (const auto& [pair, border] : borders) {
    const auto& [a, b] = pair;
    if (border.concave < rule.min_concave * border.length &&
        border.length > rule.little_border * std::min(around[at(a)], around[at(b)]))
      sets.join(at(a), at(b));
  }
  return joined(pieces, sets);
}

/// Joins each piece that is a face of a neighbour to it. The vector area of a closed surface is zero: that of
/// a face is nearly as large as its area, and takes most of itself away from that of the other piece.
Pieces with_their_faces(const SurfaceGraph& graph, const Pieces& pieces, const MemberRule& rule) {
  const std::int32_t count = piece_count(pieces);
  Eigen::Matrix3Xd vector_areas = Eigen::Matrix3Xd::Zero(3, count);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(count);
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const auto row = static_cast<Eigen::Index>(t);
    areas(pieces[t]) += graph.areas(row);
    vector_areas.col(pieces[t]) += graph.areas(row) * graph.normals.row(row).transpose();
  }
  std::vector<std::pair<double, std::int32_t>> closed(static_cast<std::size_t>(count), {0, -1});
  const auto close = [&](std::int32_t face, std::int32_t other) {
    const double alone = vector_areas.col(face).norm();
    if (alone < rule.one_sided * areas(face)) return;
    const double share =
        (vector_areas.col(other).norm() - (vector_areas.col(face) + vector_areas.col(other)).norm()) / alone;
    if (share >= rule.closes)
      closed[static_cast<std::size_t>(face)] =
          std::max(closed[static_cast<std::size_t>(face)], std::pair(share, other));
  };
  for (const SurfaceLink& link : graph.links) {
    const std::int32_t a = pieces[static_cast<std::size_t>(link.a)],
                       b = pieces[static_cast<std::size_t>(link.b)];
    if (a == b) continue;
    close(a, b);
    close(b, a);
  }
  DisjointSets sets(closed.size());
  for (std::size_t p = 0; p < closed.size(); ++p)
    if (closed[p].second >= 0) sets.join(p, static_cast<std::size_t>(closed[p].second));
  return joined(pieces, sets);
}

/// A part with what copying a cut from one side to the other needs.
struct CutPart {
  /// `smallest`: area of the smallest piece, fraction.
  CutPart(const Shape& part, double smallest)
      : shape(part),
        graph(linked_surface_graph(part, smallest)),
        index(part),
        shells(connected_components(weld(part))) {}

  const Shape& shape;
  SurfaceGraph graph;
  SurfaceIndex index;
  std::vector<std::int32_t> shells;  ///< per triangle
};

/// Barycentric coordinates of the places of a triangle at which its image is looked up. Several, since a
/// triangle may be long, and since another piece may touch it at some of them.
constexpr std::array<std::array<double, 3>, 7> places = {{{1. / 3, 1. / 3, 1. / 3},
                                                          {0.8, 0.1, 0.1},
                                                          {0.1, 0.8, 0.1},
                                                          {0.1, 0.1, 0.8},
                                                          {0.45, 0.45, 0.1},
                                                          {0.1, 0.45, 0.45},
                                                          {0.45, 0.1, 0.45}}};

/// Triangles whose sides are shorter than this, fraction of the diagonal of the part, are looked up at their
/// centres alone.
constexpr double short_side = 0.01;

/// Share of the area of a shell that is little.
constexpr double little = 0.2;

double longest_side(const Shape& shape, Eigen::Index triangle) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (shape.corner(triangle, (k + 1) % 3) - shape.corner(triangle, k)).norm());
  return longest;
}

/// Gives what little of a piece lies on another shell than most of the piece to the piece that this shell
/// mostly is. Shells that touch, or nearly, are at the same place, where an image alone does not tell them
/// apart.
Pieces with_whole_shells(const CutPart& part, Pieces pieces) {
  const std::int32_t shells = *std::max_element(part.shells.begin(), part.shells.end()) + 1;
  if (shells == 1) return pieces;
  Eigen::MatrixXd area = Eigen::MatrixXd::Zero(shells, piece_count(pieces));
  for (std::size_t t = 0; t < pieces.size(); ++t)
    area(part.shells[t], pieces[t]) += part.graph.areas(static_cast<Eigen::Index>(t));
  const Eigen::VectorXd of_shell = area.rowwise().sum(), of_piece = area.colwise().sum();
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const std::int32_t shell = part.shells[t];
    const double here = area(shell, pieces[t]);
    if (here < little * of_shell(shell) && here < of_piece(pieces[t]) / 2)
      area.row(shell).maxCoeff(&pieces[t]);
  }
  return pieces;
}

/// Returns the piece of `from` that most places of the image of every triangle of `to` lie on.
Pieces image(const CutPart& to, const CutPart& from, const Pieces& pieces, const Symmetry& reflection) {
  const Eigen::Isometry3d map = isometry_of(reflection);
  Pieces result(to.shape.triangle_part.size());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t t) {
    const auto row = static_cast<Eigen::Index>(t);
    const bool is_short = longest_side(to.shape, row) < short_side * to.graph.diagonal;
    std::map<std::int32_t, int> votes;
    for (const auto& [a, b, c] : std::span(places).first(is_short ? 1 : places.size())) {
      const Eigen::Vector3d place =
          a * to.shape.corner(row, 0) + b * to.shape.corner(row, 1) + c * to.shape.corner(row, 2);
      ++votes[pieces[static_cast<std::size_t>(from.index.nearest(map * place).triangle)]];
    }
    result[t] = std::max_element(votes.begin(), votes.end(), [](const auto& one, const auto& other) {
                  return one.second < other.second;
                })->first;
  });
  return with_whole_shells(to, std::move(result));
}

/// Returns the area on which two cuts differ, of the whole area.
double difference(const SurfaceGraph& graph, const Pieces& one, const Pieces& other) {
  double area = 0;
  for (std::size_t t = 0; t < one.size(); ++t)
    if (one[t] != other[t]) area += graph.areas(static_cast<Eigen::Index>(t));
  return area / graph.areas.sum();
}

/// Returns `pieces` of one side of a plane and their images on the other one. A piece and its image are one
/// where most of the border between them runs within one piece of the cut as it was: a rail across the plane,
/// and not two halves that meet there. `keeps`: per triangle, whether its piece is kept.
Pieces with_images(const CutPart& part, const Pieces& pieces, const Pieces& images,
                   const std::vector<char>& keeps) {
  const std::int32_t count = piece_count(pieces);
  Pieces cut = pieces;
  for (std::size_t t = 0; t < cut.size(); ++t)
    if (!keeps[t]) cut[t] = count + images[t];
  std::vector<double> within(static_cast<std::size_t>(count), 0), between = within;
  for (const SurfaceLink& link : part.graph.links) {
    const auto [kept, image] = std::minmax(cut[at(link.a)], cut[at(link.b)]);
    if (image - kept != count) continue;
    (pieces[at(link.a)] == pieces[at(link.b)] ? within : between)[at(kept)] += link.length;
  }
  DisjointSets sets(static_cast<std::size_t>(2 * count));
  for (std::int32_t p = 0; p < count; ++p)
    if (within[at(p)] > between[at(p)]) sets.join(at(p), at(count + p));
  return joined(cut, sets);
}

/// Returns the two cuts that are their own images: the pieces on one side of the plane are kept, or those on
/// the other.
std::array<Pieces, 2> mirrored(const CutPart& part, const Pieces& pieces, const Symmetry& reflection,
                               double smallest) {
  const Pieces images = image(part, part, pieces, reflection);
  std::array<std::vector<char>, 2> keeps;
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const Eigen::Vector3d centre = part.graph.centres.row(static_cast<Eigen::Index>(t));
    const double side = reflection.axis.dot(centre - reflection.point);
    keeps[0].push_back(side >= 0);
    keeps[1].push_back(side <= 0);
  }
  std::array<Pieces, 2> cuts;
  for (std::size_t k = 0; k < cuts.size(); ++k)
    cuts[k] = merge_small_segments(part.graph, with_images(part, pieces, images, keeps[k]),
                                   smallest * part.graph.areas.sum());
  return cuts;
}

}  // namespace

bool is_small(const Shape& part, double whole, const MemberRule& rule) {
  return bounding_diagonal(part) <= rule.small * whole;
}

bool may_have_members(const FittedPrimitive& part, const MemberRule& rule) {
  return has_corners(part.primitive, rule) || is_ring(part.primitive) ||
         relative_misfit(part.fit) >= rule.misfit;
}

std::vector<std::int32_t> members(const Shape& part, const CutIntoPieces& cut, const MemberRule& rule) {
  Pieces one_piece(part.triangle_part.size(), 0);
  const SurfaceGraph graph = surface_graph(part);
  if (!(graph.areas.sum() > 0)) return one_piece;
  const FittedPrimitive whole = fit_primitive(part);
  if (!may_have_members(whole, rule)) return one_piece;
  Pieces pieces = with_their_faces(graph, without_smooth_borders(graph, cut(part), rule), rule);
  const std::int32_t count = piece_count(pieces);
  if (count < 2 || count > rule.max_members) return one_piece;
  const double gain = has_corners(whole.primitive, rule) ? rule.gain_of_frames : rule.gain;
  return misfit(part, pieces) <= gain * misfit(part, one_piece) ? pieces : one_piece;
}

void make_symmetric(const std::vector<Shape>& parts, const std::vector<Relation>& relations, double smallest,
                    std::vector<std::vector<std::int32_t>>& members) {
  std::map<std::size_t, CutPart> cut;
  const auto part = [&](std::size_t p) -> const CutPart& {
    return cut.try_emplace(p, parts[p], smallest).first->second;
  };
  const auto reflects = [](const Relation& relation, RelationType type) {
    return relation.type == type && relation.symmetry.kind == SymmetryKind::reflection;
  };
  for (const Relation& relation : relations) {
    if (!reflects(relation, RelationType::self_symmetry)) continue;
    const auto p = static_cast<std::size_t>(relation.parts[0]);
    if (piece_count(members[p]) < 2) continue;
    auto [one, other] = mirrored(part(p), members[p], relation.symmetry, smallest);
    const bool alike = difference(part(p).graph, one, other) < smallest;  // primitives would fit alike, too
    members[p] =
        !alike && misfit(parts[p], other) < misfit(parts[p], one) ? std::move(other) : std::move(one);
  }
  // Of parts that are images of each other, the first one is copied to the others, from pair to pair.
  std::vector<char> reached(parts.size(), 0);
  std::vector<std::size_t> queue;
  const auto copy = [&](std::size_t from, std::size_t to, const Symmetry& reflection) {
    if (reached[to]) return;
    reached[to] = 1;
    queue.push_back(to);
    if (piece_count(members[from]) > 1)
      members[to] =
          merge_small_segments(part(to).graph, image(part(to), part(from), members[from], reflection),
                               smallest * part(to).graph.areas.sum());
    else
      members[to].assign(members[to].size(), 0);
  };
  for (std::size_t first = 0; first < parts.size(); ++first) {
    if (reached[first]) continue;
    reached[first] = 1;
    queue = {first};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const Relation& relation : relations) {
        if (!reflects(relation, RelationType::symmetry)) continue;
        const auto a = static_cast<std::size_t>(relation.parts[0]),
                   b = static_cast<std::size_t>(relation.parts[1]);
        if (queue[next] == a) copy(a, b, relation.symmetry);
        if (queue[next] == b) copy(b, a, relation.symmetry);
      }
  }
}

}  // namespace stackabilization::detail
