#pragma once
// Child processes. Each operating system has source files of its own that implement this header.
//
// Texts are UTF-8. Files are descriptors, as in platform/file.h. No function changes signal handlers, other child
// processes or open files of this process. Functions are thread-safe; an object must be used by one thread at a time.

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

/// Resource limits of a process, which it cannot raise again; 0: no limit.
struct ProcessLimits {
  uint64_t memory_bytes = 0;  ///< limit of the address space, bytes; not enforced under a sanitizer, which maps more
  double cpu_seconds = 0;     ///< limit of processor time, summed over all threads, rounded up to whole seconds
  uint64_t file_bytes = 0;    ///< maximum size of each file that it writes, bytes
  uint64_t open_files = 0;
};

/// Limits this process irrevocably, and disables its core files. Neither locks nor allocates.
void limitThisProcess(const ProcessLimits& limits);
/// Limits this process in the same way. It also cannot gain privileges, closes all files except its standard streams,
/// and is killed when the thread that started it ends.
void sandboxThisProcess(const ProcessLimits& limits);

/// Returns the path of the executable of this process. Error: io.
Result<std::string> ownProgram();
/// Whether the path refers to a file that this process may execute. Does not allocate.
bool isProgram(const std::string& path);

/// Where a standard stream of a new process is connected to.
struct Stream {
  enum Kind {
    inherited,  ///< the same as this process's
    none,       ///< empty for input, and discards output
    pipe,       ///< a pipe whose other end Process owns
    file,       ///< a duplicate of the descriptor `number`, which the caller still owns
    output,     ///< only for standard error: the same as the new process's standard output
  };
  Kind kind = inherited;
  int number = -1;
};

struct ProcessSettings {
  std::string program;                 ///< a path, or a name without a slash, which is searched in the folders of PATH
  std::vector<std::string> arguments;  ///< command line arguments, without the program's name
  /// "NAME=value" each: added to the inherited variables, replacing those of the same name
  std::vector<std::string> environment;
  bool inherits_environment = true;  ///< false: the process gets only the variables in `environment`
  Stream input, output, error;
  bool inherits_files = false;  ///< also inherits the descriptors that this process has opened as inheritable
  /// Runs the process in a process group of its own, without this process's blocked and ignored signals: signals of the
  /// terminal do not reach it, and Process::end() also kills all processes that it has started.
  bool isolated = false;
  /// Limits that apply before the program starts, and thus to the loading of its libraries. If set, the process also
  /// writes no core files, cannot gain privileges, and is killed when the thread that started it ends.
  std::optional<ProcessLimits> sandbox;
};

/// How a process ended.
struct ProcessExit {
  enum class Kind {
    exited,       ///< by itself; `number` is the exit status
    crashed,      ///< by a fault, such as an invalid memory access; `number` is the signal
    out_of_time,  ///< it exceeded its limit of processor time
    killed,       ///< by SIGKILL, from this process or from a system without free memory; `number` is the signal
    ended,        ///< by another signal; `number` is the signal
    unknown,      ///< the exit status is lost, because this process ignores SIGCHLD
  };
  Kind kind = Kind::unknown;
  int number = 0;

  bool succeeded() const { return kind == Kind::exited && number == 0; }
};

/// Owns a child process, and this process's ends of its pipes.
class Process {
 public:
  /// Starts a process. Errors: unsupported if the program is not found in PATH; io if it cannot be started for another
  /// reason.
  static Result<Process> start(const ProcessSettings& settings);
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;
  /// Ends the process as end() does.
  ~Process();

  bool isRunning() const;
  /// Writes bytes to the process's standard input, which must be a pipe; blocks until all are written. Returns false if
  /// the process no longer reads; no signal is raised. The process's output must not go to pipes, since nobody reads
  /// these meanwhile and the process could block on a full pipe.
  bool write(std::string_view bytes);
  /// Closes the process's standard input, so that it reads the end of file.
  void closeInput();
  /// Blocks until the process ends. Its output must not go to pipes, which nobody reads meanwhile.
  ProcessExit wait();
  /// Kills the process if it is still running, and, if it is isolated, all processes that it has started. Blocks until
  /// it has ended.
  ProcessExit end();

 private:
  friend class ProcessExchange;
  Process() = default;

  int id_ = -1;  ///< process id; -1: the process has ended, and its exit status was read
  bool isolated_ = false;
  double cpu_seconds_ = 0;  ///< the limit of processor time; 0: none
  File input_, output_, error_;
};

/// A request to end processes. Wakes all threads that are in runProcess() with this object.
class Cancellation {
 public:
  /// Error: io.
  static Result<Cancellation> create();
  /// Requests cancellation; cannot be undone. Thread-safe.
  void request();

 private:
  friend class ProcessExchange;
  File waiting_, asking_;  ///< the two ends of a pipe
};

struct RunSettings {
  std::string_view input;                         ///< written to the process's standard input if that is a pipe
  std::optional<std::chrono::milliseconds> time;  ///< wall time after which the process is ended
  size_t max_output = SIZE_MAX / 2;  ///< limit of standard output in bytes; if it is exceeded, the process is killed
  size_t max_error = 4096;           ///< maximum number of bytes of standard error to store, from its beginning
  const Cancellation* cancellation = nullptr;  ///< if it is requested, the process is killed; null: not cancellable
};

struct ProcessOutput {
  enum class Stop { none, time_limit, output_limit, cancelled };
  Stop stop = Stop::none;  ///< why runProcess() killed the process
  ProcessExit exit;
  std::string output, error;  ///< what the process wrote to its standard streams, as far as these are pipes
};

/// Runs a process: starts it, writes its input, and reads its output until it ends. Does not wait for processes that it
/// started and that keep its pipes open; if it is isolated, these are killed. Errors: those of Process::start(). Throws
/// std::bad_alloc, but only after the process has ended.
Result<ProcessOutput> runProcess(const ProcessSettings& settings, const RunSettings& run = {});

}  // namespace sgm::platform
