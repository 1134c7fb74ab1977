// Lists of items by key, one after another in one array.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace viewcell {

/// Key k has items[starts[k], starts[k + 1]).
template <typename Item>
struct Buckets {
  std::vector<std::uint32_t> starts;
  std::vector<Item> items;

  std::size_t size() const { return starts.size() - 1; }
  std::span<Item> of(std::size_t key) {
    return std::span(items).subspan(starts[key], starts[key + 1] - starts[key]);
  }
  std::span<const Item> of(std::size_t key) const {
    return std::span(items).subspan(starts[key], starts[key + 1] - starts[key]);
  }
};

/// for_each(emit) calls emit(key, item) for all items, keys below n_keys, twice over in the same
/// order, which a key's items keep. O(keys + items), by counting.
template <typename Item, typename ForEach>
Buckets<Item> fill_buckets(std::size_t n_keys, const ForEach& for_each) {
  Buckets<Item> out;
  out.starts.assign(n_keys + 2, 0);
  for_each([&](std::size_t key, const Item&) { ++out.starts[key + 2]; });
  std::partial_sum(out.starts.begin(), out.starts.end(), out.starts.begin());
  out.items.resize(out.starts.back());
  for_each([&](std::size_t key, const Item& item) { out.items[out.starts[key + 1]++] = item; });
  out.starts.pop_back();
  return out;
}

}  // namespace viewcell
