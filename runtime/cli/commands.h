#pragma once
// The subcommands of `sgm`, one source each. An add function declares the subcommand's options and says what to run
// when it is the one given.

#include <CLI/CLI.hpp>
#include <functional>

#include "cli/console.h"

namespace sgm::cli {

using Command = std::function<Exit()>;

Command addCheck(CLI::App& root);
Command addFmt(CLI::App& root);
Command addMesh(CLI::App& root);
Command addRender(CLI::App& root);
Command addBackends(CLI::App& root);

}  // namespace sgm::cli
