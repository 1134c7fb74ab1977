#include "base/temporaries.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <list>
#include <memory>
#include <mutex>
#include <random>
#include <set>

#include "base/descriptor.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPrefix = ".tmp-";
constexpr std::size_t kRandomDigits = 16;

struct Unfinished {
  const UndoOnSignal* owner;
  std::function<void()> undo;
};

// The one state of this library that outlives a call: a signal asks nobody for it. Never destroyed,
// for a signal may come while the process ends.
struct Registry {
  std::recursive_mutex mutex;  // guards all below; held for good once a signal has come
  std::list<Unfinished> unfinished;
  std::set<fs::path> searched;  // for leftovers
};
Registry& registry() {
  static Registry& only = *new Registry;
  return only;
}

bool is_of(std::string_view text, int (*is_digit)(int)) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [&](unsigned char c) { return is_digit(c) != 0; });
}

// What a temporary's name says: its process, and whether it is of those that hold a lock (earlier
// versions counted, and held none).
struct NameParts {
  pid_t pid = 0;
  bool is_locked = false;
};

bool parse_name(const std::string& name, NameParts& parts) {
  std::string_view rest = name;
  if (!rest.starts_with(kPrefix)) return false;
  rest.remove_prefix(kPrefix.size());
  const std::size_t dash = rest.find('-');
  if (dash == rest.npos || !is_of(rest.substr(0, dash), std::isdigit)) return false;
  if (std::from_chars(rest.data(), rest.data() + dash, parts.pid).ec != std::errc()) return false;
  rest.remove_prefix(dash + 1);
  const std::string_view tag = rest.substr(0, rest.find('-'));
  parts.is_locked = tag.size() == kRandomDigits && is_of(tag, std::isxdigit);
  return tag.size() < rest.size() &&
         (parts.is_locked || (tag.size() < 11 && is_of(tag, std::isdigit)));
}

bool is_process_gone(pid_t pid) {
  return pid == ::getpid() || (::kill(pid, 0) != 0 && errno == ESRCH);
}

// Ours, a file or a folder, and locked by nobody. The lock is held as long as the result lives.
Descriptor take_over(const fs::path& path, const NameParts& parts) {
  Descriptor fd(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (!fd.is_open() || ::fstat(fd.get(), &info) != 0) return Descriptor();
  const bool is_kind = S_ISREG(info.st_mode) || (S_ISDIR(info.st_mode) && parts.is_locked);
  if (!is_kind || info.st_uid != ::geteuid()) return Descriptor();
  if (!parts.is_locked && !is_process_gone(parts.pid)) return Descriptor();
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) return Descriptor();
  return fd;
}

std::uint64_t make_random() {
  std::uint64_t bits = 0;
  if (::getrandom(&bits, sizeof bits, 0) == sizeof bits) return bits;
  return std::random_device{}() * 0x100000001ULL;
}

}  // namespace

void run_uninterrupted(const std::function<void()>& step) {
  const std::lock_guard lock(registry().mutex);
  step();
}

void undo_unfinished() {
  registry().mutex.lock();  // and never unlocked
  for (const Unfinished& one : registry().unfinished) one.undo();
}

UndoOnSignal::UndoOnSignal(std::function<void()> undo) {
  const std::lock_guard lock(registry().mutex);
  registry().unfinished.push_front({this, std::move(undo)});
}

UndoOnSignal::~UndoOnSignal() {
  const std::lock_guard lock(registry().mutex);
  registry().unfinished.remove_if([&](const Unfinished& one) { return one.owner == this; });
}

bool Temporary::make(const fs::path& path, const std::function<bool()>& make) {
  run_uninterrupted([&] {
    if (!make()) return;
    path_ = path;
    undo_ = std::make_unique<UndoOnSignal>([path] {
      std::error_code ignored;  // the process is being ended
      fs::remove_all(path, ignored);
    });
  });
  return !path_.empty();
}

bool Temporary::rename_to(const fs::path& target) {
  bool renamed = false;
  run_uninterrupted([&] {
    renamed = ::rename(path_.c_str(), target.c_str()) == 0;
    if (renamed) keep();
  });
  return renamed;
}

void Temporary::keep() {
  undo_.reset();
  path_.clear();
}

void Temporary::remove() {
  if (path_.empty()) return;
  std::error_code ignored;  // what cannot be removed is a leftover of the next run's
  run_uninterrupted([&] { fs::remove_all(path_, ignored); });
  keep();
}

fs::path temporary_beside(const fs::path& target) {
  char tag[48];
  std::snprintf(tag, sizeof tag, "%ld-%016llx-", static_cast<long>(::getpid()),
                static_cast<unsigned long long>(make_random()));
  // Names end at 255 bytes.
  const std::string name = std::string(kPrefix) + tag + target.filename().string();
  return target.parent_path() / name.substr(0, 255);
}

bool lock_temporary(int fd) {
  // Where the file system has no locks nobody can take it over either.
  return ::flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void remove_leftovers(const fs::path& folder) {
  {
    const std::lock_guard lock(registry().mutex);
    if (!registry().searched.insert(folder).second) return;
  }
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    NameParts parts;
    if (!parse_name(at->path().filename().string(), parts)) continue;
    std::error_code ignored;  // it is in nobody's way
    if (const Descriptor lock = take_over(at->path(), parts); lock.is_open())
      fs::remove_all(at->path(), ignored);
  }
}

}  // namespace viewcell
