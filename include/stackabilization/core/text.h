#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stackabilization {

/// The bytes of a file and its name in messages.
struct Source {
  std::string_view bytes;   ///< the whole file
  const std::string& name;  ///< name in messages, usually the path
};

/// Parses the whole token as a decimal number, rounded to nearest, independent of the locale. Returns nothing
/// for other tokens and for numbers beyond the range of double. Numbers too small for double become zero.
std::optional<double> parse_number(std::string_view token);

/// Parses the whole token as a decimal integer with an optional sign. Returns nothing for other tokens and
/// for integers out of range.
std::optional<std::int64_t> parse_integer(std::string_view token);

/// Appends the shortest decimal text that reads back as the same double.
void append_number(std::string& text, double value);
/// Appends the shortest decimal text that reads back as the same float.
void append_number(std::string& text, float value);

/// Appends an integer in decimal.
void append_integer(std::string& text, std::int64_t value);

/// Returns `token` in quotes for messages: shortened, with '?' in place of unprintable bytes.
std::string in_quotes(std::string_view token);

/// Converts ASCII letters to lower case.
std::string lower_case(std::string_view text);

/// Reads a text line by line, and the blank-separated tokens of a line. Lines end with LF, CRLF or, in files
/// without LF, CR. A UTF-8 byte order mark is skipped.
class TextCursor {
 public:
  /// Whether a backslash at the end of a line joins the next line to it, as in OBJ.
  enum class Backslash { ordinary, continues_line };

  /// Starts before the first line of `source`, which must outlive the cursor.
  explicit TextCursor(const Source& source, Backslash backslash = Backslash::ordinary);

  /// Moves to the next line. Returns false at the end of the text.
  bool next_line();
  /// Moves to the next line with a token that does not begin with '#'. Returns false at the end of the text.
  bool next_content_line();
  /// Returns the next token of the line, empty when there is none.
  std::string_view token();
  /// Returns the next token of this or a later line, empty at the end of the text.
  std::string_view token_of_any_line();
  /// Returns the rest of the line, with its tokens joined by single blanks.
  std::string rest_of_line();
  /// Returns the next token of the line as a number. Throws InputError, with `what` as the expected content,
  /// for any other token.
  double number(const char* what);
  /// Returns the next token of the line as an integer. Throws InputError, with `what` as the expected
  /// content, for any other token.
  std::int64_t integer(const char* what);

  /// Throws InputError unless the part name `name` is UTF-8.
  void require_utf8(std::string_view name) const;

  /// Returns the number of unread bytes, a bound for the remaining content.
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }
  /// Returns the first byte after the end of the current line.
  const char* next_line_start() const { return line_end_ < end_ ? line_end_ + 1 : end_; }
  /// Returns the number of the current line, from 1; 0 before the first line.
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
  bool joined_ = false;  ///< whether the current line was joined from several lines
  std::int64_t line_ = 0;
  std::int64_t next_line_number_ = 1;
};

}  // namespace stackabilization
