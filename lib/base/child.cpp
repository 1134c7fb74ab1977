#include "base/child.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr std::size_t kMostWords = 480;
enum ChildExit { kDone = 0, kThrew = 1, kOutOfMemory = 2 };

// Address space of this process; 0: not known.
std::size_t used_address_space() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long n_pages = 0;
  const bool is_read = std::fscanf(file, "%lu", &n_pages) == 1;
  std::fclose(file);
  return is_read ? n_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

void limit(__rlimit_resource resource, std::size_t most) {
  rlimit now{};
  getrlimit(resource, &now);
  now.rlim_cur = std::min<rlim_t>(now.rlim_max, most);
  setrlimit(resource, &now);
}

void apply(const ChildLimits& limits, std::size_t n_used_bytes) {
  // What this process does at these signals is not for the child to do.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM})
    std::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::size_t>(limits.cpu_s));
  if (n_used_bytes > 0) limit(RLIMIT_AS, n_used_bytes + limits.memory_bytes);
  alarm(static_cast<unsigned>(limits.wall_s));
}

[[noreturn]] void run_and_end(const std::function<void()>& work, std::span<std::byte> words) {
  int code = kDone;
  try {
    work();
  } catch (const std::bad_alloc&) {
    code = kOutOfMemory;
  } catch (const std::exception& error) {
    code = kThrew;
    const std::size_t n = std::min(std::strlen(error.what()), words.size() - 1);
    std::memcpy(words.data(), error.what(), n);
  } catch (...) {
    code = kThrew;
  }
  _exit(code);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw MachineError(std::string("waiting for a process: ") + strerror(errno));
  return status;
}

std::string describe_end(int status, const char* words) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL ? "it takes too long"
                                                                       : "it crashes";
  }
  switch (WEXITSTATUS(status)) {
    case kDone:
      return "";
    case kOutOfMemory:
      return "it asks for too much memory";
    default:
      return *words == '\0' ? "it fails" : words;
  }
}

}  // namespace

SharedBytes::SharedBytes(std::size_t n_bytes) : data_(nullptr), n_bytes_(n_bytes) {
  void* data = mmap(nullptr, std::max<std::size_t>(n_bytes, 1), PROT_READ | PROT_WRITE,
                    MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) throw MachineError("out of memory");
  data_ = static_cast<std::byte*>(data);
}

SharedBytes::~SharedBytes() {
  munmap(data_, std::max<std::size_t>(n_bytes_, 1));
}

std::string run_in_child(const ChildLimits& limits, const std::function<void()>& work) {
  const SharedBytes words(kMostWords);
  const std::size_t n_used_bytes = used_address_space();
  const pid_t child = fork();
  if (child < 0) throw MachineError(std::string("cannot make a process: ") + strerror(errno));
  if (child == 0) {
    apply(limits, n_used_bytes);
    run_and_end(work, words.bytes());
  }
  return describe_end(wait_for(child), reinterpret_cast<const char*>(words.bytes().data()));
}

}  // namespace viewcell
