#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "stackabilization/deformation/wire_analysis.h"

/// Not installed.
namespace stackabilization::detail {

/// A vertex of one wire and the point of another that keep their offset where they can.
struct WireLink {
  int wire, node;
  int other;
  Eigen::Vector3d point;  ///< of `other`, at rest
  bool slides = false;    ///< the point may slide along `other`, a segment with the point inside
};

/// The vertices of wires as one numbered set of nodes, and what is derived from a WireStructure once.
struct WireNetwork {
  WireStructure structure;
  double diagonal = 0;                     ///< of the bounding box of the shape, model units
  double tolerance = 0;                    ///< of relations, model units
  double mean_length = 0;                  ///< of the wires, model units
  std::vector<std::int32_t> vertices;      ///< of the nodes, rows of Shape::vertices, ascending
  std::vector<Eigen::Vector3d> points;     ///< of the nodes
  std::vector<std::vector<int>> nodes;     ///< of each wire, along it
  std::vector<std::vector<int>> wires_at;  ///< of each node, ascending
  std::vector<int> class_of;  ///< of each wire, row of WireStructure::parallel; -1 for curved ones
  /// Of each wire: Wire::axis, made exactly parallel and symmetric where the relations say so.
  std::vector<Eigen::Vector3d> axes;
  std::vector<WireLink> links;
};

/// `link_distance`, model units: every vertex of a wire is linked to the nearest point of another network of
/// joined wires when that is no farther away. `tolerance`, model units: how well relations hold at
/// rest.
WireNetwork wire_network(const Shape& shape, WireStructure structure, double link_distance, double tolerance);

/// A wire and the linear part of the symmetries that lead to it.
struct WireImage {
  int wire;
  Eigen::Matrix3d linear;
};

/// Wire `wire` itself, then its images under the symmetries and their products, each once.
std::vector<WireImage> images_of(const WireStructure& structure, int wire);

/// Where the maps of the wires take the nodes: a junction to the mean over its wires, but the nodes of wire
/// `exact` to where that one takes them.
std::vector<Eigen::Vector3d> node_positions(const WireNetwork& network,
                                            const std::vector<Eigen::Affine3d>& maps, int exact);

}  // namespace stackabilization::detail
