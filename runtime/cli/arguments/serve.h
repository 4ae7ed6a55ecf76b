#pragma once
// What is asked of those that serve.

#include "cli/commands.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sgm::cli {

/// --listen to --waiting. needs: an option without which they say nothing; null: none.
void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs);

}  // namespace sgm::cli
