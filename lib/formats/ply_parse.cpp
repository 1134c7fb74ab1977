// parse_ply: header, then rows as text or as bytes.
#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>

#include "formats/ply.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kMostLineBytes = 1 << 20;  // provenance comments may be long
constexpr std::size_t kMostHeaderLines = 1 << 14;
constexpr std::size_t kMostElements = 64;
constexpr std::size_t kMostProperties = 256;
constexpr std::uint64_t kTypeBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::size_t n_bytes = 0;  // up to and with the end_header line
  std::int64_t n_lines = 0;
};

std::uint64_t type_bytes(PlyType type) {
  return kTypeBytes[static_cast<std::size_t>(type)];
}

std::string in_small_letters(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

// ---- the header ----

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, PlyDocument& document)
      : bytes_(bytes),
        document_(document),
        break_(bytes.starts_with("ply\r") && !bytes.starts_with("ply\r\n") ? '\r' : '\n') {}

  Header parse() {
    if (next_line() != "ply") fail("is not a PLY file: its first line is not 'ply'");
    for (std::string_view line = next_line(); line != "end_header"; line = next_line())
      parse_line(line);
    if (!has_format_) fail("the header has no line 'format'");
    for (PlyElement& element : document_.elements) {
      const std::string name = in_small_letters(element.name);
      if (!document_.find(name)) element.name = name;
      make_names_small(element);
    }
    header_.n_bytes = at_;
    return header_;
  }

 private:
  // Without the line break; blanks at the end are dropped.
  std::string_view next_line() {
    const std::size_t end = bytes_.substr(at_, kMostLineBytes).find(break_);
    ++header_.n_lines;
    if (end == std::string_view::npos)
      fail(bytes_.size() - at_ > kMostLineBytes ? "a header line is too long"
                                                : "the header has no 'end_header'");
    if (header_.n_lines > static_cast<std::int64_t>(kMostHeaderLines))
      fail("the header has too many lines");
    std::string_view line = bytes_.substr(at_, end);
    at_ += end + 1;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
      line.remove_suffix(1);
    return line;
  }

  static std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    for (;;) {
      const std::size_t start = line.find_first_not_of(" \t");
      if (start == std::string_view::npos) return words;
      const std::size_t end = std::min(line.find_first_of(" \t", start), line.size());
      words.push_back(line.substr(start, end - start));
      line.remove_prefix(end);
    }
  }

  void parse_format(const std::vector<std::string_view>& words) {
    static constexpr std::string_view kEncodings[] = {"ascii", "binary_little_endian",
                                                      "binary_big_endian"};  // Encoding's order
    const auto* found = words.size() == 3 && words[2] == "1.0"
                            ? std::find(std::begin(kEncodings), std::end(kEncodings), words[1])
                            : std::end(kEncodings);
    if (found == std::end(kEncodings))
      fail("expected 'format ascii|binary_little_endian|binary_big_endian 1.0'");
    if (has_format_) fail("the format stands twice");
    header_.encoding = static_cast<Encoding>(found - std::begin(kEncodings));
    has_format_ = true;
  }

  void parse_line(std::string_view line) {
    const std::vector<std::string_view> words = split(line);
    if (words.empty() || words[0] == "obj_info") return;
    if (words[0] == "comment")
      document_.comments.emplace_back(line.substr(std::min(line.size(), line.find("comment") + 8)));
    else if (words[0] == "format")
      parse_format(words);
    else if (words[0] == "element" && words.size() == 3)
      add_element(words[1], words[2]);
    else if (words[0] == "property" && (words.size() == 3 || words.size() == 5))
      add_property(words);
    else
      fail(has_format_ ? "expected comment, element, property or end_header"
                       : "expected 'format ascii|binary_little_endian|binary_big_endian 1.0'");
  }

  void add_element(std::string_view name, std::string_view count) {
    PlyElement element;
    element.name = name;
    const char* end = count.data() + count.size();
    const auto [stop, error] = std::from_chars(count.data(), end, element.count);
    if (stop != end || error != std::errc())
      fail("the count of element '" + element.name + "' is not a whole number");
    if (document_.find(name)) fail("element '" + element.name + "' stands twice");
    if (document_.elements.size() == kMostElements) fail("too many elements");
    document_.elements.push_back(std::move(element));
  }

  void add_property(const std::vector<std::string_view>& words) {
    if (document_.elements.empty()) fail("a property stands before the first element");
    PlyElement& element = document_.elements.back();
    PlyColumn column;
    column.name = words.back();
    column.is_list = words.size() == 5;
    if (column.is_list) {
      if (words[1] != "list") fail("expected 'property list COUNT_TYPE TYPE NAME'");
      column.count_type = parse_type(words[2]);
      if (column.count_type >= PlyType::kFloat) fail("a list's length is not of an integer type");
    }
    set_type(column, parse_type(words[words.size() - 2]));
    if (element.find(column.name)) fail("property '" + column.name + "' stands twice");
    if (element.columns.size() == kMostProperties) fail("too many properties");
    element.columns.push_back(std::move(column));
  }

  // "X" is "x", where there is no other.
  static void make_names_small(PlyElement& element) {
    for (PlyColumn& column : element.columns) {
      const std::string name = in_small_letters(column.name);
      if (!element.find(name)) column.name = name;
    }
  }

  PlyType parse_type(std::string_view word) {
    static constexpr std::string_view kNames[][2] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
    const std::string small = in_small_letters(word);
    for (std::size_t i = 0; i < std::size(kNames); ++i)
      if (small == kNames[i][0] || small == kNames[i][1]) return static_cast<PlyType>(i);
    fail("unknown type '" + std::string(word.substr(0, 40)) + "'");
  }

  template <std::size_t I = 0>
  static void set_type(PlyColumn& column, PlyType type) {
    if constexpr (I < std::variant_size_v<PlyValues>) {
      if (static_cast<std::size_t>(type) == I)
        column.values.emplace<I>();
      else
        set_type<I + 1>(column, type);
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(document_.file, "line " + std::to_string(header_.n_lines), what);
  }

  std::string_view bytes_;
  PlyDocument& document_;
  char break_;  // lines end by it
  Header header_;
  bool has_format_ = false;
  std::size_t at_ = 0;
};

// ---- rows ----

bool has_lists(const PlyElement& element) {
  return std::any_of(element.columns.begin(), element.columns.end(),
                     [](const PlyColumn& column) { return column.is_list; });
}

// The least that a row can take: its lists empty; as text, a digit and a blank a value.
std::uint64_t least_row_bytes(const PlyElement& element, Encoding encoding) {
  std::uint64_t n_bytes = 0;
  for (const PlyColumn& column : element.columns)
    n_bytes += encoding == Encoding::kAscii
                   ? 2
                   : type_bytes(column.is_list ? column.count_type : column.type());
  return n_bytes;
}

void check_count(const PlyElement& element, Encoding encoding, std::uint64_t bytes_left,
                 const std::string& file) {
  if (element.count == 0) return;
  const std::uint64_t row_bytes = least_row_bytes(element, encoding);
  if (row_bytes == 0) throw InputError(file, "header", "element '" + element.name + "' is empty");
  if (encoding == Encoding::kAscii) ++bytes_left;  // the last blank may be missing
  if (element.count > bytes_left / row_bytes)
    throw InputError(file, "header",
                     "element '" + element.name + "' claims " + std::to_string(element.count) +
                         " rows, more than the rest of the file can hold");
}

void start_rows(PlyElement& element) {
  for (PlyColumn& column : element.columns) {
    if (column.is_list)
      column.starts.reserve(element.count + 1), column.starts.push_back(0);
    else
      std::visit([&](auto& values) { values.reserve(element.count); }, column.values);
  }
}

template <typename T>
T parse_value(TextCursor& text, const PlyElement& element, std::uint64_t row) {
  if constexpr (std::is_integral_v<T>) {
    // Some writers call bytes of colours char.
    constexpr std::int64_t kMost =
        std::is_same_v<T, std::int8_t> ? 255 : std::int64_t{std::numeric_limits<T>::max()};
    return static_cast<T>(
        text.integer(text.word(), element.name.c_str(), row, std::numeric_limits<T>::min(), kMost));
  } else {
    const std::string_view word = text.word();
    T value;
    double other;
    if (parse_finite(word, value)) return value;
    if (parse_float_or_nan(word, other)) return std::numeric_limits<T>::quiet_NaN();
    text.fail(element.name + " " + std::to_string(row) + ": '" + std::string(word.substr(0, 40)) +
              "' is not a finite number");
  }
}

void parse_text_rows(PlyElement& element, TextCursor& text) {
  for (std::uint64_t row = 0; row < element.count; ++row)
    for (PlyColumn& column : element.columns) {
      // A longer list than the text has words fails at the end of the text.
      const std::int64_t n =
          column.is_list ? text.integer(text.word(), element.name.c_str(), row, 0, 0xffffffff) : 1;
      std::visit(
          [&]<typename T>(std::vector<T>& values) {
            for (std::int64_t i = 0; i < n; ++i)
              values.push_back(parse_value<T>(text, element, row));
            if (column.is_list) column.starts.push_back(values.size());
          },
          column.values);
    }
}

template <typename T>
T swapped(T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

template <typename T>
T load(const char* at, bool swap) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return swap ? swapped(value) : value;
}

// Rows of one size: each column is gathered at its stride. Returns the bytes taken.
std::uint64_t gather_rows(PlyElement& element, const char* data, bool swap) {
  const std::uint64_t stride = least_row_bytes(element, Encoding::kLittleEndian);
  const char* first = data;
  for (PlyColumn& column : element.columns) {
    std::visit(
        [&]<typename T>(std::vector<T>& values) {
          values.resize(element.count);
          for (std::uint64_t i = 0; i < element.count; ++i)
            values[i] = load<T>(first + i * stride, swap);
        },
        column.values);
    first += type_bytes(column.type());
  }
  return element.count * stride;
}

// Rows that hold lists, one after another.
class RowReader {
 public:
  RowReader(const PlyElement& element, std::string_view bytes, bool swap, const std::string& file)
      : element_(element), bytes_(bytes), swap_(swap), file_(file) {}

  void read_value(PlyColumn& column, std::uint64_t row) {
    const std::uint64_t n = column.is_list ? read_count(column.count_type, row) : 1;
    std::visit(
        [&]<typename T>(std::vector<T>& values) {
          need(n, sizeof(T), row);
          const std::size_t old = values.size();
          values.resize(old + n);
          if (n) std::memcpy(values.data() + old, bytes_.data() + at_, n * sizeof(T));
          if (swap_)
            for (std::size_t i = old; i < values.size(); ++i) values[i] = swapped(values[i]);
          at_ += n * sizeof(T);
          if (column.is_list) column.starts.push_back(values.size());
        },
        column.values);
  }
  std::uint64_t bytes_taken() const { return at_; }

 private:
  std::uint64_t read_count(PlyType type, std::uint64_t row) {
    need(1, type_bytes(type), row);
    const char* at = bytes_.data() + at_;
    at_ += type_bytes(type);
    const auto count = [&]() -> std::int64_t {
      switch (type) {
        case PlyType::kInt8:
          return load<std::int8_t>(at, swap_);
        case PlyType::kUint8:
          return load<std::uint8_t>(at, swap_);
        case PlyType::kInt16:
          return load<std::int16_t>(at, swap_);
        case PlyType::kUint16:
          return load<std::uint16_t>(at, swap_);
        case PlyType::kInt32:
          return load<std::int32_t>(at, swap_);
        default:
          return load<std::uint32_t>(at, swap_);
      }
    }();
    if (count < 0) fail(row, "a list of " + std::to_string(count) + " values");
    return static_cast<std::uint64_t>(count);
  }

  void need(std::uint64_t n, std::uint64_t size, std::uint64_t row) const {
    if (n > (bytes_.size() - at_) / size) fail(row, "the file ends inside this row");
  }

  [[noreturn]] void fail(std::uint64_t row, const std::string& what) const {
    throw InputError(file_, element_.name + " " + std::to_string(row), what);
  }

  const PlyElement& element_;
  std::string_view bytes_;
  bool swap_;
  const std::string& file_;
  std::uint64_t at_ = 0;
};

void parse_text(PlyDocument& document, std::string_view body, std::int64_t first_line) {
  TextCursor text(body, document.file, 0, first_line);
  for (PlyElement& element : document.elements) {
    check_count(element, Encoding::kAscii, text.bytes_left(), document.file);
    start_rows(element);
    parse_text_rows(element, text);
  }
  if (!text.at_end()) text.fail("the file goes on after its last row");
}

void parse_binary(PlyDocument& document, std::string_view body, Encoding encoding) {
  const bool swap = encoding == Encoding::kBigEndian;
  for (PlyElement& element : document.elements) {
    check_count(element, encoding, body.size(), document.file);
    if (!has_lists(element)) {
      body.remove_prefix(gather_rows(element, body.data(), swap));
      continue;
    }
    start_rows(element);
    RowReader reader(element, body, swap, document.file);
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (PlyColumn& column : element.columns) reader.read_value(column, row);
    body.remove_prefix(reader.bytes_taken());
  }
  if (body.find_first_not_of("\r\n") != std::string_view::npos)
    throw InputError(document.file, "", "the file goes on after its last row");
}

}  // namespace

PlyDocument parse_ply(std::string_view bytes, const std::string& file) {
  PlyDocument document;
  document.file = file;
  bytes = skip_byte_order_mark(bytes, file);
  const Header header = HeaderParser(bytes, document).parse();
  const std::string_view body = bytes.substr(header.n_bytes);
  if (header.encoding == Encoding::kAscii)
    parse_text(document, body, header.n_lines + 1);
  else
    parse_binary(document, body, header.encoding);
  return document;
}

}  // namespace viewcell
