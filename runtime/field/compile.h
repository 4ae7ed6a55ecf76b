#pragma once
// Grammar chunks become a field program for one box and one level.

#include <span>

#include "base/result.h"
#include "field/brush.h"
#include "field/group_index.h"
#include "field/host_field.h"
#include "field/shape_labels.h"

namespace sgm {

/// One derived cell and the index over its groups.
struct IndexedCell {
  const GrammarChunk* chunk = nullptr;
  const GroupIndex* index = nullptr;
};

/// What a field is compiled for.
struct FieldSettings {
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< cell edge of level 0 in units; scales Q at every level
  int32_t cell = kUnitsPerMetre / 2;         ///< cell edge of this level in units: drops detail, limits octaves
  bool solid = false;                        ///< the domain's own state
  uint32_t label = 0;                        ///< the domain's own material and tag
  ShapeLabels* shapes = nullptr;             ///< labels are to name shapes: these; the domain's, hosts' and brushes'
                                             ///< labels are kNoShape then
};

/// Compiles all groups whose influence box meets `box`. Cells may come in any order, each once: groups are sorted by
/// layer, adds before cuts, then key. The host's fields lie above them and brushes, which were checked, above these,
/// each in the order given; those that show at the level and reach into the box matter, others may be among them. Pure,
/// as far as the host's fields are. limit: a shape needs more registers than there are; errors of emitHostField().
Result<FieldProgram> compileField(std::span<const IndexedCell> cells, const IntBox& box, const FieldSettings& settings,
                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource(),
                                  std::span<const HostField> hosts = {}, std::span<const Brush> brushes = {});

/// How far around its solid a group still reaches: one cell diagonal (two cells on each axis hold it).
inline int32_t influenceMargin(int32_t cell) { return 2 * cell; }

}  // namespace sgm
