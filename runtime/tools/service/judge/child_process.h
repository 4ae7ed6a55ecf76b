#pragma once
// A child process that may end in any way: reads its output, and waits for exactly its id. Leaves the host's signal
// handlers, other children and open files alone.

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
  std::vector<std::string> arguments;    ///< after the program's name
  std::vector<std::string> environment;  ///< "NAME=value": the whole environment, nothing is inherited
  int input = -1;                        ///< an open file for its standard input; -1: a stream of `text`
  std::string_view text;
  std::chrono::milliseconds time{60000};  ///< wall time
  size_t most_output = size_t{1} << 20;   ///< bytes on its standard output
  int cancel = -1;                        ///< a descriptor: if it becomes readable, the process is ended; -1: none
};

enum class ChildEnd {
  exited,     ///< by itself; ChildOutcome::status is its status, if known
  signalled,  ///< by ChildOutcome::signal, from elsewhere
  late,       ///< ended by us after a timeout
  talkative,  ///< ended by us because of too much output
  cancelled,  ///< ended by us on request
};

struct ChildOutcome {
  ChildEnd end = ChildEnd::exited;
  std::optional<int> status;  ///< nullopt if the host discards its children's status (SIGCHLD ignored)
  int signal = 0;
  std::string output;     ///< its standard output
  std::string complaint;  ///< the beginning of its standard error, at most 4 KiB
};

/// Starts it in its own process group, with no signal blocked or ignored, waits for its end, and kills the processes
/// that it has left. May be called in any thread that lives as long as the process, which may ask to be ended with that
/// thread. Error: io if it cannot be started.
Result<ChildOutcome> runChild(const ChildSettings& settings);

/// An open descriptor. Move-only.
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

/// Opens the same file again, read-only, at its start. Error: io, also if there is no /proc.
Result<Descriptor> reopenedForReading(int file);

/// A pipe that is closed on exec, with both ends numbered above the standard streams. Error: io.
struct Pipe {
  Descriptor from, to;
  static Result<Pipe> create();
};

}  // namespace sgm::service
