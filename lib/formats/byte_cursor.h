// Walks over little-endian bytes with bounds, for the binary readers of this room.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"

namespace viewcell {

static_assert(std::endian::native == std::endian::little);

/// The bytes must outlive the cursor. Reading past the end throws InputError (file, byte).
class ByteCursor {
 public:
  ByteCursor(std::string_view bytes, std::string file, std::uint64_t start = 0)
      : bytes_(bytes), file_(std::move(file)), start_(start) {}

  template <typename T>
  T read() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view take(std::uint64_t n_bytes) {
    if (n_bytes > bytes_left()) fail("the file ends too early");
    at_ += n_bytes;
    return bytes_.substr(at_ - n_bytes, n_bytes);
  }
  /// The next n_bytes as a cursor of their own.
  ByteCursor part(std::uint64_t n_bytes) {
    const std::uint64_t start = start_ + at_;
    return {take(n_bytes), file_, start};
  }
  std::uint64_t bytes_left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "byte " + std::to_string(start_ + at_), what);
  }

 private:
  std::string_view bytes_;
  std::string file_;
  std::uint64_t start_;  // of bytes_ in the file
  std::uint64_t at_ = 0;
};

}  // namespace viewcell
