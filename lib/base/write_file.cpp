#include <fcntl.h>
#include <sys/stat.h>

#include "base/descriptor.h"
#include "base/error.h"
#include "base/file.h"
#include "base/temporaries.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// A name is lost when another process takes it for a leftover before it is locked.
constexpr int kMostNames = 100;

void write_all(int fd, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw MachineError(name + ": cannot write: " + errno_text());
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

// A device or a pipe: it is written to, for a rename would put a file in its place.
bool is_written_as_it_is(const fs::path& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

void sync(int fd, const fs::path& path) {
  if (fd < 0 || ::fsync(fd) != 0)
    throw MachineError(path.string() + ": cannot sync: " + errno_text());
}

// All of it in a file without a name, so that a kill leaves none behind. None where the file system
// has no such files.
Descriptor write_unnamed(const fs::path& target, std::string_view bytes) {
  Descriptor fd(::open(folder_of(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644));
  if (!fd.is_open() || !lock_temporary(fd.get())) return Descriptor();
  write_all(fd.get(), bytes, target.string());
  sync(fd.get(), target);
  return fd;
}

bool link_unnamed(int fd, const fs::path& name) {
  const std::string unnamed = "/proc/self/fd/" + std::to_string(fd);
  return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

// A new file that is ours alone: not through a link that was put there, nor into a file.
Descriptor open_new(const fs::path& name) {
  return Descriptor(
      ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
}

bool is_still_there(int fd) {
  struct stat info {};
  return ::fstat(fd, &info) == 0 && info.st_nlink > 0;
}

}  // namespace

PendingFile::PendingFile(fs::path target, std::string_view bytes) : target_(std::move(target)) {
  remove_leftovers(folder_of(target_));
  lock_ = write_unnamed(target_, bytes);
  const fs::path name = temporary_beside(target_);
  if (lock_.is_open() && temporary_.make(name, [&] { return link_unnamed(lock_.get(), name); }))
    return;
  write_named(bytes);
}

void PendingFile::write_named(std::string_view bytes) {
  for (int n_tries = 0; n_tries < kMostNames; ++n_tries) {
    const fs::path name = temporary_beside(target_);
    const bool made = temporary_.make(name, [&] {
      lock_ = open_new(name);
      return lock_.is_open();
    });
    if (!made) break;
    if (lock_temporary(lock_.get()) && is_still_there(lock_.get())) {
      write_all(lock_.get(), bytes, target_.string());
      return sync(lock_.get(), target_);
    }
    temporary_.keep();  // it is another's to remove
  }
  throw MachineError(target_.string() + ": cannot create: " + errno_text());
}

void PendingFile::commit(const std::function<void()>& once_there) {
  run_uninterrupted([&] {
    if (!temporary_.rename_to(target_))
      throw MachineError(target_.string() + ": cannot rename into place: " + errno_text());
    if (once_there) once_there();
  });
  const fs::path folder = folder_of(target_);
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  sync(opened.get(), folder);
}

PendingFolder::PendingFolder(const fs::path& target) {
  remove_leftovers(folder_of(target));
  for (int n_tries = 0; n_tries < kMostNames; ++n_tries) {
    const fs::path name = temporary_beside(target);
    if (!folder_.make(name, [&] { return ::mkdir(name.c_str(), 0777) == 0; })) break;
    lock_ = Descriptor(::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (lock_.is_open() && lock_temporary(lock_.get()) && is_still_there(lock_.get())) return;
    folder_.keep();  // it is another's to remove
  }
  throw MachineError(target.string() + ": cannot create: " + errno_text());
}

void PendingFolder::commit(const std::string& name, const fs::path& target) {
  if (::rename((path() / name).c_str(), target.c_str()) != 0)
    throw MachineError(target.string() + ": cannot rename into place: " + errno_text());
  const fs::path folder = folder_of(target);
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  sync(opened.get(), folder);
}

void write_file(const fs::path& path, std::string_view bytes) {
  if (path == "-") return write_all(1, bytes, "standard output");
  if (is_written_as_it_is(path)) {
    const Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!fd.is_open()) throw MachineError(path.string() + ": cannot open: " + errno_text());
    return write_all(fd.get(), bytes, path.string());
  }
  PendingFile(path, bytes).commit();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return;
  if (fs::exists(folder, ignored)) throw InputError(folder.string(), "", "is a file, not a folder");
  throw MachineError(folder.string() + ": cannot make the folder: " + error.message());
}

}  // namespace viewcell
