#include "stackabilization/io/labels.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/core/utf8.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization {

namespace {

/// A non-empty line: its tokens joined by single blanks.
struct Line {
  std::int64_t number;
  std::string text;

  std::vector<std::string_view> tokens() const {
    std::vector<std::string_view> result;
    const std::string_view view = text;
    for (std::size_t start = 0; start < view.size();) {
      const std::size_t end = std::min(view.find(' ', start), view.size());
      result.push_back(view.substr(start, end - start));
      start = end + 1;
    }
    return result;
  }
};

class LabelReader {
 public:
  LabelReader(Shape shape, const Source& source)
      : name_(source.name), shape_(std::move(shape)), cursor_(source) {
    while (cursor_.next_content_line()) lines_.push_back({cursor_.line(), cursor_.rest_of_line()});
    if (lines_.empty()) throw InputError(name_ + ": expected part labels, found none");
  }

  Shape apply() {
    for (const Line& line : lines_)
      if (!is_utf8(line.text)) fail(line, "expected names in UTF-8, found " + in_quotes(line.text));
    if (is_seg())
      apply_seg();
    else
      apply_plain();
    validate(shape_);
    return std::move(shape_);
  }

 private:
  [[noreturn]] void fail(const Line& line, const std::string& message) const {
    cursor_.fail_at(line.number, message);
  }

  /// One integer, then a line of labels or of two integers.
  bool is_seg() const {
    if (lines_.size() < 2 || !parse_integer(lines_[0].text)) return false;
    const std::vector<std::string_view> second = lines_[1].tokens();
    return second[0] == "labels" ||
           (second.size() == 2 && parse_integer(second[0]) && parse_integer(second[1]));
  }

  void apply_seg() {
    const std::optional<std::int64_t> part_count = parse_integer(lines_[0].text);
    // Each part has a triangle, a name, or an unused number. A number of parts larger than the text is an
    // error.
    const auto max_parts = static_cast<std::int64_t>(shape_.triangle_part.size() + lines_[1].text.size());
    if (*part_count < 1 || *part_count > max_parts)
      fail(lines_[0], "expected the number of parts, found " + in_quotes(lines_[0].text));
    shape_.part_names.clear();
    std::size_t next = 1;
    if (lines_[1].text.starts_with("labels")) {
      const std::vector<std::string_view> names = lines_[1].tokens();
      shape_.part_names.assign(names.begin() + 1, names.end());
      if (static_cast<std::int64_t>(shape_.part_names.size()) != *part_count)
        fail(lines_[1], "expected " + std::to_string(*part_count) + " part names, found " +
                            std::to_string(shape_.part_names.size()));
      if (std::set<std::string>(shape_.part_names.begin(), shape_.part_names.end()).size() !=
          shape_.part_names.size())
        fail(lines_[1], "expected part names that differ from each other");
      next = 2;
    }
    for (std::int64_t part = static_cast<std::int64_t>(shape_.part_names.size()); part < *part_count; ++part)
      shape_.part_names.push_back("part_" + std::to_string(part));
    assign_seg_lines(next);
  }

  void assign_seg_lines(std::size_t first_line) {
    std::fill(shape_.triangle_part.begin(), shape_.triangle_part.end(), -1);
    for (std::size_t i = first_line; i < lines_.size(); ++i) {
      const std::vector<std::string_view> tokens = lines_[i].tokens();
      if (tokens.size() != 2)
        fail(lines_[i], "expected a triangle and its part, found " + in_quotes(lines_[i].text));
      const std::int64_t triangle = index(lines_[i], tokens[0], shape_.triangle_count(), "a triangle");
      const std::int64_t part = index(lines_[i], tokens[1], shape_.part_count(), "a part");
      std::int32_t& label = shape_.triangle_part[static_cast<std::size_t>(triangle)];
      if (label >= 0) fail(lines_[i], "triangle " + std::to_string(triangle) + " has a label already");
      label = static_cast<std::int32_t>(part);
    }
    const auto missing = std::find(shape_.triangle_part.begin(), shape_.triangle_part.end(), -1);
    if (missing != shape_.triangle_part.end())
      throw InputError(name_ + ": triangle " + std::to_string(missing - shape_.triangle_part.begin()) +
                       " has no label");
  }

  std::int64_t index(const Line& line, std::string_view token, std::int64_t count, const char* what) const {
    const std::optional<std::int64_t> value = parse_integer(token);
    if (!value || *value < 0 || *value >= count)
      fail(line, std::string("expected ") + what + " between 0 and " + std::to_string(count - 1) +
                     ", found " + in_quotes(token));
    return *value;
  }

  void apply_plain() {
    if (static_cast<std::int64_t>(lines_.size()) != shape_.triangle_count())
      throw InputError(name_ + ": expected one label for each of " + std::to_string(shape_.triangle_count()) +
                       " triangles, found " + std::to_string(lines_.size()));
    const bool are_integers = std::all_of(
        lines_.begin(), lines_.end(), [](const Line& line) { return parse_integer(line.text).has_value(); });
    shape_.part_names.clear();
    if (are_integers)
      assign_numbers();
    else
      assign_names();
  }

  void assign_names() {
    std::map<std::string, std::int32_t> part_of_name;
    for (std::size_t t = 0; t < lines_.size(); ++t) {
      const auto [entry, is_new] =
          part_of_name.try_emplace(lines_[t].text, static_cast<std::int32_t>(part_of_name.size()));
      if (is_new) shape_.part_names.push_back(lines_[t].text);
      shape_.triangle_part[t] = entry->second;
    }
  }

  void assign_numbers() {
    std::map<std::int64_t, std::int32_t> part_of_number;
    for (const Line& line : lines_) {
      const std::int64_t number = *parse_integer(line.text);
      if (number < 0) fail(line, "expected a part index that is not negative, found " + in_quotes(line.text));
      part_of_number[number] = 0;
    }
    for (auto& [number, part] : part_of_number) {
      part = static_cast<std::int32_t>(shape_.part_names.size());
      shape_.part_names.push_back("part_" + std::to_string(number));
    }
    for (std::size_t t = 0; t < lines_.size(); ++t)
      shape_.triangle_part[t] = part_of_number.at(*parse_integer(lines_[t].text));
  }

  const std::string& name_;
  Shape shape_;
  TextCursor cursor_;
  std::vector<Line> lines_;
};

}  // namespace

Shape with_labels(Shape shape, std::string_view text, const std::string& name) {
  return LabelReader(std::move(shape), {text, name}).apply();
}

Shape with_labels(Shape shape, const std::filesystem::path& path) {
  return with_labels(std::move(shape), read_file(path), path.string());
}

}  // namespace stackabilization
