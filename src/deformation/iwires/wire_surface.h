#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "deformation/iwires/wire_fit.h"
#include "deformation/iwires/wire_network.h"
#include "mesh/welded_mesh.h"

/// Not installed.
namespace stackabilization::detail {

/// Carries a surface along with its wires.
///
/// The wires cut the surface into patches. At the rim of a patch each wire has a linear map, fitted to the
/// wire and its neighbours around that patch (wire_fit.h). Harmonic interpolation gives a linear map at every
/// other vertex, and the vertices follow whose edges come nearest to the edges at rest under these maps
/// (harmonic guidance, Zayer et al. 2005), with cotangent weights: two linear solves with one factorization,
/// made once.
///
/// Exact up to rounding: nothing when the wires stay; affine maps of all wires where those around a patch
/// span it; flat patches stay flat when their rim does; between two circles of a cylinder whose vertices lie
/// in rings, the straight lines of the cone.
///
/// Connected pieces without a wire follow the map fitted to their
/// nearest wire and its neighbours.
class WireSurface {
 public:
  /// `pinned`: vertices that always stay where they are, with all of equal coordinates.
  WireSurface(const Shape& rest, const WireNetwork& network, const std::vector<std::int32_t>& pinned);

  /// The vertices (rows as in Shape::vertices) when the nodes of the network are at `nodes`. Pinned ones
  /// stay.
  Points deformed(const std::vector<Eigen::Vector3d>& nodes) const;

 private:
  /// A triangle with a free corner. Corners are free (column >= 0) or known (rim >= 0).
  struct Element {
    std::array<int, 3> place, column, rim;
    std::array<double, 3> weight;  ///< of the edge opposite each corner
  };
  /// A known corner as one patch sees it: its linear map is the mean of these fits.
  using Rim = std::vector<int>;
  struct Follower {
    int place, fit;
  };

  void find_patches();
  void find_columns();
  void find_followers();
  void make_elements();
  void factorize();
  int fit_of(const std::vector<int>& wires);
  std::size_t place_count() const { return static_cast<std::size_t>(surface_.points.rows()); }
  Eigen::Vector3d point(int place) const { return surface_.points.row(place).transpose(); }
  int fit_around(int patch, int wire);
  int rim_of(int patch, int place);
  std::vector<Eigen::Vector3d> known_displacements(const std::vector<Eigen::Vector3d>& nodes,
                                                   const std::vector<Eigen::Matrix3d>& maps) const;
  Eigen::MatrixXd guidance(const std::vector<Eigen::Matrix3d>& rims) const;
  void add_guided(const Element& element, const std::array<Eigen::Matrix3d, 3>& maps,
                  const std::vector<Eigen::Vector3d>& moved, Eigen::MatrixXd& right) const;

  const WireNetwork& network_;
  WeldedMesh surface_;
  Points rest_;
  std::vector<int> node_of_;                  ///< of each place, -1 off the wires
  std::vector<char> pinned_;                  ///< of each place
  std::vector<int> column_;                   ///< of each place, -1 where known
  std::vector<int> patch_of_;                 ///< of each triangle
  std::map<int, std::vector<int>> wires_of_;  ///< of each patch, ascending; key -1: all wires
  std::map<std::vector<int>, int> fit_numbers_;
  std::map<std::pair<int, int>, int> rim_numbers_;
  std::vector<AffineFit> fits_;
  std::vector<Rim> rims_;
  std::vector<Element> elements_;
  std::vector<Follower> followers_;
  int columns_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace stackabilization::detail
