// The end by a signal: nothing unfinished stays behind.
#pragma once

#include <thread>

namespace viewcell {

/// While it lives, SIGINT, SIGTERM and SIGHUP undo what is unfinished (base/temporaries.h) and then
/// end the process as they would have ended it. Those that were ignored before stay ignored. To be
/// made before any other thread.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  int signals_ = -1, stop_ = -1;  // what the thread waits for; -1: there is no thread
  std::thread thread_;
};

}  // namespace viewcell
