#include "pm/face_copies.h"

#include <algorithm>

#include "base/buckets.h"

namespace viewcell {
namespace {

// A face, in the bucket of its lowest vertex.
struct FaceKey {
  std::uint64_t others;  // the two other vertices, the lower one first
  std::uint32_t face;
};

}  // namespace

FaceCopies find_face_copies(std::span<const Triangle> faces, std::size_t n_vertices) {
  const auto buckets = fill_buckets<FaceKey>(n_vertices, [&](const auto& emit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      auto [a, b, c] = faces[f];
      if (a == b || b == c || c == a) continue;
      if (a > b) std::swap(a, b);
      if (a > c) std::swap(a, c);
      if (b > c) std::swap(b, c);
      emit(a, FaceKey{std::uint64_t{b} << 32 | c, f});
    }
  });
  FaceCopies out;
  const auto link = [&](std::uint32_t first, std::uint32_t second) {
    if (out.empty()) out.next.assign(faces.size(), kNoCopy), out.is_copy.resize(faces.size());
    out.next[first] = second;
    out.is_copy[second] = true;
  };
  constexpr std::size_t kFew = 8;
  std::vector<FaceKey> sorted;
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const std::span<const FaceKey> keys = buckets.of(v);
    bool has_copies = keys.size() > kFew;
    for (std::size_t i = 1; i < keys.size() && !has_copies; ++i)
      for (std::size_t j = 0; j < i; ++j)
        has_copies = has_copies || keys[i].others == keys[j].others;
    if (!has_copies) continue;
    sorted.assign(keys.begin(), keys.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const FaceKey& x, const FaceKey& y) { return x.others < y.others; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].others == sorted[i - 1].others) link(sorted[i - 1].face, sorted[i].face);
  }
  return out;
}

std::vector<Triangle> without_copies(std::vector<Triangle> faces, const FaceCopies& copies) {
  for (std::size_t f = 0; f < copies.is_copy.size(); ++f)
    if (copies.is_copy[f]) faces[f] = {faces[f][0], faces[f][0], faces[f][0]};
  return faces;
}

}  // namespace viewcell
