#pragma once
// Functions that declare the commands of `sgm` and their options to the command line parser. Each returns the function
// that runs its command.

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/support/console.h"

namespace CLI {
class App;
}

namespace sgm::cli {

/// The arguments of the command line, without the program's name.
using Words = std::vector<std::string>;

/// The function that runs a command. It takes the arguments of the command line as its parameter, or has no parameter.
class Command {
 public:
  template <std::invocable Run>
  Command(Run run) : run_([run = std::move(run)](const Words&) { return run(); }) {}
  template <std::invocable<const Words&> Run>
  Command(Run run) : run_(std::move(run)) {}

  Exit operator()(const Words& words) const { return run_(words); }

 private:
  std::function<Exit(const Words&)> run_;
};

using AddCommand = Command (*)(CLI::App& root);

/// Functions that add the commands of this build, in the order of --help. Defined in all_commands.cpp or
/// core_commands.cpp.
std::span<const AddCommand> commandsToAdd();
/// Names of the commands that exist in other builds, but not in this one.
std::span<const std::string_view> commandsLeftOut();

Command addCheck(CLI::App& root);
Command addFmt(CLI::App& root);
Command addExplain(CLI::App& root);
Command addLsp(CLI::App& root);
Command addMesh(CLI::App& root);
Command addRender(CLI::App& root);
Command addPreview(CLI::App& root);
Command addBake(CLI::App& root);
Command addStore(CLI::App& root);
Command addMeasure(CLI::App& root);
Command addClassify(CLI::App& root);
Command addMasters(CLI::App& root);
Command addFly(CLI::App& root);
Command addServe(CLI::App& root);
Command addBench(CLI::App& root);
Command addPaper(CLI::App& root);
Command addBackends(CLI::App& root);
/// Adds the command `inspect`, which --help does not list: only the metrics service calls it.
Command addInspect(CLI::App& root);

}  // namespace sgm::cli
