#include "formats/face_list.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "formats/format_number.h"
#include "mesh/offset.h"
#include "mesh/triangulate.h"

namespace viewcell {
namespace {

template <typename PlaceOf>
Box box_of(std::span<const std::uint32_t> corners, std::size_t n_vertices, const PlaceOf& place) {
  Box box;
  for (const std::uint32_t v : corners) box.add(place(v));
  if (corners.empty())
    for (std::size_t v = 0; v < n_vertices; ++v) box.add(place(v));
  return box;
}

void remark_offset(const TriMesh& mesh, Remarks* remarks) {
  if (mesh.offset != glm::dvec3(0))
    add_remark(
        remarks,
        "far from the origin: positions are kept about (" + format_offset(mesh.offset, ", ") + ")",
        mesh.positions.size());
}

// ---- polygons at one place ----

std::span<const std::uint32_t> corners_of_face(const FaceList& faces, std::uint32_t f) {
  return std::span(faces.vertices).subspan(faces.starts[f], faces.starts[f + 1] - faces.starts[f]);
}

// A polygon that has its corners where an earlier one has them, as the two sides of a sheet do.
struct Copy {
  std::uint32_t face, original;
  std::size_t first;  // its corner where the original's first one is
  bool is_back;       // it has the others the other way round

  std::uint32_t corner(std::uint32_t of_original, std::size_t n) const {
    return static_cast<std::uint32_t>((is_back ? first + n - of_original : first + of_original) %
                                      n);
  }
};

bool align(std::span<const std::uint32_t> original, std::span<const std::uint32_t> corners,
           const std::vector<glm::vec3>& positions, Copy& copy) {
  const std::size_t n = original.size();
  if (corners.size() != n) return false;
  for (copy.first = 0; copy.first < n; ++copy.first)
    for (const bool is_back : {true, false}) {
      copy.is_back = is_back;
      std::uint32_t k = 0;
      while (k < n && positions[original[k]] == positions[corners[copy.corner(k, n)]]) ++k;
      if (k == n) return true;
    }
  return false;
}

// Ascending.
std::vector<Copy> find_copies(const FaceList& faces, const std::vector<glm::vec3>& positions) {
  constexpr std::size_t kBits = 16;  // a polygon: few are looked at twice
  constexpr std::size_t kMostOriginals = 8, kMostCorners = 1024;  // what a hostile file may cost
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;      // the same from any corner
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto corners = corners_of_face(faces, f);
    if (corners.size() < 4 || corners.size() > kMostCorners) continue;
    std::uint64_t key = 0;
    for (const std::uint32_t v : corners) key += hash_position(positions[v]);
    keys.emplace_back(key, f);
  }
  std::vector<Copy> out;
  if (keys.size() < 2) return out;
  const std::size_t mask = std::bit_ceil(kBits * keys.size()) - 1;
  std::vector<bool> is_met(mask + 1, false), is_met_again(mask + 1, false);
  for (const auto& [key, f] : keys) {
    if (is_met[key & mask]) is_met_again[key & mask] = true;
    is_met[key & mask] = true;
  }
  std::erase_if(keys, [&](const auto& key) { return !is_met_again[key.first & mask]; });
  std::sort(keys.begin(), keys.end());
  for (std::size_t first = 0, i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[first].first) first = i;
    for (std::size_t k = first; k < std::min(i, first + kMostOriginals); ++k) {
      Copy copy{keys[i].second, keys[k].second, 0, false};
      if (!align(corners_of_face(faces, copy.original), corners_of_face(faces, copy.face),
                 positions, copy))
        continue;
      out.push_back(copy);
      break;
    }
  }
  std::sort(out.begin(), out.end(), [](const Copy& a, const Copy& b) { return a.face < b.face; });
  return out;
}

// As its original is cut, so that a sheet is one surface, not two that cross.
PolygonCut cut_copy(const Copy& copy, std::span<const std::uint32_t> original,
                    const std::vector<glm::vec3>& positions, std::vector<Triangle>& out) {
  std::vector<glm::vec3> points;
  for (const std::uint32_t v : original) points.push_back(positions[v]);
  const PolygonCut how = triangulate_polygon(points, out);
  for (Triangle& t : out) {
    for (std::uint32_t& k : t) k = copy.corner(k, original.size());
    if (copy.is_back) std::swap(t[1], t[2]);
  }
  return how;
}

}  // namespace

std::uint64_t hash_position(const glm::vec3& p) {
  std::uint64_t h = 0;
  for (int k = 0; k < 3; ++k) {
    h = (h ^ std::bit_cast<std::uint32_t>(p[k] + 0.0f)) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return h;
}

void cut_faces(const FaceList& faces, TriMesh& mesh, TriangleSources* sources, Remarks* remarks) {
  std::vector<glm::vec3> points;
  std::vector<Triangle> cut;
  std::size_t n_short = 0, n_crossed = 0;
  mesh.triangles.reserve(faces.size());
  const std::vector<Copy> copies = find_copies(faces, mesh.positions);
  auto copy = copies.begin();
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const std::uint64_t first = faces.starts[f], n = faces.starts[f + 1] - first;
    n_short += n < 3;
    if (n < 3) continue;
    points.clear(), cut.clear();
    for (std::uint64_t c = first; c < first + n; ++c)
      points.push_back(mesh.positions[faces.vertices[c]]);
    const bool is_copy = copy != copies.end() && copy->face == f;
    const PolygonCut how =
        is_copy ? cut_copy(*copy, corners_of_face(faces, copy->original), mesh.positions, cut)
                : triangulate_polygon(points, cut);
    copy += is_copy;
    n_crossed += how == PolygonCut::crossed;
    for (const Triangle& t : cut) {
      mesh.triangles.push_back({faces.vertices[first + t[0]], faces.vertices[first + t[1]],
                                faces.vertices[first + t[2]]});
      if (sources == nullptr) continue;
      for (const std::uint32_t corner : t) sources->corners.push_back(first + corner);
      sources->faces.push_back(f);
    }
  }
  add_remark(remarks, "faces of fewer than three corners, left out", n_short);
  add_remark(remarks, "polygons that cross themselves or have no area, cut into fans", n_crossed);
}

void mend_unused_places(std::vector<glm::dvec3>& places, std::span<const std::uint32_t> corners,
                        const std::string& file, Remarks* remarks,
                        std::span<const std::int64_t> lines) {
  constexpr double kMost = std::numeric_limits<float>::max();
  std::vector<std::size_t> nowhere;
  for (std::size_t v = 0; v < places.size(); ++v)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(places[v][k]) <= kMost) && (nowhere.empty() || nowhere.back() != v))
        nowhere.push_back(v);
  if (nowhere.empty()) return;
  std::vector<bool> is_used(places.size(), corners.empty());
  for (const std::uint32_t v : corners) is_used[v] = true;
  for (std::size_t i = 0; i < nowhere.size(); ++i) {
    const std::size_t v = nowhere[i];
    const std::string line = i < lines.size() ? "line " + std::to_string(lines[i]) + ": " : "";
    if (is_used[v])
      throw InputError(file, line + "vertex " + std::to_string(v),
                       "a coordinate is not a finite number");
    places[v] = places[corners[0]];
  }
  add_remark(remarks, "vertices that no face uses, without a position", nowhere.size());
}

void place_vertices(std::span<const glm::dvec3> places, std::span<const std::uint32_t> corners,
                    TriMesh& mesh, Remarks* remarks, const std::optional<glm::dvec3>& stated) {
  const Box box = box_of(corners, places.size(), [&](std::size_t v) { return places[v]; });
  const bool takes_stated = stated && is_offset_near(box, *stated);
  place_vertices(mesh, places, takes_stated ? *stated : choose_offset(box));
  remark_offset(mesh, remarks);
}

void choose_offset_of(std::span<const std::uint32_t> corners, TriMesh& mesh, Remarks* remarks) {
  change_offset(mesh, choose_offset(box_of(corners, mesh.positions.size(),
                                           [&](std::size_t v) { return place_of(mesh, v); })));
  remark_offset(mesh, remarks);
}

}  // namespace viewcell
