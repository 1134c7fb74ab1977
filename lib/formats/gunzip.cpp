#include <zlib.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

constexpr std::uint64_t kMostInflatedBytes = 4ULL << 30;
constexpr std::uint64_t kFreeBytes = 64ULL << 20;
constexpr std::uint64_t kMostRatio = 100;  // deflate can reach 1032; text of numbers stays under 10

// An inflate stream that ends itself.
class Inflater {
 public:
  Inflater() {
    constexpr int kGzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw MachineError("zlib: cannot start inflate");
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  z_stream stream{};
};

}  // namespace

std::string gunzip(std::string_view bytes, const std::filesystem::path& file) {
  const std::uint64_t most = std::min(kMostInflatedBytes, kFreeBytes + kMostRatio * bytes.size());
  Inflater inflater;
  z_stream& stream = inflater.stream;
  std::string out;
  std::string block(1 << 18, '\0');
  std::size_t at = 0;
  for (;;) {
    const std::size_t n_in =
        std::min<std::size_t>(bytes.size() - at, std::numeric_limits<uInt>::max());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
    stream.avail_in = static_cast<uInt>(n_in);
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    const int code = inflate(&stream, Z_NO_FLUSH);
    at += n_in - stream.avail_in;
    const std::size_t n_out = block.size() - stream.avail_out;
    if (out.size() + n_out > most)
      throw InputError(file.string(), "",
                       "unpacks to more than " + std::to_string(most) + " bytes");
    out.append(block, 0, n_out);
    if (code == Z_STREAM_END) {
      if (at == bytes.size()) return out;
      inflateReset(&stream);  // a gzip file may hold several members
    } else if (code != Z_OK) {
      throw InputError(file.string(), "byte " + std::to_string(at),
                       at == bytes.size() ? "the gzip file is cut off" : "not valid gzip data");
    }
  }
}

}  // namespace viewcell
