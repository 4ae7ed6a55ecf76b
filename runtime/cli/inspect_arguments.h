#pragma once
// What `sgm inspect` is asked on its command line.

#include <functional>

#include "cli/console.h"

namespace CLI {
class App;
}

namespace sgm::cli {

/// The command, which help does not list: the metrics service calls it. What runs it.
std::function<Exit()> addInspect(CLI::App& root);

}  // namespace sgm::cli
