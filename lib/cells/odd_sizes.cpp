#include "cells/odd_sizes.h"

#include <algorithm>
#include <cstdio>

namespace viewcell {
namespace {

constexpr double kSuits = 0.8;  // of a cell's circumradius: a statue 40 units high, cells of 50

// Objects of one oddity: the first, and how many there are.
struct OddObjects {
  std::size_t n = 0;
  std::string first;
  void add(const std::string& words) {
    if (n++ == 0) first = words;
  }
};

std::string odd_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, x < 1000 || x > 1e15 ? "%.3g" : "%.0f", x);
  return text;
}

std::string name_of_object(const Scene& scene, std::size_t id) {
  return "object " + std::to_string(id) + " ('" + scene.objects[id].name + "', of " +
         scene.mesh_of(scene.objects[id]).file + ")";
}

void finish_line(const OddObjects& odd, const std::string& advice, std::vector<std::string>& out) {
  if (odd.n == 0) return;
  std::string line = odd.first;
  if (odd.n > 1) line += ", and so are " + std::to_string(odd.n - 1) + " more";
  out.push_back(line + ": " + advice);
}

}  // namespace

std::vector<std::string> find_odd_sizes(const Scene& scene, double cell_size) {
  OddObjects large, small, outside;
  const glm::dvec2 area = scene.area.hi - scene.area.lo;
  const double suits = kSuits * cell_size;
  for (std::size_t id = 0; id < scene.objects.size(); ++id) {
    const Box box = world_box(scene, scene.objects[id]);
    const glm::dvec3 size = box.size();
    const double extent = std::max({size.x, size.y, size.z});
    const auto words = [&](double times, const char* than) {
      return name_of_object(scene, id) + " is " + odd_number(extent) + " units large, " +
             odd_number(times) + " times " + than + " what suits cells of size " +
             odd_number(cell_size);
    };
    if (extent > kOddTimes * suits && extent > std::max(area.x, area.y))
      large.add(words(extent / suits, "more than"));
    if (extent < suits / kOddTimes) small.add(words(suits / std::max(extent, 1e-300), "less than"));
    if (box.hi.x < scene.area.lo.x || box.lo.x > scene.area.hi.x || box.hi.y < scene.area.lo.y ||
        box.lo.y > scene.area.hi.y)
      outside.add(name_of_object(scene, id) + " stands outside the area");
  }
  std::vector<std::string> lines;
  finish_line(large, "is its mesh's \"scale\" right?", lines);
  finish_line(small, "is its mesh's \"scale\" right?", lines);
  finish_line(outside, "no cell is there (\"translation\", \"area\"; \"place\": \"ground\")",
              lines);
  return lines;
}

}  // namespace viewcell
