#include "report/csv.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr std::size_t kMostShown = 60;  // characters of a field in a message

std::string at_line(std::size_t line) {
  return "line " + std::to_string(line);
}

std::string quote(const std::string& text) {
  return "'" + (text.size() > kMostShown ? text.substr(0, kMostShown) + "..." : text) + "'";
}

// Reads fields one by one; knows where it is.
class CsvCursor {
 public:
  CsvCursor(const std::string& text, const std::filesystem::path& file) : text_(text), file_(file) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }

  bool is_at_end() const { return at_ >= text_.size(); }
  std::size_t line() const { return line_; }

  /// A record's fields, the end of its line included.
  std::vector<std::string> record() {
    std::vector<std::string> fields;
    do fields.push_back(field());
    while (take(','));
    end_line();
    return fields;
  }

 private:
  bool is_next(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) {
    if (!is_next(c)) return false;
    ++at_;
    return true;
  }
  std::string field() { return take('"') ? quoted() : plain(); }

  std::string plain() {
    const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    std::string field = text_.substr(at_, end - at_);
    at_ = end;
    return field;
  }

  std::string quoted() {
    const std::size_t first_line = line_;
    std::string field;
    while (!is_at_end()) {
      const char c = text_[at_++];
      if (c == '"' && !take('"')) return field;
      line_ += c == '\n';
      field += c;
    }
    throw InputError(file_.string(), at_line(first_line), "a quote does not end");
  }

  void end_line() {
    take('\r');
    if (!is_at_end() && !take('\n'))
      throw InputError(file_.string(), at_line(line_), "a field goes on after its quote");
    ++line_;
  }

  const std::string& text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0, line_ = 1;
};

bool is_empty_line(const std::vector<std::string>& record) {
  return record.size() == 1 && record[0].empty();
}

void check_header(const CsvTable& table) {
  if (table.columns.empty()) throw InputError(table.file.string(), "", "has no header");
  std::set<std::string> names;
  for (const std::string& name : table.columns)
    if (!names.insert(name).second)
      throw InputError(table.file.string(), "header", "column " + quote(name) + " stands twice");
}

}  // namespace

CsvTable parse_csv(const std::string& text, const std::filesystem::path& file) {
  CsvTable table;
  table.file = file;
  for (CsvCursor cursor(text, file); !cursor.is_at_end();) {
    const std::size_t line = cursor.line();
    std::vector<std::string> record = cursor.record();
    if (is_empty_line(record)) continue;
    if (table.columns.empty()) {
      table.columns = std::move(record);
      continue;
    }
    if (record.size() != table.columns.size())
      throw InputError(file.string(), at_line(line),
                       "has " + std::to_string(record.size()) + " fields, the header has " +
                           std::to_string(table.columns.size()));
    table.rows.push_back(std::move(record));
    table.lines.push_back(line);
  }
  check_header(table);
  return table;
}

std::size_t find_column(const CsvTable& table, const std::string& name) {
  std::string names;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    if (table.columns[k] == name) return k;
    names += (k == 0 ? "" : ", ") + table.columns[k];
  }
  throw InputError(table.file.string(), "header",
                   "has no column " + quote(name) + "; it has " + names.substr(0, 400));
}

std::vector<double> read_numbers(const CsvTable& table, std::size_t column) {
  std::vector<double> numbers;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& field = table.rows[r][column];
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (!field.empty() && (error != std::errc() || end != field.data() + field.size()))
      throw InputError(table.file.string(), at_line(table.lines[r]),
                       table.columns[column] + ": " + quote(field) + " is not a number");
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace viewcell
