#pragma once
// Notes to the user about meshes that may differ from the expected ones.

#include <string>

#include "tools/support/region.h"
#include "world/world_field.h"

namespace sgm::cli {

/// Explains in one sentence why a region has no triangle, and suggests what to try. Errors: those of derivation.
Result<std::string> whyEmpty(const WorldField& world, const Region& region);

/// Prints to stderr which parts are thinner than a cell, one line for each rule.
void sayThinParts(const std::vector<ThinPart>& parts, int32_t cell);

/// Warns on stderr about treemaps whose walls are thinner than a cell.
void warnOfThinWalls(const std::string& file, const Program& program, int32_t cell);

}  // namespace sgm::cli
