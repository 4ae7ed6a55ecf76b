#include <poll.h>

#include <algorithm>

#include "base/platform/pipe_posix.h"
#include "base/platform/process.h"

namespace sgm::platform {
namespace {

using Clock = std::chrono::steady_clock;

/// Intervals at which to test whether the child has ended. The end of its output streams does not show this reliably,
/// since the child's own child processes may keep the streams open.
constexpr std::chrono::milliseconds kBetweenLooks{50}, kBetweenLooksAtItsEnd{1};

}  // namespace

/// Exchanges input and output with a child process until the child ends.
class ProcessExchange {
 public:
  ProcessExchange(Process process, const RunSettings& run)
      : process_(std::move(process)), run_(run), unsent_(run.input) {
    if (unsent_.empty()) process_.closeInput();
  }

  ProcessOutput finish() && {
    using Stop = ProcessOutput::Stop;
    const Clock::time_point start = Clock::now();
    while (process_.isRunning() && said_.stop == Stop::none) {
      const bool silent = !process_.output_ && !process_.error_;
      auto most = silent ? kBetweenLooksAtItsEnd : kBetweenLooks;
      if (run_.time) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(start + *run_.time - Clock::now());
        most = std::min(left, most);
      }
      if (most.count() <= 0) {
        said_.stop = Stop::time_limit;
      } else {
        serve(most);
      }
    }
    said_.exit = process_.end();
    if (said_.stop == Stop::none) readRest();
    return std::move(said_);
  }

 private:
  /// Waits, at most for the time `most`, until a stream is ready or a cancellation is requested, and handles that
  /// event.
  void serve(std::chrono::milliseconds most) {
    // A stream that is closed has descriptor -1, which poll() ignores.
    std::array<pollfd, 4> waited{{{run_.cancellation != nullptr ? run_.cancellation->waiting_.number() : -1, POLLIN, 0},
                                  {process_.output_.number(), POLLIN, 0},
                                  {process_.error_.number(), POLLIN, 0},
                                  {process_.input_.number(), POLLOUT, 0}}};
    if (poll(waited.data(), waited.size(), static_cast<int>(most.count())) <= 0) return;
    if (waited[0].revents != 0) {
      said_.stop = ProcessOutput::Stop::cancelled;
      return;
    }
    if (waited[1].revents != 0) readOutput();
    if (waited[2].revents != 0) read(process_.error_, said_.error, run_.max_error);
    if (waited[3].revents != 0) write();
  }

  void write() {
    const ssize_t sent = send(process_.input_.number(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) unsent_.remove_prefix(static_cast<size_t>(sent));
    const bool lost = sent < 0 && errno != EINTR && errno != EAGAIN;
    if (lost || unsent_.empty()) process_.closeInput();
  }

  void readOutput() {
    // Read one byte more than the limit: if that byte exists, the output exceeds the limit.
    read(process_.output_, said_.output, run_.max_output + 1);
    if (said_.output.size() > run_.max_output) said_.stop = ProcessOutput::Stop::output_limit;
  }

  void read(File& stream, std::string& into, size_t most) {
    const ptrdiff_t size = readNext(stream.number(), piece_.data(), piece_.size());
    if (size <= 0) {
      stream = File();
    } else {
      into.append(piece_.data(), std::min(static_cast<size_t>(size), most - into.size()));
    }
  }

  /// After the child has ended, reads the output left in the pipes, without waiting for other processes that keep the
  /// pipes open.
  void readRest() {
    constexpr int kMaxPieces = 64;
    bool more = true;
    for (int i = 0; more && i < kMaxPieces && said_.stop == ProcessOutput::Stop::none; ++i) {
      std::array<pollfd, 2> ready{{{process_.output_.number(), POLLIN, 0}, {process_.error_.number(), POLLIN, 0}}};
      more = poll(ready.data(), ready.size(), 0) > 0;
      if (ready[0].revents != 0) readOutput();
      if (ready[1].revents != 0) read(process_.error_, said_.error, run_.max_error);
    }
  }

  Process process_;
  const RunSettings& run_;
  std::string_view unsent_;
  std::array<char, 65536> piece_;
  ProcessOutput said_;
};

Result<Cancellation> Cancellation::create() {
  Result<Pipe> pipe = openPipe();
  if (!pipe) return pipe.error();
  Cancellation made;
  made.waiting_ = std::move(pipe->from);
  made.asking_ = std::move(pipe->to);
  return made;
}

// Write a byte to wake the waiting threads. Closing the pipe's write end would not suffice: a child process that was
// forked meanwhile may have a copy of it.
void Cancellation::request() { static_cast<void>(writeNext(asking_.number(), "", 1)); }

Result<ProcessOutput> runProcess(const ProcessSettings& settings, const RunSettings& run) {
  Result<Process> process = Process::start(settings);
  if (!process) return process.error();
  return ProcessExchange(std::move(*process), run).finish();
}

}  // namespace sgm::platform
