#pragma once
// Child processes as the operating system has them. Each system has sources of its own that implement this header.
//
// Texts are UTF-8. Files are descriptors, as in platform/file.h. No function disturbs signal handlers, other children
// or open files of this process. Functions are thread-safe, objects belong to one thread at a time.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/platform/file.h"
#include "base/result.h"

namespace sgm::platform {

/// Limits that a process cannot raise again; 0: none.
struct ProcessLimits {
  uint64_t memory_bytes = 0;  ///< of address space; not enforced under a sanitizer, which maps more
  double cpu_seconds = 0;     ///< processor time, summed over its threads, rounded up to whole seconds
  uint64_t file_bytes = 0;    ///< size of each file that it writes
  uint64_t open_files = 0;
};

/// Limits this process for good: it writes no core files, gains no privileges, keeps no open files but its standard
/// streams, and is ended when the thread that started it ends.
void sandboxThisProcess(const ProcessLimits& limits);

/// The path of the program that this process runs. Error: io.
Result<std::string> ownProgram();
/// Whether the path is that of a file that this process may run. Does not allocate.
bool isProgram(const std::string& path);

/// A standard stream of a new process.
struct Stream {
  enum Kind {
    inherited,  ///< the same as this process's
    none,       ///< empty for input, and discards output
    pipe,       ///< Process has the other end
    file,       ///< a copy of the descriptor `number`, which stays the caller's
    output,     ///< of standard error: the same as the new process's standard output
  };
  Kind kind = inherited;
  int number = -1;
};

struct ProcessSettings {
  std::string program;                   ///< a path; a name without a slash is looked for in the folders of PATH
  std::vector<std::string> arguments;    ///< after the program's name
  std::vector<std::string> environment;  ///< "NAME=value": added to this process's variables, or in their place
  bool inherits_environment = true;      ///< false: `environment` is all that it gets
  Stream input, output, error;
  bool inherits_files = false;  ///< also gets the files that this process has opened to be inherited
  /// In a process group of its own, without the signals that this process blocks or ignores: a terminal's signals do
  /// not reach it, and ending it ends everything that it has started.
  bool isolated = false;
  /// Limits in force before its program starts. It then also writes no core files, gains no privileges, and is ended
  /// when the thread that starts it ends.
  std::optional<ProcessLimits> sandbox;
};

/// How a process has ended.
struct ProcessExit {
  enum class Kind {
    exited,       ///< by itself, with the status `number`
    crashed,      ///< by a fault of its own; `number` is the system's: that of a signal
    out_of_time,  ///< by its limit of processor time
    killed,       ///< by force: by this process, or by a system that is out of memory; `number` as for crashed
    ended,        ///< by another signal from outside; `number` as for crashed
    unknown,      ///< the system has forgotten it, because this process ignores the ends of its children (SIGCHLD)
  };
  Kind kind = Kind::unknown;
  int number = 0;

  bool succeeded() const { return kind == Kind::exited && number == 0; }
};

/// Owns a child process and this process's ends of its pipes, until the child has ended.
class Process {
 public:
  /// Errors: unsupported if no folder of PATH has the program; io if it cannot be started otherwise.
  static Result<Process> start(const ProcessSettings& settings);
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;
  /// As end().
  ~Process();

  bool isRunning() const;
  /// Sends bytes to its standard input, a pipe, and blocks until it has room for all of them. Returns false if the
  /// process reads no more; no signal comes of it. Its output must not go to pipes, which could fill meanwhile.
  bool write(std::string_view bytes);
  /// Ends its standard input.
  void closeInput();
  /// Blocks until it has ended. Its output must not go to pipes, which nobody reads meanwhile.
  ProcessExit wait();
  /// Kills it unless it has ended, and if it is isolated, everything that it has started; blocks until it has ended.
  ProcessExit end();

 private:
  friend class ProcessExchange;
  Process() = default;

  int id_ = -1;  ///< -1 if its end is known
  bool isolated_ = false;
  double cpu_seconds_ = 0;  ///< limit
  File input_, output_, error_;
};

/// A request to end processes, which wakes the threads in runProcess().
class Cancellation {
 public:
  /// Error: io.
  static Result<Cancellation> create();
  /// Any thread; holds for good.
  void request();

 private:
  friend class ProcessExchange;
  File waiting_, asking_;  ///< the two ends of a pipe
};

struct RunSettings {
  std::string_view input;                         ///< for a standard input that is a pipe
  std::optional<std::chrono::milliseconds> time;  ///< wall time after which the process is ended
  size_t most_output = SIZE_MAX / 2;              ///< bytes of standard output; with more, the process is ended
  size_t most_error = 4096;                       ///< bytes of standard error that are kept, from its beginning
  const Cancellation* cancellation = nullptr;     ///< on request, the process is ended; null: none
};

struct ProcessOutput {
  enum class Stop { none, time_limit, output_limit, cancelled };
  Stop stop = Stop::none;  ///< why runProcess() has ended it
  ProcessExit exit;
  std::string output, error;  ///< from pipes
};

/// Starts a process, writes its input and reads its output until it ends, but not until processes that it has started
/// and that hold its pipes end; if it is isolated, these are killed then. Errors: those of Process::start. Throws
/// std::bad_alloc, only after the process has ended.
Result<ProcessOutput> runProcess(const ProcessSettings& settings, const RunSettings& run = {});

}  // namespace sgm::platform
