#include "report/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace viewcell {

std::string format_fixed(double x, int n_decimals, const std::string& not_a_number,
                         bool with_sign) {
  if (std::isnan(x)) return not_a_number;
  char text[400];  // the longest double has some 310 digits before the point
  std::snprintf(text, sizeof text, with_sign ? "%+.*f" : "%.*f", n_decimals, x);
  return text;
}

std::string format_table(const TableRows& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(widths[c] - row[c].size(), ' ');
      out += c == 0 ? row[c] + pad : "  " + pad + row[c];
    }
    out.erase(out.find_last_not_of(' ') + 1);
    out += '\n';
  }
  return out;
}

std::string format_markdown_table(const TableRows& rows) {
  std::string out;
  for (const auto& row : rows) {
    out += '|';
    for (const std::string& cell : row) out += " " + cell + " |";
    out += '\n';
    if (&row != &rows.front()) continue;
    out += "|---|";
    for (std::size_t c = 1; c < row.size(); ++c) out += "---:|";
    out += '\n';
  }
  return out;
}

}  // namespace viewcell
