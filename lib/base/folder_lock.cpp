#include "base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "base/descriptor.h"
#include "base/error.h"
#include "base/temporaries.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockName = ".viewcell-lock";
constexpr std::size_t kMostTextBytes = 256;
// A lock that is neither free nor shared is being written into: that takes microseconds.
constexpr int kMostTries = 1000;
constexpr std::chrono::milliseconds kPause(1);

std::string read_text(int fd) {
  std::string text(kMostTextBytes, '\0');
  const ssize_t n = ::pread(fd, text.data(), text.size(), 0);
  text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return text;
}

bool write_text(int fd, const std::string& text) {
  return ::ftruncate(fd, 0) == 0 &&
         ::pwrite(fd, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

// Its last holder may have removed it since it was opened.
bool is_named(int fd, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(fd, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

// A file of ours alone: what somebody else put there, or linked there, is not written into.
bool is_lock_file(int fd) {
  struct stat info {};
  return ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_nlink == 1 &&
         info.st_size <= static_cast<off_t>(kMostTextBytes);
}

enum class Attempt { held, taken, again, no_locks };

Attempt try_to_hold(int fd, const fs::path& path, const std::string& text) {
  const bool is_alone = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  if (!is_alone && errno != EWOULDBLOCK) return Attempt::no_locks;
  if (!is_named(fd, path)) return Attempt::again;
  if (is_alone && !is_lock_file(fd)) {
    ::unlink(path.c_str());
    return Attempt::again;
  }
  if (is_alone && !write_text(fd, text)) return Attempt::no_locks;
  if (::flock(fd, LOCK_SH | LOCK_NB) != 0) return Attempt::again;
  if (!is_named(fd, path)) return Attempt::again;  // between the two locks it is nobody's
  return read_text(fd) == text ? Attempt::held : Attempt::taken;
}

}  // namespace

struct FolderLock::Holder {
  Holder(Descriptor opened, const fs::path& name)
      : fd(std::move(opened)), path(name), undo([this] { release(); }) {}
  ~Holder() {
    run_uninterrupted([&] { release(); });
  }
  // Only its last holder removes the file.
  void release() {
    if (::flock(fd.get(), LOCK_EX | LOCK_NB) == 0 && is_named(fd.get(), path))
      ::unlink(path.c_str());
  }
  Descriptor fd;
  fs::path path;
  UndoOnSignal undo;
};

FolderLock::FolderLock(const fs::path& folder, const std::string& writer,
                       const std::string& content) {
  const fs::path path = folder / kLockName;
  const std::string text = writer + " " + content;
  VIEWCELL_CHECK(text.size() < kMostTextBytes, text);
  for (int n_tries = 0; n_tries < kMostTries; ++n_tries, std::this_thread::sleep_for(kPause)) {
    Descriptor fd(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (!fd.is_open()) throw MachineError(path.string() + ": cannot create: " + errno_text());
    switch (try_to_hold(fd.get(), path, text)) {
      case Attempt::no_locks:
        ::unlink(path.c_str());
        return;
      case Attempt::held:
        holder_ = std::make_unique<Holder>(std::move(fd), path);
        return;
      case Attempt::taken: {
        const std::string other = read_text(fd.get());
        throw InputError(folder.string(), "",
                         other.substr(0, other.find(' ')) +
                             " is writing there, with other inputs or options; let it end first, "
                             "or write into another folder");
      }
      case Attempt::again:
        break;
    }
  }
  throw InputError(folder.string(), "", std::string("cannot lock ") + kLockName);
}

FolderLock::~FolderLock() = default;

FolderHold::FolderHold(const fs::path& folder)
    : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (fd_.is_open()) ::flock(fd_.get(), LOCK_SH | LOCK_NB);
}

bool remove_unheld(const fs::path& folder) {
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!fd.is_open()) return errno == ENOENT;
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  std::error_code error;
  fs::remove_all(folder, error);
  return !error;
}

}  // namespace viewcell
