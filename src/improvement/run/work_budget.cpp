#include "improvement/run/work_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stackabilization::detail {

std::int64_t WorkBudget::designs_until(double share, double min_share) const {
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  if (!std::isfinite(designs_)) return most;
  const double left = std::max(share * designs_ - static_cast<double>(used_), min_share * designs_);
  return left < static_cast<double>(most) ? std::max<std::int64_t>(0, static_cast<std::int64_t>(left)) : most;
}

double WorkBudget::seconds_until(double share, double min_share) const {
  if (!std::isfinite(seconds_)) return seconds_;
  const double left = std::max(share * seconds_ - elapsed(), min_share * seconds_);
  return std::max(left, std::numeric_limits<double>::min());
}

bool WorkBudget::late(double share) {
  if (elapsed() <= share * seconds_) return false;
  met_deadline_ = true;
  return true;
}

}  // namespace stackabilization::detail
