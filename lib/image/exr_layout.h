// The headers and chunk tables of an EXR file, checked before a decoder reads it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace viewcell {

/// An open file that closes itself.
struct CloseStream {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

/// Walks the headers and chunk tables of a scan-line EXR, of one part or many, and holds that
/// - it is one: no tiles, no deep data;
/// - every data window is 1 to 16384 pixels a side, its corners within 2^20 of the origin;
/// - the chunk tables are as long as the windows ask for, and every chunk starts inside the file;
/// - the last chunk ends inside the file: so a file cut anywhere is found out here.
/// Reads headers and tables only, of the open file, which is called so in errors, and moves its
/// position. Returns its size in bytes. Throws InputError naming the file and the part.
std::uint64_t check_exr_layout(std::FILE* file, const std::string& name);

}  // namespace viewcell
