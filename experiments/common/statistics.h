#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stackabilization::experiments {

/// Middle value; the lower one of two. Precondition: not empty.
double median(std::vector<double> values);

/// The value at rank ceil(fraction n) of n, counted from 1: at least that share of the values is no larger.
/// Precondition: not empty, fraction in (0, 1].
double quantile(std::vector<double> values, double fraction);

/// y = factor x^exponent.
struct PowerLaw {
  double exponent = 0, factor = 0;
};

/// Power law through points (x, y) by least squares of the logarithms. Points with a coordinate that is not
/// positive and finite do not count; nothing unless two different x are left.
std::optional<PowerLaw> power_law(const std::vector<Eigen::Vector2d>& points);

/// Order p of a method whose error shrinks like resolution^-p: points are (resolution, |error|). Errors below
/// `floor` do not count: there a method is limited by its precision and converges no further.
std::optional<double> order_of_convergence(const std::vector<Eigen::Vector2d>& points, double floor = 0);

}  // namespace stackabilization::experiments
