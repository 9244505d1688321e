#pragma once

#include <string>

namespace stackabilization::apps {

/// A bar on standard error, only when that is a terminal; gone when the object goes.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` done, in [0, 1].
  void show(double fraction);

 private:
  std::string label_;
  bool terminal_;
  int shown_percent_ = -1;
};

}  // namespace stackabilization::apps
