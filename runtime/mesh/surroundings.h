#pragma once
// The squares around a side in a face of the chunk, and the cells on both sides of these squares.
//
// A face vertex may lie beyond the square of its side, in the adjacent square. Each of the four sides of a square that
// the surface passes through may have a face vertex in that square. A PART of the adjacent square consists of the
// points that are nearer to the edge shared with the side's own square than to its other edges: face vertices that stay
// within their own parts do not interfere.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// True if the square that is `by` squares away from the side's square, along an axis of the face, lies in the same
/// face of the same chunk. cell: cell edge in units.
bool isInFace(const SharpSide& side, int axis, int by, int32_t cell);

class Surroundings {
 public:
  /// Squares of the face: `own` is the side's; `beside` the adjacent one, if it has the face vertices; `low`, `high`
  /// and `opposite` are around the latter.
  enum class Place : uint8_t { own, beside, low, high, opposite };
  static constexpr std::array<Place, 3> kAround{Place::low, Place::high, Place::opposite};
  static constexpr size_t kCorners = 36;

  /// Borrows the side, which must have at least one position (SharpSide::places).
  Surroundings(const SharpSide& side, int32_t cell);

  /// Returns a corner of the cells at these squares, in units; nullopt if it lies beyond the world, or is not needed.
  std::optional<Int3> corner(size_t number) const;
  /// Receives the field's samples at all corners that are not nullopt, in ascending order of their numbers.
  void take(std::span<const FieldSample> samples);

  /// False if the side has two face vertices in two different squares adjacent to its own; true otherwise.
  bool areTogether() const { return are_together_; }
  /// True if a face vertex in an adjacent square lies outside its part of that square (see the top of the file).
  bool leavesPart() const { return leaves_part_; }
  /// True if that square lies in the same face of the chunk, and the surface passes through it.
  bool passes(Place place) const;
  /// Returns the step from the side's own cell to the cell at another square, in cells.
  Int3 stepTo(Place place) const;
  /// Returns the field at the corners of the cell below or above a square, numbered as in the case tables
  /// (mesh/tables.h); nullopt if the cell reaches beyond the world, where there is no surface.
  std::optional<std::array<int32_t, 8>> ofCell(bool above, Place place) const;

 private:
  bool exists(Place place) const;
  size_t numberOf(Place place, size_t bits, size_t level) const;
  bool isSolid(size_t corner) const { return q_[corner] < 0; }
  /// The bit of an axis in a corner's number.
  size_t bitOf(int axis) const { return axis == (side_.axis + 1) % 3 ? 1 : 2; }
  /// The axis along the edge between the side's own square and the adjacent square.
  int along() const { return 3 - side_.axis - across_; }

  const SharpSide& side_;
  int32_t cell_;
  /// axis and step (1, -1) from the side's own square to that of the face vertices; step 0 if it is the own square
  int across_ = 0, by_ = 0;
  bool are_together_ = true;
  bool leaves_part_ = false;
  std::array<int32_t, kCorners> q_{};
};

}  // namespace sgm
