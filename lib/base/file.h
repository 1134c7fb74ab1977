// Files read whole, and files written whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"
#include "base/temporaries.h"

namespace viewcell {

/// The whole file. Throws InputError when it is missing, is a folder, is unreadable, or is larger
/// than max_bytes; "-" reads standard input.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 1ULL << 33);

/// Throws InputError where a pipe, a socket or a device stands: what is typed may be one, what a
/// file or a folder names may not, for reading it might never end.
void refuse_special(const std::filesystem::path& path);

/// Writes the bytes to a temporary beside the target, syncs and renames it: after a kill at any
/// moment the target is absent, old or whole, and where the file system has files without a name
/// (ext4, xfs, btrfs, tmpfs) hardly a temporary is left behind. "-" writes standard output; a
/// device or a pipe is written to as it is. Throws MachineError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that is on disk but not in its place yet, for several that must come together. Without
/// commit() nothing is left of it, and the target stays as it was.
class PendingFile {
 public:
  /// Writes and syncs. Throws MachineError.
  PendingFile(std::filesystem::path target, std::string_view bytes);
  /// Renames it to the target; once_there runs in the same step (run_uninterrupted). Throws
  /// MachineError: before once_there when the target is as it was, after it when only syncing
  /// failed.
  void commit(const std::function<void()>& once_there = {});

 private:
  void write_named(std::string_view bytes);

  std::filesystem::path target_;
  Descriptor lock_;
  Temporary temporary_;
};

/// A folder beside a target, for writers that take file names: it goes with all that is in it but
/// what commit() took out.
class PendingFolder {
 public:
  explicit PendingFolder(const std::filesystem::path& target);
  const std::filesystem::path& path() const { return folder_.path(); }
  /// Renames the file of that name to the target. Throws MachineError.
  void commit(const std::string& name, const std::filesystem::path& target);

 private:
  Descriptor lock_;
  Temporary folder_;
};

/// Makes the folder and its parents. Throws MachineError, or InputError when a file is in the way.
void make_folder(const std::filesystem::path& folder);

/// `relative`, as written in `file`, as a path to open: relative to the folder of `file`, and not
/// outside it (symbolic links followed), and no pipe or device. Throws InputError (file, place).
std::filesystem::path resolve_inside(const std::filesystem::path& file, const std::string& place,
                                     const std::string& relative);

/// XXH3 (64 bits) as 16 hexadecimal digits.
std::string hash_hex(std::string_view bytes);
std::string hash_hex(std::uint64_t hash);
std::uint64_t hash_bytes(const void* data, std::size_t n_bytes);
/// hash_hex of a file's bytes.
std::string hash_file(const std::filesystem::path& path);

}  // namespace viewcell
