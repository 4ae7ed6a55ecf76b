#pragma once
// `sgm render --frame`: which uses of a rule are meant, where they stand, and what region shows one of them.

#include <string>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// The rules that a text names: "Drip", "cave.Dripstone", or a path such as "Row/Post[2]" whose beginning may be left
/// out, or "net(0, 0, 0)/Node/Chamber[0]" as messages print it.
struct FramedRule {
  std::string text;
  std::vector<uint32_t> rules;  ///< Program::rules; of a path those with the name of its last step
  bool by_path = false;
};

/// Errors: invalid_argument, with near names where there are some.
Result<FramedRule> findFramedRule(const Program& program, std::string_view text);

/// Whether a use's whole path ends as the wanted one says, or is all of it where that names a cell.
bool matchesPath(std::string_view wanted, std::string_view path);

struct RuleUse {
  std::string path;
  IntBox bounds;                             ///< of its shapes, units
  std::shared_ptr<const DerivedCell> alone;  ///< its shapes, without what encloses them
};

/// The uses in the box that have shapes and an end. Errors: limit for too many; those of derivation.
Result<std::vector<RuleUse>> usesIn(const WorldField& world, const FramedRule& wanted, const IntBox& box);

/// Where to look for a use, and with which cells.
struct FrameRegion {
  IntBox region;
  int32_t cell = 0;  ///< units
};

/// Around the use that is nearest to the world's origin, of those that are not smaller than most. Errors:
/// invalid_argument if the rule has no use within 512 m, or in a finite world; those of derivation.
Result<FrameRegion> regionAround(const WorldField& world, const FramedRule& wanted);

}  // namespace sgm::cli
