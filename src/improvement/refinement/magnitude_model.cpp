#include "improvement/refinement/magnitude_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/quadratic_programme.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Number of parabolas that successively approximate the length of the displacement.
constexpr int max_parabolas = 3;

/// Largest number of cuts kept, the most nearly active ones, and how far below 0 a cut may lie. Violations
/// are in units of S.
constexpr std::size_t max_cuts = 400;
constexpr double far_below = 0.5;

/// Corrections take back this multiple of the violation, so that iterates do not approach the boundary from
/// outside.
constexpr double excess = 2;

using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector vector_of(const Magnitudes& x) {
  return Vector(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace

/// Quadratic programme of a step. Variables: the step, then one slack per change, or one for the largest
/// violation.
class MagnitudeModel::Programme {
 public:
  explicit Programme(const MagnitudeModel& model)
      : model_(model), size_(static_cast<Eigen::Index>(model.centre_.size())) {
    levels_.resize(static_cast<Eigen::Index>(model.cuts_.size()));
    for (Eigen::Index c = 0; c < levels_.size(); ++c) levels_(c) = model.level(cut(c));
  }

  QuadraticMinimum step(const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest) const {
    QuadraticProgramme programme = linear_part(lowest, highest);
    if (minimal_shortfall() || gram().size() == 0) return minimize(programme);
    QuadraticMinimum result{Eigen::VectorXd::Zero(size_), {}};
    // Every parabola that touches the length bounds it from above. Successive minima approach that of the
    // length.
    for (int round = 0; round < max_parabolas; ++round) {
      const double length = std::max(displacement(result.x.head(size_)), tolerance::relative * scale());
      programme.q.topLeftCorner(size_, size_) = gram().bottomRightCorner(size_, size_) / (length * scale());
      programme.c.head(size_) = gram().col(0).tail(size_) / (length * scale());
      result = minimize(programme);
    }
    return result;
  }

  /// Returns the reduced costs at a minimum, see Step::pull.
  Eigen::VectorXd reduced_costs(const QuadraticMinimum& minimum) const {
    return scale() * (minimum.multipliers.head(size_) + minimum.multipliers.segment(size_, size_));
  }

  /// Returns the predicted merit after a step.
  double merit(const Eigen::VectorXd& step) const {
    if (minimal_shortfall()) {
      double largest = -std::numeric_limits<double>::infinity();
      for (Eigen::Index c = 0; c < levels_.size(); ++c)
        largest = std::max(largest, levels_(c) + cut(c).slope.dot(step));
      return largest;
    }
    double sum = model_.constant_ + displacement(step);
    for (const Row& change : model_.changes_) sum += std::abs(change(0) + change.tail(size_).dot(step));
    return sum;
  }

 private:
  bool minimal_shortfall() const { return model_.goal_ == MagnitudeGoal::feasible; }
  const Cut& cut(Eigen::Index c) const { return model_.cuts_[static_cast<std::size_t>(c)]; }
  const Eigen::MatrixXd& gram() const { return model_.slopes_.gram; }
  /// Returns the divisor that scales changes.
  double scale() const { return minimal_shortfall() || !(model_.base_.change > 0) ? 1 : model_.base_.change; }

  double displacement(const Eigen::VectorXd& step) const {
    if (gram().size() == 0) return 0;
    Eigen::VectorXd from(step.size() + 1);
    from << 1, step;
    return std::sqrt(std::max(0.0, from.dot(gram() * from)));
  }

  /// Returns the programme without the displacement.
  QuadraticProgramme linear_part(const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest) const {
    const auto changes = static_cast<Eigen::Index>(model_.changes_.size());
    const Eigen::Index slacks = minimal_shortfall() ? 1 : changes;
    const Eigen::Index count = size_ + slacks, rows = 2 * size_ + 2 * changes + levels_.size();
    QuadraticProgramme programme{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count),
                                 Eigen::MatrixXd::Zero(rows, count), Eigen::VectorXd::Zero(rows)};
    programme.c.tail(slacks).setOnes();
    programme.a.topLeftCorner(size_, size_).setIdentity();
    programme.a.block(size_, 0, size_, size_) = -Eigen::MatrixXd::Identity(size_, size_);
    programme.b.head(2 * size_) << highest, -lowest;
    Eigen::Index row = 2 * size_;
    for (Eigen::Index g = 0; g < changes; ++g)
      for (const double sign : {1.0, -1.0}) {
        const Row& change = model_.changes_[static_cast<std::size_t>(g)];
        programme.a.row(row).head(size_) = sign * change.tail(size_) / scale();
        programme.a(row, size_ + g) = -1;
        programme.b(row++) = -sign * change(0) / scale();
      }
    for (Eigen::Index c = 0; c < levels_.size(); ++c, ++row) {
      programme.a.row(row).head(size_) = cut(c).slope;
      if (minimal_shortfall()) programme.a(row, size_) = -1;
      programme.b(row) = -levels_(c);
    }
    return programme;
  }

  const MagnitudeModel& model_;
  Eigen::Index size_;
  Eigen::VectorXd levels_;  ///< values of the cuts at the centre
};

MagnitudeModel::MagnitudeModel(MagnitudeGoal goal, Magnitudes centre, const MagnitudeSample& base,
                               const MagnitudeSlopes& slopes)
    : goal_(goal) {
  move_to(std::move(centre), base, slopes);
}

double MagnitudeModel::merit(const MagnitudeSample& sample) const {
  return goal_ == MagnitudeGoal::feasible ? sample.violations.maxCoeff() : sample.change;
}

double MagnitudeModel::level(const Cut& cut) const {
  return cut.value + cut.slope.dot(vector_of(centre_));
}

void MagnitudeModel::move_to(Magnitudes centre, const MagnitudeSample& base, const MagnitudeSlopes& slopes) {
  centre_ = std::move(centre);
  base_ = base;
  slopes_ = slopes;
  std::erase_if(cuts_, [&](const Cut& cut) {
    return level(cut) > base.violations[cut.row] + tolerance::target || level(cut) < -far_below;
  });
  if (cuts_.size() > max_cuts) {
    std::stable_sort(cuts_.begin(), cuts_.end(),
                     [&](const Cut& a, const Cut& b) { return level(a) > level(b); });
    cuts_.resize(max_cuts);
  }
  changes_.clear();
  constant_ = 0;
  if (goal_ == MagnitudeGoal::min_change) group_changes(base, slopes);
  add(centre_, base, slopes);
}

/// Gives changes one common slack if their values and slopes are multiples of each other; these are mostly
/// changes of symmetric parts.
void MagnitudeModel::group_changes(const MagnitudeSample& base, const MagnitudeSlopes& slopes) {
  std::vector<Row> shapes;
  for (Eigen::Index row = 0; row < base.changes.size(); ++row) {
    Row change(1 + slopes.changes.cols());
    change << base.changes[row], slopes.changes.row(row);
    if (change.tail(change.size() - 1).norm() <= tolerance::magnitude * base.change) {
      constant_ += std::abs(base.changes[row]);
      continue;
    }
    const Row shape = change.normalized();
    const auto same = std::find_if(shapes.begin(), shapes.end(), [&](const Row& other) {
      return std::abs(shape.dot(other)) >= 1 - tolerance::magnitude;
    });
    if (same == shapes.end()) {
      shapes.push_back(shape);
      changes_.push_back(change);
    } else {
      changes_[static_cast<std::size_t>(same - shapes.begin())] +=
          shape.dot(*same) < 0 ? Row(-change) : change;
    }
  }
}

void MagnitudeModel::add(const Magnitudes& at, const MagnitudeSample& sample, const MagnitudeSlopes& slopes) {
  std::erase_if(cuts_, [](const Cut& cut) { return !cut.measured; });
  for (Eigen::Index row = 0; row < sample.violations.size(); ++row) {
    const Row slope = slopes.violations.row(row);
    add({row, sample.violations[row] - slope.dot(vector_of(at)), slope, true});
  }
}

void MagnitudeModel::correct(const Magnitudes& at, const MagnitudeSample& sample) {
  for (Eigen::Index row = 0; row < sample.violations.size(); ++row) {
    const Row slope = slopes_.violations.row(row);
    if (sample.violations[row] > 0)
      add({row, excess * sample.violations[row] - slope.dot(vector_of(at)), slope, false});
  }
}

/// Adds a cut unless it repeats another one, or lies far below 0 at the centre when the change is minimised.
void MagnitudeModel::add(Cut cut) {
  // S is not convex: a cut from a distant point may be too high at the centre. It is lowered to the measured
  // value.
  if (cut.measured) cut.value -= std::max(0.0, level(cut) - base_.violations[cut.row]);
  const double now = level(cut);
  if (goal_ == MagnitudeGoal::min_change && now < -far_below) return;
  const bool known = std::any_of(cuts_.begin(), cuts_.end(), [&](const Cut& other) {
    return std::abs(level(other) - now) <= tolerance::magnitude &&
           (other.slope - cut.slope).norm() <= tolerance::magnitude * (1 + cut.slope.norm());
  });
  if (!known) cuts_.push_back(std::move(cut));
}

MagnitudeModel::Step MagnitudeModel::step(const Magnitudes& lowest, const Magnitudes& highest) const {
  const Eigen::VectorXd centre = vector_of(centre_);
  Eigen::VectorXd low = (vector_of(lowest) - centre).cwiseMin(0),
                  high = (vector_of(highest) - centre).cwiseMax(0);
  for (std::size_t k = 0; k < slopes_.refused_below.size(); ++k)
    if (slopes_.refused_below[k]) low(static_cast<Eigen::Index>(k)) = 0;
  for (std::size_t k = 0; k < slopes_.refused_above.size(); ++k)
    if (slopes_.refused_above[k]) high(static_cast<Eigen::Index>(k)) = 0;
  const Programme programme(*this);
  const QuadraticMinimum minimum = programme.step(low, high);
  const Eigen::VectorXd by = minimum.x.head(centre.size());
  Step step{centre_, merit(base_) - programme.merit(by), programme.reduced_costs(minimum)};
  for (std::size_t k = 0; k < centre_.size(); ++k)
    step.to[k] = std::clamp(centre_[k] + by(static_cast<Eigen::Index>(k)), lowest[k], highest[k]);
  return step;
}

}  // namespace stackabilization::detail
