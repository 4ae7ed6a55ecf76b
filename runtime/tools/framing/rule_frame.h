#pragma once
// `sgm render --frame`: finds the uses of a grammar rule, and a region that shows one of these uses.

#include <string>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// The meaning of the text after --frame: a rule ("Drip", "cave.Dripstone"), the end of a path of rule uses
/// ("Row/Post[2]"), or a whole path from a grammar cell, as messages print it ("net(0, 0, 0)/Node/Chamber[0]").
struct FramedRule {
  std::string text;
  std::vector<uint32_t> rules;  ///< indices into Program::rules; for a path, the rules with the name of its last step
  bool by_path = false;
};

/// Error: invalid_argument; the message suggests similar names if there are any.
Result<FramedRule> findFramedRule(const Program& program, std::string_view text);

/// Whether the path of a use ends with the wanted path, or equals it if the wanted path begins with a grammar cell.
bool matchesPath(std::string_view wanted, std::string_view path);

struct RuleUse {
  std::string path;
  IntBox bounds;  ///< bounds of the use's shapes, units
  /// A derived cell with the use's shapes only, without the shapes that enclose them.
  std::shared_ptr<const DerivedCell> alone;
};

/// The uses in the box that have shapes and finite bounds. Errors: limit if there are too many; those of derivation.
Result<std::vector<RuleUse>> usesIn(const WorldField& world, const FramedRule& wanted, const IntBox& box);

/// A region around a use, and the edge of the grid cells that suit its size.
struct FrameRegion {
  IntBox region;
  int32_t cell = 0;  ///< edge of a grid cell, in units
};

/// Chooses the region around the use nearest to the world's origin, among the uses of at least median size. Errors:
/// invalid_argument if the rule has no use within 512 m of the origin, or in a finite world; those of derivation.
Result<FrameRegion> regionAround(const WorldField& world, const FramedRule& wanted);

}  // namespace sgm::cli
