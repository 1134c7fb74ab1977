#include "pm/fan.h"

#include <algorithm>
#include <cstring>

namespace viewcell {
namespace {

constexpr std::size_t kLanes = 8;
// Longer fans are sorted.
constexpr std::size_t kMostCompared = 128;
constexpr std::uint32_t kNoVertex = 0xffffffffu;
// Numbers that one instruction compares (of GCC and Clang).
using Lanes [[gnu::vector_size(kLanes * sizeof(std::uint32_t))]] = std::uint32_t;

// Whether each of the values is among n others exactly once; the values filled up to 8 with
// kNoVertex.
bool match_once(const std::uint32_t* values, const std::uint32_t* others, std::size_t n) {
  Lanes all, n_equal{};
  std::memcpy(&all, values, sizeof all);
  for (std::size_t i = 0; i < n; ++i) n_equal -= all == others[i];
  const Lanes wrong = (n_equal - 1) & (all != kNoVertex);
  std::uint64_t any[4];
  std::memcpy(any, &wrong, sizeof any);
  return (any[0] | any[1] | any[2] | any[3]) == 0;
}

std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> out(values.begin(), values.end());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void Fan::resize(std::size_t n) {
  n_ = n;
  const std::size_t n_filled = (n + kLanes - 1) / kLanes * kLanes;
  if (a_.size() < n_filled) a_.resize(n_filled), b_.resize(n_filled);
  for (std::size_t i = n; i < n_filled; ++i) a_[i] = b_[i] = kNoVertex;
}

bool Fan::is_closed() const {
  if (n_ > kMostCompared) {
    const auto all_a = sorted(a()), all_b = sorted(b());
    return all_a == all_b && std::adjacent_find(all_a.begin(), all_a.end()) == all_a.end();
  }
  const auto all_once = [this](const auto& x, const auto& y) {
    for (std::size_t i = 0; i < n_; i += kLanes)
      if (!match_once(&x[i], y.data(), n_)) return false;
    return true;
  };
  return all_once(a_, b_) && all_once(b_, a_);
}

// Each triangle (v, a, b) has the edges v-a and v-b, so an edge with two triangles is met twice.
bool Fan::has_odd_edge() const {
  if (is_closed()) return false;
  if (n_ > kMostCompared) {
    std::vector<std::uint32_t> all = sorted(a()), all_b = sorted(b());
    all.insert(all.end(), all_b.begin(), all_b.end());
    std::sort(all.begin(), all.end());
    for (auto first = all.begin(), last = first; first != all.end(); first = last) {
      last = std::upper_bound(first, all.end(), *first);
      if ((last - first) % 2 == 1) return true;
    }
    return false;
  }
  const auto n_times = [this](std::uint32_t x) {
    const auto all_a = a(), all_b = b();
    return std::count(all_a.begin(), all_a.end(), x) + std::count(all_b.begin(), all_b.end(), x);
  };
  for (std::size_t i = 0; i < n_; ++i)
    if (n_times(a_[i]) % 2 == 1 || n_times(b_[i]) % 2 == 1) return true;
  return false;
}

}  // namespace viewcell
