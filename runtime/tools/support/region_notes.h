#pragma once
// What a person should know of a region's mesh that is not as they may expect it.

#include <string>

#include "tools/support/region.h"
#include "world/world_field.h"

namespace sgm::cli {

/// Why a region has no triangle, and what to try; in one sentence. Errors: those of derivation.
Result<std::string> whyEmpty(const WorldField& world, const Region& region);

/// Of parts thinner than a cell, a line a rule, to stderr.
void sayThinParts(const std::vector<ThinPart>& parts, int32_t cell);

/// Of treemaps whose walls are thinner than a cell, to stderr.
void warnOfThinWalls(const std::string& file, const Program& program, int32_t cell);

}  // namespace sgm::cli
