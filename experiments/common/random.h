#pragma once

#include <random>

namespace stackabilization::experiments {

/// Numbers in [0, 1) that are the same on every machine, unlike the distributions of <random>.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform() { return engine_() / 4294967296.0; }

 private:
  std::mt19937 engine_;
};

}  // namespace stackabilization::experiments
