#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cstdio>

#include "base/error.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

std::string read_standard_input(std::uint64_t max_bytes) {
  std::string bytes;
  char block[1 << 16];
  for (;;) {
    const ssize_t n = ::read(0, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError("-", "", "cannot read standard input: " + errno_text());
    if (n == 0) return bytes;
    bytes.append(block, static_cast<std::size_t>(n));
    if (bytes.size() > max_bytes)
      throw InputError("-", "", "more than " + std::to_string(max_bytes) + " bytes");
  }
}

}  // namespace

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  if (path == "-") return read_standard_input(max_bytes);
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.get() < 0) throw InputError(path.string(), "", "cannot open: " + errno_text());
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) throw InputError(path.string(), "", errno_text());
  if (S_ISDIR(info.st_mode)) throw InputError(path.string(), "", "is a folder, not a file");
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size > max_bytes)
    throw InputError(path.string(), "",
                     std::to_string(size) + " bytes, more than " + std::to_string(max_bytes));
  std::string bytes(size, '\0');
  std::size_t done = 0;
  for (;;) {
    if (done == bytes.size()) bytes.resize(done + 4096);  // a pipe has no size: read to its end
    const ssize_t n = ::read(fd.get(), bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError(path.string(), "", "cannot read: " + errno_text());
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
    if (done > max_bytes)
      throw InputError(path.string(), "", "more than " + std::to_string(max_bytes) + " bytes");
  }
  bytes.resize(done);
  return bytes;
}

void refuse_special(const fs::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode))
    throw InputError(path.string(), "", "is a pipe or a device, not a file");
}

fs::path resolve_inside(const fs::path& file, const std::string& place,
                        const std::string& relative) {
  const auto refuse = [&](const std::string& why) -> void {
    throw InputError(file.string(), place, "path '" + relative + "' " + why);
  };
  const auto canonical = [&](const fs::path& path) {
    std::error_code error;  // a loop of links, a name too long, a folder that may not be entered
    fs::path out = fs::weakly_canonical(path, error);
    if (error) refuse("cannot be followed: " + error.message());
    return out;
  };
  if (relative.empty()) refuse("is empty");
  if (relative.find('\0') != std::string::npos) refuse("holds a zero byte");
  if (fs::path(relative).is_absolute()) refuse("is absolute; it must be relative to the file");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const fs::path root = canonical(folder);
  const fs::path full = canonical(folder / relative);
  const auto [at_root, at_full] = std::mismatch(root.begin(), root.end(), full.begin(), full.end());
  if (at_root != root.end()) refuse("leaves the file's folder");
  std::error_code ignored;  // what is not there is another's to say
  const fs::file_status found = fs::status(full, ignored);
  if (fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found))
    refuse("is a pipe or a device, not a file");
  return folder / relative;
}

std::uint64_t hash_bytes(const void* data, std::size_t n_bytes) {
  return XXH3_64bits(data, n_bytes);
}

std::string hash_hex(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string hash_hex(std::string_view bytes) {
  return hash_hex(hash_bytes(bytes.data(), bytes.size()));
}

std::string hash_file(const fs::path& path) {
  return hash_hex(read_file(path));
}

}  // namespace viewcell
