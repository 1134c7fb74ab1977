#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "cells/cells.h"
#include "scene/camera.h"

namespace viewcell {
namespace {

// A whole number of digits alone, or -1.
int parse_count(const std::string& text) {
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

int parse_int(const std::string& text, const std::string& all) {
  const int value = parse_count(text);
  if (value < 0) throw UsageError("--cells: '" + text + "' in '" + all + "' is not a cell");
  return value;
}

void add_range(const CellSet& cells, const std::string& item, const std::string& all,
               std::set<int>& out) {
  const std::size_t dash = item.find('-');
  const int first = parse_int(item.substr(0, dash), all);
  const int last = dash == std::string::npos ? first : parse_int(item.substr(dash + 1), all);
  if (last < first) throw UsageError("--cells: '" + item + "' runs backwards");
  if (last >= cells.grid.n_cells())
    throw InputError("--cells", item,
                     "cell " + std::to_string(last) + " is out of range: the grid has cells 0 to " +
                         std::to_string(cells.grid.n_cells() - 1));
  for (int i = first; i <= last; ++i) out.insert(i);
}

void add_list(const CellSet& cells, const std::string& list, std::set<int>& out) {
  std::string item;
  for (const char c : list + ",") {
    if (c != ',' && !std::isspace(static_cast<unsigned char>(c))) {
      item += c;
    } else if (!item.empty()) {
      add_range(cells, item, list.size() < 60 ? list : list.substr(0, 60) + "...", out);
      item.clear();
    }
  }
}

// The cells on the path, found at steps short against a cell.
void add_path(const CellSet& cells, const std::string& file, std::set<int>& out) {
  const CameraPath path = read_path(file);
  const auto add = [&](const glm::dvec3& eye) {
    if (const auto cell = cell_at(cells.grid, coord_at(cells.grid, glm::dvec2(eye))))
      out.insert(static_cast<int>(*cell));
  };
  add(path.samples.front().eye);
  for (std::size_t i = 1; i < path.samples.size(); ++i) {
    const glm::dvec3 a = path.samples[i - 1].eye, b = path.samples[i].eye;
    const int n = 1 + static_cast<int>(std::min(1e6, glm::length(b - a) / (cells.grid.size / 50)));
    for (int k = 1; k <= n; ++k) add(glm::mix(a, b, static_cast<double>(k) / n));
  }
}

void keep_slice(const std::string& slice, std::vector<CellId>& list) {
  const std::size_t stroke = std::min(slice.find('/'), slice.size());
  const int i = parse_count(slice.substr(0, stroke));
  const int n = stroke < slice.size() ? parse_count(slice.substr(stroke + 1)) : -1;
  if (i < 1 || n < i) throw UsageError("--slice: '" + slice + "' is not I/N with 1 <= I <= N");
  std::vector<CellId> kept;
  for (std::size_t k = static_cast<std::size_t>(i) - 1; k < list.size();
       k += static_cast<std::size_t>(n))
    kept.push_back(list[k]);
  list = std::move(kept);
}

}  // namespace

std::vector<CellId> select_cells(const CellSet& cells, const std::string& list,
                                 const std::string& slice) {
  std::set<int> chosen;
  if (list == "all") {
    for (int i = 0; i < cells.grid.n_cells(); ++i) chosen.insert(i);
  } else if (list.starts_with("@")) {
    add_list(cells, read_file(list.substr(1), 1 << 26), chosen);
  } else if (list.starts_with("path:")) {
    add_path(cells, list.substr(5), chosen);
  } else {
    add_list(cells, list, chosen);
  }
  if (chosen.empty()) throw UsageError("--cells: '" + list + "' names no cell");
  std::vector<CellId> out;
  for (const int i : chosen) out.push_back(CellId(i));
  if (!slice.empty()) keep_slice(slice, out);
  return out;
}

std::vector<CentreId> centres_of(const CellSet& cells, const std::vector<CellId>& list) {
  std::set<CentreId> centres;
  for (const CellId cell : list)
    for (const CentreId centre : views_of(cells.grid, cell)) centres.insert(centre);
  return {centres.begin(), centres.end()};
}

}  // namespace viewcell
