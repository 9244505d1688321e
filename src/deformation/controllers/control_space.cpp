#include "deformation/controllers/control_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "core/index.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/structure/relation_graph.h"
#include "structure/model/correspondence.h"

namespace stackabilization::detail {

namespace {

int point_count(const Primitive& primitive) {
  return static_cast<int>(control_points(primitive).rows());
}

bool is_symmetry(const Relation& relation) {
  return relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
}

void check_rest(const Structure& rest) {
  std::vector<Primitive> primitives;
  for (const Part& part : rest.parts) primitives.push_back(part.primitive);
  const std::vector<double> residuals = relation_residuals(rest, primitives);
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (!(residuals[k] <= tolerance::relation))
      throw InputError("relation " + std::to_string(k) + " (" + describe(rest.relations[k], rest) +
                       ") does not hold at rest: its primitives are off by " + std::to_string(residuals[k]) +
                       " of the diagonal");
}

/// Returns the projector onto the null space of `sum`, the sum of (G - 1)^T (G - 1).
Eigen::MatrixXd null_projector(const Eigen::MatrixXd& sum) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(sum);
  Eigen::Index rank = 0;
  while (rank < sum.rows() && solver.eigenvalues()(rank) < tolerance::invariance) ++rank;
  const Eigen::MatrixXd kept = solver.eigenvectors().leftCols(rank);
  return kept * kept.transpose();
}

Eigen::Quaterniond turned(const Eigen::Quaterniond& rotation, const Eigen::Matrix3d& axial) {
  const Eigen::Vector3d axis = axial * rotation.vec();
  return {rotation.w(), axis.x(), axis.y(), axis.z()};
}

}  // namespace

ControlSpace::ControlSpace(const Structure& rest) : images_(rest.parts.size()), tree_(rest.relations.size()) {
  check_rest(rest);
  for (const Part& part : rest.parts) rest_.push_back(part.primitive);
  std::vector<std::vector<int>> orders;
  for (const Relation& relation : rest.relations)
    orders.push_back(is_symmetry(relation) ? control_correspondence(rest_[at(relation.parts.front())],
                                                                    rest_[at(relation.parts.back())],
                                                                    isometry_of(relation.symmetry))
                                           : std::vector<int>());
  const RelationGraph graph(rest);
  for (int part = 0; part < static_cast<int>(rest_.size()); ++part)
    if (class_of(part) < 0) spread_class(part, rest, graph, orders);
  for (std::size_t k = 0; k < orders.size(); ++k)
    if (is_symmetry(rest.relations[k]) && !tree_[k]) add_stabiliser(static_cast<int>(k), rest, orders[k]);
  for (Class& of_class : classes_) prepare_projectors(of_class);
}

void ControlSpace::spread_class(int first, const Structure& rest, const RelationGraph& graph,
                                const std::vector<std::vector<int>>& orders) {
  Image& image = images_[at(first)];
  image.of_class = class_count();
  image.order.resize(at(point_count(rest_[at(first)])));
  std::iota(image.order.begin(), image.order.end(), 0);
  image.inverse_order = image.order;
  std::vector<int> members = {first};
  for (std::size_t next = 0; next < members.size(); ++next)
    for (const int row : graph.incident(members[next])) {
      const Relation& relation = rest.relations[at(row)];
      const int known = members[next], other = graph.opposite(row, known);
      if (relation.type != RelationType::symmetry || class_of(other) >= 0) continue;
      const bool forward = relation.parts[0] == known;
      const std::vector<int>& order = orders[at(row)];
      const Image& from = images_[at(known)];
      const Eigen::Matrix3d map = isometry_of(relation.symmetry).linear();
      Image& to = images_[at(other)];
      to.of_class = from.of_class;
      to.linear = (forward ? map : Eigen::Matrix3d(map.transpose())) * from.linear;
      to.order = composed_order(from.order, forward ? order : inverse_order(order));
      to.inverse_order = inverse_order(to.order);
      tree_[at(row)] = true;
      members.push_back(other);
    }
  std::sort(members.begin(), members.end());
  classes_.push_back({std::move(members), {}, {}, Eigen::Matrix3d::Identity()});
}

void ControlSpace::add_stabiliser(int relation, const Structure& rest, const std::vector<int>& order) {
  const Relation& symmetry = rest.relations[at(relation)];
  const Image &from = images_[at(symmetry.parts.front())], &to = images_[at(symmetry.parts.back())];
  classes_[at(from.of_class)].stabilisers.push_back(
      {relation, to.linear.transpose() * isometry_of(symmetry.symmetry).linear() * from.linear,
       composed_order(composed_order(from.order, order), to.inverse_order)});
}

void ControlSpace::prepare_projectors(Class& of_class) const {
  if (of_class.stabilisers.empty()) return;
  const Primitive& primitive = rest(of_class.members.front());
  const int n = point_count(primitive);
  const int size = std::holds_alternative<Cuboid>(primitive) ? 3 * n : 4 * n;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  Eigen::Matrix3d rotation_sum = Eigen::Matrix3d::Zero();
  for (const Stabiliser& g : of_class.stabilisers) {
    Eigen::MatrixXd change = -Eigen::MatrixXd::Identity(size, size);
    for (int i = 0; i < n; ++i) {
      change.block<3, 3>(3 * g.order[at(i)], 3 * i) += g.linear;
      if (size > 3 * n) change(3 * n + g.order[at(i)], 3 * n + i) += 1;
    }
    sum.noalias() += change.transpose() * change;
    const Eigen::Matrix3d turn = g.linear.determinant() * g.linear - Eigen::Matrix3d::Identity();
    rotation_sum += turn.transpose() * turn;
  }
  of_class.projector = null_projector(sum);
  of_class.rotation_projector = null_projector(rotation_sum);
}

ControlState ControlSpace::state_of(int part, const Primitive& now) const {
  const Image& image = images_[at(part)];
  const Points moved = control_points(now) - control_points(rest(part));
  const Eigen::Index n = moved.rows();
  ControlState state;
  state.values.resize(std::holds_alternative<Cuboid>(now) ? 3 * n : 4 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    state.values.segment<3>(3 * i) =
        image.linear.transpose() * moved.row(image.order[at(static_cast<int>(i))]).transpose();
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&now)) {
    const auto& before = std::get<GeneralizedCylinder>(rest(part));
    for (Eigen::Index i = 0; i < n; ++i) {
      const int k = image.order[at(static_cast<int>(i))];
      state.values(3 * n + i) = cylinder->radii(k) - before.radii(k);
    }
    state.rotation =
        turned((cylinder->rotation * before.rotation.inverse()).normalized(), axial(part).transpose());
  }
  return state;
}

Primitive ControlSpace::primitive(int part, const ControlState& state) const {
  const Image& image = images_[at(part)];
  Primitive now = rest(part);
  const auto move = [&](auto& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(image.order[at(static_cast<int>(i))]) +=
          (image.linear * state.values.segment<3>(3 * i)).transpose();
  };
  if (auto* cuboid = std::get_if<Cuboid>(&now)) {
    move(cuboid->corners);
    return now;
  }
  auto& cylinder = std::get<GeneralizedCylinder>(now);
  move(cylinder.centres);
  const Eigen::Index n = cylinder.radii.size();
  for (Eigen::Index i = 0; i < n; ++i)
    cylinder.radii(image.order[at(static_cast<int>(i))]) += state.values(3 * n + i);
  cylinder.rotation = turned(state.rotation, axial(part)) * cylinder.rotation;
  return now;
}

std::vector<ControlState> ControlSpace::states(const std::vector<Primitive>& now) const {
  std::vector<ControlState> states;
  for (int c = 0; c < class_count(); ++c) {
    const int first = members(c).front();
    states.push_back(invariant(c, state_of(first, now[at(first)])));
  }
  return states;
}

std::vector<Primitive> ControlSpace::primitives(const std::vector<ControlState>& states) const {
  std::vector<Primitive> primitives;
  for (int part = 0; part < static_cast<int>(rest_.size()); ++part)
    primitives.push_back(primitive(part, states[at(class_of(part))]));
  return primitives;
}

Eigen::MatrixXd ControlSpace::invariant_columns(int of_class, const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd& projector = classes_[at(of_class)].projector;
  return projector.size() == 0 ? columns : projector * columns;
}

ControlState ControlSpace::invariant(int of_class, ControlState state) const {
  const Class& c = classes_[at(of_class)];
  if (c.projector.size() == 0) return state;
  state.values = c.projector * state.values;
  const Eigen::AngleAxisd turn(state.rotation);
  const Eigen::Vector3d vector = c.rotation_projector * (turn.angle() * turn.axis());
  const double angle = vector.norm();
  state.rotation = angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle))
                             : Eigen::Quaterniond::Identity();
  return state;
}

Eigen::Matrix<double, 3, Eigen::Dynamic> ControlSpace::point_rows(int part, int point,
                                                                  const Eigen::MatrixXd& columns) const {
  const Image& image = images_[at(part)];
  return image.linear * columns.middleRows<3>(3 * image.inverse_order[at(point)]);
}

Eigen::RowVectorXd ControlSpace::radius_row(int part, int section, const Eigen::MatrixXd& columns) const {
  const Image& image = images_[at(part)];
  return columns.row(static_cast<Eigen::Index>(3 * image.order.size()) + image.inverse_order[at(section)]);
}

}  // namespace stackabilization::detail
