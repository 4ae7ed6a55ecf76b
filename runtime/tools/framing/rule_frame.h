#pragma once
// `sgm render --frame`: finds the uses of a rule, and a region that shows one of them.

#include <string>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// What the text of --frame names: a rule ("Drip", "cave.Dripstone"), the end of a path of uses ("Row/Post[2]"), or a
/// whole path from a cell, as messages print it ("net(0, 0, 0)/Node/Chamber[0]").
struct FramedRule {
  std::string text;
  std::vector<uint32_t> rules;  ///< indices into Program::rules; for a path, those with the name of its last step
  bool by_path = false;
};

/// Error: invalid_argument, which suggests similar names if there are any.
Result<FramedRule> findFramedRule(const Program& program, std::string_view text);

/// Whether a use's path ends with the wanted path, or equals it if that names a cell.
bool matchesPath(std::string_view wanted, std::string_view path);

struct RuleUse {
  std::string path;
  IntBox bounds;                             ///< of its shapes, units
  std::shared_ptr<const DerivedCell> alone;  ///< its shapes, without those that enclose them
};

/// The bounded uses in the box that have shapes. Errors: limit for too many; those of derivation.
Result<std::vector<RuleUse>> usesIn(const WorldField& world, const FramedRule& wanted, const IntBox& box);

/// A region around a use, and its cell size.
struct FrameRegion {
  IntBox region;
  int32_t cell = 0;  ///< units
};

/// Around the use nearest to the world's origin, among those of at least median size. Errors: invalid_argument if the
/// rule has no use within 512 m, or in a finite world; those of derivation.
Result<FrameRegion> regionAround(const WorldField& world, const FramedRule& wanted);

}  // namespace sgm::cli
