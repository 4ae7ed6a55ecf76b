#pragma once
// Messages that tell the user why a mesh may differ from the expected one.

#include <string>

#include "tools/support/region.h"
#include "world/world_field.h"

namespace sgm::cli {

/// Why a region has no triangle, in one sentence, with a suggestion what to try. Errors: those of derivation.
Result<std::string> whyEmpty(const WorldField& world, const Region& region);

/// Prints to stderr which parts are thinner than a cell, one line for each rule of the grammar.
void sayThinParts(const std::vector<ThinPart>& parts, int32_t cell);

/// Prints a warning to stderr for each treemap whose walls are thinner than a cell.
void warnOfThinWalls(const std::string& file, const Program& program, int32_t cell);

}  // namespace sgm::cli
