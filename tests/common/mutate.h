// Changed copies of a file, on purpose or damaged: whatever a reader makes of them, it must not
// crash.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "base/random.h"

namespace viewcell {

/// With `to` for the first `from`, which must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// One to four bytes changed, or a stretch taken out, doubled or cut off.
inline std::string mutate(std::string bytes, Random& random) {
  const auto place = [&] { return random.below(static_cast<std::uint32_t>(bytes.size())); };
  const std::uint32_t kind = random.below(8);
  if (kind == 0) return bytes.substr(0, place());
  if (kind == 1) return bytes.erase(place(), 1 + random.below(8));
  if (kind == 2) {
    const std::size_t at = place();
    return bytes.insert(at, bytes.substr(at, 1 + random.below(16)));
  }
  for (std::uint32_t n = 1 + random.below(4); n > 0; --n) {
    static constexpr char kTelling[] = {0, -1, '9', '-', 'e', ' ', '\n', 0x7f};
    bytes[place()] = random.below(2) ? kTelling[random.below(sizeof kTelling)]
                                     : static_cast<char>(random.below(256));
  }
  return bytes;
}

/// Calls read(damaged) for `n` damaged copies; InputError is the one exception allowed. Of many
/// copies some are cut short, which must be noticed.
template <typename Read>
void read_damaged_copies(const std::string& bytes, int n, std::uint64_t seed, const Read& read) {
  Random random(seed);
  int n_refused = 0;
  for (int i = 0; i < n; ++i) {
    const std::string damaged = mutate(bytes, random);
    try {
      read(damaged);
    } catch (const InputError&) {
      ++n_refused;
    }
  }
  if (n >= 100) {
    EXPECT_GT(n_refused, n / 20);
  }
}

}  // namespace viewcell
