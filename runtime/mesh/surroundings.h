#pragma once
// The grid squares around a loop side in a face of the chunk, and the cells on both sides of these squares.
//
// A side is a segment of a surface loop on a cell's face. A face vertex (mesh/sharp_loops.h) may lie beyond the square
// of its side, in an adjacent square. So one square may contain face vertices of the sides in all four squares around
// it. Each square is therefore divided into four PARTS, one per edge: the part of an edge consists of the points that
// are nearer to this edge than to the others. Face vertices do not interfere if each of them stays in the part of the
// edge that borders its side's own square.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "mesh/creases.h"
#include "mesh/sharp_loops.h"

namespace sgm {

/// True if the square that is `by` squares away from the square of a loop side, along an axis of the face, lies in the
/// same face of the same chunk. cell: cell edge in units.
bool isInFace(const SharpSide& side, int axis, int by, int32_t cell);

class Surroundings {
 public:
  /// Squares of the face. own: the square of the loop side. beside: the adjacent square that contains the face
  /// vertices, if they are not in `own`. low, high, opposite: the other squares that share an edge with `beside`.
  enum class Place : uint8_t { own, beside, low, high, opposite };
  static constexpr std::array<Place, 3> kAround{Place::low, Place::high, Place::opposite};
  static constexpr size_t kCorners = 36;

  /// Borrows the loop side, which must have at least one position (SharpSide::places).
  Surroundings(const SharpSide& side, int32_t cell);

  /// Returns the position of a corner of the cells below and above these squares, in units; nullopt if the corner lies
  /// beyond the world, or is not needed. number: 0..kCorners - 1.
  std::optional<Int3> corner(size_t number) const;
  /// Receives the field's samples at all corners that are not nullopt, in ascending order of their numbers.
  void take(std::span<const FieldSample> samples);

  /// False if the loop side has two face vertices in two different squares adjacent to its own; true otherwise.
  bool areTogether() const { return are_together_; }
  /// True if a face vertex in an adjacent square lies outside its part of that square (see the top of the file).
  bool leavesPart() const { return leaves_part_; }
  /// True if the square lies in the same face of the chunk as the loop side, and the surface passes through the square.
  bool passes(Place place) const;
  /// Returns the step from the loop side's own cell to the cell at another square, in cells.
  Int3 stepTo(Place place) const;
  /// Returns the field at the corners of the cell below or above a square, numbered as in the case tables
  /// (mesh/tables.h); nullopt if the cell reaches beyond the world, where there is no surface.
  std::optional<std::array<int32_t, 8>> ofCell(bool above, Place place) const;

 private:
  bool exists(Place place) const;
  size_t numberOf(Place place, size_t bits, size_t level) const;
  bool isSolid(size_t corner) const { return q_[corner] < 0; }
  /// In the number of a corner of the side's own square, one bit tells the corner's position along each axis of the
  /// face. Returns that bit for an axis.
  size_t bitOf(int axis) const { return axis == (side_.axis + 1) % 3 ? 1 : 2; }
  /// The axis along the edge between the side's own square and the adjacent square.
  int along() const { return 3 - side_.axis - across_; }

  const SharpSide& side_;
  int32_t cell_;
  /// The direction from the side's own square to the square that contains its face vertices. across_: axis of the
  /// direction; by_: 1 or -1 along this axis, 0 if both squares are the same.
  int across_ = 0, by_ = 0;
  bool are_together_ = true;
  bool leaves_part_ = false;
  std::array<int32_t, kCorners> q_{};
};

}  // namespace sgm
