#include "apps/common/progress.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>

namespace stackabilization::apps {

namespace {

constexpr int bar_width = 40;  ///< characters
constexpr std::chrono::milliseconds between_lines(100);

}  // namespace

ProgressBar::ProgressBar(std::string label, const Caller* caller)
    : label_(std::move(label)), caller_(caller), terminal_(!caller && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (shown_percent_ >= 0)
    std::cerr << '\r' << std::string(label_.size() + bar_width + 8, ' ') << '\r' << std::flush;
}

void ProgressBar::show(double fraction) {
  if (caller_ && caller_->progress) caller_->progress(label_, fraction);
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  if (!terminal_ || percent == shown_percent_) return;
  shown_percent_ = percent;
  const int filled = bar_width * percent / 100;
  std::cerr << '\r' << label_ << " [" << std::string(filled, '=') << std::string(bar_width - filled, ' ')
            << "] " << percent << '%' << std::flush;
}

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() {
  if (width_ > 0) std::cerr << '\r' << std::string(width_, ' ') << '\r' << std::flush;
}

bool StatusLine::due() const {
  return terminal_ && Clock::now() - shown_ >= between_lines;
}

void StatusLine::show(const std::string& line) {
  if (!terminal_) return;
  shown_ = Clock::now();
  std::cerr << '\r' << line << std::string(width_ > line.size() ? width_ - line.size() : 0, ' ')
            << std::flush;
  width_ = line.size();
}

}  // namespace stackabilization::apps
