#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace stackabilization::detail {

/// What a run of several phases may use: a number of designs, counted, and seconds until a deadline. Phases
/// end at shares of both. Only where a deadline is given does a clock decide anything.
class WorkBudget {
 public:
  /// Both above 0, infinite without a limit. The time begins now.
  WorkBudget(double designs, double seconds) : designs_(designs), seconds_(seconds), start_(Clock::now()) {}

  /// That many designs were made. From one thread at a time, so that all that follows is the same each time.
  void charge(std::int64_t designs) { used_ += designs; }
  std::int64_t used() const { return used_; }
  /// Designs that may be made before `share` of all is used up, at least `min_share` of all.
  std::int64_t designs_until(double share, double min_share = 0) const;
  /// The same for seconds; above 0.
  double seconds_until(double share, double min_share = 0) const;
  /// Is it later than this share of the time? May be asked from any thread.
  bool late(double share);
  /// Has the deadline ended anything?
  bool met_deadline() const { return met_deadline_; }
  /// Something else found that it has.
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
