#pragma once
// The command that repeats what was done, as a reader would type it in the report's folder.

#include <string>

#include "cli/commands.h"

namespace sgm::cli {

std::string commandOf(const std::string& name, const WorldOptions& options);
std::string commandOf(const RenderOptions& options);
std::string commandOf(const MeasureOptions& options);

}  // namespace sgm::cli
