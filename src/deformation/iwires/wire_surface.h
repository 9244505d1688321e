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

// Deformation of the surface between wires.
namespace stackabilization::detail {

/// Deforms a surface with its wires.
///
/// The wires cut the surface into patches. At the rim of a patch each wire has a linear map, fitted to the
/// wire and its neighbours around that patch (wire_fit.h). Harmonic interpolation gives a linear map at every
/// other vertex. The positions of these vertices are those whose edges come nearest to the edges at rest
/// under these maps (harmonic guidance, Zayer et al. 2005), with cotangent weights. Both steps are linear
/// solves with one factorization, computed once.
///
/// Exact up to rounding: the rest pose when the wires stay; affine maps of all wires, when the wires around
/// each patch span it; flatness of a flat patch, when its rim stays flat; the straight lines of a cone
/// between two circles of a cylinder whose vertices lie in rings.
///
/// Connected components without a wire follow the map fitted to their nearest wire and its neighbours.
class WireSurface {
 public:
  /// `pinned`: rows of Shape::vertices that do not move; vertices of equal coordinates do not move either.
  WireSurface(const Shape& rest, const WireNetwork& network, const std::vector<std::int32_t>& pinned);

  /// Computes the deformed vertices for the positions `nodes` of the nodes of the network: n x 3, rows as in
  /// Shape::vertices. Pinned vertices do not move.
  Points deformed(const std::vector<Eigen::Vector3d>& nodes) const;

 private:
  /// A triangle with a free corner. A corner is free (column >= 0) or known (rim >= 0).
  struct Element {
    std::array<int, 3> place, column, rim;
    std::array<double, 3> weight;  ///< weight of the edge opposite each corner
  };
  /// A known corner of one patch: its linear map is the mean of these fits.
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
  std::vector<int> node_of_;                  ///< node of each place, -1 off the wires
  std::vector<char> pinned_;                  ///< whether each place is pinned
  std::vector<int> column_;                   ///< unknown of each place, -1 for a known position
  std::vector<int> patch_of_;                 ///< patch of each triangle
  std::map<int, std::vector<int>> wires_of_;  ///< wires around each patch, ascending; key -1: all wires
  std::map<std::vector<int>, int> fit_numbers_;
  std::map<std::pair<int, int>, int> rim_numbers_;
  std::vector<WireFit> fits_;
  std::vector<Rim> rims_;
  std::vector<Element> elements_;
  std::vector<Follower> followers_;
  int columns_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace stackabilization::detail
