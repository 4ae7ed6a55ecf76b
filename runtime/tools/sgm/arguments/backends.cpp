// Declares the command that lists this machine's devices for meshing.

#include <memory>

#include "tools/cli/measure/commands.h"
#include "tools/sgm/arguments/shared.h"

namespace sgm::cli {

Command addBackends(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("backends", "List the backends and devices of this machine, and why others are not usable");
  const auto json = std::make_shared<bool>(false);
  app->add_flag("--json", *json, "Print the list as one JSON object on standard output");
  app->footer("Example:\n  sgm backends --json");
  return [json] { return listBackends(*json); };
}

}  // namespace sgm::cli
