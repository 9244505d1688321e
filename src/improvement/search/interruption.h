#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization::detail {

/// Tells whether a search has to stop before its work is done: deadline or cancellation. Any thread may ask.
/// The caller's function is called only from the thread that made this object.
class Interruption {
 public:
  explicit Interruption(const BestFirstOptions& options)
      : options_(options), caller_(std::this_thread::get_id()), start_(Clock::now()) {}

  /// Returns whether the search has to stop.
  bool now() {
    if (!timed_out_ && seconds() >= options_.seconds) timed_out_ = true;
    if (!cancelled_ && options_.cancelled && std::this_thread::get_id() == caller_ && options_.cancelled())
      cancelled_ = true;
    return timed_out_ || cancelled_;
  }
  /// Returns why the search has to stop, if `now` has returned true.
  std::optional<SearchEnd> why() const {
    if (cancelled_) return SearchEnd::cancelled;
    if (timed_out_) return SearchEnd::time_limit;
    return std::nullopt;
  }
  /// Returns the seconds since the start.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  const BestFirstOptions& options_;
  std::thread::id caller_;
  Clock::time_point start_;
  std::atomic<bool> timed_out_ = false, cancelled_ = false;
};

}  // namespace stackabilization::detail
