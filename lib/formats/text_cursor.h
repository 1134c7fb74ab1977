// Walks over the words of a text file, for the readers of this room.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace viewcell {

/// What is behind a byte order mark (UTF-8), if there is one: editors put it before text of any
/// format. Throws InputError for marks of UTF-16 and UTF-32.
std::string_view skip_byte_order_mark(std::string_view bytes, const std::string& file);

/// The line breaks of a text: '\n', or '\r' where that stands alone, as of old Macintoshes.
char line_break_of(std::string_view text);

/// A word as a finite float; false when it is not one ("nan", "1e99" and "12x" are not).
bool parse_finite(std::string_view word, float& out);
bool parse_finite(std::string_view word, double& out);
/// Like these, and NaN for what programs print where a number is none: "nan", "-inf", "-nan(ind)",
/// "1.#QNAN".
bool parse_float_or_nan(std::string_view word, double& out);
/// A whole number; false when it is not one or does not fit.
bool parse_integer(std::string_view word, std::int64_t& out);

/// White space separates words, and so do byte order marks, which files put together have inside; a
/// backslash joins a line to the next; a comment runs from its sign
/// to the end of the line. The text must outlive the cursor. Every getter throws InputError (file,
/// line) for what it does not expect.
class TextCursor {
 public:
  /// comment: '#', or 0 for none. first_line: the number of the text's first line.
  TextCursor(std::string_view text, std::string file, char comment = '#',
             std::int64_t first_line = 1)
      : text_(text),
        file_(std::move(file)),
        comment_(comment),
        break_(line_break_of(text)),
        line_(first_line) {}

  /// True when no word is left.
  bool at_end();
  /// The next word, which may stand lines below.
  std::string_view word();
  /// The next word of this line; empty when the line has no more.
  std::string_view word_in_line();
  /// Leaves the cursor at the start of the next line.
  void skip_line();

  /// A word as a number; what and id name it in the error ("vertex 17").
  float number(std::string_view word, const char* what, std::uint64_t id) const;
  /// Within what a float holds; rounded to float it is the float next to the word.
  double coordinate(std::string_view word, const char* what, std::uint64_t id) const;
  /// The same, or NaN (parse_float_or_nan).
  double coordinate_or_nan(std::string_view word, const char* what, std::uint64_t id) const;
  std::int64_t integer(std::string_view word, const char* what, std::uint64_t id, std::int64_t lo,
                       std::int64_t hi) const;

  /// Bytes not walked over yet.
  std::uint64_t bytes_left() const { return text_.size() - at_; }
  std::int64_t line() const { return line_; }
  /// Throws InputError at this line.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_space();
  void skip_space_in_line();
  bool is_blank(char c) const;
  bool is_continuation() const;
  bool is_mark() const;
  std::string_view take_word();

  std::string_view text_;
  std::string file_;
  char comment_, break_;
  std::size_t at_ = 0;
  std::int64_t line_;
};

}  // namespace viewcell
