#include "stackabilization/structure/part_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/index.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/model/correspondence.h"

namespace stackabilization {

namespace {

using detail::at;

/// Cosine of the angle within which the nearest part is the next one of a row.
constexpr double same_way = 0.5;

/// A part as the search compares it.
struct RowPart {
  Points points;           ///< control points at rest
  Eigen::Vector3d centre;  ///< mean of the points
  double diagonal;         ///< of the box of the points
};

/// The next part of a row, and how its control points correspond to those of the one before.
struct Step {
  int part;
  std::vector<int> order;
};

class RowSearch {
 public:
  explicit RowSearch(const Structure& structure) : structure_(structure) {
    for (const Part& part : structure.parts) {
      const Points points = control_points(part.primitive);
      const Eigen::RowVector3d extent = points.colwise().maxCoeff() - points.colwise().minCoeff();
      parts_.push_back({points, points.colwise().mean().transpose(), extent.norm()});
    }
  }

  std::vector<PartRow> run() {
    find_steps();
    std::vector<PartRow> rows;
    std::set<std::pair<int, int>> used;
    for (int part = 0; part < count(); ++part)
      for (const Step& first : steps_[at(part)]) {
        if (used.contains({part, first.part}) || opposite(part, first.part)) continue;
        PartRow row{{part}, {identity(part)}};
        for (std::optional<Step> next = first; next; next = after(row)) {
          row.parts.push_back(next->part);
          row.control_points.push_back(composed_order(row.control_points.back(), next->order));
        }
        if (row.parts.size() < 3) continue;
        for (std::size_t k = 1; k < row.parts.size(); ++k) {
          used.emplace(row.parts[k - 1], row.parts[k]);
          used.emplace(row.parts[k], row.parts[k - 1]);
        }
        rows.push_back(std::move(row));
      }
    return rows;
  }

 private:
  int count() const { return static_cast<int>(parts_.size()); }

  std::vector<int> identity(int part) const {
    std::vector<int> order;
    for (Eigen::Index i = 0; i < parts_[at(part)].points.rows(); ++i) order.push_back(static_cast<int>(i));
    return order;
  }

  /// Finds, for each part, the nearest parts of its form in every direction.
  void find_steps() {
    std::vector<std::vector<Step>> alike(parts_.size());
    for (int a = 0; a < count(); ++a)
      for (int b = a + 1; b < count(); ++b)
        if (std::optional<std::vector<int>> order = correspondence(a, b)) {
          alike[at(b)].push_back({a, inverse_order(*order)});
          alike[at(a)].push_back({b, std::move(*order)});
        }
    for (int a = 0; a < count(); ++a) {
      std::vector<Step> found;
      const auto by = [&](const Step& step) { return between(a, step.part); };
      std::stable_sort(alike[at(a)].begin(), alike[at(a)].end(), [&](const Step& one, const Step& other) {
        return by(one).squaredNorm() < by(other).squaredNorm();
      });
      for (Step& step : alike[at(a)])
        if (std::none_of(found.begin(), found.end(), [&](const Step& nearer) {
              return by(nearer).normalized().dot(by(step).normalized()) > same_way;
            }))
          found.push_back(std::move(step));
      steps_.push_back(std::move(found));
    }
  }

  Eigen::Vector3d between(int a, int b) const { return parts_[at(b)].centre - parts_[at(a)].centre; }

  /// Returns which control points of `b` correspond to those of `a` where they are of one form, but apart.
  std::optional<std::vector<int>> correspondence(int a, int b) const {
    const RowPart &one = parts_[at(a)], &other = parts_[at(b)];
    const double allowed = tolerance::row_form * std::min(one.diagonal, other.diagonal);
    const Eigen::Vector3d by = between(a, b);
    if (std::abs(one.diagonal - other.diagonal) > allowed) return std::nullopt;
    if (by.norm() <= tolerance::relative * structure_.diagonal) return std::nullopt;
    std::vector<int> order =
        control_correspondence(primitive(a), primitive(b), Eigen::Isometry3d(Eigen::Translation3d(by)));
    if (order.empty()) return std::nullopt;
    const Eigen::VectorXd radii = radii_of(a);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if ((one.points.row(k) + by.transpose() - other.points.row(order[i])).norm() > allowed)
        return std::nullopt;
      if (radii.size() > 0 && std::abs(radii(k) - radii_of(b)(order[i])) > allowed) return std::nullopt;
    }
    return order;
  }

  const Primitive& primitive(int part) const { return structure_.parts[at(part)].primitive; }

  /// Returns the radii of a generalized cylinder, none of a cuboid.
  Eigen::VectorXd radii_of(int part) const {
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive(part));
    return cylinder ? cylinder->radii : Eigen::VectorXd();
  }

  /// Returns whether the control points and radii of three parts change by even steps; `first`, `second`:
  /// from the middle one to the outer ones.
  bool is_even(int middle, const Step& first, const Step& second) const {
    const Points &points = parts_[at(middle)].points, &before = parts_[at(first.part)].points,
                 &after = parts_[at(second.part)].points;
    const Eigen::VectorXd radii = radii_of(middle), before_radii = radii_of(first.part),
                          after_radii = radii_of(second.part);
    const double allowed = std::min(tolerance::row_step * between(middle, first.part).norm(),
                                    tolerance::row_evenness * structure_.diagonal);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const int k = static_cast<int>(i);
      if ((before.row(first.order[at(k)]) + after.row(second.order[at(k)]) - 2 * points.row(i)).norm() >
          allowed)
        return false;
      if (radii.size() > 0 && std::abs(before_radii(first.order[at(k)]) + after_radii(second.order[at(k)]) -
                                       2 * radii(i)) > allowed)
        return false;
    }
    return true;
  }

  /// Returns the step from `part` that goes on with the one back to `from`.
  const Step* opposite(int part, int from) const {
    const std::vector<Step>& steps = steps_[at(part)];
    const auto back =
        std::find_if(steps.begin(), steps.end(), [&](const Step& step) { return step.part == from; });
    if (back == steps.end()) return nullptr;
    for (const Step& step : steps)
      if (step.part != from && is_even(part, *back, step)) return &step;
    return nullptr;
  }

  /// Returns the step that goes on with a row.
  std::optional<Step> after(const PartRow& row) const {
    const int last = row.parts.back();
    const Step* next = opposite(last, row.parts[row.parts.size() - 2]);
    if (!next || std::find(row.parts.begin(), row.parts.end(), next->part) != row.parts.end())
      return std::nullopt;
    return *next;
  }

  const Structure& structure_;
  std::vector<RowPart> parts_;
  std::vector<std::vector<Step>> steps_;  ///< per part, shortest first
};

}  // namespace

std::vector<PartRow> find_part_rows(const Structure& structure) {
  if (structure.parts.size() > tolerance::max_parts_in_rows) return {};
  return RowSearch(structure).run();
}

}  // namespace stackabilization
