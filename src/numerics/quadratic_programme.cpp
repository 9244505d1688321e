#include "numerics/quadratic_programme.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int max_steps = 60;

/// Fraction of the way to the first vanishing multiplier or slack at which a step ends.
constexpr double share_of_way = 0.995;

/// Returns the longest step, at most 1, that keeps `values` above 0.
double step_length(const Eigen::VectorXd& values, const Eigen::VectorXd& by) {
  double longest = 1;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (by(i) < 0) longest = std::min(longest, -share_of_way * values(i) / by(i));
  return longest;
}

class InteriorPoint {
 public:
  explicit InteriorPoint(const QuadraticProgramme& programme)
      : p_(programme),
        x_(Eigen::VectorXd::Zero(programme.c.size())),
        slacks_(programme.b.cwiseMax(1)),
        multipliers_(Eigen::VectorXd::Ones(programme.b.size())) {}

  QuadraticMinimum run() {
    for (int step = 0; step < max_steps && !settled(); ++step)
      if (!advance()) break;
    return {x_, multipliers_};
  }

 private:
  double gap() const { return slacks_.dot(multipliers_) / static_cast<double>(slacks_.size()); }

  bool settled() {
    dual_ = p_.q * x_ + p_.c + p_.a.transpose() * multipliers_;
    primal_ = p_.a * x_ + slacks_ - p_.b;
    const double scale = 1 + p_.c.cwiseAbs().maxCoeff();
    return dual_.cwiseAbs().maxCoeff() <= tolerance::relative * scale &&
           primal_.cwiseAbs().maxCoeff() <= tolerance::relative && gap() <= tolerance::relative * scale;
  }

  struct Step {
    Eigen::VectorXd x, slacks, multipliers;
  };

  /// Computes Newton's step that reduces the products of slacks and multipliers by `products`.
  Step step(const Eigen::LDLT<Eigen::MatrixXd>& factors, const Eigen::VectorXd& products) const {
    const Eigen::VectorXd weights = multipliers_.cwiseQuotient(slacks_);
    Step by;
    by.x = factors.solve(-dual_ + p_.a.transpose() *
                                      (products.cwiseQuotient(slacks_) - weights.cwiseProduct(primal_)));
    by.slacks = -primal_ - p_.a * by.x;
    by.multipliers = -(products + multipliers_.cwiseProduct(by.slacks)).cwiseQuotient(slacks_);
    return by;
  }

  /// Returns false when there is no step, as for contradictory rows.
  bool advance() {
    Eigen::MatrixXd normal = p_.q;
    normal.noalias() += p_.a.transpose() * multipliers_.cwiseQuotient(slacks_).asDiagonal() * p_.a;
    const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
    const Eigen::VectorXd products = slacks_.cwiseProduct(multipliers_);
    const Step predicted = step(factors, products);
    const double ahead =
        std::min(step_length(slacks_, predicted.slacks), step_length(multipliers_, predicted.multipliers));
    const double after =
        (slacks_ + ahead * predicted.slacks).dot(multipliers_ + ahead * predicted.multipliers) /
        static_cast<double>(slacks_.size());
    const double ratio = after / gap(), centring = ratio * ratio * ratio;
    const Step corrected =
        step(factors,
             (products + predicted.slacks.cwiseProduct(predicted.multipliers)).array() - centring * gap());
    const double length =
        std::min(step_length(slacks_, corrected.slacks), step_length(multipliers_, corrected.multipliers));
    if (!corrected.x.allFinite() || !corrected.slacks.allFinite() || !corrected.multipliers.allFinite())
      return false;
    x_ += length * corrected.x;
    slacks_ += length * corrected.slacks;
    multipliers_ += length * corrected.multipliers;
    return true;
  }

  const QuadraticProgramme& p_;
  Eigen::VectorXd x_, slacks_, multipliers_;
  Eigen::VectorXd dual_, primal_;
};

}  // namespace

QuadraticMinimum minimize(const QuadraticProgramme& programme) {
  return InteriorPoint(programme).run();
}

}  // namespace stackabilization::detail
