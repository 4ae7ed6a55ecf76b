#include "cli/limited_process.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// What the child says begins with this, or with kFailed and the error's code.
constexpr char kDone = 'd', kFailed = 'f';

void limit(decltype(RLIMIT_AS) what, uint64_t most) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
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

[[noreturn]] void beChild(int to, const std::function<Result<std::string>()>& work, const ProcessLimits& limits) {
  // Neither a core file nor a signal handler of the parent's: what the parent has begun is the parent's.
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) std::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<uint64_t>(std::ceil(limits.seconds)));
  if (!kMapsWithoutEnd) limit(RLIMIT_AS, limits.memory);
  const Result<std::string> result = guarded(work);
  std::string said;
  if (result) {
    said = kDone + *result;
  } else {
    said = std::string{kFailed, static_cast<char>(result.error().code)} + result.error().message;
  }
  for (size_t sent = 0; sent < said.size();) {
    const ssize_t more = write(to, said.data() + sent, said.size() - sent);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    sent += static_cast<size_t>(more);
  }
  std::fflush(stderr);
  _exit(0);
}

/// All that comes until the other end is closed; nothing where that takes too long.
std::optional<std::string> readAll(int from, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::string said;
  std::array<char, 65536> piece{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    pollfd ready{from, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(std::min<int64_t>(left.count(), 1000))) <= 0) continue;
    const ssize_t more = read(from, piece.data(), piece.size());
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) return said;
    said.append(piece.data(), static_cast<size_t>(more));
  }
}

Error tooMuchMemory(const ProcessLimits& limits) {
  return {Code::limit, fmt::format("it takes more than {} MB of memory: give it more with --memory, or a smaller file",
                                   limits.memory >> 20)};
}

}  // namespace

Result<std::string> runLimited(const std::function<Result<std::string>()>& work, const ProcessLimits& limits) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return Error{Code::io, fmt::format("cannot open a pipe: {}", std::strerror(errno))};
  // What is buffered would come out of both processes.
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    const int why = errno;
    close(ends[0]);
    close(ends[1]);
    return Error{Code::io, fmt::format("cannot start a process: {}", std::strerror(why))};
  }
  if (child == 0) {
    close(ends[0]);
    beChild(ends[1], work, limits);
  }
  close(ends[1]);
  const std::optional<std::string> said = readAll(ends[0], limits.seconds);
  close(ends[0]);
  if (!said) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  const bool out_of_time =
      !said || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL));
  if (out_of_time) {
    return Error{Code::limit, fmt::format("it takes more than {} s: give it more with --seconds, or a smaller file",
                                          limits.seconds)};
  }
  if (WIFSIGNALED(status)) {
    return Error{Code::limit, fmt::format("the process that read it was ended by signal {}: this is a bug of sgm's, "
                                          "please send us the file",
                                          WTERMSIG(status))};
  }
  if (!said->empty() && said->front() == kDone) return said->substr(1);
  if (said->size() < 2) return tooMuchMemory(limits);
  const auto code = static_cast<Code>((*said)[1]);
  if (code == Code::out_of_memory) return tooMuchMemory(limits);
  return Error{code, said->substr(2)};
}

}  // namespace sgm::cli
