#pragma once
// The squares of a chunk's face around a side at the border, and the cells on both sides of them.
//
// A face vertex may lie beyond its side's own square, in the adjacent square. Each of the four sides of a square that
// the surface passes through may have a face vertex there. A PART of the adjacent square is nearer to its common edge
// with the side's own square than to its other edges: two face vertices that stay in their own parts do not interfere.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// True if the square `by` squares away from a side's along an axis of its face is in the same face of a chunk.
bool isInFace(const SharpSide& side, int axis, int by, int32_t cell);

class Surroundings {
 public:
  /// Squares of the face: the side's own; the one with the face vertices, if different; and those around the latter.
  enum class Place : uint8_t { own, beside, low, high, opposite };
  static constexpr std::array<Place, 3> kAround{Place::low, Place::high, Place::opposite};
  static constexpr size_t kCorners = 36;

  /// Borrows the side, which must have places.
  Surroundings(const SharpSide& side, int32_t cell);

  /// A corner of the squares' cells, in units; nullopt if it lies beyond the world, or is not needed.
  std::optional<Int3> corner(size_t number) const;
  /// samples: at all corners that are not nullopt, in their order.
  void take(std::span<const FieldSample> samples);

  /// True if the face vertices do not lie in two different squares adjacent to the side's.
  bool areTogether() const { return are_together_; }
  /// True if face vertices lie in an adjacent square, beyond their part of it.
  bool leavesPart() const { return leaves_part_; }
  /// True if the surface passes through a square that is in the same face of the chunk.
  bool passes(Place place) const;
  /// The step from the side's own cell to the cell at another square, in cells.
  Int3 stepTo(Place place) const;
  /// The field at the corners of the cell below or above a square, numbered as in the case tables; nullopt if the cell
  /// reaches beyond the world, and has no surface.
  std::optional<std::array<int32_t, 8>> ofCell(bool above, Place place) const;

 private:
  bool exists(Place place) const;
  size_t numberOf(Place place, size_t bits, size_t level) const;
  bool isSolid(size_t corner) const { return q_[corner] < 0; }
  /// The bit of an axis in a corner's number.
  size_t bitOf(int axis) const { return axis == (side_.axis + 1) % 3 ? 1 : 2; }
  /// The axis along the edge between the side's square and the one beside it.
  int along() const { return 3 - side_.axis - across_; }

  const SharpSide& side_;
  int32_t cell_;
  int across_ = 0, by_ = 0;  ///< axis and step (1, -1) to the face vertices' square; step 0 if it is the own one
  bool are_together_ = true;
  bool leaves_part_ = false;
  std::array<int32_t, kCorners> q_{};
};

}  // namespace sgm
