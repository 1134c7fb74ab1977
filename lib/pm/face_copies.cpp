#include "pm/face_copies.h"

#include <algorithm>
#include <utility>

#include "base/buckets.h"

namespace viewcell {
namespace {

// A face, among those of its lowest vertex.
struct FaceKey {
  std::uint64_t others;  // the two other vertices, the lower one first
  std::uint32_t face;
};

Triangle in_order(const Triangle& face) {
  auto [a, b, c] = face;
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

// Of faces with three corners: calls visit(keys) for those of each lowest vertex, faces ascending;
// of some, that are not in order, twice.
template <typename Visit>
void for_each_lowest(std::span<const Triangle> faces, std::size_t n_vertices, Visit&& visit) {
  const auto key_of = [&](std::uint32_t f, const Triangle& t) {
    return FaceKey{std::uint64_t{t[1]} << 32 | t[2], f};
  };
  // Mostly they stand in this order as they are (WedgeOptions::along_curve).
  std::vector<FaceKey> keys;
  std::uint32_t at = 0, f = 0;
  for (; f < faces.size(); ++f) {
    const Triangle t = in_order(faces[f]);
    if (t[0] == t[1] || t[1] == t[2]) continue;
    if (t[0] < at) break;
    if (std::exchange(at, t[0]) != t[0]) {
      visit(std::span<const FaceKey>(keys));
      keys.clear();
    }
    keys.push_back(key_of(f, t));
  }
  visit(std::span<const FaceKey>(keys));
  if (f == faces.size()) return;
  const auto buckets = fill_buckets<FaceKey>(n_vertices, [&](const auto& emit) {
    for (f = 0; f < faces.size(); ++f) {
      const Triangle t = in_order(faces[f]);
      if (t[0] != t[1] && t[1] != t[2]) emit(t[0], key_of(f, t));
    }
  });
  for (std::size_t v = 0; v < n_vertices; ++v) visit(buckets.of(v));
}

}  // namespace

FaceCopies find_face_copies(std::span<const Triangle> faces, std::size_t n_vertices) {
  FaceCopies out;
  const auto link = [&](std::uint32_t first, std::uint32_t second) {
    if (out.empty()) out.next.assign(faces.size(), kNoCopy), out.is_copy.resize(faces.size());
    out.next[first] = second;
    out.is_copy[second] = true;
  };
  constexpr std::size_t kFew = 8;
  std::vector<FaceKey> sorted;
  for_each_lowest(faces, n_vertices, [&](std::span<const FaceKey> keys) {
    bool has_copies = keys.size() > kFew;
    for (std::size_t i = 1; i < keys.size() && !has_copies; ++i)
      for (std::size_t j = 0; j < i; ++j)
        has_copies = has_copies || keys[i].others == keys[j].others;
    if (!has_copies) return;
    sorted.assign(keys.begin(), keys.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const FaceKey& x, const FaceKey& y) { return x.others < y.others; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].others == sorted[i - 1].others) link(sorted[i - 1].face, sorted[i].face);
  });
  return out;
}

std::vector<Triangle> without_copies(std::vector<Triangle> faces, const FaceCopies& copies) {
  for (std::size_t f = 0; f < copies.is_copy.size(); ++f)
    if (copies.is_copy[f]) faces[f] = {faces[f][0], faces[f][0], faces[f][0]};
  return faces;
}

}  // namespace viewcell
