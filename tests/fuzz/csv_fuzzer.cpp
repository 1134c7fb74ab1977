// CSV.
#include "fuzz.h"
#include "report/csv.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  CsvTable table;
  if (!is_taken([&] { table = parse_csv(std::string(view_of(data, n_bytes)), "in.csv"); }))
    return 0;
  hold(table.lines.size() == table.rows.size(), "a line a row");
  for (const auto& row : table.rows)
    hold(row.size() == table.columns.size(), "rows are of one length");
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    is_taken([&] { hold(read_numbers(table, c).size() == table.rows.size(), "a number a row"); });
  return 0;
}
