#pragma once
// Brushes: edits by which players dig and build. Each brush is a layer of its own above everything that the grammar
// derives.

#include "base/result.h"
#include "field/builder.h"

namespace sgm {

struct Brush {
  enum class Shape : uint8_t { sphere, box, capsule };
  Shape shape = Shape::sphere;
  bool cut = false;  ///< true: the brush removes its shape from the solid; false: it adds the shape
  /// index into the grammar's materials; 0: a cut keeps the material of the solid that it cuts, an added shape gets the
  /// default
  uint16_t material = 0;
  /// index into the grammar's tags; 0: a cut keeps the tag of the solid that it cuts, an added shape has no tag
  uint16_t tag = 0;
  Int3 from;  ///< centre of a sphere or a box, one end of a capsule, in units
  Int3 to;    ///< the other end of a capsule, in units
  Int3 half;  ///< half extents of a box along its own axes, in units
  /// rotation from the box's axes to the world's: quaternion x y z w of any length above 0
  std::array<float, 4> turn{0, 0, 0, 1};
  int32_t radius = 0;  ///< radius of a sphere or a capsule, in units
  int32_t smooth = 0;  ///< width of the blend with the existing field, in units; 0: none
};

inline constexpr int32_t kMaxBrushSize = 1 << 20;  ///< limit of each length of a brush, in units

/// Checks a brush. Errors: invalid_argument if a size is 0 or over kMaxBrushSize, or if the quaternion `turn` has
/// length 0; range if the brush leaves the world. Members that the brush's shape does not use may have any value.
Result<void> checkBrush(const Brush& brush);

/// Returns a box that contains every point where the brush changes solid to void or void to solid, including its blend.
/// Precondition of this and the following functions: checkBrush() has accepted the brush.
IntBox brushBounds(const Brush& brush);

/// True if the brush has an effect at a level with cells of this edge, in units: if it is nowhere thinner than a cell.
/// The samples of a level would hit only pieces of a thinner brush.
bool brushShows(const Brush& brush, int32_t cell);

/// Emits the brush as the only group of layer number `layer`. cell: edge of the level's cells in units, the same as for
/// all other groups of the program.
Result<void> emitBrush(ProgramBuilder& builder, const Brush& brush, int32_t cell, uint32_t layer);

}  // namespace sgm
