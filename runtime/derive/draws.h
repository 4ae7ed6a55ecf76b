#pragma once
// The constants that are hashed with keys, so that different keys and random draws of derivation are independent.
// Changing a constant changes all worlds.

#include <cstdint>

namespace sgm {

/// Salts for keys that are hashed with the position of a lattice cell.
enum LatticeSalt : uint64_t { kCellSalt = 1, kFaceSalt, kTreeSalt, kBlockSalt, kNoiseSalt };

/// Salts for keys below a derivation path or a cell's key.
enum PathSalt : uint64_t {
  /// plus the statement's kind: separates the keys of combiners from those of leaves and rules
  kCombinerSalt = 0x6E6F6465,
  kLoopSalt = 0x6C6F6F70,  ///< plus the statement's ordinal: one copy of a loop
  kSetSalt = 0x73657473,   ///< plus the hash of the rule's name: a point set that spans the whole layer
  kAnchorSalt = 0x616E6368,
  kBendSalt = 0x62656E64,
  kBranchSalt = 0x6272616E,    ///< a skeleton; hashed with the ordinal of its expression
  kForkSalt = 0x666F726B,      ///< a side branch; hashed with the step at which it starts
  kSegmentSalt = 0x7365676D,   ///< a segment; hashed with its step
  kJointSalt = 0x6A6F696E,     ///< the joint behind a segment; hashed with its step
  kCorridorSalt = 0x636F7272,  ///< a stretch of a treemap's corridor; hashed with its number
  kFacadeSalt = 0x66616361,    ///< an outer wall of a room; hashed with its number
  kWaveSalt = 0x77617665,      ///< the tiles of a wfc; hashed with the statement's ordinal
};

/// Ordinals of the different draws from one key.
enum Draw : uint64_t {
  kPriorityDraw = 8,
  kJitterDraw = 0x100,  ///< plus the axis 0..2
  kOpenDraw = 0x200,
  kEdgeDraw = 0x300,    ///< plus 8 times one corner, plus the other corner
  kChoiceDraw = 0x400,  ///< plus 8 times the axis plus the corner
  kKeyedDraw = 0x500,
  kWeightDraw = 0x700,
  kTurnDraw = 0x800,  ///< kTurnDraw to kSideDraw: of a joint of a skeleton
  kAroundDraw,
  kForkDraw,
  kLeaveDraw,
  kSideDraw,
  kOutlineDraw = 0x900,  ///< kOutlineDraw and kAlongDraw: of a piece of a plan
  kAlongDraw,
  kPathDraw = 0x10000,  ///< plus the expression's ordinal
};

}  // namespace sgm
