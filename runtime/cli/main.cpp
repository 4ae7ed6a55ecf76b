// The command `sgm`.

#include <fmt/core.h>

#include <csignal>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "sgm/sgm.h"

namespace {

using sgm::cli::Exit;

Exit run(int argc, char** argv) {
  CLI::App app("Shape grammars with morphing: from grammar text to meshes and pictures.", "sgm");
  app.set_version_flag("--version", std::string("sgm ") + sgm_version_string());
  app.require_subcommand(1);
  app.footer(
      "Run sgm COMMAND --help for its options and an example.\n"
      "Exit status: 0 done; 1 the input is wrong; 2 usage; 3 no such backend or device here; 4 a file could not "
      "be read or written.");
  using Add = sgm::cli::Command (*)(CLI::App&);
  std::vector<sgm::cli::Command> commands;
  for (const Add add :
       {sgm::cli::addCheck, sgm::cli::addFmt, sgm::cli::addMesh, sgm::cli::addRender, sgm::cli::addBackends})
    commands.push_back(add(app));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(e), Exit::done;
    fmt::print(stderr, "sgm: usage: {}\nRun sgm --help, or sgm COMMAND --help.\n", e.what());
    return Exit::usage;
  }
  const std::vector<CLI::App*> all = app.get_subcommands([](CLI::App*) { return true; });
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i]->parsed()) return commands[i]();
  }
  return Exit::usage;
}

}  // namespace

int main(int argc, char** argv) {
  // A file that grows past a limit is then a failed write, which cleans up after itself.
  std::signal(SIGXFSZ, SIG_IGN);
  Exit status = Exit::input;
  try {
    status = run(argc, argv);
  } catch (const std::bad_alloc&) {
    sgm::cli::complain(Exit::input, "out of memory: take a smaller region or a larger --cell");
  } catch (const std::exception& e) {
    sgm::cli::complain(Exit::input, e.what());
  }
  // What was printed may not have arrived (a full disk behind a redirection).
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    status = sgm::cli::complain(Exit::file, "cannot write to standard output");
  }
  return static_cast<int>(status);
}
