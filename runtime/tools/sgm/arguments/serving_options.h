#pragma once
// Command line options of the commands that can start the metrics service.

#include "tools/cli/fly/commands.h"
#include "tools/support/serving.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sgm::cli {

/// Adds --serve, --keep-serving, and the options of addServingOptions(). In a build without the service, using --serve
/// is an error.
void addFlightServing(CLI::App& app, FlyOptions& options);

/// Adds the options of the metrics service, from --listen to --waiting. needs: the option that must be given too when
/// one of these options is given; null if there is none.
void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs);

}  // namespace sgm::cli
