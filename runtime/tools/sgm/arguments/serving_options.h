#pragma once
// Options of the commands that can start the metrics service.

#include "tools/cli/fly/commands.h"
#include "tools/support/serving.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sgm::cli {

/// Adds --serve, --keep-serving, and the options of addServingOptions(). In a build without the service, --serve is a
/// usage error.
void addFlightServing(CLI::App& app, FlyOptions& options);

/// Adds the options from --listen to --waiting. needs: an option without which they are usage errors; null: none.
void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs);

}  // namespace sgm::cli
