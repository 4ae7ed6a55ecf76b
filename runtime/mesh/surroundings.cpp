#include "mesh/surroundings.h"

#include <algorithm>

namespace sgm {
namespace {

// The numbers of the corners of five grid squares in a face of the chunk (Surroundings::Place): the square of the loop
// side ("own"), one adjacent square, and the three other squares that share an edge with the adjacent square. Each
// corner exists on three levels: c = 0 below the face, 1 in it, 2 above it. The own square has four corners per level,
// and each other square adds two:
// - own square: a + 2b + 4c; a counts along u = (axis + 1) % 3, and b along v = (axis + 2) % 3
// - adjacent square: kFar + a + 2c; a counts along the edge that it shares with the own square
// - squares at the low and the high end of that edge: kLow + a + 2c and kHigh + a + 2c; a counts away from the own
//   square
// - opposite square: kOpposite + a + 2c; a counts along the same edge
constexpr size_t kFar = 12, kLow = 18, kHigh = 24, kOpposite = 30;

}  // namespace

bool isInFace(const SharpSide& side, int axis, int by, int32_t cell) {
  const int64_t square = floorDiv(side.corner[axis], cell);
  return floorDiv(square, kChunkCells) == floorDiv(square + by, kChunkCells);
}

Surroundings::Surroundings(const SharpSide& side, int32_t cell) : side_(side), cell_(cell) {
  for (const Int3& place : side.places.all()) {
    for (const int k : {(side.axis + 1) % 3, (side.axis + 2) % 3}) {
      const int32_t height = std::max(-place[k], place[k] - kSubcell), at = place[3 - side.axis - k];
      if (height <= 0) continue;
      const int by = place[k] < 0 ? -1 : 1;
      if (by_ != 0 && (across_ != k || by_ != by)) are_together_ = false;
      across_ = k;
      by_ = by;
      if (height >= std::min(at, kSubcell - at) || 2 * height >= kSubcell) leaves_part_ = true;
    }
  }
}

bool Surroundings::exists(Place place) const {
  if (place == Place::own) return true;
  if (by_ == 0) return false;
  if (place == Place::beside) return true;
  if (place == Place::opposite) return isInFace(side_, across_, 2 * by_, cell_);
  return isInFace(side_, along(), place == Place::low ? -1 : 1, cell_);
}

std::optional<Int3> Surroundings::corner(size_t number) const {
  Int3 steps;
  const auto level = [&](size_t first) { return static_cast<int32_t>((number - first) >> 1) - 1; };
  const auto a = static_cast<int32_t>(number & 1);
  if (number < kFar) {
    steps[(side_.axis + 1) % 3] = a;
    steps[(side_.axis + 2) % 3] = static_cast<int32_t>(number >> 1 & 1);
    steps[side_.axis] = static_cast<int32_t>(number >> 2) - 1;
  } else {
    const Place place = number < kLow        ? Place::beside
                        : number < kHigh     ? Place::low
                        : number < kOpposite ? Place::high
                                             : Place::opposite;
    if (!exists(place) || (place != Place::beside && !leaves_part_)) return std::nullopt;
    if (place == Place::low || place == Place::high) {
      steps[across_] = by_ < 0 ? -a : 1 + a;
      steps[along()] = place == Place::low ? -1 : 2;
      steps[side_.axis] = level(place == Place::low ? kLow : kHigh);
    } else {
      const int32_t beyond = place == Place::beside ? 1 : 2;
      steps[across_] = by_ < 0 ? -beyond : 1 + beyond;
      steps[along()] = a;
      steps[side_.axis] = level(place == Place::beside ? kFar : kOpposite);
    }
  }
  Int3 at = side_.corner;
  for (int k = 0; k < 3; ++k) {
    const int64_t moved = at[k] + int64_t{steps[k]} * cell_;
    if (moved != saturate(moved)) return std::nullopt;
    at[k] = static_cast<int32_t>(moved);
  }
  return at;
}

void Surroundings::take(std::span<const FieldSample> samples) {
  size_t next = 0;
  for (size_t i = 0; i < kCorners; ++i)
    if (corner(i)) q_[i] = samples[next++].q;
}

/// Returns the number (see the top of the file) of a corner of the cells below or above a square. bits: the corner's
/// position in the square, a + 2b. level: c.
size_t Surroundings::numberOf(Place place, size_t bits, size_t level) const {
  if (place == Place::own) return bits + 4 * level;
  const size_t across = bitOf(across_), along_bit = 3 - across;
  const bool is_far = ((bits & across) != 0) == (by_ > 0), is_second = (bits & along_bit) != 0;
  switch (place) {
    case Place::low:
    case Place::high:
      if (is_second != (place == Place::high)) return numberOf(Place::beside, bits ^ along_bit, level);
      return (place == Place::low ? kLow : kHigh) + (is_far ? 1 : 0) + 2 * level;
    case Place::opposite:
      if (!is_far) return numberOf(Place::beside, bits ^ across, level);
      return kOpposite + (is_second ? 1 : 0) + 2 * level;
    default:
      return is_far ? kFar + (is_second ? 1 : 0) + 2 * level : (bits ^ across) + 4 * level;
  }
}

bool Surroundings::passes(Place place) const {
  if (!exists(place)) return false;
  for (size_t bits = 0; bits < 4; ++bits)
    if (!corner(numberOf(place, bits, 1))) return false;
  const bool first = isSolid(numberOf(place, 0, 1));
  return isSolid(numberOf(place, 1, 1)) != first || isSolid(numberOf(place, 2, 1)) != first ||
         isSolid(numberOf(place, 3, 1)) != first;
}

Int3 Surroundings::stepTo(Place place) const {
  Int3 steps;
  if (place != Place::own) steps[across_] = place == Place::opposite ? 2 * by_ : by_;
  if (place == Place::low) steps[along()] = -1;
  if (place == Place::high) steps[along()] = 1;
  return steps;
}

std::optional<std::array<int32_t, 8>> Surroundings::ofCell(bool above, Place place) const {
  std::array<int32_t, 8> q{};
  for (size_t i = 0; i < 8; ++i) {
    const size_t number = numberOf(place, i & 3, (i >> 2) + (above ? 1 : 0));
    if (!corner(number)) return std::nullopt;
    q[(i & 1) << (side_.axis + 1) % 3 | (i >> 1 & 1) << (side_.axis + 2) % 3 | i >> 2 << side_.axis] = q_[number];
  }
  return q;
}

}  // namespace sgm
