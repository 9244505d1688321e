#include "stackabilization/core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/utf8.h"

namespace stackabilization {

namespace {

std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  return token;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

template <class Number>
void append_chars(std::string& text, Number value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end);
}

}  // namespace

std::optional<double> parse_number(std::string_view token) {
  token = without_plus(token);
  const char* const end = token.data() + token.size();
  double value = 0;
  auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::result_out_of_range) {
    // from_chars does not say at which side of the range; the wider type does.
    long double wide = 0;
    const auto wide_result = std::from_chars(token.data(), end, wide);
    if (wide_result.ec != std::errc() || std::abs(wide) > 1) return std::nullopt;
    value = static_cast<double>(wide);
    error = std::errc();
  }
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  token = without_plus(token);
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || stop != token.data() + token.size()) return std::nullopt;
  return value;
}

void append_number(std::string& text, double value) {
  append_chars(text, value);
}
void append_number(std::string& text, float value) {
  append_chars(text, value);
}
void append_integer(std::string& text, std::int64_t value) {
  append_chars(text, value);
}

std::string in_quotes(std::string_view token) {
  constexpr std::size_t max_quoted = 40;
  std::string result = "'";
  for (const char c : token.substr(0, max_quoted)) result += c >= ' ' && c <= '~' ? c : '?';
  if (token.size() > max_quoted) result += "...";
  result += '\'';
  return result;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

TextCursor::TextCursor(const Source& source, Backslash backslash)
    : name_(source.name),
      position_(source.bytes.data()),
      line_end_(source.bytes.data()),
      end_(source.bytes.data() + source.bytes.size()),
      joins_lines_(backslash == Backslash::continues_line) {
  if (source.bytes.starts_with("\xEF\xBB\xBF")) position_ += 3;
  line_end_ = position_;
  if (source.bytes.find('\n') == std::string_view::npos) newline_ = '\r';
}

/// Whether a backslash at `at` is the last thing of its line.
bool TextCursor::is_joint(const char* at) const {
  if (*at != '\\') return false;
  const char* next = at + 1;
  if (next < end_ && newline_ == '\n' && *next == '\r') ++next;
  return next == end_ || *next == newline_;
}

bool TextCursor::next_line() {
  if (line_ > 0) position_ = next_line_start();
  if (position_ == end_) return false;
  line_ = next_line_number_;
  joined_ = false;
  const char* from = position_;
  for (;;) {
    const void* found = std::memchr(from, newline_, static_cast<std::size_t>(end_ - from));
    line_end_ = found ? static_cast<const char*>(found) : end_;
    ++next_line_number_;
    const char* last = line_end_;
    while (last > from && last[-1] == '\r') --last;
    if (!joins_lines_ || last == from || last[-1] != '\\' || line_end_ == end_) return true;
    joined_ = true;
    from = line_end_ + 1;
  }
}

bool TextCursor::next_content_line() {
  while (next_line()) {
    skip_blanks();
    if (position_ < line_end_ && *position_ != '#') return true;
  }
  return false;
}

void TextCursor::skip_blanks() {
  while (position_ < line_end_ && (is_blank(*position_) || (joined_ && is_joint(position_)))) ++position_;
}

std::string_view TextCursor::token() {
  skip_blanks();
  const char* const start = position_;
  while (position_ < line_end_ && !is_blank(*position_) && !(joined_ && is_joint(position_))) ++position_;
  return {start, static_cast<std::size_t>(position_ - start)};
}

std::string_view TextCursor::token_of_any_line() {
  for (;;) {
    const std::string_view found = line_ > 0 ? token() : std::string_view();
    if (!found.empty() || !next_line()) return found;
  }
}

std::string TextCursor::rest_of_line() {
  std::string result;
  for (std::string_view next = token(); !next.empty(); next = token()) {
    if (!result.empty()) result += ' ';
    result += next;
  }
  return result;
}

double TextCursor::number(const char* what) {
  const std::string_view text = token();
  const std::optional<double> value = parse_number(text);
  if (!value) fail_expected(what, text);
  return *value;
}

std::int64_t TextCursor::integer(const char* what) {
  const std::string_view text = token();
  const std::optional<std::int64_t> value = parse_integer(text);
  if (!value) fail_expected(what, text);
  return *value;
}

void TextCursor::require_utf8(std::string_view name) const {
  if (!is_utf8(name)) fail_expected("a name in UTF-8", name);
}

void TextCursor::fail(const std::string& message) const {
  fail_at(std::max<std::int64_t>(line_, 1), message);
}

void TextCursor::fail_at(std::int64_t line, const std::string& message) const {
  throw InputError(name_ + ":" + std::to_string(line) + ": " + message);
}

void TextCursor::fail_expected(const char* what, std::string_view found) const {
  fail(std::string("expected ") + what + ", found " +
       (found.empty() ? "the end of the line" : in_quotes(found)));
}

}  // namespace stackabilization
