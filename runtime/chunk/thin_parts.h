#pragma once
// Finds parts of a world that are thinner than a cell of the meshed level: a mesh may miss them.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// The thin parts of one rule's statements.
struct ThinPart {
  std::string rule;       ///< name of the rule as it is called: "Pane", "cave.Column"
  bool cut = false;       ///< true: the thin part is cut away; false: it is added
  int32_t thickness = 0;  ///< thickness of the thinnest such part, in units
  size_t uses = 0;        ///< number of uses of the rule that have such a part
  bool is_about = false;  ///< `uses` is an estimate: some were counted by shapes, and a use may have several
};

/// Finds the thin parts whose middle lies in the box; sorted by rule name. The thickness of a shape is its smallest
/// diameter; an intersection has that of its thinnest operand, a sum or a morph that of its thickest part. Does not
/// report parts that `detail` and `lod` drop at this level, parts with something thicker beside them along half of
/// their length or more (a slab on a wall, a pipe in the ground), and walls of treemaps. The first cells of a layer are
/// derived again, to find each shape's statement; later cells only if they have thin shapes of a new kind. Errors:
/// those of derivation.
Result<std::vector<ThinPart>> thinParts(const WorldField& world, const IntBox& box, int level);

}  // namespace sgm
