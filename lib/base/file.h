// Files read whole, and files written whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewcell {

/// The whole file. Throws InputError when it is missing, is a folder, is unreadable, or is larger
/// than max_bytes; "-" reads standard input.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 1ULL << 33);

/// Writes the bytes to a temporary beside the target, syncs and renames it: after a kill at any
/// moment the target is absent, old or whole, and where the file system has files without a name
/// (ext4, xfs, btrfs, tmpfs) hardly a temporary is left behind. "-" writes standard output; a
/// device or a pipe is written to as it is. Throws MachineError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that others fill by name (a library's writer): write to temporary(), then commit().
/// Without commit() the temporary is removed and the target stays as it was.
class PendingFile {
 public:
  explicit PendingFile(std::filesystem::path target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  /// Beside the target, with the target's extension.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Syncs the temporary and renames it to the target. Throws MachineError.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
};

/// Makes the folder and its parents. Throws MachineError, or InputError when a file is in the way.
void make_folder(const std::filesystem::path& folder);

/// `relative`, as written in `file`, as a path to open: relative to the folder of `file`, and not
/// outside it (symbolic links followed). Throws InputError (file, place).
std::filesystem::path resolve_inside(const std::filesystem::path& file, const std::string& place,
                                     const std::string& relative);

/// XXH3 (64 bits) as 16 hexadecimal digits.
std::string hash_hex(std::string_view bytes);
std::uint64_t hash_bytes(const void* data, std::size_t n_bytes);
/// hash_hex of a file's bytes.
std::string hash_file(const std::filesystem::path& path);

}  // namespace viewcell
