#pragma once
// Finds parts of a world that are thinner than a cell of the meshed level: a mesh may miss them.

#include <string>
#include <vector>

#include "world/world_field.h"

namespace sgm {

/// The thin parts (see thinParts()) that the statements of one rule make.
struct ThinPart {
  std::string rule;       ///< name of the rule as in its call, such as "Pane" or "cave.Column"
  bool cut = false;       ///< true: the thin part is cut away; false: it is added
  int32_t thickness = 0;  ///< thickness of the thinnest of these parts, in units
  size_t uses = 0;        ///< number of derived uses of the rule that have such a thin part
  /// true: `uses` is only an estimate: for some cells it is the number of thin shapes, and one use of the rule may have
  /// several
  bool is_about = false;
};

/// Finds the thin parts whose middle lies in the box; sorted by rule name. The thickness of a shape is its smallest
/// diameter; an intersection has the thickness of its thinnest operand, a sum or a morph that of its thickest operand.
///
/// Does not report parts that `detail` and `lod` drop at this level; parts with something thicker beside them along at
/// least half of their extent (a slab on a wall, a pipe in the ground); and walls of treemaps.
///
/// The first cells of a layer are derived again, to find the statement of each shape; later cells only if they have
/// thin shapes of a new kind. Errors: those of derivation.
Result<std::vector<ThinPart>> thinParts(const WorldField& world, const IntBox& box, int level);

}  // namespace sgm
