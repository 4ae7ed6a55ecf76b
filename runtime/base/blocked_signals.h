#pragma once
// Threads of the library that leave signals to those of the program.

#if defined(__unix__) || defined(__APPLE__)
#include <pthread.h>

#include <csignal>
#endif

namespace sgm {

/// While it lives, on the thread that made it: signals wait for other threads, and for those that it starts meanwhile
/// they do so for good. Those of a fault of the thread itself are not blocked: blocked, they would end the process
/// without the handler that the program has for them. The mask before is there again afterwards.
class BlockedSignals {
 public:
#if defined(__unix__) || defined(__APPLE__)
  BlockedSignals() {
    sigset_t blocked;
    sigfillset(&blocked);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS}) sigdelset(&blocked, fault);
    pthread_sigmask(SIG_BLOCK, &blocked, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
#else
  BlockedSignals() = default;
  ~BlockedSignals() = default;
#endif
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

#if defined(__unix__) || defined(__APPLE__)
 private:
  sigset_t before_{};
#endif
};

}  // namespace sgm
