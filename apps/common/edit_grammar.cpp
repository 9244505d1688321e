#include "apps/common/edit_grammar.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string_view>

#include "apps/common/text.h"
#include "apps/common/values.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/core/text.h"

namespace stackabilization::apps {

namespace {

constexpr std::array<const char*, 6> face_names = {"-x", "+x", "-y", "+y", "-z", "+z"};
constexpr const char* linear_word = "linearly";
constexpr std::uint64_t max_index = std::numeric_limits<int>::max();
constexpr double radians_per_degree = std::numbers::pi / 180;

/// What follows the part in a handle, "face=", and the kind it makes.
struct Suffix {
  const char* word;
  HandleKind kind;
  std::uint64_t most;
};
constexpr std::array<Suffix, 3> suffixes = {{{"face=", HandleKind::face, 5},
                                             {"corner=", HandleKind::corner, 7},
                                             {"section=", HandleKind::section, max_index}}};
constexpr std::array<Suffix, 2> partless = {
    {{"point=", HandleKind::point, max_index}, {"wire=", HandleKind::wire, max_index}}};

/// Words between blanks; one that begins with a quote goes on to the closing one.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false, quoted = false;
  for (const char c : text) {
    if (!quoted && (c == ' ' || c == '\t')) {
      inside = false;
      continue;
    }
    if (!inside) {
      words.emplace_back();
      inside = true;
      quoted = c == '\'';
    } else if (c == '\'' && words.back().front() == '\'') {
      quoted = !quoted;
    }
    words.back() += c;
  }
  return words;
}

std::string quoted_name(const std::string& name) {
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? "''" : std::string(1, c);
  return text + "'";
}

std::string place_of(const std::string& edit) {
  return "the edit \"" + edit + "\": ";
}

class Parser {
 public:
  Parser(const std::string& text, const std::vector<std::string>& part_names)
      : place_(place_of(text)), words_(words_of(text)), part_names_(part_names) {}

  Edit parse() {
    if (words_.empty())
      fail("expected a handle and what to do to it, such as leg/face=-z move 0 0 0.1; found nothing");
    Edit edit;
    edit.handle = handle();
    edit.operation = operation();
    edit.falloff = falloff(edit);
    if (next_ < words_.size())
      fail("expected nothing after " + words_[next_ - 1] + ", found '" + words_[next_] + "'");
    return edit;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw UsageError(place_ + what); }

  std::string found() const {
    return next_ < words_.size() ? "found '" + words_[next_] + "'" : "found the end";
  }

  Handle handle() {
    const std::string word = words_[next_++];
    if (word == "shape") return {HandleKind::shape, 0, 0};
    for (const Suffix& kind : partless)
      if (word.starts_with(kind.word)) return {kind.kind, 0, index(kind, word)};
    const std::size_t end = word.front() == '\'' ? word.rfind('\'') : std::string::npos;
    if (end == 0) fail("expected a closing ' after " + word);
    const std::string_view tail = std::string_view(word).substr(end == std::string::npos ? 0 : end + 1);
    const std::size_t slash = tail.rfind('/');
    const Suffix* const suffix =
        slash == std::string_view::npos ? nullptr : suffix_of(tail.substr(slash + 1));
    if (end != std::string::npos && !tail.empty() && (suffix == nullptr || slash != 0))
      fail("expected /face=, /corner= or /section= after the quoted part, found '" + std::string(tail) + "'");
    const std::size_t name_size = word.size() - (suffix == nullptr ? 0 : tail.size() - slash);
    const int part = part_of(word.substr(0, name_size));
    if (suffix == nullptr) return {HandleKind::part, part, 0};
    return {suffix->kind, part, index(*suffix, word.substr(name_size + 1))};
  }

  static const Suffix* suffix_of(std::string_view text) {
    const auto found = std::find_if(suffixes.begin(), suffixes.end(),
                                    [&](const Suffix& suffix) { return text.starts_with(suffix.word); });
    return found == suffixes.end() ? nullptr : &*found;
  }

  int index(const Suffix& kind, const std::string& word) const {
    const std::string_view prefix = kind.word;
    const std::string value = word.substr(prefix.size());
    if (kind.kind == HandleKind::face) {
      const auto name = std::find(face_names.begin(), face_names.end(), value);
      if (name != face_names.end()) return static_cast<int>(name - face_names.begin());
      if (value.size() != 1 || value[0] < '0' || value[0] > '5')
        fail("face= expects one of -x, +x, -y, +y, -z, +z or a number from 0 to 5, found '" + value + "'");
    }
    return static_cast<int>(parse_count({place_ + std::string(prefix), "", 0, kind.most}, value));
  }

  int part_of(const std::string& word) const {
    std::string name = word;
    if (word.front() == '\'') {
      name.clear();
      for (std::size_t i = 1; i + 1 < word.size(); ++i) {
        name += word[i];
        if (word[i] == '\'') ++i;
      }
    }
    const auto found = std::find(part_names_.begin(), part_names_.end(), name);
    if (found == part_names_.end())
      fail("expected a part, shape, point=N or wire=N, and " + unknown_part(part_names_, name));
    return static_cast<int>(found - part_names_.begin());
  }

  Operation operation() {
    const std::string verb = next_ < words_.size() ? words_[next_] : "";
    if (verb != "move" && verb != "rotate" && verb != "scale" && verb != "taper" && verb != "lean")
      fail("expected move, rotate, scale, taper or lean, " + found());
    ++next_;
    if (verb == "move") return Move{vector("move")};
    if (verb == "lean") {
      const Eigen::Vector3d by = vector("lean");
      expect("towards");
      return Lean{by, vector("towards")};
    }
    const double amount = number(verb);
    if (verb == "rotate") {
      expect("about");
      return Rotate{vector("about"), amount * radians_per_degree};
    }
    if (verb == "taper") {
      expect("towards");
      Taper taper{amount, vector("towards"), {}};
      if (next_ < words_.size()) {
        expect("along");
        taper.along = vector("along");
      }
      return taper;
    }
    Scale scale{amount, {}};
    if (next_ < words_.size() && words_[next_] != linear_word) {
      expect("along");
      scale.along = vector("along");
    }
    return scale;
  }

  Falloff falloff(Edit edit) {
    if (next_ == words_.size() || words_[next_] != linear_word) return Falloff::gaussian;
    edit.falloff = Falloff::linear;
    if (!falls_off_linearly(edit))
      fail("expected linearly after moves and scalings of cross-sections only, such as leg/section=0");
    ++next_;
    return Falloff::linear;
  }

  void expect(const std::string& word) {
    if (next_ == words_.size() || words_[next_] != word)
      fail("expected " + word + " after " + words_[next_ - 1] + ", " + found());
    ++next_;
  }

  double number(const std::string& after) {
    if (next_ == words_.size()) fail(after + " expects a number, found the end");
    return parse_number(place_ + after, words_[next_++]);
  }

  Eigen::Vector3d vector(const std::string& after) {
    if (words_.size() - next_ < 3)
      fail(after + " expects three numbers, found " + std::to_string(words_.size() - next_));
    return {number(after), number(after), number(after)};
  }

  std::string place_;
  std::vector<std::string> words_;
  const std::vector<std::string>& part_names_;
  std::size_t next_ = 0;
};

/// Would the name, unquoted, be read as itself?
bool reads_as_part(const std::string& name) {
  if (name == "shape" || name.front() == '\'' || name.find_first_of(" \t") != std::string::npos) return false;
  const std::size_t slash = name.rfind('/');
  const auto begins = [&](std::size_t at, const auto& kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const Suffix& kind) {
      return std::string_view(name).substr(at).starts_with(kind.word);
    });
  };
  return !begins(0, partless) && (slash == std::string::npos || !begins(slash + 1, suffixes));
}

/// Shortest number of degrees that is parsed as these radians, or the nearest one.
std::string turn_text(double radians) {
  const double degrees = radians / radians_per_degree;
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    const double parsed = stackabilization::parse_number(significant_text(degrees, digits)).value();
    if (parsed * radians_per_degree == radians) return exact_digits(parsed);
  }
  return exact_digits(degrees);
}

}  // namespace

Edit parse_edit(const std::string& text, const std::vector<std::string>& part_names, double diagonal) {
  Edit edit = Parser(text, part_names).parse();
  try {
    validate(edit, diagonal);
  } catch (const UsageError& error) {
    throw UsageError(place_of(text) + error.what());
  }
  return edit;
}

std::string handle_text(const Handle& handle, const std::vector<std::string>& part_names) {
  if (handle.kind == HandleKind::shape) return "shape";
  for (const Suffix& kind : partless)
    if (kind.kind == handle.kind) return kind.word + std::to_string(handle.index);
  const std::string& name = part_names.at(static_cast<std::size_t>(handle.part));
  const std::string part = reads_as_part(name) ? name : quoted_name(name);
  for (const Suffix& kind : suffixes)
    if (kind.kind == handle.kind)
      return part + "/" + kind.word +
             (handle.kind == HandleKind::face ? face_names.at(static_cast<std::size_t>(handle.index))
                                              : std::to_string(handle.index));
  return part;
}

std::string edit_text(const Edit& edit, const std::vector<std::string>& part_names) {
  const std::string handle = handle_text(edit.handle, part_names);
  const std::string how = falls_off_linearly(edit) ? std::string(" ") + linear_word : "";
  if (const auto* move = std::get_if<Move>(&edit.operation))
    return handle + " move " + vector_text(move->by) + how;
  if (const auto* rotate = std::get_if<Rotate>(&edit.operation))
    return handle + " rotate " + turn_text(rotate->radians) + " about " + vector_text(rotate->axis);
  if (const auto* taper = std::get_if<Taper>(&edit.operation))
    return handle + " taper " + exact_digits(taper->factor) + " towards " + vector_text(taper->axis) +
           (taper->along ? " along " + vector_text(*taper->along) : std::string());
  if (const auto* lean = std::get_if<Lean>(&edit.operation))
    return handle + " lean " + vector_text(lean->by) + " towards " + vector_text(lean->axis);
  const Scale& scale = std::get<Scale>(edit.operation);
  return handle + " scale " + exact_digits(scale.factor) +
         (scale.along ? " along " + vector_text(*scale.along) : std::string()) + how;
}

std::vector<std::string> edit_texts(const std::vector<Edit>& edits,
                                    const std::vector<std::string>& part_names) {
  std::vector<std::string> texts;
  for (const Edit& edit : edits) texts.push_back(edit_text(edit, part_names));
  return texts;
}

}  // namespace stackabilization::apps
