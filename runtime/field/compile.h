#pragma once
// Compiles grammar chunks to a field program for one box and one level.

#include <span>

#include "base/result.h"
#include "field/brush.h"
#include "field/group_index.h"
#include "field/host_field.h"
#include "field/shape_labels.h"

namespace sgm {

/// One derived cell and the index of its groups.
struct IndexedCell {
  const GrammarChunk* chunk = nullptr;
  const GroupIndex* index = nullptr;
};

/// The target of a compilation.
struct FieldSettings {
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< cell edge of level 0 in units; scales Q at every level
  int32_t cell = kUnitsPerMetre / 2;         ///< cell edge of this level in units: drops detail, limits octaves
  bool solid = false;                        ///< the domain's initial state
  uint32_t label = 0;                        ///< the domain's material and tag
  ShapeLabels* shapes = nullptr;             ///< if set, labels are numbers of shapes in here, and the labels of the
                                             ///< domain, of hosts and of brushes are kNoShape
};

/// Compiles all groups whose influence box meets `box`. Cells may be in any order, each once: groups are sorted by
/// layer, adds before cuts, then key. Host fields lie above them and brushes, which must be checked, above these, each
/// in the given order. Only those that are visible at the level and reach into the box matter; others may be present.
/// Pure if the host's fields are. Errors: limit if a shape needs more registers than exist; errors of emitHostField().
Result<FieldProgram> compileField(std::span<const IndexedCell> cells, const IntBox& box, const FieldSettings& settings,
                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource(),
                                  std::span<const HostField> hosts = {}, std::span<const Brush> brushes = {});

/// How far a group reaches around its solid: one cell diagonal, rounded up to two cells on each axis.
inline int32_t influenceMargin(int32_t cell) { return 2 * cell; }

}  // namespace sgm
