#pragma once
// Which fans a surface cannot have, by exact tests in integers: the verdicts of mesh/features.h.

#include "mesh/features.h"

namespace sgm {

/// Rounds fans in `loops`, which are in the order of the patch. Throws std::bad_alloc.
class FanConflicts {
 public:
  /// Borrows all.
  FanConflicts(const SurfacePatch& patch, std::span<const SharpSide> sides, std::span<SharpLoop> loops,
               std::pmr::memory_resource* memory);

  /// Whether all triangles of a loop's fan, with all of its face vertices, have an area, and meet each other only where
  /// they are joined.
  bool isSound(const SharpLoop& loop) const;
  /// Rounds those of the listed loops, numbers of the patch, whose fan would be invalid in any state of the loops
  /// around it: each of these a fan or rounded.
  void roundInAnyState(std::span<const uint32_t> numbers);
  /// Gives those of the listed loops whose fan is invalid beside what the others are a spare place for the cell vertex,
  /// or rounds them, until none is.
  void roundUntilValid(std::span<const uint32_t> numbers);

 private:
  const SurfacePatch& patch_;
  std::span<const SharpSide> sides_;
  std::span<SharpLoop> loops_;
  std::pmr::memory_resource* memory_;
};

}  // namespace sgm
