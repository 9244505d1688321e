#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "stackabilization/deformation/wire_analysis.h"

// Wires as a graph of numbered nodes.
namespace stackabilization::detail {

/// A vertex of one wire and a point of another wire that keep their offset if possible.
struct WireLink {
  int wire, node;
  int other;
  Eigen::Vector3d point;  ///< point of `other`, at rest
  /// Whether the point may slide along `other`: `other` is a segment and the point lies inside it.
  bool slides = false;
};

/// The vertices of all wires as one numbered set of nodes, and quantities derived once from a WireStructure.
struct WireNetwork {
  WireStructure structure;
  double diagonal = 0;                     ///< diagonal of the bounding box of the shape, model units
  double tolerance = 0;                    ///< tolerance of relations at rest, model units
  double mean_length = 0;                  ///< mean length of the wires, model units
  std::vector<std::int32_t> vertices;      ///< rows of Shape::vertices of the nodes, ascending
  std::vector<Eigen::Vector3d> points;     ///< positions of the nodes at rest
  std::vector<std::vector<int>> nodes;     ///< nodes of each wire, along it
  std::vector<std::vector<int>> wires_at;  ///< wires at each node, ascending
  std::vector<int> class_of;  ///< row of WireStructure::parallel of each wire; -1 for curved wires
  /// Wire::axis of each wire, made exactly parallel and symmetric as the relations demand.
  std::vector<Eigen::Vector3d> axes;
  std::vector<WireLink> links;
};

/// Creates the network of the wires of a shape. Links every vertex of a wire to the nearest point of another
/// network of joined wires that is within `link_distance`, model units. `tolerance`: accuracy to which
/// relations hold at rest, model units.
WireNetwork wire_network(const Shape& shape, WireStructure structure, double link_distance, double tolerance);

/// An image of a wire, and the linear part of the symmetries that map the wire to this image.
struct WireImage {
  int wire;
  Eigen::Matrix3d linear;
};

/// Returns wire `wire` itself, then its images under the symmetries and their products, each once.
std::vector<WireImage> images_of(const WireStructure& structure, int wire);

/// Computes the positions of the nodes under the maps of the wires. A junction takes the mean over its wires.
/// A node of wire `exact` takes the position under the map of that wire.
std::vector<Eigen::Vector3d> node_positions(const WireNetwork& network,
                                            const std::vector<Eigen::Affine3d>& maps, int exact);

}  // namespace stackabilization::detail
