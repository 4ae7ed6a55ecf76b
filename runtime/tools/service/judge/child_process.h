#pragma once
// A process that works for this one and may come to any end: what it says is read, and it is waited for, by its own id
// alone. The host's signal handlers, its other children and its open files are left alone.

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm::service {

struct ChildSettings {
  std::string program;                   ///< path
  std::vector<std::string> arguments;    ///< behind the program's name
  std::vector<std::string> environment;  ///< "NAME=value": nothing else of the host's is handed on
  int input = -1;                        ///< an open file that becomes its standard input; -1: a stream of `text`
  std::string_view text;
  std::chrono::milliseconds time{60000};  ///< of the clock
  size_t most_output = size_t{1} << 20;   ///< bytes on its standard output
  int cancel = -1;                        ///< a descriptor: the process is ended once it can be read; -1: none
};

enum class ChildEnd {
  exited,     ///< by itself; ChildOutcome::status says how, where that is known
  signalled,  ///< by ChildOutcome::signal, which was not ours
  late,       ///< ended by us: its time was over
  talkative,  ///< ended by us: it said more than it may
  cancelled,  ///< ended by us, as asked
};

struct ChildOutcome {
  ChildEnd end = ChildEnd::exited;
  std::optional<int> status;  ///< unknown where the host has children reaped for it (SIGCHLD ignored)
  int signal = 0;
  std::string output;     ///< its standard output
  std::string complaint;  ///< how its standard error began, 4 KiB at most
};

/// Starts it, in a process group of its own with no signal blocked or ignored, waits for its end, and ends what it has
/// started and left. Any thread; which must live as long as the process, since that may ask to be ended with it.
/// Errors: io where it cannot be started.
Result<ChildOutcome> runChild(const ChildSettings& settings);

/// An open descriptor. Moves only.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int number() const { return number_; }
  void reset();

 private:
  int number_ = -1;
};

/// The same file opened anew: to be read alone, from its start. Error: io, also where there is no /proc.
Result<Descriptor> reopenedForReading(int file);

/// A pipe that is closed on exec, both ends numbered above the standard streams. Error: io.
struct Pipe {
  Descriptor from, to;
  static Result<Pipe> create();
};

}  // namespace sgm::service
