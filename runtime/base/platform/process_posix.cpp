#include "base/platform/process.h"

#include <fcntl.h>
#include <pthread.h>
#if defined(__linux__)
#include <sys/auxv.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>

#include "base/plain_text.h"
#include "base/platform/pipe_posix.h"

extern char** environ;

namespace sgm::platform {
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

constexpr int kFirstFree = 3;  // first descriptor after the standard streams

/// execve() fails with ETXTBSY while another process has the program's file open for writing. Usually that process is a
/// child that is being started and holds a copy of the descriptor for some microseconds, so starting is tried again.
constexpr int kMaxTries = 50;
constexpr std::chrono::milliseconds kBetweenTries{10};

struct Ends {
  File ours, theirs;
};

Result<Ends> endsOf(const Stream& stream, bool is_input) {
  switch (stream.kind) {
    case Stream::inherited:
    case Stream::output:
      return Ends();
    case Stream::none: {
      Result<File> file = clearOfStreams(File(::open("/dev/null", (is_input ? O_RDONLY : O_WRONLY) | O_CLOEXEC)));
      if (!file) return file.error();
      return Ends{File(), std::move(*file)};
    }
    case Stream::file: {
      File copy(fcntl(stream.number, F_DUPFD_CLOEXEC, kFirstFree));
      if (!copy) return ioError("cannot duplicate a descriptor");
      return Ends{File(), std::move(copy)};
    }
    case Stream::pipe: {
      Result<Pipe> pipe = is_input ? openSocket() : openPipe();
      if (!pipe) return pipe.error();
      if (is_input) return Ends{std::move(pipe->to), std::move(pipe->from)};
      return Ends{std::move(pipe->from), std::move(pipe->to)};
    }
  }
  return Ends();
}

/// Returns the paths at which to search for a program, in the order of PATH.
std::vector<std::string> candidatesFor(const std::string& program) {
  if (program.find('/') != program.npos) return {program};
  const char* path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "/bin:/usr/bin";
  std::vector<std::string> candidates;
  for (size_t at = 0; at <= folders.size();) {
    const size_t end = std::min(folders.find(':', at), folders.size());
    // An empty entry of PATH means the current folder.
    candidates.push_back((end == at ? "." : folders.substr(at, end - at)) + "/" + program);
    at = end + 1;
  }
  return candidates;
}

std::vector<std::string> environmentOf(const ProcessSettings& settings) {
  std::vector<std::string> all = settings.environment;
  const auto isReplaced = [&](std::string_view variable) {
    const std::string_view name = variable.substr(0, variable.find('=') + 1);
    return std::ranges::any_of(settings.environment, [&](const std::string& own) { return own.starts_with(name); });
  };
  for (char** inherited = environ; settings.inherits_environment && *inherited != nullptr; ++inherited)
    if (!isReplaced(*inherited)) all.emplace_back(*inherited);
  return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Functions from here to Launch::becomeProgram neither lock nor allocate. After vfork() they run in a child that shares
// this process's memory, while other threads of this process may hold locks or be changing the heap.

/// Sets a resource limit that the process cannot raise again. beyond: how much the hard limit exceeds the soft limit,
/// so that the soft limit's signal can end the process first.
void limit(decltype(RLIMIT_AS) what, uint64_t most, uint64_t beyond = 0) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_max = std::min<rlim_t>(most + beyond, now.rlim_max);
  now.rlim_cur = std::min<rlim_t>(most, now.rlim_max);
  setrlimit(what, &now);
}

/// Makes the kernel kill this process when the thread that started it ends, and denies it new privileges.
void confine() {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
#endif
}

/// Marks all descriptors after the standard streams close-on-exec: the host program may have opened some without
/// O_CLOEXEC.
void closeOthersOnExec() {
#if defined(SYS_close_range)
  constexpr unsigned kOnExec = 4;  // value of CLOSE_RANGE_CLOEXEC, which old headers do not define
  if (syscall(SYS_close_range, unsigned{kFirstFree}, ~0u, kOnExec) == 0) return;
#endif
  rlimit most{};
  if (getrlimit(RLIMIT_NOFILE, &most) != 0) return;
  for (int file = kFirstFree; file < static_cast<int>(std::min<rlim_t>(most.rlim_cur, 65536)); ++file)
    fcntl(file, F_SETFD, FD_CLOEXEC);
}

/// Everything that a child process needs until its program starts, prepared before the fork.
class Launch {
 public:
  Launch(const ProcessSettings& settings, const std::array<int, 3>& streams)
      : settings_(settings),
        streams_(streams),
        candidates_(candidatesFor(settings.program)),
        words_(settings.arguments),
        variables_(environmentOf(settings)) {
    words_.insert(words_.begin(), settings.program);
    arguments_ = pointersTo(words_);
    environment_ = pointersTo(variables_);
  }

  /// Starts the child and sets `id`. The child reports a failure through the pipe `report`. Returns 0 if its program
  /// has started, otherwise errno of the failure.
  int start(Pipe report, pid_t& id) const {
    sigset_t all, before;
    sigfillset(&all);
    // Block all signals: a signal handler that ran in the child would change this process's memory, which the child
    // shares.
    pthread_sigmask(SIG_SETMASK, &all, &before);
    id = spawn(report.to.number(), before);
    int failure = id < 0 ? errno : 0;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (failure != 0) return failure;
    report.to = File();
    // When the program starts, the child's end of the pipe is closed (O_CLOEXEC), so this read returns 0 bytes.
    if (readNext(report.from.number(), &failure, sizeof failure) != sizeof failure) return 0;
    while (waitpid(id, nullptr, 0) < 0 && errno == EINTR) {
    }
    return failure;
  }

 private:
  pid_t spawn(int report, const sigset_t& mask) const {
    const pid_t parent = getpid();
    // fork() would copy the page tables, which is slow for a large process and may run out of memory; posix_spawn()
    // cannot set resource limits.
    const pid_t id = vfork();
    if (id == 0) becomeProgram(report, mask, parent);
    return id;
  }

  [[noreturn]] void becomeProgram(int report, const sigset_t& mask, pid_t parent) const {
    if (settings_.isolated) setpgid(0, 0);
    restoreSignals();
    for (int stream = 0; stream < kFirstFree; ++stream) {
      const int from = streams_[static_cast<size_t>(stream)];
      if (from >= 0) dup2(from, stream);
    }
    if (!settings_.inherits_files) closeOthersOnExec();
    if (settings_.sandbox) {
      confine();
      if (getppid() != parent) _exit(1);
      limitThisProcess(*settings_.sandbox);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, settings_.isolated ? &none : &mask, nullptr);
    const int failure = execute();
    [[maybe_unused]] const ssize_t told = ::write(report, &failure, sizeof failure);
    _exit(127);
  }

  void restoreSignals() const {
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    for (int signal = 1; signal < NSIG; ++signal) {
      struct sigaction now {};
      if (sigaction(signal, nullptr, &now) != 0) continue;
      const bool keeps = now.sa_handler == SIG_IGN && !settings_.isolated && !(settings_.sandbox && signal == SIGXCPU);
      if (!keeps) sigaction(signal, &usual, nullptr);
    }
  }

  /// Tries to execute each candidate path in turn. Returns only on failure, with the reason as errno value.
  int execute() const {
    int failure = 0;
    for (const std::string& candidate : candidates_) {
      execve(candidate.c_str(), arguments_.data(), environment_.data());
      const bool missing = errno == ENOENT || errno == ENOTDIR;
      if (failure == 0 || !missing) failure = errno;
      if (!missing && errno != EACCES) break;
    }
    return failure;
  }

  const ProcessSettings& settings_;
  std::array<int, 3> streams_;
  std::vector<std::string> candidates_, words_, variables_;
  std::vector<char*> arguments_, environment_;
};

ProcessExit exitOf(int status, const rusage& used, double cpu_seconds) {
  using Kind = ProcessExit::Kind;
  if (WIFEXITED(status)) return {Kind::exited, WEXITSTATUS(status)};
  const int signal = WTERMSIG(status);
  const double cpu = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  switch (signal) {
    case SIGXCPU:
      return {Kind::out_of_time, signal};
    case SIGKILL:
      return {cpu_seconds > 0 && cpu >= cpu_seconds ? Kind::out_of_time : Kind::killed, signal};
    case SIGSEGV:
    case SIGABRT:
    case SIGBUS:
    case SIGFPE:
    case SIGILL:
      return {Kind::crashed, signal};
    default:
      return {Kind::ended, signal};
  }
}

enum class State { runs, ended, forgotten };

/// Returns the state of a child without reaping it, so that its id stays valid. `forgotten`: the system has already
/// reaped the child.
State stateOf(int id) {
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOHANG | WNOWAIT) != 0)
    return errno == EINTR ? State::runs : State::forgotten;
  return info.si_pid == 0 ? State::runs : State::ended;
}

}  // namespace

void limitThisProcess(const ProcessLimits& limits) {
  limit(RLIMIT_CORE, 0);
  if (limits.cpu_seconds > 0) limit(RLIMIT_CPU, static_cast<uint64_t>(std::ceil(limits.cpu_seconds)), 1);
  if (limits.file_bytes > 0) limit(RLIMIT_FSIZE, limits.file_bytes);
  if (limits.open_files > 0) limit(RLIMIT_NOFILE, limits.open_files);
  // RLIMIT_NPROC is not set: it counts all processes of the user, so on a busy machine this process could not start
  // threads.
  if (limits.memory_bytes > 0 && !kMapsWithoutEnd) limit(RLIMIT_AS, limits.memory_bytes);
}

void sandboxThisProcess(const ProcessLimits& limits) {
  confine();
#if defined(SYS_close_range)
  syscall(SYS_close_range, unsigned{kFirstFree}, ~0u, 0u);
#endif
  limitThisProcess(limits);
}

Result<std::string> ownProgram() {
  std::error_code why;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", why);
  if (!why) return path.string();
#if defined(__linux__)
  // Fallback for containers without /proc. The path may be relative, if the program was started by a relative path.
  if (const auto* started_as = reinterpret_cast<const char*>(getauxval(AT_EXECFN)))
    return std::filesystem::absolute(started_as).string();
#endif
  return Error{Code::io, "cannot find the path of this program: " + systemMessage(why)};
}

bool isProgram(const std::string& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

Result<Process> Process::start(const ProcessSettings& settings) {
  Result<Ends> input = endsOf(settings.input, true), output = endsOf(settings.output, false),
               error = endsOf(settings.error, false);
  for (const Result<Ends>* made : {&input, &output, &error})
    if (!*made) return made->error();
  std::array<int, 3> streams{input->theirs.number(), output->theirs.number(), error->theirs.number()};
  if (settings.error.kind == Stream::output) streams[2] = streams[1] >= 0 ? streams[1] : STDOUT_FILENO;
  const Launch launch(settings, streams);

  pid_t id = -1;
  int failure = ETXTBSY;
  for (int tries = 0; failure == ETXTBSY && tries < kMaxTries; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(kBetweenTries);
    Result<Pipe> report = openPipe();
    if (!report) return report.error();
    failure = launch.start(std::move(*report), id);
  }
  if (failure != 0) {
    const bool missing = failure == ENOENT && settings.program.find('/') == std::string::npos;
    return Error{missing ? Code::unsupported : Code::io,
                 settings.program + " cannot be run: " + systemMessage(failure)};
  }
  Process process;
  process.id_ = id;
  process.isolated_ = settings.isolated;
  process.cpu_seconds_ = settings.sandbox ? settings.sandbox->cpu_seconds : 0;
  process.input_ = std::move(input->ours);
  process.output_ = std::move(output->ours);
  process.error_ = std::move(error->ours);
  return process;
}

Process::Process(Process&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      isolated_(other.isolated_),
      cpu_seconds_(other.cpu_seconds_),
      input_(std::move(other.input_)),
      output_(std::move(other.output_)),
      error_(std::move(other.error_)) {}

Process::~Process() { end(); }

bool Process::isRunning() const { return id_ >= 0 && stateOf(id_) == State::runs; }

bool Process::write(std::string_view bytes) {
  while (!bytes.empty() && input_) {
    const ssize_t sent = send(input_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
  return bytes.empty();
}

void Process::closeInput() { input_ = File(); }

ProcessExit Process::wait() {
  if (id_ < 0) return {};
  int status = 0;
  rusage used{};
  pid_t ended = 0;
  do ended = wait4(id_, &status, 0, &used);
  while (ended < 0 && errno == EINTR);
  const bool known = ended == id_;
  id_ = -1;
  return known ? exitOf(status, used, cpu_seconds_) : ProcessExit();
}

ProcessExit Process::end() {
  if (id_ < 0) return {};
  // If the system has already reaped the child and its streams are closed, its id may now belong to another process; do
  // not kill that process.
  const State state = stateOf(id_);
  const bool is_its_own = state != State::forgotten || output_ || error_;
  if (isolated_ ? is_its_own : state == State::runs) kill(isolated_ ? -id_ : id_, SIGKILL);
  return wait();
}

}  // namespace sgm::platform
