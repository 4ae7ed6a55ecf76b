#pragma once
// Compiles the shapes of grammar chunks into one field program, for one box and one level.

#include <span>

#include "base/result.h"
#include "field/brush.h"
#include "field/group_index.h"
#include "field/host_field.h"
#include "field/shape_labels.h"

namespace sgm {

/// The derived shapes of one cell of the grammar, with the index of their groups.
struct IndexedCell {
  const GrammarChunk* chunk = nullptr;
  const GroupIndex* index = nullptr;
};

/// The level and the domain for which a program is compiled.
struct FieldSettings {
  /// cell edge of level 0 in units; scales the quantised samples at every level
  int32_t finest_cell = kUnitsPerMetre / 2;
  /// cell edge of this level in units: shapes too small for it are dropped, and the octaves of noise are limited
  int32_t cell = kUnitsPerMetre / 2;
  bool solid = false;  ///< true if the domain is solid where no shape is
  uint32_t label = 0;  ///< label (material and tag) of the domain's solid
  /// if set, labels are numbers of shapes in this table; the domain, host fields and brushes then have the label
  /// kNoShape
  ShapeLabels* shapes = nullptr;
};

/// Compiles all groups whose influence box meets `box`. Cells may be in any order, each once: groups are sorted by
/// layer, then those that add before those that cut, then by key. Host fields become the layers above all cells, and
/// brushes, which checkBrush() must have accepted, the layers above the host fields, each in the given order. Host
/// fields and brushes that are not visible at the level or do not reach into the box may be passed, but have no effect.
/// Pure if the sampling of the host fields is. Errors: limit if a shape needs more registers than exist; errors of
/// emitHostField().
Result<FieldProgram> compileField(std::span<const IndexedCell> cells, const IntBox& box, const FieldSettings& settings,
                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource(),
                                  std::span<const HostField> hosts = {}, std::span<const Brush> brushes = {});

/// Returns how far a group's influence reaches around its solid, in units: one cell diagonal, rounded up to two cells
/// on each axis.
inline int32_t influenceMargin(int32_t cell) { return 2 * cell; }

}  // namespace sgm
