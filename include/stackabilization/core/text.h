#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stackabilization {

/// The bytes of a file and what messages call it.
struct Source {
  std::string_view bytes;   ///< all of the file
  const std::string& name;  ///< what messages call it, as a rule its path
};

/// Decimal number of the whole token, rounded to nearest, independent of the locale; nothing when the token
/// is something else or beyond the range of double. Numbers too small for double become zero.
std::optional<double> parse_number(std::string_view token);

/// Decimal integer of the whole token, with or without a sign; nothing when the token is something else or
/// beyond the range.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// Shortest decimal text that reads back as the same double.
void append_number(std::string& text, double value);
/// The same for a float.
void append_number(std::string& text, float value);

/// Appends an integer and nothing else.
void append_integer(std::string& text, std::int64_t value);

/// `token` between quotes, shortened, with unprintable bytes as '?', for messages.
std::string in_quotes(std::string_view token);

/// In lower case, ASCII letters only.
std::string lower_case(std::string_view text);

/// Walks through the lines of a text and the blank-separated tokens of a line. Lines end with LF, CRLF or, in
/// files without LF, CR. A UTF-8 byte order mark is skipped.
class TextCursor {
 public:
  /// Whether a backslash at the end of a line joins the next line to it, as in OBJ.
  enum class Backslash { ordinary, continues_line };

  /// Stands before the first line of `source`, which must outlive the cursor.
  explicit TextCursor(const Source& source, Backslash backslash = Backslash::ordinary);

  /// Goes to the next line; false at the end of the text.
  bool next_line();
  /// Goes to the next line that has a token and does not begin with '#'; false at the end of the text.
  bool next_content_line();
  /// Next token of the line, empty when there is none.
  std::string_view token();
  /// Next token of this or a later line, empty at the end of the text.
  std::string_view token_of_any_line();
  /// The rest of the line, its tokens joined by single blanks.
  std::string rest_of_line();
  /// Next token of the line as a number. Throws InputError, which says that `what` was expected, where it is
  /// none.
  double number(const char* what);
  /// Next token of the line as an integer. Throws InputError, which says that `what` was expected, where it
  /// is none.
  std::int64_t integer(const char* what);

  /// Throws InputError unless `name`, which is to be that of a part, is UTF-8.
  void require_utf8(std::string_view name) const;

  /// Bytes not yet walked over; a bound for what a file can still hold.
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }
  /// First byte after the end of the current line.
  const char* next_line_start() const { return line_end_ < end_ ? line_end_ + 1 : end_; }
  /// Number of the current line, from 1; 0 before the first.
  std::int64_t line() const { return line_; }

  /// Throws InputError "NAME:LINE: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws InputError "NAME:LINE: MESSAGE" about another line.
  [[noreturn]] void fail_at(std::int64_t line, const std::string& message) const;
  /// Throws InputError "NAME:LINE: expected WHAT, found 'TOKEN'".
  [[noreturn]] void fail_expected(const char* what, std::string_view found) const;

 private:
  bool is_joint(const char* at) const;
  void skip_blanks();

  const std::string& name_;
  const char* position_;
  const char* line_end_;
  const char* end_;
  char newline_ = '\n';
  bool joins_lines_;
  bool joined_ = false;  ///< The current line was joined from several.
  std::int64_t line_ = 0;
  std::int64_t next_line_number_ = 1;
};

}  // namespace stackabilization
