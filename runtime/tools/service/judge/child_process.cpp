#include "tools/service/judge/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/plain_text.h"

namespace sgm::service {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMostComplaint = 4096;
constexpr int kFirstFree = 3;  // after the standard streams
/// A process may have ended although its streams are open, held by one of its own children.
constexpr std::chrono::milliseconds kBetweenLooks{50}, kBetweenLooksAtItsEnd{1};

Error failed(const char* what, int why = errno) { return {Code::io, std::string(what) + ": " + systemMessage(why)}; }

/// If the host has closed its standard streams, new descriptors get their numbers: move them away from the numbers that
/// the child's streams will have.
Result<Descriptor> clearOfStreams(Descriptor descriptor) {
  if (descriptor.number() >= kFirstFree) return descriptor;
  const int moved = fcntl(descriptor.number(), F_DUPFD_CLOEXEC, kFirstFree);
  if (moved < 0) return failed("cannot duplicate a descriptor");
  return Descriptor(moved);
}

Result<Pipe> clearOfStreams(std::array<int, 2> ends) {
  Descriptor first(ends[0]), second(ends[1]);
  Result<Descriptor> from = clearOfStreams(std::move(first)), to = clearOfStreams(std::move(second));
  if (!from) return from.error();
  if (!to) return to.error();
  return Pipe{std::move(*from), std::move(*to)};
}

/// A socket, so that writing to a closed one is an error instead of a signal to the host.
Result<Pipe> makeInput() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return failed("cannot open a socket");
  return clearOfStreams(ends);
}

class SpawnActions {
 public:
  SpawnActions() : failed_(posix_spawn_file_actions_init(&actions_)) {}
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }

  void place(int descriptor, int stream) { note(posix_spawn_file_actions_adddup2(&actions_, descriptor, stream)); }
  /// Closes the host's own descriptors, which it may have opened without O_CLOEXEC.
  void closeOthers() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
    note(posix_spawn_file_actions_addclosefrom_np(&actions_, kFirstFree));
#endif
  }
  int error() const { return failed_; }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void note(int code) { failed_ = failed_ != 0 ? failed_ : code; }

  posix_spawn_file_actions_t actions_{};
  int failed_;
};

class SpawnAttributes {
 public:
  SpawnAttributes() : failed_(posix_spawnattr_init(&attributes_)) {
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    const std::array<int, 4> codes{
        posix_spawnattr_setsigmask(&attributes_, &none), posix_spawnattr_setsigdefault(&attributes_, &all),
        posix_spawnattr_setpgroup(&attributes_, 0),
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP)};
    for (const int code : codes) failed_ = failed_ != 0 ? failed_ : code;
  }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }

  int error() const { return failed_; }
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
  int failed_;
};

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

class Child {
 public:
  Child() = default;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(); }

  /// Error: io.
  Result<void> start(const ChildSettings& settings);
  /// Throws std::bad_alloc only after the process has ended.
  ChildOutcome waitFor(const ChildSettings& settings) &&;

 private:
  enum class State { runs, ended, gone };
  State look() const;
  void write();
  /// Whether the output is within the limit.
  bool read(Descriptor& stream, std::string& into, size_t most, bool keeps_within);
  std::optional<ChildEnd> serve(const ChildSettings& settings, std::chrono::milliseconds most);
  void readWhatIsLeft(const ChildSettings& settings);
  void end();

  pid_t id_ = -1;  ///< -1 if it is not running, or has been waited for
  Descriptor input_, output_, error_;
  std::string_view unsent_;
  ChildOutcome outcome_;
};

Result<void> Child::start(const ChildSettings& settings) {
  Result<Pipe> output = Pipe::create(), error = Pipe::create();
  if (!output) return output.error();
  if (!error) return error.error();
  Descriptor given;
  if (settings.input < 0) {
    Result<Pipe> input = makeInput();
    if (!input) return input.error();
    given = std::move(input->from);
    input_ = std::move(input->to);
    unsent_ = settings.text;
    if (unsent_.empty()) input_.reset();
  } else {
    const int copy = fcntl(settings.input, F_DUPFD_CLOEXEC, kFirstFree);
    if (copy < 0) return failed("cannot duplicate a descriptor");
    given = Descriptor(copy);
  }
  SpawnActions actions;
  actions.place(given.number(), STDIN_FILENO);
  actions.place(output->to.number(), STDOUT_FILENO);
  actions.place(error->to.number(), STDERR_FILENO);
  actions.closeOthers();
  const SpawnAttributes attributes;
  for (const int code : {actions.error(), attributes.error()})
    if (code != 0) return failed("cannot prepare a process", code);

  std::vector<std::string> arguments = settings.arguments, environment = settings.environment;
  arguments.insert(arguments.begin(), settings.program);
  const int code = posix_spawn(&id_, settings.program.c_str(), actions.get(), attributes.get(),
                               pointersTo(arguments).data(), pointersTo(environment).data());
  if (code != 0) return failed(("cannot start " + settings.program).c_str(), code);
  output_ = std::move(output->from);
  error_ = std::move(error->from);
  return {};
}

/// The id stays valid until end(), unless the host discards its children's status.
Child::State Child::look() const {
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) != 0)
    return errno == EINTR ? State::runs : State::gone;
  return info.si_pid == 0 ? State::runs : State::ended;
}

void Child::write() {
  const ssize_t sent = send(input_.number(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (sent >= 0) unsent_.remove_prefix(static_cast<size_t>(sent));
  const bool lost = sent < 0 && errno != EINTR && errno != EAGAIN;
  if (lost || unsent_.empty()) input_.reset();
}

bool Child::read(Descriptor& stream, std::string& into, size_t most, bool keeps_within) {
  std::array<char, 32768> piece;
  const ssize_t size = ::read(stream.number(), piece.data(), piece.size());
  if (size < 0 && errno == EINTR) return true;
  if (size <= 0) {
    stream.reset();
    return true;
  }
  const auto more = static_cast<size_t>(size);
  into.append(piece.data(), std::min(more, most - into.size()));
  return !keeps_within || into.size() < most;
}

/// Waits for an event, or for the time `most`. Returns the reason to end the process, if any.
std::optional<ChildEnd> Child::serve(const ChildSettings& settings, std::chrono::milliseconds most) {
  // poll() ignores negative descriptors.
  std::array<pollfd, 4> waited{{{settings.cancel, POLLIN, 0},
                                {output_.number(), POLLIN, 0},
                                {error_.number(), POLLIN, 0},
                                {input_.number(), POLLOUT, 0}}};
  if (poll(waited.data(), waited.size(), static_cast<int>(most.count())) <= 0) return std::nullopt;
  if (waited[0].revents != 0) return ChildEnd::cancelled;
  // One byte more than allowed shows that the limit is exceeded.
  if (waited[1].revents != 0 && !read(output_, outcome_.output, settings.most_output + 1, true))
    return ChildEnd::talkative;
  if (waited[2].revents != 0) read(error_, outcome_.complaint, kMostComplaint, false);
  if (waited[3].revents != 0) write();
  return std::nullopt;
}

/// Reads the output left in the pipes, without waiting for other processes that hold them.
void Child::readWhatIsLeft(const ChildSettings& settings) {
  constexpr int kMostPieces = 64;
  bool more = true;
  for (int i = 0; more && i < kMostPieces && outcome_.output.size() <= settings.most_output; ++i) {
    std::array<pollfd, 2> ready{{{output_.number(), POLLIN, 0}, {error_.number(), POLLIN, 0}}};
    more = poll(ready.data(), ready.size(), 0) > 0;
    if (ready[0].revents != 0) read(output_, outcome_.output, settings.most_output + 1, true);
    if (ready[1].revents != 0) read(error_, outcome_.complaint, kMostComplaint, false);
  }
}

/// Kills it with its whole group, unless it has ended, and blocks until then.
void Child::end() {
  if (id_ < 0) return;
  // If it is gone and its streams are closed, its id may belong to another process.
  if (look() != State::gone || output_.number() >= 0 || error_.number() >= 0) kill(-id_, SIGKILL);
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(id_, &status, 0);
  while (ended < 0 && errno == EINTR);
  const bool known = ended == id_;
  id_ = -1;
  if (known && WIFEXITED(status)) outcome_.status = WEXITSTATUS(status);
  if (known && WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
}

ChildOutcome Child::waitFor(const ChildSettings& settings) && {
  const Clock::time_point late = Clock::now() + settings.time;
  std::optional<ChildEnd> why;
  State state = State::runs;
  while (state == State::runs && !why) {
    const bool silent = output_.number() < 0 && error_.number() < 0;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(late - Clock::now());
    if (left.count() <= 0) {
      why = ChildEnd::late;
    } else {
      why = serve(settings, std::min(left, silent ? kBetweenLooksAtItsEnd : kBetweenLooks));
    }
    if (!why) state = look();
  }
  end();
  if (!why) {
    readWhatIsLeft(settings);
    if (outcome_.output.size() > settings.most_output) {
      why = ChildEnd::talkative;
    } else if (outcome_.signal != 0) {
      why = ChildEnd::signalled;
    }
  }
  outcome_.end = why.value_or(ChildEnd::exited);
  return std::move(outcome_);
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    reset();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

Descriptor::~Descriptor() { reset(); }

void Descriptor::reset() {
  if (number_ >= 0) close(number_);
  number_ = -1;
}

Result<Descriptor> reopenedForReading(int file) {
  const int opened = open(("/proc/self/fd/" + std::to_string(file)).c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return failed("cannot open a file again");
  return Descriptor(opened);
}

Result<Pipe> Pipe::create() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return failed("cannot open a pipe");
  return clearOfStreams(ends);
}

Result<ChildOutcome> runChild(const ChildSettings& settings) {
  Child child;
  if (const Result<void> started = child.start(settings); !started) return started.error();
  return std::move(child).waitFor(settings);
}

}  // namespace sgm::service
