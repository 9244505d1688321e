#include "deformation/iwires/wire_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "core/disjoint_sets.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int all_wires = -1;

/// Returns half the cotangents at the corners of a triangle; 1 for a triangle without area.
std::array<double, 3> cotangent_weights(const std::array<Eigen::Vector3d, 3>& p) {
  std::array<double, 3> weights = {1, 1, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
    const double area = a.cross(b).norm();
    if (area <= tolerance::relative * std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()}))
      return {1, 1, 1};
    weights[k] = a.dot(b) / area / 2;
  }
  return weights;
}

}  // namespace

WireSurface::WireSurface(const Shape& rest, const WireNetwork& network,
                         const std::vector<std::int32_t>& pinned)
    : network_(network),
      surface_(weld(rest)),
      rest_(rest.vertices),
      node_of_(place_count(), -1),
      pinned_(place_count(), 0) {
  for (std::size_t i = 0; i < network.vertices.size(); ++i)
    node_of_[static_cast<std::size_t>(surface_.of_vertex[static_cast<std::size_t>(network.vertices[i])])] =
        static_cast<int>(i);
  for (const std::int32_t v : pinned)
    pinned_[static_cast<std::size_t>(surface_.of_vertex[static_cast<std::size_t>(v)])] = 1;
  find_patches();
  find_followers();
  find_columns();
  make_elements();
  factorize();
}

void WireSurface::find_patches() {
  std::map<std::pair<int, int>, int> wire_at;
  for (std::size_t k = 0; k < network_.nodes.size(); ++k) {
    const auto& nodes = network_.nodes[k];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto place = [&](int node) {
        return surface_
            .of_vertex[static_cast<std::size_t>(network_.vertices[static_cast<std::size_t>(node)])];
      };
      // The closing segment of an open wire of more than two nodes is not an edge, or does no harm as one.
      wire_at[std::minmax(place(nodes[i]), place(nodes[(i + 1) % nodes.size()]))] = static_cast<int>(k);
    }
    wires_of_[all_wires].push_back(static_cast<int>(k));
  }
  const Eigen::Index count = surface_.triangles.rows();
  DisjointSets patches(static_cast<std::size_t>(count));
  std::map<std::pair<int, int>, std::size_t> first;
  std::vector<std::pair<Eigen::Index, int>> beside;
  for (Eigen::Index t = 0; t < count; ++t)
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> edge =
          std::minmax<int>(surface_.triangles(t, k), surface_.triangles(t, (k + 1) % 3));
      if (const auto wire = wire_at.find(edge); wire != wire_at.end())
        beside.emplace_back(t, wire->second);
      else if (edge.first != edge.second)
        patches.join(first.emplace(edge, t).first->second, static_cast<std::size_t>(t));
    }
  for (Eigen::Index t = 0; t < count; ++t)
    patch_of_.push_back(static_cast<int>(patches.root(static_cast<std::size_t>(t))));
  for (const auto& [triangle, wire] : beside)
    wires_of_[patch_of_[static_cast<std::size_t>(triangle)]].push_back(wire);
  for (auto& [patch, wires] : wires_of_) {
    std::sort(wires.begin(), wires.end());
    wires.erase(std::unique(wires.begin(), wires.end()), wires.end());
  }
}

int WireSurface::fit_of(const std::vector<int>& wires) {
  const auto [it, added] = fit_numbers_.emplace(wires, static_cast<int>(fits_.size()));
  if (added) {
    std::set<int> nodes;
    for (const int k : wires) {
      const auto& own = network_.nodes[static_cast<std::size_t>(k)];
      nodes.insert(own.begin(), own.end());
    }
    fits_.emplace_back(std::vector<int>(nodes.begin(), nodes.end()), network_.points);
  }
  return it->second;
}

int WireSurface::fit_around(int patch, int wire) {
  const std::vector<int>& around = wires_of_[patch];
  std::set<int> joined = {wire};
  for (const int node : network_.nodes[static_cast<std::size_t>(wire)])
    for (const int k : network_.wires_at[static_cast<std::size_t>(node)])
      if (std::binary_search(around.begin(), around.end(), k)) joined.insert(k);
  return fit_of({joined.begin(), joined.end()});
}

int WireSurface::rim_of(int patch, int place) {
  const auto [it, added] = rim_numbers_.emplace(std::pair(patch, place), static_cast<int>(rims_.size()));
  if (!added) return it->second;
  Rim rim;
  if (const int node = node_of_[static_cast<std::size_t>(place)]; node >= 0) {
    const auto& wires = network_.wires_at[static_cast<std::size_t>(node)];
    const auto& around = wires_of_[patch];
    for (const int k : wires)
      if (std::binary_search(around.begin(), around.end(), k)) rim.push_back(fit_around(patch, k));
    // A patch may touch a wire in a single vertex.
    if (rim.empty())
      for (const int k : wires) rim.push_back(fit_around(all_wires, k));
  }
  rims_.push_back(std::move(rim));
  return it->second;
}

void WireSurface::find_followers() {
  const std::size_t count = place_count();
  DisjointSets pieces(count);
  for (const auto& t : surface_.triangles.rowwise())
    for (const int corner : t) pieces.join(static_cast<std::size_t>(t(0)), static_cast<std::size_t>(corner));
  std::vector<char> led(count, 0);
  for (std::size_t p = 0; p < count; ++p)
    if (node_of_[p] >= 0 || pinned_[p]) led[pieces.root(p)] = 1;
  std::map<std::size_t, std::pair<double, int>> nearest;
  for (std::size_t p = 0; p < count; ++p) {
    if (led[pieces.root(p)]) continue;
    auto& best =
        nearest.try_emplace(pieces.root(p), std::numeric_limits<double>::infinity(), -1).first->second;
    for (std::size_t i = 0; i < network_.points.size(); ++i) {
      const double distance = (network_.points[i] - point(static_cast<int>(p))).squaredNorm();
      if (distance < best.first) best = {distance, static_cast<int>(i)};
    }
  }
  for (std::size_t p = 0; p < count; ++p) {
    if (led[pieces.root(p)]) continue;
    const int node = nearest.at(pieces.root(p)).second;
    const int wire = network_.wires_at[static_cast<std::size_t>(node)].front();
    followers_.push_back({static_cast<int>(p), fit_around(all_wires, wire)});
  }
}

void WireSurface::find_columns() {
  column_.assign(place_count(), -1);
  std::vector<char> following(place_count(), 0);
  for (const Follower& f : followers_) following[static_cast<std::size_t>(f.place)] = 1;
  for (std::size_t p = 0; p < column_.size(); ++p)
    if (node_of_[p] < 0 && !pinned_[p] && !following[p]) column_[p] = columns_++;
}

void WireSurface::make_elements() {
  for (Eigen::Index t = 0; t < surface_.triangles.rows(); ++t) {
    Element element{{}, {}, {-1, -1, -1}, {}};
    std::array<Eigen::Vector3d, 3> corners;
    bool free = false;
    for (std::size_t k = 0; k < 3; ++k) {
      element.place[k] = surface_.triangles(t, static_cast<int>(k));
      const auto place = static_cast<std::size_t>(element.place[k]);
      corners[k] = point(element.place[k]);
      element.column[k] = column_[place];
      free = free || column_[place] >= 0;
    }
    if (!free) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (element.column[k] < 0)
        element.rim[k] = rim_of(patch_of_[static_cast<std::size_t>(t)], element.place[k]);
    element.weight = cotangent_weights(corners);
    elements_.push_back(element);
  }
}

void WireSurface::factorize() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Element& e : elements_)
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = e.column[(k + 1) % 3], j = e.column[(k + 2) % 3];
      if (i >= 0) entries.emplace_back(i, i, e.weight[k]);
      if (j >= 0) entries.emplace_back(j, j, e.weight[k]);
      if (i < 0 || j < 0) continue;
      entries.emplace_back(i, j, -e.weight[k]);
      entries.emplace_back(j, i, -e.weight[k]);
    }
  Eigen::SparseMatrix<double> matrix(columns_, columns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

/// Computes the linear maps of the free vertices, less the identity: one row per vertex, column by column.
Eigen::MatrixXd WireSurface::guidance(const std::vector<Eigen::Matrix3d>& rims) const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(columns_, 9);
  for (const Element& e : elements_)
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t step : {1U, 2U}) {
        const int free = e.column[(k + step) % 3], known = e.rim[(k + 3 - step) % 3];
        if (free >= 0 && known >= 0)
          right.row(free) += e.weight[k] * rims[static_cast<std::size_t>(known)].reshaped().transpose();
      }
  return factor_.solve(right);
}

/// Computes the displacements of the vertices on wires, of pinned vertices and of followers; zero for the
/// others.
std::vector<Eigen::Vector3d> WireSurface::known_displacements(
    const std::vector<Eigen::Vector3d>& nodes, const std::vector<Eigen::Matrix3d>& maps) const {
  std::vector<Eigen::Vector3d> moved(place_count(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < moved.size(); ++p)
    if (node_of_[p] >= 0 && !pinned_[p])
      moved[p] = nodes[static_cast<std::size_t>(node_of_[p])] - point(static_cast<int>(p));
  for (const Follower& f : followers_) {
    const WireFit& fit = fits_[static_cast<std::size_t>(f.fit)];
    const Eigen::Vector3d from = point(f.place);
    moved[static_cast<std::size_t>(f.place)] =
        fit.moved_centre(nodes) + maps[static_cast<std::size_t>(f.fit)] * (from - fit.centre()) - from;
  }
  return moved;
}

/// Adds the contribution of one triangle to the right side. `maps`: the linear maps at its corners, less the
/// identity.
void WireSurface::add_guided(const Element& element, const std::array<Eigen::Matrix3d, 3>& maps,
                             const std::vector<Eigen::Vector3d>& moved, Eigen::MatrixXd& right) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Eigen::Vector3d edge =
        (maps[i] + maps[j]) * (point(element.place[i]) - point(element.place[j])) / 2;
    // `moved` is still zero for free vertices, so it adds known displacements only.
    if (element.column[i] >= 0)
      right.row(element.column[i]) +=
          element.weight[k] * (moved[static_cast<std::size_t>(element.place[j])] + edge).transpose();
    if (element.column[j] >= 0)
      right.row(element.column[j]) +=
          element.weight[k] * (moved[static_cast<std::size_t>(element.place[i])] - edge).transpose();
  }
}

Points WireSurface::deformed(const std::vector<Eigen::Vector3d>& nodes) const {
  std::vector<Eigen::Matrix3d> maps, rims;
  for (const WireFit& fit : fits_) maps.push_back(fit.linear(nodes));
  for (const Rim& rim : rims_) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const int fit : rim) sum += maps[static_cast<std::size_t>(fit)] - Eigen::Matrix3d::Identity();
    rims.push_back(sum / std::max(1.0, static_cast<double>(rim.size())));
  }
  std::vector<Eigen::Vector3d> moved = known_displacements(nodes, maps);
  if (columns_ > 0) {
    const Eigen::MatrixXd inner = guidance(rims);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(columns_, 3);
    for (const Element& e : elements_) {
      std::array<Eigen::Matrix3d, 3> at_corners;
      for (std::size_t k = 0; k < 3; ++k)
        at_corners[k] = e.rim[k] >= 0 ? rims[static_cast<std::size_t>(e.rim[k])]
                                      : Eigen::Matrix3d(inner.row(e.column[k]).reshaped(3, 3));
      add_guided(e, at_corners, moved, right);
    }
    const Eigen::MatrixXd free = factor_.solve(right);
    for (std::size_t p = 0; p < moved.size(); ++p)
      if (column_[p] >= 0) moved[p] = free.row(column_[p]).transpose();
  }
  Points vertices = rest_;
  for (std::size_t v = 0; v < surface_.of_vertex.size(); ++v)
    if (const int place = surface_.of_vertex[v]; place >= 0)
      vertices.row(static_cast<Eigen::Index>(v)) += moved[static_cast<std::size_t>(place)].transpose();
  return vertices;
}

}  // namespace stackabilization::detail
