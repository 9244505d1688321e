#include "deformation/iwires/wire_network.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "core/disjoint_sets.h"

namespace stackabilization::detail {

namespace {

void number_nodes(const Shape& shape, WireNetwork& network) {
  const WireStructure& structure = network.structure;
  for (const Wire& wire : structure.wires)
    network.vertices.insert(network.vertices.end(), wire.curve.vertices.begin(), wire.curve.vertices.end());
  std::sort(network.vertices.begin(), network.vertices.end());
  network.vertices.erase(std::unique(network.vertices.begin(), network.vertices.end()),
                         network.vertices.end());
  network.wires_at.resize(network.vertices.size());
  for (const std::int32_t v : network.vertices) network.points.push_back(shape.vertices.row(v).transpose());
  for (std::size_t k = 0; k < structure.wires.size(); ++k) {
    network.mean_length += structure.wires[k].length / static_cast<double>(structure.wires.size());
    std::vector<int> nodes;
    for (const std::int32_t v : structure.wires[k].curve.vertices) {
      const auto node =
          std::lower_bound(network.vertices.begin(), network.vertices.end(), v) - network.vertices.begin();
      nodes.push_back(static_cast<int>(node));
      network.wires_at[static_cast<std::size_t>(node)].push_back(static_cast<int>(k));
    }
    network.nodes.push_back(std::move(nodes));
  }
}

/// Computes WireNetwork::axes. Parallel wires share one axis; `sign` turns the axis of a wire into that of
/// its class.
void align_axes(WireNetwork& network) {
  const WireStructure& structure = network.structure;
  network.class_of.assign(structure.wires.size(), -1);
  std::vector<double> sign(structure.wires.size(), 1);
  std::vector<Eigen::Vector3d> axes;
  for (const auto& parallel : structure.parallel) {
    const Eigen::Vector3d first = structure.wires[static_cast<std::size_t>(parallel.front())].axis;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int k : parallel) {
      const Wire& wire = structure.wires[static_cast<std::size_t>(k)];
      sign[static_cast<std::size_t>(k)] = wire.axis.dot(first) < 0 ? -1 : 1;
      sum += sign[static_cast<std::size_t>(k)] * wire.length * wire.axis;
      network.class_of[static_cast<std::size_t>(k)] = static_cast<int>(axes.size());
    }
    axes.push_back(sum.normalized());
  }
  std::vector<int> row = network.class_of;
  for (std::size_t k = 0; k < structure.wires.size(); ++k)
    if (row[k] < 0) {
      row[k] = static_cast<int>(axes.size());
      axes.push_back(structure.wires[k].axis);
    }
  // Average over symmetric pairs until all agree: after one sweep for symmetries that commute, after a few
  // for others.
  constexpr int sweeps = 16;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const WireSymmetry& pair : structure.symmetric) {
      const Eigen::Matrix3d q =
          isometry_of(structure.symmetries[static_cast<std::size_t>(pair.symmetry)]).linear();
      Eigen::Vector3d& a = axes[static_cast<std::size_t>(row[static_cast<std::size_t>(pair.wire)])];
      Eigen::Vector3d& b = axes[static_cast<std::size_t>(row[static_cast<std::size_t>(pair.image)])];
      if (a.isZero(0) || b.isZero(0)) continue;
      const Eigen::Vector3d image = q * a;
      const double s = image.dot(b) < 0 ? -1 : 1;
      b = (b + s * image).normalized();
      a = s * q.transpose() * b;
    }
  for (std::size_t k = 0; k < structure.wires.size(); ++k)
    network.axes.push_back(sign[k] * axes[static_cast<std::size_t>(row[k])]);
}

/// Returns the link of `node` to the nearest point of the wires of other networks within `distance`.
std::optional<WireLink> nearest_point(const WireNetwork& network, const std::vector<std::size_t>& network_of,
                                      std::size_t node, double distance) {
  const Eigen::Vector3d& from = network.points[node];
  const int wire = network.wires_at[node].front();
  std::optional<WireLink> best;
  for (std::size_t k = 0; k < network.nodes.size(); ++k) {
    if (network_of[k] == network_of[static_cast<std::size_t>(wire)]) continue;
    const std::vector<int>& nodes = network.nodes[k];
    const Wire& other = network.structure.wires[k];
    for (std::size_t i = 0; i + (other.curve.closed ? 0 : 1) < nodes.size(); ++i) {
      const Eigen::Vector3d& a = network.points[static_cast<std::size_t>(nodes[i])];
      const Eigen::Vector3d along =
          network.points[static_cast<std::size_t>(nodes[(i + 1) % nodes.size()])] - a;
      const double share = std::clamp((from - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const Eigen::Vector3d point = a + share * along;
      const double d = (point - from).norm();
      if (d > distance || (best && d == distance)) continue;
      distance = d;
      const bool at_end = (i == 0 && share == 0) || (i + 2 == nodes.size() && share == 1);
      best = WireLink{wire, static_cast<int>(node), static_cast<int>(k), point,
                      other.form == WireForm::straight && !at_end};
    }
  }
  return best;
}

void find_links(double distance, WireNetwork& network) {
  DisjointSets joined(network.nodes.size());
  for (const auto& wires : network.wires_at)
    for (const int k : wires)
      joined.join(static_cast<std::size_t>(wires.front()), static_cast<std::size_t>(k));
  std::vector<std::size_t> network_of;
  for (std::size_t k = 0; k < network.nodes.size(); ++k) network_of.push_back(joined.root(k));
  for (std::size_t i = 0; i < network.points.size(); ++i)
    if (const auto link = nearest_point(network, network_of, i, distance)) network.links.push_back(*link);
}

}  // namespace

WireNetwork wire_network(const Shape& shape, WireStructure structure, double link_distance,
                         double tolerance) {
  WireNetwork network;
  Eigen::AlignedBox3d box;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
  network.diagonal = box.diagonal().norm();
  network.structure = std::move(structure);
  number_nodes(shape, network);
  align_axes(network);
  network.tolerance = tolerance;
  find_links(link_distance, network);
  return network;
}

std::vector<WireImage> images_of(const WireStructure& structure, int wire) {
  std::vector<WireImage> images = {{wire, Eigen::Matrix3d::Identity()}};
  std::vector<char> seen(structure.wires.size(), 0);
  seen[static_cast<std::size_t>(wire)] = 1;
  for (std::size_t i = 0; i < images.size(); ++i)
    for (const WireSymmetry& pair : structure.symmetric) {
      if (pair.wire != images[i].wire || seen[static_cast<std::size_t>(pair.image)]) continue;
      seen[static_cast<std::size_t>(pair.image)] = 1;
      const Eigen::Matrix3d q =
          isometry_of(structure.symmetries[static_cast<std::size_t>(pair.symmetry)]).linear();
      images.push_back({pair.image, q * images[i].linear});
    }
  return images;
}

std::vector<Eigen::Vector3d> node_positions(const WireNetwork& network,
                                            const std::vector<Eigen::Affine3d>& maps, int exact) {
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < network.points.size(); ++i) {
    const std::vector<int>& wires = network.wires_at[i];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int k : wires) sum += maps[static_cast<std::size_t>(k)] * network.points[i];
    positions.push_back(std::find(wires.begin(), wires.end(), exact) != wires.end()
                            ? Eigen::Vector3d(maps[static_cast<std::size_t>(exact)] * network.points[i])
                            : Eigen::Vector3d(sum / static_cast<double>(wires.size())));
  }
  return positions;
}

}  // namespace stackabilization::detail
