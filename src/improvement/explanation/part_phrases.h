#pragma once

#include <string>
#include <vector>

namespace stackabilization::detail {

/// What a person calls some parts.
struct PartPhrase {
  std::string words;    ///< "4 legs", "left and right apron", "middle bar"
  bool plural = false;  ///< whether the words are a plural
};

/// Finds what a person calls parts by their names. A name is cut into words at everything but letters, and
/// between letters and digits. Words for a side, such as "left", come first; numbers and words of one or two
/// letters are labels, which come last.
class PartPhrases {
 public:
  /// `names`: of all parts. `nouns`: one per part, for names without a word or with a word such as "part".
  PartPhrases(const std::vector<std::string>& names, const std::vector<std::string>& nouns);

  /// Returns a phrase for some parts, ascending, that fits no other part: "4 legs", "2 back legs",
  /// "legs 1 and 2", "left and right aprons", "2 bars (3_part3, 5_part5)".
  PartPhrase phrase(const std::vector<int>& parts) const;
  /// Returns the noun of a part: the last word of its name that is not for a side.
  const std::string& noun(int part) const { return parts_[static_cast<std::size_t>(part)].noun; }

 private:
  struct Name {
    std::string whole;
    std::vector<std::string> words;   ///< in the order of the phrase, without labels
    std::vector<std::string> labels;  ///< numbers and words of one or two letters
    std::string noun;
    bool nameless = false;
  };

  std::vector<std::string> common_words(const std::vector<int>& parts) const;
  bool fits_others(const std::vector<std::string>& words, const std::vector<int>& parts) const;
  std::string distinguished(const std::vector<std::string>& words, const std::vector<int>& parts) const;

  std::vector<Name> parts_;
};

}  // namespace stackabilization::detail
