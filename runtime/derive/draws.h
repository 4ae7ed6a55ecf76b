#pragma once
// Salts: constants that are hashed with keys, so that different keys and random draws of derivation are independent.
// Changing a constant changes all worlds.

#include <cstdint>

namespace sgm {

/// Salts for keys that are hashed with the position of a lattice cell.
enum LatticeSalt : uint64_t { kCellSalt = 1, kFaceSalt, kTreeSalt, kBlockSalt, kNoiseSalt };

/// Salts for keys that are derived from a derivation path or a cell's key.
enum PathSalt : uint64_t {
  /// key of a combiner; the salt is added to the statement's kind, so that the key differs from keys of leaves and
  /// rules
  kCombinerSalt = 0x6E6F6465,
  kLoopSalt = 0x6C6F6F70,  ///< keys of the copies of a loop; added to the statement's ordinal
  /// key of a point set; if the set spans the whole layer, the salt is added to the hash of the rule or override
  kSetSalt = 0x73657473,
  kAnchorSalt = 0x616E6368,
  kBendSalt = 0x62656E64,
  kBranchSalt = 0x6272616E,    ///< key of a skeleton; hashed with the ordinal of its expression
  kForkSalt = 0x666F726B,      ///< key of a skeleton's side branch; hashed with the step at which the branch starts
  kSegmentSalt = 0x7365676D,   ///< key of a segment of a skeleton; hashed with the segment's step in its branch
  kJointSalt = 0x6A6F696E,     ///< key of the joint behind a skeleton's segment; hashed with the segment's step
  kCorridorSalt = 0x636F7272,  ///< key of one rectangle of a treemap's corridor; hashed with the rectangle's index
  kFacadeSalt = 0x66616361,    ///< key of an outer wall of a room; hashed with the wall's number
  kWaveSalt = 0x77617665,      ///< key of the tiles of a wfc; added to the statement's ordinal
};

/// Numbers of draws: random draws with the same key but different numbers are independent.
enum Draw : uint64_t {
  kPriorityDraw = 8,
  kJitterDraw = 0x100,  ///< jitter of a point; added to the axis (0 to 2)
  kOpenDraw = 0x200,
  kEdgeDraw = 0x300,    ///< weight of an octree edge; added to 8 * axis + corner
  kChoiceDraw = 0x400,  ///< choice of an open face; added to 8 * axis + corner, or to the axis alone
  kKeyedDraw = 0x500,
  kWeightDraw = 0x700,
  kTurnDraw = 0x800,  ///< kTurnDraw to kSideDraw: draws for a joint of a skeleton
  kAroundDraw,
  kForkDraw,
  kLeaveDraw,
  kSideDraw,
  kOutlineDraw = 0x900,  ///< kOutlineDraw and kAlongDraw: draws for a piece of a building's ground plan
  kAlongDraw,
  kPathDraw = 0x10000,  ///< draw of an expression such as rand(); added to the expression's ordinal
};

}  // namespace sgm
