// Parses the command line with CLI11. CLI11 is included in this folder only, since sources that include it take long to
// compile.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/text/sink.h"
#include "sgm/sgm.h"
#include "tools/sgm/arguments/add_commands.h"
#include "tools/sgm/command_line.h"
#include "tools/support/console.h"

namespace sgm::cli {
namespace {

/// The message for a usage error. If the word in the place of a command is not the name of a command, the message
/// suggests the most similar command or, if none is similar, all commands. Otherwise it is CLI11's own message.
std::string errorTextOf(const CLI::App& root, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<const CLI::App*> commands = root.get_subcommands(nullptr);
  for (int i = 1; i < argc && !commands.empty() && argv[i][0] != '-'; ++i) {
    const std::string word = argv[i];
    const auto known = std::ranges::find(commands, word, [](const CLI::App* command) { return command->get_name(); });
    if (known != commands.end()) {
      commands = (*known)->get_subcommands(nullptr);
      continue;
    }
    Suggestion suggestion(word);
    std::string all;
    for (const CLI::App* command : commands) {
      if (command->get_group().empty()) continue;  // a command that --help does not list is not suggested either
      suggestion.offer(command->get_name());
      all += (all.empty() ? "" : ", ") + command->get_name();
    }
    const std::string_view best = suggestion.best();
    return fmt::format("there is no command '{}': {}", word,
                       best.empty() ? "write one of " + all : fmt::format("did you mean '{}'?", best));
  }
  return error.what();
}

}  // namespace

Exit runCommandLine(int argc, char** argv) {
  CLI::App app("Shape grammars with morphing: from grammar text to meshes and pictures.", "sgm");
  app.set_version_flag("--version", std::string("sgm ") + sgm_version_string());
  app.require_subcommand(1);
  app.footer(
      "Run sgm COMMAND --help for its options and an example.\n"
      "Exit status: 0 success; 1 wrong input; 2 wrong usage; 3 backend or device not available; 4 a file could not\n"
      "be read or written; the highest if there are several.");
  std::vector<Command> commands;
  for (const AddCommand add : commandsToAdd()) commands.push_back(add(app));

  // Check for commands that this build lacks before CLI11 parses the command line: CLI11 would answer `sgm bake --help`
  // with the help of sgm itself.
  if (argc > 1 && std::ranges::count(commandsLeftOut(), std::string_view(argv[1])) > 0) {
    return reportError(Exit::usage,
                       fmt::format("this build of sgm leaves out '{}': configure it with SGM_TOOLS=all (cmake "
                                   "--preset release), and build it again",
                                   argv[1]));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(e), Exit::done;
    fmt::print(stderr, "sgm: usage: {}\nRun sgm --help, or sgm COMMAND --help.\n", errorTextOf(app, e, argc, argv));
    return Exit::usage;
  }
  const std::vector<CLI::App*> all = app.get_subcommands([](CLI::App*) { return true; });
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i]->parsed()) return commands[i](Words(argv + 1, argv + argc));
  }
  return Exit::usage;
}

}  // namespace sgm::cli
