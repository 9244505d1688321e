#pragma once

#include <string>
#include <vector>

#include "accuracy/shortfall.h"
#include "common/experiment.h"

namespace stackabilization::experiments {

/// A sampling held against the exact answer.
struct Accuracy {
  Eigen::Vector3d direction;
  Sampling sampling;
  double extent = 0;   ///< h, model units
  double exact = 0;    ///< f_max, model units
  double error = 0;    ///< of f_max, over h; negative: too small
  double S_exact = 0;  ///< oriented boxes
  double S_error = 0;
  Shortfall shortfall;
};

/// What was measured on one model, or on all.
struct AccuracyOfModel {
  std::string model, hash;
  std::vector<Accuracy> rows;
};

/// Writes the tables of the errors - by model and for all models together; what errors are due to; how many
/// samples keep the error below a bound - and the plot of the errors.
void summarise(const std::vector<AccuracyOfModel>& models, Report& report);

}  // namespace stackabilization::experiments
