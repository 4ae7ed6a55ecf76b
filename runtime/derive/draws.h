#pragma once
// The list of named numbers that are hashed with keys, to separate the keys and draws of derivation. Changing a number
// changes all worlds.

#include <cstdint>

namespace sgm {

/// Salts of keys that are hashed with a cell's position.
enum LatticeSalt : uint64_t { kCellSalt = 1, kFaceSalt, kTreeSalt, kBlockSalt, kNoiseSalt };

/// Salts of keys under a derivation path or a cell's key.
enum PathSalt : uint64_t {
  kCombinerSalt = 0x6E6F6465,  ///< plus the statement's kind: apart from the keys of leaves and rules
  kLoopSalt = 0x6C6F6F70,      ///< plus the statement's ordinal
  kSetSalt = 0x73657473,       ///< plus the hash of the rule's name, for a set of the whole layer
  kAnchorSalt = 0x616E6368,
  kBendSalt = 0x62656E64,
  kBranchSalt = 0x6272616E,    ///< a skeleton, with the ordinal of its expression
  kForkSalt = 0x666F726B,      ///< a side branch, with the step at which it starts
  kSegmentSalt = 0x7365676D,   ///< a segment, with its step
  kJointSalt = 0x6A6F696E,     ///< the joint behind a segment, with its step
  kCorridorSalt = 0x636F7272,  ///< a stretch of a treemap's corridor, with its number
  kFacadeSalt = 0x66616361,    ///< an outer wall of a room, with its number
  kWaveSalt = 0x77617665,      ///< the choice of all tiles of a wfc, with its ordinal
};

/// Ordinals of the draws of one key.
enum Draw : uint64_t {
  kPriorityDraw = 8,
  kJitterDraw = 0x100,  ///< plus the axis
  kOpenDraw = 0x200,
  kEdgeDraw = 0x300,    ///< plus 8 times one corner plus the other
  kChoiceDraw = 0x400,  ///< plus 8 times the axis plus the corner
  kKeyedDraw = 0x500,
  kWeightDraw = 0x700,
  kTurnDraw = 0x800,  ///< of a joint, and so are the next four
  kAroundDraw,
  kForkDraw,
  kLeaveDraw,
  kSideDraw,
  kOutlineDraw = 0x900,  ///< of a piece of a plan, and so is the next
  kAlongDraw,
  kPathDraw = 0x10000,  ///< plus the expression's ordinal
};

}  // namespace sgm
