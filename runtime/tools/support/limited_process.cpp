#include "tools/support/limited_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <optional>

#include "base/plain_text.h"

namespace sgm::cli {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMapsWithoutEnd = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kMapsWithoutEnd = true;
#else
constexpr bool kMapsWithoutEnd = false;
#endif
#else
constexpr bool kMapsWithoutEnd = false;
#endif

/// First character of the child's message; kFailed is followed by the error's code.
constexpr char kDone = 'd', kFailed = 'f';
/// The child's exit statuses if it could not send a message.
constexpr int kNoMemory = 3, kLost = 4;

/// Cannot be raised again. `beyond`: reserve in which the limit's signal can end the process.
void limit(decltype(RLIMIT_AS) what, uint64_t most, uint64_t beyond = 0) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_max = std::min<rlim_t>(most + beyond, now.rlim_max);
  now.rlim_cur = std::min<rlim_t>(most, now.rlim_max);
  setrlimit(what, &now);
}

Result<std::string> guarded(const std::function<Result<std::string>()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, ""};
  } catch (const std::exception& e) {
    return Error{Code::limit, e.what()};
  }
}

std::string saidOf(const std::function<Result<std::string>()>& work) {
  const Result<std::string> result = guarded(work);
  if (result) return kDone + *result;
  return std::string{kFailed, static_cast<char>(result.error().code)} + result.error().message;
}

[[noreturn]] void beChild(int to, pid_t parent, const std::function<Result<std::string>()>& work,
                          const ProcessLimits& limits) {
  // The parent's unfinished files belong to the parent. Signals that it ignores (under nohup) stay ignored.
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGXCPU, SIG_DFL);
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (getppid() != parent) _exit(kLost);
  limitThisProcess(limits);
  // No exception may unwind into the parent's stack frames.
  try {
    const std::string said = saidOf(work);
    for (size_t sent = 0; sent < said.size();) {
      const ssize_t more = write(to, said.data() + sent, said.size() - sent);
      if (more < 0 && errno == EINTR) continue;
      if (more <= 0) _exit(kLost);
      sent += static_cast<size_t>(more);
    }
  } catch (...) {
    _exit(kNoMemory);
  }
  std::fflush(stderr);
  _exit(0);
}

/// Reads until the other end is closed; nullopt after a timeout.
std::optional<std::string> readAll(int from, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::string said;
  std::array<char, 65536> piece{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    pollfd ready{from, POLLIN, 0};
    const int found = poll(&ready, 1, static_cast<int>(std::min<int64_t>(left.count(), 1000)));
    if (found < 0 && errno != EINTR) return said;
    if (found <= 0) continue;
    const ssize_t more = read(from, piece.data(), piece.size());
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) return said;
    said.append(piece.data(), static_cast<size_t>(more));
  }
}

Error tooMuchMemory(const ProcessLimits& limits) {
  return {Code::limit,
          fmt::format("it takes more than {} MB of memory: allow more with --memory, or use a smaller file",
                      limits.memory >> 20)};
}

}  // namespace

void limitThisProcess(const ProcessLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<uint64_t>(std::ceil(limits.seconds)), 1);
  if (!kMapsWithoutEnd) limit(RLIMIT_AS, limits.memory);
}

Result<std::string> runLimited(const std::function<Result<std::string>()>& work, const ProcessLimits& limits) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return Error{Code::io, fmt::format("cannot open a pipe: {}", systemMessage(errno))};
  // Otherwise both processes would print the buffered output.
  std::fflush(nullptr);
  // If SIGCHLD is ignored, the child's status is lost.
  const auto before = std::signal(SIGCHLD, SIG_DFL);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    const int why = errno;
    close(ends[0]);
    close(ends[1]);
    std::signal(SIGCHLD, before);
    return Error{Code::io, fmt::format("cannot start a process: {}", systemMessage(why))};
  }
  if (child == 0) {
    close(ends[0]);
    beChild(ends[1], parent, work, limits);
  }
  close(ends[1]);
  const std::optional<std::string> said = readAll(ends[0], limits.seconds);
  close(ends[0]);
  if (!said) kill(child, SIGKILL);
  int status = 0;
  rusage used{};
  pid_t ended = 0;
  do ended = wait4(child, &status, 0, &used);
  while (ended < 0 && errno == EINTR);
  std::signal(SIGCHLD, before);
  if (ended < 0) return Error{Code::io, fmt::format("cannot wait for a process: {}", systemMessage(errno))};

  const double processor = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (!said || signal == SIGXCPU || (signal == SIGKILL && processor >= limits.seconds)) {
    return Error{Code::limit, fmt::format("it takes more than {} s: allow more with --seconds, or use a smaller file",
                                          limits.seconds)};
  }
  if (signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE || signal == SIGILL) {
    return Error{
        Code::limit,
        fmt::format("the process that read it crashed with signal {}: this is a bug in sgm, please send us the file",
                    signal)};
  }
  if (signal != 0) {
    return Error{Code::limit, fmt::format("the process that read it was killed from outside, by signal {}{}", signal,
                                          signal == SIGKILL ? ": the machine may be out of memory" : "")};
  }
  if (!said->empty() && said->front() == kDone) return said->substr(1);
  if (WEXITSTATUS(status) == kNoMemory) return tooMuchMemory(limits);
  if (said->size() < 2) return Error{Code::io, "the process that read it ended without an answer"};
  const auto code = static_cast<Code>((*said)[1]);
  if (code == Code::out_of_memory) return tooMuchMemory(limits);
  return Error{code, said->substr(2)};
}

}  // namespace sgm::cli
