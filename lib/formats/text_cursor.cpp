#include "formats/text_cursor.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";

template <typename Real>
bool parse_real(std::string_view word, Real& out) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);  // from_chars takes no plus sign
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, out);
  if (stop != end || error == std::errc::invalid_argument) return false;
  // Too small for the type is zero or denormal, too large is refused below.
  if (error == std::errc::result_out_of_range)
    out = static_cast<Real>(std::strtod(std::string(word).c_str(), nullptr));
  return std::isfinite(out);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 40;
  return "'" + std::string(word.substr(0, kMost)) + (word.size() > kMost ? "...'" : "'");
}

std::string named(const char* what, std::uint64_t id) {
  return what + (" " + std::to_string(id)) + ": ";
}

// Half way between two floats: rounding it could go the other way than rounding the word.
bool is_between_floats(double x) {
  constexpr int kMoreBits = 53 - 24;
  const auto bits = std::bit_cast<std::uint64_t>(x) & ((1ull << kMoreBits) - 1);
  return bits == 1ull << (kMoreBits - 1);
}

}  // namespace

char line_break_of(std::string_view text) {
  const std::size_t first = text.find_first_of("\r\n");
  const bool is_alone = first != std::string_view::npos && text[first] == '\r' &&
                        text.find('\n', first) == std::string_view::npos;
  return is_alone ? '\r' : '\n';
}

std::string_view skip_byte_order_mark(std::string_view bytes, const std::string& file) {
  using namespace std::string_view_literals;
  if (bytes.starts_with(kMark)) return bytes.substr(kMark.size());
  for (const std::string_view mark : {"\xff\xfe"sv, "\xfe\xff"sv, "\0\0\xfe\xff"sv})
    if (bytes.starts_with(mark))
      throw InputError(file, "",
                       "is text in UTF-16 or UTF-32, which is not read; save it as UTF-8");
  return bytes;
}

bool parse_finite(std::string_view word, float& out) {
  return parse_real(word, out);
}
bool parse_finite(std::string_view word, double& out) {
  return parse_real(word, out);
}

bool parse_float_or_nan(std::string_view word, double& out) {
  if (parse_finite(word, out)) return true;
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  std::string begin(word.substr(0, 3));
  for (char& c : begin) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (begin != "nan" && begin != "inf" && begin != "1.#") return false;
  out = std::numeric_limits<double>::quiet_NaN();
  return true;
}

bool parse_integer(std::string_view word, std::int64_t& out) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, out);
  return stop == end && error == std::errc();
}

bool TextCursor::at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextCursor::word() {
  if (at_end()) fail("the file ends too early");
  return take_word();
}

std::string_view TextCursor::word_in_line() {
  skip_space_in_line();
  return take_word();
}

void TextCursor::skip_line() {
  const std::size_t end = text_.find(break_, at_);
  at_ = end == std::string_view::npos ? text_.size() : end + 1;
  ++line_;
}

float TextCursor::number(std::string_view word, const char* what, std::uint64_t id) const {
  float value;
  if (parse_finite(word, value)) return value;
  fail(named(what, id) +
       (word.empty() ? "a number is missing" : quoted(word) + " is not a finite number"));
}

double TextCursor::coordinate(std::string_view word, const char* what, std::uint64_t id) const {
  using Float = std::numeric_limits<float>;
  double value = 0;
  const bool is_number = parse_finite(word, value);
  if (is_number && value == 0) return value;
  const double size = std::abs(value);
  if (!is_number || size < Float::min() || size > Float::max()) return number(word, what, id);
  return is_between_floats(value) ? std::nextafter(value, number(word, what, id)) : value;
}

double TextCursor::coordinate_or_nan(std::string_view word, const char* what,
                                     std::uint64_t id) const {
  double value = 0;
  const bool is_nan =
      !parse_finite(word, value) && parse_float_or_nan(word, value) && value != value;
  return is_nan ? value : coordinate(word, what, id);
}

std::int64_t TextCursor::integer(std::string_view word, const char* what, std::uint64_t id,
                                 std::int64_t lo, std::int64_t hi) const {
  std::int64_t value;
  const bool is_whole = parse_integer(word, value);
  if (is_whole && value >= lo && value <= hi) return value;
  if (word.empty()) fail(named(what, id) + "a number is missing");
  if (!is_whole) fail(named(what, id) + quoted(word) + " is not a whole number");
  fail(named(what, id) + quoted(word) + " is not within " + std::to_string(lo) + " to " +
       std::to_string(hi));
}

void TextCursor::fail(const std::string& what) const {
  throw InputError(file_, "line " + std::to_string(line_), what);
}

bool TextCursor::is_blank(char c) const {
  return c != break_ && (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f');
}

// A backslash before the end of a line joins it to the next (OBJ).
bool TextCursor::is_continuation() const {
  if (text_[at_] != '\\') return false;
  const std::string_view after = text_.substr(at_ + 1, 2);
  return after.starts_with(break_) || after == "\r\n";
}

bool TextCursor::is_mark() const {
  return text_[at_] == kMark[0] && text_.substr(at_).starts_with(kMark);
}

void TextCursor::skip_space_in_line() {
  for (; at_ < text_.size(); ++at_) {
    if (is_continuation()) {
      at_ = text_.find(break_, at_);
      ++line_;
    } else if (is_mark()) {
      at_ += kMark.size() - 1;
    } else if (!is_blank(text_[at_])) {
      break;
    }
  }
  if (comment_ && at_ < text_.size() && text_[at_] == comment_)
    at_ = std::min(text_.find(break_, at_), text_.size());
}

void TextCursor::skip_space() {
  for (;;) {
    skip_space_in_line();
    if (at_ == text_.size() || text_[at_] != break_) return;
    ++at_;
    ++line_;
  }
}

std::string_view TextCursor::take_word() {
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != break_ && !is_continuation())
    ++at_;
  return text_.substr(start, at_ - start);
}

}  // namespace viewcell
