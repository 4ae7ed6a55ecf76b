#pragma once
// Brushes: what players dig away and build on. Each is a layer of its own above all that a grammar derives.

#include "base/result.h"
#include "field/builder.h"

namespace sgm {

struct Brush {
  enum class Shape : uint8_t { sphere, box, capsule };
  Shape shape = Shape::sphere;
  bool cut = false;       ///< takes its shape away; else adds it
  uint16_t material = 0;  ///< of the grammar's; 0: a cut leaves what it was cut into, an add has the default
  uint16_t tag = 0;       ///< likewise
  Int3 from;              ///< centre of a sphere or a box, one end of a capsule, in units
  Int3 to;                ///< the other end of a capsule
  Int3 half;              ///< half extents of a box along its own axes, in units
  std::array<float, 4> turn{0, 0, 0, 1};  ///< from a box's axes to the world's: a quaternion x y z w of any length
  int32_t radius = 0;                     ///< of a sphere or a capsule, in units
  int32_t smooth = 0;                     ///< width of the blend with what is there, in units; 0: none
};

inline constexpr int32_t kMaxBrushSize = 1 << 20;  ///< of each length of a brush, in units

/// invalid_argument: a size that is 0 or over kMaxBrushSize, a turn without direction. range: it leaves the world.
/// What the brush's shape does not use may be anything.
Result<void> checkBrush(const Brush& brush);

/// Holds every place where the brush changes a solid or a void, its blend included. Precondition here and below: it has
/// been checked.
IntBox brushBounds(const Brush& brush);

/// Whether the brush shows where cells have this edge, in units: as long as it is nowhere thinner than a cell. Samples
/// would find only pieces of a thinner one.
bool brushShows(const Brush& brush, int32_t cell);

/// Emits the brush as the only group of a layer. cell: edge of the level's cells in units, as for all groups.
Result<void> emitBrush(ProgramBuilder& builder, const Brush& brush, int32_t cell, uint32_t layer);

}  // namespace sgm
