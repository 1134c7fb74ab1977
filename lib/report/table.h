// Tables of text, for people to read.
#pragma once

#include <string>
#include <vector>

namespace viewcell {

/// Cells of a table, row by row, the header first; all rows have as many cells.
using TableRows = std::vector<std::vector<std::string>>;

/// x with so many decimals; not_a_number for NaN.
std::string format_fixed(double x, int n_decimals, const std::string& not_a_number,
                         bool with_sign = false);

/// The first column to the left, the others to the right, two spaces between.
std::string format_table(const TableRows& rows);
/// The same as Markdown.
std::string format_markdown_table(const TableRows& rows);

}  // namespace viewcell
