#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <iterator>

#include "base/error.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

std::string errno_text() {
  return std::strerror(errno);
}

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

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

void write_all(int fd, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw MachineError(name + ": cannot write: " + errno_text());
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

// A device or a pipe: it is written to, for a rename would put a file in its place.
bool is_special(const fs::path& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

// Unique in this process and among processes; leading dot, so that globs pass it over.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string tag = std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return target.parent_path() / (".tmp-" + tag + "-" + target.filename().string());
}

void sync_path(const fs::path& path, int flags) {
  const Descriptor fd(::open(path.c_str(), flags));
  if (fd.get() < 0 || ::fsync(fd.get()) != 0)
    throw MachineError(path.string() + ": cannot sync: " + errno_text());
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

void rename_into_place(const fs::path& temporary, const fs::path& target) {
  if (::rename(temporary.c_str(), target.c_str()) != 0)
    throw MachineError(target.string() + ": cannot rename into place: " + errno_text());
  sync_path(folder_of(target), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

// Through a file that has no name until all of it is on disk, so that a kill leaves none behind.
// False where the file system or the machine has no such files.
bool write_unnamed(const fs::path& temporary, const fs::path& target, std::string_view bytes) {
  const Descriptor fd(::open(folder_of(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644));
  if (fd.get() < 0) return false;
  write_all(fd.get(), bytes, target.string());
  if (::fsync(fd.get()) != 0)
    throw MachineError(target.string() + ": cannot sync: " + errno_text());
  const std::string unnamed = "/proc/self/fd/" + std::to_string(fd.get());
  return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, temporary.c_str(), AT_SYMLINK_FOLLOW) == 0;
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

void write_file(const fs::path& path, std::string_view bytes) {
  if (path == "-") return write_all(1, bytes, "standard output");
  if (is_special(path)) {
    const Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (fd.get() < 0) throw MachineError(path.string() + ": cannot open: " + errno_text());
    return write_all(fd.get(), bytes, path.string());
  }
  PendingFile pending(path);
  if (write_unnamed(pending.temporary(), path, bytes))
    return rename_into_place(pending.temporary(), path);
  {
    const Descriptor fd(
        ::open(pending.temporary().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (fd.get() < 0) throw MachineError(path.string() + ": cannot create: " + errno_text());
    write_all(fd.get(), bytes, path.string());
  }
  pending.commit();
}

PendingFile::PendingFile(fs::path target)
    : target_(std::move(target)), temporary_(temporary_beside(target_)) {}

PendingFile::~PendingFile() {
  if (temporary_.empty()) return;
  std::error_code ignored;  // the temporary may never have been made
  fs::remove(temporary_, ignored);
}

void PendingFile::commit() {
  sync_path(temporary_, O_RDONLY | O_CLOEXEC);
  rename_into_place(temporary_, target_);
  temporary_.clear();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return;
  if (fs::exists(folder, ignored)) throw InputError(folder.string(), "", "is a file, not a folder");
  throw MachineError(folder.string() + ": cannot make the folder: " + error.message());
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
  return folder / relative;
}

std::uint64_t hash_bytes(const void* data, std::size_t n_bytes) {
  return XXH3_64bits(data, n_bytes);
}

std::string hash_hex(std::string_view bytes) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(hash_bytes(bytes.data(), bytes.size())));
  return text;
}

std::string hash_file(const fs::path& path) {
  return hash_hex(read_file(path));
}

}  // namespace viewcell
