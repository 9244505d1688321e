#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace stackabilization::test {

/// Numbers in [-1, 1), the same everywhere.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint32_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) / 0x1p31 - 1; }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd result(rows, columns);
    for (double& number : result.reshaped()) number = (*this)();
    return result;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace stackabilization::test
