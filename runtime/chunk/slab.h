#pragma once
// Computes the extent of a shape along its own axes.

#include <algorithm>
#include <array>
#include <optional>

#include "base/vec3.h"
#include "derive/shape.h"

namespace sgm {

/// A box around a shape, aligned with the shape's axes. The shortest edge of the box is the shape's thickness.
struct Slab {
  Int3 origin;       ///< origin of the shape's frame
  Vector3 middle{};  ///< centre of the box relative to the origin, in units along the world's axes
  std::array<Vector3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector3 half{};  ///< half extents along the axes, in units

  double thickness() const { return 2 * *std::min_element(half.begin(), half.end()); }
};

/// Returns the slab of a single shape; nullopt for half-spaces, voxels and combiners.
std::optional<Slab> slabOfShape(const GrammarChunk& chunk, const Shape& shape);

/// Returns the slab of the middle piece of a sweep. cell_edge: minimum length of the piece, in units.
Slab slabOfSweep(const GrammarChunk& chunk, const Shape& sweep, int32_t cell_edge);

/// Returns the position at an offset from the slab's middle, in units along the world's axes.
Int3 placeIn(const Slab& slab, const Vector3& offset = {});

}  // namespace sgm
