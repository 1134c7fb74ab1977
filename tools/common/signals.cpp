#include "common/signals.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>

#include "base/temporaries.h"

namespace viewcell {
namespace {

sigset_t find_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL)
      sigaddset(&set, signal);
  }
  return set;
}

[[noreturn]] void end_by(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);  // not reached: the signal's default is to end the process
}

void wait_for_signal(int signals, int stop) {
  pollfd waited[] = {{signals, POLLIN, 0}, {stop, POLLIN, 0}};
  while (::poll(waited, 2, -1) < 0 && errno == EINTR) {
  }
  signalfd_siginfo info{};
  if ((waited[0].revents & POLLIN) == 0 || ::read(signals, &info, sizeof info) != sizeof info)
    return;
  undo_unfinished();
  end_by(static_cast<int>(info.ssi_signo));
}

}  // namespace

SignalGuard::SignalGuard() {
  const sigset_t set = find_signals();
  signals_ = ::signalfd(-1, &set, SFD_CLOEXEC);
  stop_ = ::eventfd(0, EFD_CLOEXEC);
  if (signals_ < 0 || stop_ < 0) return;  // then signals end the process at once
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  thread_ = std::thread(wait_for_signal, signals_, stop_);
}

SignalGuard::~SignalGuard() {
  if (thread_.joinable()) {
    const std::uint64_t one = 1;
    while (::write(stop_, &one, sizeof one) < 0 && errno == EINTR) {
    }
    thread_.join();
  }
  for (const int fd : {signals_, stop_})
    if (fd >= 0) ::close(fd);
}

}  // namespace viewcell
