#pragma once
// `sgm render --frame`: finds the uses (applications) of a grammar rule, and a region that shows one use.

#include <string>
#include <string_view>
#include <vector>

#include "world/world_field.h"

namespace sgm::cli {

/// The parsed argument of --frame: a rule ("Drip", "cave.Dripstone"), the end of a path of rule uses ("Row/Post[2]"),
/// or a whole path that begins with a grammar cell, as messages print it ("net(0, 0, 0)/Node/Chamber[0]").
struct FramedRule {
  std::string text;
  std::vector<uint32_t> rules;  ///< indices into Program::rules; for a path, all rules with the name of its last step
  bool by_path = false;
};

/// Parses the argument of --frame. Error: invalid_argument; the message suggests similar names if there are any.
Result<FramedRule> findFramedRule(const Program& program, std::string_view text);

/// Whether the derivation path `path` of a rule use ends with `wanted`, or equals it if `wanted` begins with a grammar
/// cell.
bool matchesPath(std::string_view wanted, std::string_view path);

struct RuleUse {
  std::string path;
  IntBox bounds;  ///< bounds of the shapes that the use creates, in units
  /// A derived cell that contains only the shapes of this use, without enclosing shapes.
  std::shared_ptr<const DerivedCell> alone;
};

/// Finds, in a box of the world, those uses of the rule that create shapes and have finite bounds. Errors: limit if
/// there are too many; those of derivation.
Result<std::vector<RuleUse>> usesIn(const WorldField& world, const FramedRule& wanted, const IntBox& box);

/// A region around a rule use, and a grid cell size that suits the size of the use.
struct FrameRegion {
  IntBox region;
  int32_t cell = 0;  ///< edge of a grid cell, in units
};

/// Chooses a region around the use that is nearest to the world's origin among the uses of at least median size.
/// Errors: invalid_argument if the rule has no use within 512 m of the origin (in a finite world: none at all); those
/// of derivation.
Result<FrameRegion> regionAround(const WorldField& world, const FramedRule& wanted);

}  // namespace sgm::cli
