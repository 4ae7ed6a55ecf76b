#pragma once
// Notes for users on meshes that may surprise them.

#include <string>

#include "tools/support/region.h"
#include "world/world_field.h"

namespace sgm::cli {

/// Why a region has no triangle, and what to try, in one sentence. Errors: those of derivation.
Result<std::string> whyEmpty(const WorldField& world, const Region& region);

/// Lists parts thinner than a cell on stderr, a line for each rule.
void sayThinParts(const std::vector<ThinPart>& parts, int32_t cell);

/// Warns on stderr of treemaps whose walls are thinner than a cell.
void warnOfThinWalls(const std::string& file, const Program& program, int32_t cell);

}  // namespace sgm::cli
