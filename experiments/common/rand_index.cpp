#include "common/rand_index.h"

#include <map>
#include <utility>

namespace stackabilization::experiments {

namespace {

double pairs(double count) {
  return count * (count - 1) / 2;
}

}  // namespace

double rand_error(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  std::map<std::int32_t, double> in_a, in_b;
  std::map<std::pair<std::int32_t, std::int32_t>, double> in_both;
  for (std::size_t f = 0; f < a.size(); ++f) {
    ++in_a[a[f]];
    ++in_b[b[f]];
    ++in_both[{a[f], b[f]}];
  }
  double together = 0;  // pairs together in a, plus those in b, minus twice those in both
  for (const auto& [label, count] : in_a) together += pairs(count);
  for (const auto& [label, count] : in_b) together += pairs(count);
  for (const auto& [labels, count] : in_both) together -= 2 * pairs(count);
  return together / pairs(static_cast<double>(a.size()));
}

}  // namespace stackabilization::experiments
