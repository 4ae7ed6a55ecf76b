#include "tools/support/awaited_signals.h"

#include <algorithm>
#include <csignal>

namespace sgm::cli {
namespace {

sigset_t awaited() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
  return set;
}

}  // namespace

AwaitedSignals::AwaitedSignals() {
  const sigset_t set = awaited();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

AwaitedSignals::~AwaitedSignals() { release(); }

void AwaitedSignals::release() {
  if (!held_) return;
  held_ = false;
  const sigset_t set = awaited();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

bool AwaitedSignals::came() {
  const sigset_t set = awaited();
  const timespec now{};
  if (came_ == 0) came_ = std::max(0, sigtimedwait(&set, nullptr, &now));
  return came_ != 0;
}

void AwaitedSignals::pass() {
  release();
  std::raise(came_);
}

void AwaitedSignals::wait() {
  const sigset_t set = awaited();
  while (came_ == 0)
    if (sigwait(&set, &came_) != 0) came_ = 0;
  release();
}

}  // namespace sgm::cli
