// The entry point of the command `sgm`, and its signal handler.

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "tools/sgm/command_line.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"

namespace {

using sgm::cli::Exit;

/// Signal handler. Removes unfinished files, and then ends the process by the same signal, so that a shell reports 128
/// + the signal. While work must not be interrupted, the handler only records the signal, which is raised again after
/// that work.
void endBy(int signal) {
  if (sgm::cli::ending_signals.waits(signal)) return;
  sgm::cli::unfinished_files.remove();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void handleSignals() {
  // Ignore SIGXFSZ: exceeding the file size limit then fails the write, and the writer removes its file.
  std::signal(SIGXFSZ, SIG_IGN);
  // If the parent process ignores SIGCHLD, this process inherits that setting. The system would then discard the exit
  // status of child processes.
  std::signal(SIGCHLD, SIG_DFL);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) {
    // Signals that the parent process ignores (nohup, a background job of a script) stay ignored.
    if (std::signal(signal, endBy) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace

int main(int argc, char** argv) {
  handleSignals();
  Exit status = Exit::input;
  try {
    status = sgm::cli::runCommandLine(argc, argv);
  } catch (const std::bad_alloc&) {
    sgm::cli::reportError(Exit::input, "out of memory: choose a smaller region or a larger --cell");
  } catch (const std::exception& e) {
    sgm::cli::reportError(Exit::input, e.what());
  }
  // Report lost output, for example if standard output is a file on a full disk.
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    status = sgm::cli::reportError(Exit::file, "cannot write to standard output");
  }
  return static_cast<int>(status);
}
