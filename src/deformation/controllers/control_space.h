#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {
class RelationGraph;
}

namespace stackabilization::detail {

/// Changes of the controls of a primitive since rest.
struct ControlState {
  /// Displacements of the n control points, three numbers per point; for a generalized cylinder then the
  /// changes of its n radii. 3 n or 4 n numbers, model units.
  Eigen::VectorXd values;
  /// Rotation of a generalized cylinder as a whole since rest.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Control values of all parts after elimination of the symmetry relations. A class is an orbit of parts: the
/// parts that symmetries map onto each other. The first member of a class represents it. The stabiliser of
/// the first member consists of its own self-symmetries and of those that close a loop of pairs. It confines
/// the control values of the class to a subspace. Primitives computed from invariant states are symmetric up
/// to rounding, whatever the states are. Symmetry planes and axes are fixed in space.
class ControlSpace {
 public:
  /// A symmetry that maps the first member of a class onto itself.
  struct Stabiliser {
    int relation = 0;        ///< row of Structure::relations that it comes from
    Eigen::Matrix3d linear;  ///< linear part of the symmetry, acts on displacements
    std::vector<int> order;  ///< the symmetry maps control point i to control point order[i]
  };

  /// Throws InputError, naming the relation, when the primitives at rest violate a symmetry relation by more
  /// than tolerance::relation of the diagonal.
  explicit ControlSpace(const Structure& rest);

  int class_count() const { return static_cast<int>(classes_.size()); }
  int class_of(int part) const { return images_[static_cast<std::size_t>(part)].of_class; }
  /// Returns the parts of a class, ascending; the first one represents the class.
  const std::vector<int>& members(int of_class) const {
    return classes_[static_cast<std::size_t>(of_class)].members;
  }
  const std::vector<Stabiliser>& stabilisers(int of_class) const {
    return classes_[static_cast<std::size_t>(of_class)].stabilisers;
  }
  /// Returns the control point of the first member whose image is control point `point` of `part`.
  int counterpart(int part, int point) const {
    return images_[static_cast<std::size_t>(part)].inverse_order[static_cast<std::size_t>(point)];
  }
  const Primitive& rest(int part) const { return rest_[static_cast<std::size_t>(part)]; }

  /// Computes the invariant states of all classes from the primitives of their first members.
  std::vector<ControlState> states(const std::vector<Primitive>& now) const;
  /// Computes the primitive of `part` from the state of its class. For a state of zeros the result equals the
  /// primitive at rest bit for bit.
  Primitive primitive(int part, const ControlState& state) const;
  std::vector<Primitive> primitives(const std::vector<ControlState>& states) const;
  /// Computes the state of the class from the primitive `now` of `part`. The state is not yet projected to
  /// the invariant subspace.
  ControlState state_of(int part, const Primitive& now) const;
  /// Projects orthogonally onto the subspace that all stabilisers leave invariant.
  ControlState invariant(int of_class, ControlState state) const;
  Eigen::MatrixXd invariant_columns(int of_class, const Eigen::MatrixXd& columns) const;

  /// Returns the 3 x m displacements of control point `point` of `part` for m columns of changes of the
  /// control values of its class.
  Eigen::Matrix<double, 3, Eigen::Dynamic> point_rows(int part, int point,
                                                      const Eigen::MatrixXd& columns) const;
  /// Returns the 1 x m changes of the radius of `section` of `part` for the same columns.
  Eigen::RowVectorXd radius_row(int part, int section, const Eigen::MatrixXd& columns) const;
  /// Returns the linear part of the isometry that maps the first member to `part`: `linear` acts on
  /// displacements, `axial` on rotation vectors.
  const Eigen::Matrix3d& linear(int part) const { return images_[static_cast<std::size_t>(part)].linear; }
  Eigen::Matrix3d axial(int part) const { return linear(part).determinant() * linear(part); }

 private:
  struct Image {
    int of_class = -1;
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    /// Control point of the part for each control point of the first member, and the inverse map.
    std::vector<int> order, inverse_order;
  };
  struct Class {
    std::vector<int> members;
    std::vector<Stabiliser> stabilisers;
    /// Projector of control values onto the invariant subspace; empty without stabilisers.
    Eigen::MatrixXd projector;
    Eigen::Matrix3d rotation_projector;  ///< projector of rotation vectors
  };

  /// Creates the class of `first` by a walk along the symmetric pairs of the graph. `orders`: correspondences
  /// of control points under the symmetry relations.
  void spread_class(int first, const Structure& rest, const RelationGraph& graph,
                    const std::vector<std::vector<int>>& orders);
  void add_stabiliser(int relation, const Structure& rest, const std::vector<int>& order);
  void prepare_projectors(Class& of_class) const;

  std::vector<Primitive> rest_;
  std::vector<Image> images_;  ///< per part
  std::vector<Class> classes_;
  std::vector<bool> tree_;  ///< per relation, whether it is an edge of the spanning tree of a class
};

}  // namespace stackabilization::detail
