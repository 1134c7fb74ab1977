// Comma-separated values with a header, as RFC 4180 has them: quotes, doubled within quotes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace viewcell {

struct CsvTable {
  std::filesystem::path file;                  ///< for errors
  std::vector<std::string> columns;            ///< names, each of its own
  std::vector<std::vector<std::string>> rows;  ///< each as long as columns
  std::vector<std::size_t> lines;              ///< of the file, where each row begins; from 1
};

/// Text that came from `file`; a byte order mark and empty lines are skipped. Throws InputError
/// (file, line) for a row that is not as long as the header, a quote that does not end, text after
/// a quote, a column named twice, or no header.
CsvTable parse_csv(const std::string& text, const std::filesystem::path& file);

/// The place of a column. Throws InputError that names the columns there are.
std::size_t find_column(const CsvTable& table, const std::string& name);

/// A column of numbers; empty fields and "nan" as NaN. Throws InputError (file, line, column).
std::vector<double> read_numbers(const CsvTable& table, std::size_t column);

}  // namespace viewcell
