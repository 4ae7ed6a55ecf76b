#pragma once
// Keeps signals away from the library's threads, so that the threads of the host program receive and handle them.

#if defined(__unix__) || defined(__APPLE__)
#include <pthread.h>

#include <csignal>
#endif

namespace sgm {

/// Blocks signals on the constructing thread for the lifetime of the object. Threads started meanwhile inherit the
/// signal mask and keep it. Synchronous signals such as SIGSEGV, which a thread's own fault raises, are not blocked: if
/// they were, the fault would end the process without calling the program's handler. The destructor restores the
/// previous mask.
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
