#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

namespace stackabilization::detail {

/// Budget of a run with several phases: a number of designs, and seconds until a deadline. Phases end at
/// shares of both. Without a deadline no clock decides anything.
class WorkBudget {
 public:
  /// Number of designs and seconds, both > 0; infinite: no limit. The time starts now.
  WorkBudget(double designs, double seconds) : designs_(designs), seconds_(seconds), start_(Clock::now()) {}

  /// Records that `designs` designs were made. Call it from one thread at a time, so that results are
  /// reproducible.
  void charge(std::int64_t designs) { used_ += designs; }
  std::int64_t used() const { return used_; }
  /// Returns the share of the designs that are used, with `further` ones, in [0, 1]; 0 without a limit.
  double share_used(std::int64_t further = 0) const {
    return std::min(1.0, static_cast<double>(used_ + further) / designs_);
  }
  /// Returns how many designs are left until `share` of the budget is used, at least `min_share` of the
  /// budget.
  std::int64_t designs_until(double share, double min_share = 0) const;
  /// Returns how many seconds are left until `share` of the time is used, at least `min_share` of the time.
  /// Always above 0.
  double seconds_until(double share, double min_share = 0) const;
  /// Returns whether `share` of the time is used. Any thread may ask.
  bool late(double share);
  /// Returns whether the deadline ended any phase.
  bool met_deadline() const { return met_deadline_; }
  /// Records that the deadline ended a phase.
  void note_deadline() { met_deadline_ = true; }

 private:
  using Clock = std::chrono::steady_clock;

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  double designs_, seconds_;
  Clock::time_point start_;
  std::int64_t used_ = 0;
  std::atomic<bool> met_deadline_ = false;
};

}  // namespace stackabilization::detail
