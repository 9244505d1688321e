#include "improvement/search/refusal_reason.h"

#include <algorithm>
#include <charconv>

namespace stackabilization::detail {

namespace {

bool is_amount(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() &&
         word.find_first_of(".eE") != std::string_view::npos;
}

}  // namespace

std::string without_amounts(std::string_view reason) {
  constexpr std::string_view borders = " ,;:()";
  std::string text;
  while (!reason.empty()) {
    const std::size_t word = std::min(reason.find_first_of(borders), reason.size());
    const std::string_view core = reason.substr(0, word);
    text += is_amount(core) ? "..." : core;
    if (word < reason.size()) text += reason[word];
    reason.remove_prefix(std::min(word + 1, reason.size()));
  }
  return text;
}

}  // namespace stackabilization::detail
