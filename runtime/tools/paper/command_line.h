#pragma once
// Makes the command line for repeating a measurement. It must be run in the report's folder.

#include <string>

#include "tools/cli/measure/commands.h"
#include "tools/support/options.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

std::string commandOf(const std::string& name, const WorldOptions& options);
std::string commandOf(const RenderOptions& options);
std::string commandOf(const MeasureOptions& options);

}  // namespace sgm::cli
