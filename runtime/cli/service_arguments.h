#pragma once
// The command line of what serves, beside arguments.cpp.

#include <functional>

#include "cli/commands.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sgm::cli {

/// --listen to --waiting. needs: an option without which they say nothing; null: none.
void addServingOptions(CLI::App& app, ServingOptions& options, CLI::Option* needs);
std::function<Exit()> addServe(CLI::App& root);

}  // namespace sgm::cli
