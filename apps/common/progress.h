#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "apps/common/caller.h"

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
