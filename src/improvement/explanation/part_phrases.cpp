#include "improvement/explanation/part_phrases.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "core/index.h"
#include "stackabilization/core/text.h"

namespace stackabilization::detail {

namespace {

constexpr std::size_t max_listed = 4;
/// Words of so many letters tell parts apart as numbers do: "leg_lf" is leg lf.
constexpr std::size_t longest_label = 2;

constexpr std::array<std::string_view, 14> side_words = {"left",  "right", "front",  "back",  "rear",
                                                         "upper", "lower", "middle", "top",   "bottom",
                                                         "inner", "outer", "side",   "centre"};
constexpr std::array<std::string_view, 20> generic_words = {
    "part",    "parts",    "object",  "mesh",  "group",    "geometry", "component",
    "shape",   "node",     "solid",   "piece", "default",  "none",     "model",
    "unnamed", "material", "polygon", "obj",   "instance", "segment"};

template <class List, class Item>
bool contains(const List& list, const Item& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

enum class Sort { other, letter, digit };

Sort sort_of(unsigned char c) {
  if (c >= '0' && c <= '9') return Sort::digit;
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c >= 0x80;
  return letter ? Sort::letter : Sort::other;
}

/// Returns the runs of letters and of digits of a name, in lower case.
std::vector<std::string> runs_of(const std::string& name) {
  std::vector<std::string> runs;
  Sort before = Sort::other;
  for (const char c : name) {
    const Sort sort = sort_of(static_cast<unsigned char>(c));
    if (sort != Sort::other) {
      if (sort != before) runs.emplace_back();
      runs.back() += c;
    }
    before = sort;
  }
  for (std::string& run : runs) run = lower_case(run);
  return runs;
}

bool is_plural(const std::string& noun) {
  return noun.size() > 2 && noun.ends_with('s') && !noun.ends_with("ss") && !noun.ends_with("us");
}

std::string plural_of(const std::string& noun) {
  if (is_plural(noun) || noun.empty()) return noun;
  const auto ends = [&](std::string_view end) { return noun.ends_with(end); };
  if (ends("s") || ends("x") || ends("ch") || ends("sh")) return noun + "es";
  if (ends("y") && noun.size() > 1 && !contains(std::string_view("aeiou"), noun[noun.size() - 2]))
    return noun.substr(0, noun.size() - 1) + "ies";
  return noun + "s";
}

std::string joined_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// "1, 2 and 4"
std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k)
    text += (k == 0 ? "" : k + 1 == items.size() ? " and " : ", ") + items[k];
  return text;
}

/// Returns words with the last one in the plural.
std::string plural_phrase(std::vector<std::string> words) {
  words.back() = plural_of(words.back());
  return joined_words(words);
}

}  // namespace

PartPhrases::PartPhrases(const std::vector<std::string>& names, const std::vector<std::string>& nouns) {
  for (std::size_t part = 0; part < names.size(); ++part) {
    Name name{names[part], {}, {}, {}};
    std::vector<std::string> sides;
    for (const std::string& run : runs_of(names[part])) {
      if (sort_of(static_cast<unsigned char>(run.front())) == Sort::digit || run.size() <= longest_label)
        name.labels.push_back(run);
      else if (contains(side_words, run))
        sides.push_back(run);
      else if (!contains(generic_words, run))
        name.words.push_back(run);
    }
    name.nameless = name.words.empty() && sides.empty();
    if (name.nameless) name.words = {nouns[part]};
    if (name.words.empty()) {
      name.words.push_back(sides.back());
      sides.pop_back();
    }
    name.noun = name.words.back();
    name.words.insert(name.words.begin(), sides.begin(), sides.end());
    parts_.push_back(std::move(name));
  }
}

std::vector<std::string> PartPhrases::common_words(const std::vector<int>& parts) const {
  std::vector<std::string> words = parts_[at(parts.front())].words;
  for (const int part : parts)
    std::erase_if(words, [&](const std::string& word) { return !contains(parts_[at(part)].words, word); });
  return words;
}

bool PartPhrases::fits_others(const std::vector<std::string>& words, const std::vector<int>& parts) const {
  for (int part = 0; part < static_cast<int>(parts_.size()); ++part) {
    const std::vector<std::string>& own = parts_[at(part)].words;
    const bool fits =
        std::all_of(words.begin(), words.end(), [&](const auto& word) { return contains(own, word); });
    if (fits && !contains(parts, part)) return true;
  }
  return false;
}

/// Tells parts from others that share the words: by their labels, by what else they are called, or by name.
std::string PartPhrases::distinguished(const std::vector<std::string>& words,
                                       const std::vector<int>& parts) const {
  std::vector<std::string> labels, sides, names;
  bool labelled = parts.size() <= max_listed, sided = labelled;
  for (const int part : parts) {
    const Name& name = parts_[at(part)];
    std::vector<std::string> others;
    for (const std::string& word : name.words)
      if (!contains(words, word)) others.push_back(word);
    labelled = labelled && name.labels.size() == 1 && others.empty() && !name.nameless;
    sided = sided && name.labels.empty() && !others.empty();
    if (labelled) labels.push_back(name.labels.front());
    if (sided) sides.push_back(joined_words(others));
    names.push_back(name.whole);
  }
  const bool several = parts.size() > 1;
  if (labelled) return (several ? plural_phrase(words) : joined_words(words)) + " " + listed(labels);
  if (sided) return listed(sides) + " " + (several ? plural_phrase(words) : joined_words(words));
  const std::string counted =
      several ? std::to_string(parts.size()) + " " + plural_phrase(words) : joined_words(words);
  const bool is_name = !several && lower_case(names.front()) == counted;
  if (parts.size() > max_listed || is_name) return counted;
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return counted + " (" + text + ")";
}

PartPhrase PartPhrases::phrase(const std::vector<int>& parts) const {
  const bool several = parts.size() > 1;
  std::vector<std::string> words = common_words(parts);
  const std::string& noun = parts_[at(parts.front())].noun;
  if (words.empty() || !contains(words, noun)) {
    // The parts have no noun in common.
    std::vector<std::string> names;
    for (const int part : parts) {
      const std::vector<std::string>& own = parts_[at(part)].words;
      names.push_back(fits_others(own, {part}) ? distinguished(own, {part}) : joined_words(own));
    }
    if (names.size() <= max_listed && std::set(names.begin(), names.end()).size() == names.size())
      return {listed(names), true};
    return {std::to_string(parts.size()) + " parts", true};
  }
  // The noun is the last word also where names have it before others.
  std::stable_partition(words.begin(), words.end(), [&](const std::string& word) { return word != noun; });
  if (fits_others(words, parts)) return {distinguished(words, parts), several || is_plural(noun)};
  if (!several) return {joined_words(words), is_plural(noun)};
  return {std::to_string(parts.size()) + " " + plural_phrase(words), true};
}

}  // namespace stackabilization::detail
