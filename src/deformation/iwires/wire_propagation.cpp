#include "deformation/iwires/wire_propagation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "deformation/iwires/wire_modes.h"
#include "deformation/iwires/wire_turns.h"
#include "numerics/constrained_least_squares.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

using Row = ConstrainedLeastSquares::Row;
using Rows3 = std::array<Row, 3>;
using Turns = std::vector<Eigen::Matrix3d>;

/// Weights of objective terms, relative to that of keeping the positions of wires.
constexpr double weight_of_shape = 64;  ///< size and shape of curved wires
constexpr double weight_of_links = 64;  ///< offset of linked wires
/// Scale of the equations of symmetries: they hold more exactly than relations that were measured with noise.
constexpr double factor_of_symmetry = 32;
constexpr int max_rounds = 16;
constexpr double thin_angle = 0.1;  ///< sine below which two directions of sliding count as one

/// Subject of an equation, for the refusal when the equation is violated.
struct Demand {
  RefusalCause cause;
  int wire = -1, other = -1;
};

/// The least-squares problem of one edit.
class PropagationProblem {
 public:
  PropagationProblem(const WireNetwork& network, const WireMaps& now, const WireEdit& edit, Turns turns)
      : structure_(network.structure), network_(network), now_(now), edit_(edit), turns_(std::move(turns)) {
    for (std::size_t k = 0; k < structure_.wires.size(); ++k)
      centres_.push_back(now[k] * structure_.wires[k].centre);
    make_axes();
    modes_ = wire_modes(structure_, axes_, edit);
    problem_.emplace(modes_.variables);
    fix_edited();
    wish_to_stay();
    wish_links();
    demand_junctions();
    demand_planes();
    demand_symmetries();
  }

  void hold(const WireHolds& holds) {
    for (std::size_t i = 0; i < network_.vertices.size(); ++i)
      if (std::binary_search(holds.vertices.begin(), holds.vertices.end(), network_.vertices[i]))
        for (const int k : network_.wires_at[i])
          demand_zero(displacement(k, point(k, static_cast<int>(i))), {RefusalCause::fixed_wire, k});
    if (holds.height) hold_height(*holds.height);
  }

  /// Solves the problem. Fixes the size of wires that would be flattened and solves again, until there are
  /// none.
  PropagatedWires solve() {
    for (int round = 0; round < max_rounds; ++round) {
      const auto solution = problem_->solve(tolerance::rounding * network_.diagonal);
      const std::vector<int> flattened = collapses(solution.values);
      if (flattened.empty()) return result_of(solution);
      for (const int k : flattened) {
        if (k == edit_.wire) return flattened_result(k);
        for (const WireMode& mode : modes(k)) problem_->fix(mode.variable, 0);
      }
    }
    return flattened_result(edit_.wire);
  }

 private:
  int count() const { return static_cast<int>(structure_.wires.size()); }
  const Wire& wire(int k) const { return structure_.wires[static_cast<std::size_t>(k)]; }

  Eigen::Matrix3d change(int k, const Eigen::VectorXd& values) const {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    for (const WireMode& mode : modes(k)) linear += values(mode.variable) * mode.matrix;
    return linear;
  }

  std::vector<int> collapses(const Eigen::VectorXd& values) const {
    std::vector<int> flattened;
    for (int k = 0; k < count(); ++k)
      if (change(k, values).determinant() <= tolerance::collapse) flattened.push_back(k);
    return flattened;
  }

  PropagatedWires flattened_result(int k) const {
    return {now_, std::numeric_limits<double>::infinity(), wire(k).length,
            Refusal{.cause = RefusalCause::collapsed_wire, .index = k}};
  }

  PropagatedWires result_of(const ConstrainedLeastSquares::Solution& solution) const {
    PropagatedWires result;
    for (int k = 0; k < count(); ++k) {
      Eigen::Affine3d step = Eigen::Affine3d::Identity();
      step.linear() = change(k, solution.values) * turn(k);
      step.translation() = centre(k) + solution.values.segment<3>(3 * k) - step.linear() * centre(k);
      result.maps.push_back(step * now_[static_cast<std::size_t>(k)]);
    }
    for (std::size_t i = 0; i < demands_.size(); ++i) {
      const bool measured =
          demands_[i].cause == RefusalCause::wire_junction || demands_[i].cause == RefusalCause::wire_plane;
      const double exact = tolerance::relation * network_.diagonal;
      const double violation = std::abs(solution.residual(static_cast<Eigen::Index>(i))) /
                               (demands_[i].cause == RefusalCause::wire_image ? factor_of_symmetry : 1);
      double excess = violation / (measured ? std::max(network_.tolerance, exact) : exact);
      if (std::isnan(excess)) excess = std::numeric_limits<double>::infinity();
      if (excess <= result.excess) continue;
      result.excess = excess;
      result.violation = violation;
      result.missed = {.cause = demands_[i].cause, .index = demands_[i].wire, .other = demands_[i].other};
    }
    return result;
  }

  const std::vector<WireMode>& modes(int k) const { return modes_.of_wire[static_cast<std::size_t>(k)]; }
  const Eigen::Matrix3d& turn(int k) const { return turns_[static_cast<std::size_t>(k)]; }
  const Eigen::Vector3d& centre(int k) const { return centres_[static_cast<std::size_t>(k)]; }
  const Eigen::Vector3d& axis(int k) const { return axes_[static_cast<std::size_t>(k)]; }
  const std::vector<int>& nodes(int k) const { return network_.nodes[static_cast<std::size_t>(k)]; }

  /// Returns the current position of a node on wire k.
  Eigen::Vector3d point(int k, int node) const {
    return now_[static_cast<std::size_t>(k)] * network_.points[static_cast<std::size_t>(node)];
  }

  /// Computes directions and normals after the turns.
  void make_axes() {
    for (int k = 0; k < count(); ++k) {
      const Eigen::Matrix3d linear = turn(k) * now_[static_cast<std::size_t>(k)].linear();
      const Eigen::Vector3d& rest = network_.axes[static_cast<std::size_t>(k)];
      axes_.push_back(wire(k).form == WireForm::straight
                          ? (linear * rest).normalized()
                          : (linear.inverse().transpose() * rest).normalized());
    }
  }

  /// Fixes the edited wire and its images at the positions that the edit prescribes.
  void fix_edited() {
    for (const WireImage& image : images_of(structure_, edit_.wire)) {
      const Eigen::Vector3d by = image.linear * edit_.by;
      for (int c = 0; c < 3; ++c) problem_->fix(3 * image.wire + c, by(c));
      for (const WireMode& mode : modes(image.wire)) {
        const double growth = edit_.motion == WireMotion::scale ? edit_.factor - 1 : 0;
        // Each mode is a multiple of a projection or of an elementary matrix e_i e_j^T. The trace of the
        // latter is zero unless i = j.
        const double trace = mode.matrix.trace(), size = mode.matrix.norm();
        problem_->fix(mode.variable, std::abs(trace) > size / 2 ? growth * trace / (size * size) : 0);
      }
    }
  }

  /// Returns the rows of the displacement of the point x by wire k, without the displacement by its turn.
  Rows3 displacement(int k, const Eigen::Vector3d& x) const {
    const Eigen::Vector3d arm = turn(k) * (x - centre(k));
    Rows3 rows;
    for (int c = 0; c < 3; ++c) rows[static_cast<std::size_t>(c)].push_back({3 * k + c, 1});
    for (const WireMode& mode : modes(k)) {
      const Eigen::Vector3d change = mode.matrix * arm;
      for (int c = 0; c < 3; ++c)
        if (change(c) != 0) rows[static_cast<std::size_t>(c)].push_back({mode.variable, change(c)});
    }
    return rows;
  }

  /// Returns the displacement of the point x by the turn of wire k.
  Eigen::Vector3d turned(int k, const Eigen::Vector3d& x) const {
    return (turn(k) - Eigen::Matrix3d::Identity()) * (x - centre(k));
  }

  static Row combined(const Rows3& rows, const Eigen::Vector3d& along) {
    Row row;
    for (int c = 0; c < 3; ++c)
      for (const auto& term : rows[static_cast<std::size_t>(c)])
        if (along(c) != 0) row.push_back({term.variable, along(c) * term.factor});
    return row;
  }

  static Rows3 difference(Rows3 a, const Rows3& b) {
    for (std::size_t c = 0; c < 3; ++c)
      for (const auto& term : b[c]) a[c].push_back({term.variable, -term.factor});
    return a;
  }

  void add_equality(Row row, double right, const Demand& about) {
    if (about.cause == RefusalCause::wire_image) {
      for (auto& term : row) term.factor *= factor_of_symmetry;
      right *= factor_of_symmetry;
    }
    problem_->add_equality(row, right);
    demands_.push_back(about);
  }

  void demand_equal(const Rows3& rows, const Eigen::Vector3d& right, const Demand& about) {
    for (int c = 0; c < 3; ++c) add_equality(rows[static_cast<std::size_t>(c)], right(c), about);
  }

  void demand_zero(const Rows3& rows, const Demand& about) {
    demand_equal(rows, Eigen::Vector3d::Zero(), about);
  }

  double weight(int k) const { return std::min(wire(k).length / network_.mean_length, 1.0); }

  void wish_to_stay() {
    for (int k = 0; k < count(); ++k) {
      const bool straight = wire(k).form == WireForm::straight;
      std::vector<int> held = nodes(k);
      if (straight) held = {held.front(), held.back()};
      for (const int node : held)
        for (const Row& row : displacement(k, point(k, node)))
          problem_->add_soft(row, 0, weight(k) / static_cast<double>(held.size()));
      if (!straight)
        for (const WireMode& mode : modes(k))
          problem_->add_soft({{mode.variable, 1}}, 0, weight_of_shape * weight(k));
    }
  }

  /// Returns the projection `across` without the direction of the segment k, so that sliding along it is
  /// free.
  Eigen::Matrix3d without_sliding(int k, const Eigen::Matrix3d& across) const {
    const Eigen::Vector3d left = across * axis(k);
    if (left.norm() <= thin_angle) return across;
    return across - left.normalized() * left.normalized().transpose();
  }

  bool inside_segment(int k, int node) const {
    return wire(k).form == WireForm::straight && node != nodes(k).front() && node != nodes(k).back();
  }

  void wish_links() {
    for (const WireLink& link : network_.links) {
      const Eigen::Vector3d a = point(link.wire, link.node);
      const Eigen::Vector3d b = now_[static_cast<std::size_t>(link.other)] * link.point;
      const Rows3 rows = difference(displacement(link.wire, a), displacement(link.other, b));
      const Eigen::Vector3d right = turned(link.other, b) - turned(link.wire, a);
      Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
      if (link.slides) across = without_sliding(link.other, across);
      if (inside_segment(link.wire, link.node)) across = without_sliding(link.wire, across);
      const double strength = weight_of_links * std::min(weight(link.wire), weight(link.other));
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d along = across.col(c);
        problem_->add_soft(combined(rows, along), along.dot(right), strength);
      }
    }
  }

  void demand_junctions() {
    for (std::size_t i = 0; i < network_.wires_at.size(); ++i) {
      const auto& wires = network_.wires_at[i];
      for (std::size_t j = 1; j < wires.size(); ++j) {
        const int a = wires.front(), b = wires[j];
        const Eigen::Vector3d at_a = point(a, static_cast<int>(i)), at_b = point(b, static_cast<int>(i));
        demand_equal(difference(displacement(a, at_a), displacement(b, at_b)),
                     turned(b, at_b) - turned(a, at_a), {RefusalCause::wire_junction, b, a});
      }
    }
  }

  /// Returns the common normal of a plane after the linear maps of its wires; nothing when their normals
  /// differ.
  template <typename LinearMap>
  static std::optional<Eigen::Vector3d> common_normal(const WirePlane& plane, const LinearMap& map) {
    std::optional<Eigen::Vector3d> normal;
    for (const int k : plane.wires) {
      const Eigen::Vector3d own = (map(k).inverse().transpose() * plane.normal).normalized();
      if (!normal) normal = own;
      if (own.cross(*normal).norm() > tolerance::relative) return std::nullopt;
    }
    return normal;
  }

  void demand_planes() {
    for (const WirePlane& plane : structure_.planes) {
      const auto now = [&](int k) -> Eigen::Matrix3d { return now_[static_cast<std::size_t>(k)].linear(); };
      const auto before = common_normal(plane, now);
      const auto after = common_normal(plane, [&](int k) -> Eigen::Matrix3d { return turn(k) * now(k); });
      if (!before || !after) continue;
      const int first = plane.wires.front();
      for (const int k : plane.wires) {
        if (k == first) continue;
        const Eigen::Vector3d between = centre(k) - centre(first);
        Row row;
        for (int c = 0; c < 3; ++c) {
          row.push_back({3 * k + c, (*after)(c)});
          row.push_back({3 * first + c, -(*after)(c)});
        }
        add_equality(row, before->dot(between) - after->dot(between), {RefusalCause::wire_plane, k, first});
      }
    }
  }

  void demand_symmetries() {
    for (const WireSymmetry& pair : structure_.symmetric) {
      const Eigen::Isometry3d map =
          isometry_of(structure_.symmetries[static_cast<std::size_t>(pair.symmetry)]);
      const Eigen::Matrix3d q = map.linear();
      const int a = pair.wire, b = pair.image;
      const Demand about{RefusalCause::wire_image, b, a};
      Rows3 rows;
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          if (q(c, d) != 0) rows[static_cast<std::size_t>(c)].push_back({3 * a + d, q(c, d)});
      const Eigen::Vector3d image = map * centre(a);
      demand_equal(difference(displacement(b, image), rows), -turned(b, image), about);
      if (wire(a).form == WireForm::planar || wire(a).form == WireForm::spatial)
        demand_same_change(a, b, q, about);
    }
  }

  /// Demands that the linear change of b is that of a, conjugated by q.
  void demand_same_change(int a, int b, const Eigen::Matrix3d& q, const Demand& about) {
    const double size = wire(b).length / 2;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Row row;
        for (const WireMode& mode : modes(b)) row.push_back({mode.variable, size * mode.matrix(i, j)});
        for (const WireMode& mode : modes(a))
          row.push_back({mode.variable, -size * (q * mode.matrix * q.transpose())(i, j)});
        add_equality(row, 0, about);
      }
  }

  void hold_height(const Eigen::Vector3d& along) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto each_node = [&](const auto& visit) {
      for (int k = 0; k < count(); ++k)
        for (const int node : nodes(k)) visit(k, point(k, node), along.dot(point(k, node)));
    };
    each_node([&](int, const Eigen::Vector3d&, double height) {
      low = std::min(low, height);
      high = std::max(high, height);
    });
    const double slack = tolerance::relative * network_.diagonal;
    each_node([&](int k, const Eigen::Vector3d& x, double height) {
      if (height > low + slack && height < high - slack) return;
      add_equality(combined(displacement(k, x), along), -along.dot(turned(k, x)),
                   {RefusalCause::wire_extent, k});
    });
  }

  const WireStructure& structure_;
  const WireNetwork& network_;
  const WireMaps& now_;
  const WireEdit& edit_;
  Turns turns_;
  std::vector<Eigen::Vector3d> centres_, axes_;
  WireModes modes_;
  std::optional<ConstrainedLeastSquares> problem_;
  std::vector<Demand> demands_;
};

}  // namespace

PropagatedWires propagate(const WireNetwork& network, const WireMaps& now, const WireEdit& edit,
                          const WireHolds& holds) {
  const std::size_t count = network.structure.wires.size();
  const bool turning = edit.motion == WireMotion::turn;
  const auto solve = [&](Turns turns) {
    PropagationProblem problem(network, now, edit, std::move(turns));
    problem.hold(holds);
    return problem.solve();
  };
  PropagatedWires result = solve(turning ? spread_turn(network, edit.wire, edit.linear)
                                         : Turns(count, Eigen::Matrix3d::Identity()));
  if (!turning || result.excess <= 1) return result;
  PropagatedWires whole = solve(Turns(count, edit.linear));
  return whole.excess < result.excess ? whole : result;
}

}  // namespace stackabilization::detail
