#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {
class RelationGraph;
}

namespace stackabilization::detail {

/// Where the controls of a primitive are, since rest.
struct ControlState {
  /// Displacements of the n control points, point by point; of a generalized cylinder then the changes of its
  /// n radii. 3 n or 4 n numbers, model units.
  Eigen::VectorXd values;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< of a generalized cylinder as a whole
};

/// The controls of all parts with the symmetry relations eliminated: parts that symmetries take onto each
/// other form a class, whose first member stands for all of them, and the self-symmetries of that member (its
/// own, and those that close a loop of pairs) confine its controls to a subspace. What is built from the
/// states of the classes is symmetric up to rounding, whatever they are. Symmetries are fixed in space.
class ControlSpace {
 public:
  /// A symmetry that takes the first member of a class onto itself.
  struct Stabiliser {
    int relation = 0;        ///< row of Structure::relations that it comes from
    Eigen::Matrix3d linear;  ///< acts on displacements
    std::vector<int> order;  ///< control point i goes to order[i]
  };

  /// Throws InputError, naming the relation, when primitives that should be symmetric are not so at rest, to
  /// tolerance::relation.
  explicit ControlSpace(const Structure& rest);

  int class_count() const { return static_cast<int>(classes_.size()); }
  int class_of(int part) const { return images_[static_cast<std::size_t>(part)].of_class; }
  /// Parts of a class, ascending; the first stands for all.
  const std::vector<int>& members(int of_class) const {
    return classes_[static_cast<std::size_t>(of_class)].members;
  }
  const std::vector<Stabiliser>& stabilisers(int of_class) const {
    return classes_[static_cast<std::size_t>(of_class)].stabilisers;
  }
  /// Control point of the first member of its class that control point `point` of `part` is the image of.
  int counterpart(int part, int point) const {
    return images_[static_cast<std::size_t>(part)].inverse_order[static_cast<std::size_t>(point)];
  }
  const Primitive& rest(int part) const { return rest_[static_cast<std::size_t>(part)]; }

  /// States of the classes, read off their first members and made invariant.
  std::vector<ControlState> states(const std::vector<Primitive>& now) const;
  /// The parts of the state of a class, the primitives at rest to the bit for a state of zeros.
  Primitive primitive(int part, const ControlState& state) const;
  std::vector<Primitive> primitives(const std::vector<ControlState>& states) const;
  /// The state of the class for which `part` is as given, not yet made invariant.
  ControlState state_of(int part, const Primitive& now) const;
  /// Orthogonal projection onto what the stabilisers leave alone.
  ControlState invariant(int of_class, ControlState state) const;
  Eigen::MatrixXd invariant_columns(int of_class, const Eigen::MatrixXd& columns) const;

  /// 3 x m: moves of control point `point` of `part` by m columns of changes of its class.
  Eigen::Matrix<double, 3, Eigen::Dynamic> point_rows(int part, int point,
                                                      const Eigen::MatrixXd& columns) const;
  /// 1 x m: changes of the radius of its section.
  Eigen::RowVectorXd radius_row(int part, int section, const Eigen::MatrixXd& columns) const;
  /// What the isometry that takes the first member to `part` does to displacements, and to rotation vectors.
  const Eigen::Matrix3d& linear(int part) const { return images_[static_cast<std::size_t>(part)].linear; }
  Eigen::Matrix3d axial(int part) const { return linear(part).determinant() * linear(part); }

 private:
  struct Image {
    int of_class = -1;
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    std::vector<int> order, inverse_order;  ///< from the first member's control points, and back
  };
  struct Class {
    std::vector<int> members;
    std::vector<Stabiliser> stabilisers;
    Eigen::MatrixXd projector;           ///< of values; empty without stabilisers
    Eigen::Matrix3d rotation_projector;  ///< of rotation vectors
  };

  /// Walks from `first` along the pairs of the graph; `orders` are the correspondences of the symmetry
  /// relations.
  void spread_class(int first, const Structure& rest, const RelationGraph& graph,
                    const std::vector<std::vector<int>>& orders);
  void add_stabiliser(int relation, const Structure& rest, const std::vector<int>& order);
  void prepare_projectors(Class& of_class) const;

  std::vector<Primitive> rest_;
  std::vector<Image> images_;  ///< per part
  std::vector<Class> classes_;
  std::vector<bool> tree_;  ///< per relation: it carried a class from one part to the next
};

}  // namespace stackabilization::detail
