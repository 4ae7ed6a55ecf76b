#pragma once
// Child processes. Each operating system has its own source files that implement this header. Texts are UTF-8. Files
// are descriptors, as in platform/file.h. No function changes this process's signal handlers, other child processes or
// open files. Functions are thread-safe; an object must be used by one thread at a time.

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

/// Resource limits of a process, which the process cannot raise again; 0 means no limit.
struct ProcessLimits {
  uint64_t memory_bytes = 0;  ///< limit of the address space in bytes; not enforced under a sanitizer, since sanitizers
                              ///< map more
  double cpu_seconds = 0;     ///< limit of processor time in seconds, summed over all threads, rounded up to whole
                              ///< seconds
  uint64_t file_bytes = 0;    ///< maximum size in bytes of each file that the process writes
  uint64_t open_files = 0;
};

/// Applies the limits to this process irrevocably, and disables its core files. Neither locks nor allocates.
void limitThisProcess(const ProcessLimits& limits);
/// Applies the limits as limitThisProcess() does. In addition, this process cannot gain privileges, closes all files
/// except its standard streams, and is killed when the thread that started it ends.
void sandboxThisProcess(const ProcessLimits& limits);

/// Returns the path of this process's executable file. Error: io.
Result<std::string> ownProgram();
/// Returns true if the path refers to a regular file that this process may execute. Does not allocate.
bool isProgram(const std::string& path);

/// The source or destination of a standard stream of a new process.
struct Stream {
  enum Kind {
    inherited,  ///< the same stream as in this process
    none,       ///< the null device: input is empty, output is discarded
    pipe,       ///< a pipe whose other end is owned by the Process object
    file,       ///< a duplicate of the descriptor `number`, which the caller still owns
    output,     ///< the same destination as the new process's standard output; only for standard error
  };
  Kind kind = inherited;
  int number = -1;
};

struct ProcessSettings {
  std::string program;                 ///< a path, or a name without a slash, which is searched for in the folders of
                                       ///< PATH
  std::vector<std::string> arguments;  ///< command line arguments, without the program's name
  /// strings "NAME=value": added to the inherited variables, or replacing those of the same name
  std::vector<std::string> environment;
  bool inherits_environment = true;  ///< false: the process gets only the variables in `environment`, and inherits none
  Stream input, output, error;
  bool inherits_files = false;  ///< true: the process also inherits the descriptors that this process opened as
                                ///< inheritable
  /// Runs the process in its own process group, without this process's blocked and ignored signals. Signals from the
  /// terminal then do not reach it, and Process::end() also kills all processes that it has started.
  bool isolated = false;
  /// Limits that apply before the program starts, so they also cover the loading of its libraries. If set, the process
  /// also writes no core files, cannot gain privileges, and is killed when the thread that started it ends.
  std::optional<ProcessLimits> sandbox;
};

/// How a process ended.
struct ProcessExit {
  enum class Kind {
    exited,       ///< ended by itself; `number` is the exit status
    crashed,      ///< ended by a fault, such as an invalid memory access; `number` is the signal
    out_of_time,  ///< killed because it exceeded its limit of processor time
    killed,       ///< killed by SIGKILL, from this process or from a system out of memory; `number` is the signal
    ended,        ///< ended by another signal; `number` is the signal
    unknown,      ///< the exit status is lost, because this process ignores SIGCHLD
  };
  Kind kind = Kind::unknown;
  int number = 0;

  bool succeeded() const { return kind == Kind::exited && number == 0; }
};

/// Owns a child process and this process's ends of the pipes to it. The destructor kills the child.
class Process {
 public:
  /// Starts a process. Errors: unsupported if the program is not found in PATH; io if it cannot be started for another
  /// reason.
  static Result<Process> start(const ProcessSettings& settings);
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;
  /// Kills the process as end() does.
  ~Process();

  bool isRunning() const;
  /// Writes bytes to the child's standard input, which must be a pipe; blocks until all are written. Returns false,
  /// without raising a signal, if the child no longer reads. The child's output must not go to pipes: these are not
  /// read meanwhile, so the child could block on a full pipe.
  bool write(std::string_view bytes);
  /// Closes the child's standard input, so that the child reads the end of file.
  void closeInput();
  /// Blocks until the child ends. The child's output must not go to pipes: these are not read meanwhile, so the child
  /// could block on a full pipe.
  ProcessExit wait();
  /// Kills the child if it is still running, and, if it is isolated, all processes that it has started. Blocks until
  /// the child has ended.
  ProcessExit end();

 private:
  friend class ProcessExchange;
  Process() = default;

  int id_ = -1;  ///< process id of the child; -1: it has ended, and its exit status was read
  bool isolated_ = false;
  double cpu_seconds_ = 0;  ///< the child's limit of processor time in seconds; 0: none
  File input_, output_, error_;
};

/// A request to cancel runs of child processes: all runProcess() calls that were given this object kill their child and
/// return.
class Cancellation {
 public:
  /// Error: io.
  static Result<Cancellation> create();
  /// Requests cancellation; cannot be undone. Thread-safe.
  void request();

 private:
  friend class ProcessExchange;
  File waiting_, asking_;  ///< read end and write end of the pipe by which request() wakes the waiting threads
};

struct RunSettings {
  std::string_view input;                         ///< bytes for the process's standard input; ignored if that stream
                                                  ///< is not a pipe
  std::optional<std::chrono::milliseconds> time;  ///< maximum run time (wall clock), after which the process is killed;
                                                  ///< nullopt: no limit
  size_t max_output = SIZE_MAX / 2;  ///< limit of standard output in bytes; if it is exceeded, the process is killed
  size_t max_error = 4096;           ///< number of bytes of standard error to keep, from its beginning; the rest is
                                     ///< discarded
  const Cancellation* cancellation = nullptr;  ///< a request on this object kills the process; null: the run cannot be
                                               ///< cancelled
};

struct ProcessOutput {
  enum class Stop { none, time_limit, output_limit, cancelled };
  Stop stop = Stop::none;  ///< why runProcess() killed the process
  ProcessExit exit;
  std::string output, error;  ///< standard output and standard error of the process, if they were pipes
};

/// Runs a process: starts it, writes its input, and reads its output until it ends. If the process has started further
/// processes that keep its pipes open, the call does not wait for these; if the process is isolated, they are killed.
/// Errors: those of Process::start(). Throws std::bad_alloc, but only after the process has ended.
Result<ProcessOutput> runProcess(const ProcessSettings& settings, const RunSettings& run = {});

}  // namespace sgm::platform
