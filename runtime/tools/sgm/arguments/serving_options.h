#pragma once
// Options of commands that start the metrics service.

#include "tools/cli/fly/commands.h"
#include "tools/support/serving.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sgm::cli {

/// --serve, --keep-serving, and those below. In a small build, --serve is a usage error.
void addFlightServing(CLI::App& app, FlyOptions& options);

/// --listen to --waiting. needs: an option that they require; null: none.
void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs);

}  // namespace sgm::cli
