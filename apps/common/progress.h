#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "apps/common/caller.h"
#include "apps/common/interrupt.h"

namespace stackabilization::apps {

/// A bar on standard error, only when that is a terminal; gone when the object goes. A caller is told
/// instead.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label, const Caller* caller = nullptr);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` done, in [0, 1].
  void show(double fraction);

 private:
  std::string label_;
  const Caller* caller_;
  bool terminal_;
  int shown_percent_ = -1;
};

/// Returns work(options) with `progress` and `cancelled` of the options set: a bar with this label shows how
/// far it is, and a signal, or the caller, ends it with Interrupted.
template <class Options, class Work>
auto with_progress(const std::string& label, const Caller* caller, Options options, const Work& work) {
  ProgressBar bar(label, caller);
  const DeferredInterrupts interrupts(caller);
  options.progress = [&bar](double fraction) { bar.show(fraction); };
  options.cancelled = [&interrupts] { return interrupts.requested(); };
  auto result = work(options);
  if (interrupts.requested()) throw Interrupted();
  return result;
}

/// One line of words on standard error that is written over, only when that is a terminal; gone when the
/// object goes.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Is it time for another line? No more than ten a second, none without a terminal.
  bool due() const;
  void show(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::size_t width_ = 0;  ///< characters shown
  Clock::time_point shown_{};
};

}  // namespace stackabilization::apps
