// Replaces serving_options.cpp in a build without the metrics service (SGM_TOOLS=core): using --serve is an error.

#include <CLI/CLI.hpp>

#include "tools/cli/fly/commands.h"
#include "tools/sgm/arguments/serving_options.h"

namespace sgm::cli {

void addFlightServing(CLI::App& app, FlyOptions&) {
  const auto refuse = [](int64_t) {
    throw CLI::ValidationError(
        "this build of sgm leaves out '--serve': configure it with SGM_TOOLS=all (cmake --preset release), and build "
        "it "
        "again",
        CLI::ExitCodes::ValidationError);
  };
  app.add_flag_function("--serve", refuse)->group("");  // an empty group hides the option in --help
}

}  // namespace sgm::cli
