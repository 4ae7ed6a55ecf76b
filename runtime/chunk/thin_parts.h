#pragma once
// Parts of a world that are thinner than a cell of the level at which it is meshed: a mesh may miss them.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// What is thin of the statements of one rule.
struct ThinPart {
  std::string rule;       ///< as it is called: "Pane", "cave.Column"
  bool cut = false;       ///< what is taken away is thin, not what is there
  int32_t thickness = 0;  ///< of the thinnest, units
  size_t uses = 0;        ///< of the rule, that have such a part
  bool is_about = false;  ///< some of them were counted by their shapes, of which a use may have several
};

/// The thin parts whose middle lies in the box, by name. The thickness of a shape is its least diameter; of an
/// intersection, that of its thinnest operand; of a sum and of a morph, that of their thickest part. Left out are parts
/// that `detail` and `lod` drop at this level, parts that lie on or in something thicker along half of their length or
/// more (a slab on a wall, a pipe in the ground), and walls of treemaps. Of a layer's cells the first are derived anew,
/// to see which statement each shape is of; later ones only if they have thin shapes unlike all of those. Errors: those
/// of derivation.
Result<std::vector<ThinPart>> thinParts(const WorldField& world, const IntBox& box, int level);

}  // namespace sgm
