#pragma once

namespace stackabilization::experiments {

/// Seconds on a steady clock.
double now();

/// Processor seconds that all threads of this process have used: what other programs do at the same time
/// does not count.
double processor_now();

/// Seconds since it was made, by both clocks.
class Stopwatch {
 public:
  Stopwatch() : started_(now()), processor_started_(processor_now()) {}

  double seconds() const { return now() - started_; }
  double processor_seconds() const { return processor_now() - processor_started_; }

 private:
  double started_, processor_started_;
};

}  // namespace stackabilization::experiments
