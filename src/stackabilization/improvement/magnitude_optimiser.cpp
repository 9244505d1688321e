#include "stackabilization/improvement/magnitude_optimiser.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include "stackabilization/shape/tolerances.h"

namespace stackabilization::detail {

namespace {

/// What D is scaled to at the start: the optimiser's first step is about as long as its gradient.
constexpr double scaled_distortion = 10;

/// Added to what is minimised where an edit is refused, so that line searches turn back.
constexpr double refused = 1e3;

/// Calls of one run, also of points known already.
constexpr int most_calls = 200;

using Row = Eigen::RowVectorXd;

/// A sum of changes that grow and shrink together: symmetric parts, mostly.
struct Group {
  std::vector<Eigen::Index> rows;
  std::vector<double> signs;
};

/// The nonlinear programme in the form that NLopt takes: variables are the magnitudes, then slacks (one per
/// group of changes, or the largest shortfall).
class Programme {
 public:
  Programme(MagnitudeProblem& problem, const MagnitudeRun& run)
      : problem_(problem), goal_(run.goal), start_(run.start), radius_(run.radius) {
    const MagnitudeSample base = problem.at(start_);
    const MagnitudeSlopes slopes = problem.slopes(start_);
    if (goal_ == MagnitudeGoal::unchanged) group_changes(base, slopes);
    group_constraints(base, slopes);
    scale_ = base.distortion > 0 ? scaled_distortion / base.distortion : 1;
  }

  MagnitudeRunEnd run() {
    const std::size_t count = problem_.size() + slacks();
    const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
        nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(count)), &nlopt_destroy);
    optimiser_ = optimiser.get();
    std::vector<double> lowest(count, goal_ == MagnitudeGoal::unchanged ? 0 : -infinity_),
        highest(count, infinity_);
    for (std::size_t k = 0; k < problem_.size(); ++k) {
      lowest[k] = std::max(problem_.lowest(), start_[k] - radius_);
      highest[k] = std::min(problem_.highest(), start_[k] + radius_);
    }
    nlopt_set_lower_bounds(optimiser_, lowest.data());
    nlopt_set_upper_bounds(optimiser_, highest.data());
    nlopt_set_min_objective(optimiser_, &Programme::objective, this);
    const std::vector<double> exactly(constraints(), 0);
    nlopt_add_inequality_mconstraint(optimiser_, static_cast<unsigned>(constraints()), &Programme::constraint,
                                     this, exactly.data());
    nlopt_set_xtol_rel(optimiser_, tolerance::magnitude);
    nlopt_set_ftol_rel(optimiser_, tolerance::magnitude);
    nlopt_set_maxeval(optimiser_, most_calls);
    std::vector<double> variables = start_variables();
    double value = 0;
    nlopt_optimize(optimiser_, variables.data(), &value);
    if (error_) std::rethrow_exception(error_);
    variables.resize(problem_.size());
    return {variables, refused_};
  }

 private:
  std::size_t slacks() const { return goal_ == MagnitudeGoal::unchanged ? groups_.size() : 1; }
  std::size_t constraints() const { return 2 * groups_.size() + rows_.size(); }

  /// Changes that are multiples of each other, as values and slopes, have one slack for all.
  void group_changes(const MagnitudeSample& base, const MagnitudeSlopes& slopes) {
    std::vector<Row> shapes;
    for (Eigen::Index row = 0; row < base.changes.size(); ++row) {
      Row shape(1 + slopes.changes.cols());
      shape << base.changes[row], slopes.changes.row(row);
      if (shape.tail(shape.size() - 1).norm() <= tolerance::magnitude * base.distortion) continue;
      shape.normalize();
      const auto same = std::find_if(shapes.begin(), shapes.end(), [&](const Row& other) {
        return std::abs(shape.dot(other)) >= 1 - tolerance::magnitude;
      });
      const auto group = static_cast<std::size_t>(same - shapes.begin());
      if (same == shapes.end()) {
        shapes.push_back(shape);
        groups_.emplace_back();
      }
      groups_[group].rows.push_back(row);
      groups_[group].signs.push_back(shape.dot(shapes[group]) < 0 ? -1 : 1);
    }
  }

  /// Constraints that are the same, as values and slopes, become one, their maximum: optimisers do not like
  /// repetition.
  void group_constraints(const MagnitudeSample& base, const MagnitudeSlopes& slopes) {
    std::vector<Row> shapes;
    for (Eigen::Index row = 0; row < base.shortfalls.size(); ++row) {
      Row shape(1 + slopes.shortfalls.cols());
      shape << base.shortfalls[row], slopes.shortfalls.row(row);
      const auto same = std::find_if(shapes.begin(), shapes.end(), [&](const Row& other) {
        return (shape - other).norm() <= tolerance::magnitude * (1 + shape.norm());
      });
      const auto group = static_cast<std::size_t>(same - shapes.begin());
      if (same == shapes.end()) {
        shapes.push_back(shape);
        rows_.emplace_back();
      }
      rows_[group].push_back(row);
    }
  }

  static Eigen::Index largest(const MagnitudeSample& sample, const std::vector<Eigen::Index>& rows) {
    return *std::max_element(rows.begin(), rows.end(), [&](Eigen::Index a, Eigen::Index b) {
      return sample.shortfalls[a] < sample.shortfalls[b];
    });
  }

  std::vector<double> start_variables() {
    std::vector<double> variables = start_;
    const MagnitudeSample& base = problem_.at(start_);
    if (goal_ == MagnitudeGoal::feasible) {
      variables.push_back(base.shortfalls.maxCoeff());
    }
    for (const Group& group : groups_) variables.push_back(scale_ * std::abs(change(base, group)));
    return variables;
  }

  static double change(const MagnitudeSample& sample, const Group& group) {
    double sum = 0;
    for (std::size_t k = 0; k < group.rows.size(); ++k) sum += group.signs[k] * sample.changes[group.rows[k]];
    return sum;
  }

  static Row slope(const MagnitudeSlopes& slopes, const Group& group) {
    Row sum = Row::Zero(slopes.changes.cols());
    for (std::size_t k = 0; k < group.rows.size(); ++k)
      sum += group.signs[k] * slopes.changes.row(group.rows[k]);
    return sum;
  }

  Magnitudes magnitudes(const double* variables) const {
    return Magnitudes(variables, variables + problem_.size());
  }

  /// Ends the run where there is no more to do, or no more may be done.
  void stop_if_done() {
    const bool found = goal_ == MagnitudeGoal::feasible && problem_.best();
    if (found || problem_.stopped()) nlopt_force_stop(optimiser_);
  }

  double objective(const double* variables, double* gradient) {
    const std::size_t count = problem_.size() + slacks();
    double value = 0;
    for (std::size_t k = problem_.size(); k < count; ++k) value += variables[k];
    if (gradient)
      for (std::size_t k = 0; k < count; ++k) gradient[k] = k < problem_.size() ? 0 : 1;
    if (!problem_.at(magnitudes(variables)).made) {
      refused_ = true;
      value += refused;
    }
    stop_if_done();
    return value;
  }

  void constraint(double* result, const double* variables, double* gradient) {
    const Magnitudes x = magnitudes(variables);
    const MagnitudeSample sample = problem_.at(x);
    const std::size_t size = problem_.size(), count = size + slacks();
    if (gradient) std::fill_n(gradient, constraints() * count, 0.0);
    if (!sample.made) {
      std::fill_n(result, constraints(), refused);
      return;
    }
    std::optional<MagnitudeSlopes> slopes;
    if (gradient) slopes = problem_.slopes(x);
    const auto set = [&](std::size_t row, double value, const Row& slope) {
      result[row] = value;
      if (gradient) std::copy(slope.data(), slope.data() + slope.size(), gradient + row * count);
    };
    std::size_t row = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const double sign : {1.0, -1.0}) {
        const Row along = slopes ? Row(sign * scale_ * slope(*slopes, groups_[g])) : Row();
        set(row, sign * scale_ * change(sample, groups_[g]) - variables[size + g], along);
        if (gradient) gradient[row * count + size + g] = -1;
        ++row;
      }
    for (const std::vector<Eigen::Index>& rows : rows_) {
      const Eigen::Index of = largest(sample, rows);
      const double slack = goal_ == MagnitudeGoal::feasible ? variables[size] : 0;
      set(row, sample.shortfalls[of] - slack, slopes ? Row(slopes->shortfalls.row(of)) : Row());
      if (gradient && goal_ == MagnitudeGoal::feasible) gradient[row * count + size] = -1;
      ++row;
    }
  }

  /// NLopt is C: no exception may pass through it.
  template <typename Function>
  void guarded(const Function& function) {
    try {
      if (!error_) function();
    } catch (...) {
      error_ = std::current_exception();
      nlopt_force_stop(optimiser_);
    }
  }

  static double objective(unsigned, const double* variables, double* gradient, void* self) {
    double value = 0;
    auto* programme = static_cast<Programme*>(self);
    programme->guarded([&] { value = programme->objective(variables, gradient); });
    return value;
  }

  static void constraint(unsigned, double* result, unsigned, const double* variables, double* gradient,
                         void* self) {
    auto* programme = static_cast<Programme*>(self);
    programme->guarded([&] { programme->constraint(result, variables, gradient); });
  }

  static constexpr double infinity_ = std::numeric_limits<double>::infinity();

  MagnitudeProblem& problem_;
  MagnitudeGoal goal_;
  Magnitudes start_;
  double radius_;
  std::vector<Group> groups_;
  std::vector<std::vector<Eigen::Index>> rows_;  ///< of shortfalls, in groups
  double scale_ = 1;                             ///< of D
  nlopt_opt optimiser_ = nullptr;
  bool refused_ = false;
  std::exception_ptr error_;
};

}  // namespace

MagnitudeRunEnd optimised_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run) {
  return Programme(problem, run).run();
}

}  // namespace stackabilization::detail
