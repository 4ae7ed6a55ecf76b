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

/// Ends the process by the signal, as if it were not handled (a shell then reports 128 + the signal), but first removes
/// unfinished files. Defers the signal while work must not be interrupted.
void endBy(int signal) {
  if (sgm::cli::ending_signals.waits(signal)) return;
  sgm::cli::unfinished_files.remove();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void handleSignals() {
  // With SIGXFSZ ignored, exceeding the file size limit is a failed write, after which the writer removes its file.
  std::signal(SIGXFSZ, SIG_IGN);
  // If the caller ignores it, the system would forget how child processes end.
  std::signal(SIGCHLD, SIG_DFL);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) {
    // Signals that the caller ignores (nohup, a background job of a script) stay ignored.
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
  // Output may have been lost, for example on a full disk to which it is redirected.
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    status = sgm::cli::reportError(Exit::file, "cannot write to standard output");
  }
  return static_cast<int>(status);
}
