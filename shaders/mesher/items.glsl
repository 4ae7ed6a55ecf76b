// Items are boxes that are pruned, sampled and given attributes as a whole: the bricks of a chunk, 8^3 samples each and
// one more on its high faces; and the plane of a seam, once in the chunk's own field and once in the coarser level's.

const uint kBricks = 64u;      // bricks in a chunk, x fastest
const uint kBrickSamples = 8u;
const uint kItemWords = 8u;
const uint kItemList = 0u;     // offset in scratch of its list of records
const uint kItemCount = 1u;    // length of the list; 0 for a uniform brick
const uint kItemFlags = 2u;
const uint kItemInitial = 3u;  // the field without all removed records, as float bits, and its label
const uint kItemLabel = 4u;
const uint kItemScale = 5u;    // Q per unit, as float bits
const uint kItemOwner = 6u;    // offset in `batch`: brick: its chunk's record; plane: its seam's record
// brick: mask of its eight parts that are solid throughout; from bit 8 on, of those that are void
const uint kItemParts = 7u;
const uint kItemSolid = 1u;    // proven: all samples are solid
const uint kItemEmpty = 2u;    // proven: no sample is solid

// Brick b of a chunk contains samples first..last on each axis.
uvec3 firstOfBrick(uint b) { return uvec3(b & 3u, b >> 2 & 3u, b >> 4) * kBrickSamples; }
uvec3 lastOfBrick(uint b) {
  uvec3 first = firstOfBrick(b);
  return first + kBrickSamples - uvec3(lessThan(first, uvec3(24u)));
}

// The eight parts of a brick, x fastest: 4^3 samples each, and one more on the chunk's high faces.
uvec3 firstOfPart(uint b, uint part) { return firstOfBrick(b) + 4u * uvec3(part & 1u, part >> 1 & 1u, part >> 2); }
uvec3 lastOfPart(uint b, uint part) {
  uvec3 first = firstOfPart(b, part);
  return first + 4u - uvec3(lessThan(first, uvec3(28u)));
}

// An entry of a list: the record's offset, in units of 32 words, and how pruning changed it.
const uint kKept = 0u;
// only its first operand is left, so it is a copy; for a fold: the influence box need not be tested
const uint kFirstAlone = 1u;
const uint kSecondAlone = 2u;

#include "mesher/record_header.h"

// Flags of a fold (in its seventh parameter word). Bit 0: it joins the cuts; bit 1: its influence box must be tested;
// kEndsLayer: it is not a group, but the end of its layer.
const uint kEndsLayer = 4u;

// A job of pruning: one program, and all boxes to which it is pruned.
const uint kJobWords = 12u;
const uint kJobHeaders = 0u;  // offset of the first header, in vectors
const uint kJobRecords = 1u;
// 0: the bricks of a chunk; 1: the planes of its seams; 2: these planes in the coarser level's field
const uint kJobKind = 2u;
const uint kJobChunk = 3u;    // index in the batch
const uint kJobFirstSeam = 4u;
const uint kJobSeams = 5u;
const uint kJobLists = 6u;    // offset in scratch of the lists of records that stay: one per box, with space for all records
const uint kJobInitial = 7u;  // float bits; the label and Q per unit follow
const uint kJobLabel = 8u;
const uint kJobScale = 9u;

// Software Vulkan ends all loops of an invocation after 65,535 rounds in total (Mesa's guard against endless loops), so
// long work is divided: sampling into slices, each an entry of the list of sampled items (number of the item, the
// slice, number of slices), and attributes into units of limited numbers of vertices.
const uint kMaxRounds = 60000u;
const uint kMaxSlices = 16u;
// Returns an upper bound of the rounds of a sweep over this number of records: all kinds of op for each, and the
// octaves of noise.
uint roundsOf(uint records) { return 64u * records + 64u; }
uint sampledEntry(uint item, uint slice, uint slices) { return item | slice << 20 | slices << 26; }
uint itemOfEntry(uint entry) { return entry & 0xFFFFFu; }
uint sliceOfEntry(uint entry) { return entry >> 20 & 63u; }
uint slicesOfEntry(uint entry) { return entry >> 26; }

// A unit of attributes: the number of its item, its first vertex, and its number of vertices. The first vertex is an
// index: for a brick, into the list of vertices by brick; for a plane, among the vertices that are evaluated with the
// plane's field.
const uint kUnitWords = 4u;
uint verticesOfUnit(uint records, uint width) { return max(kMaxRounds / roundsOf(records), 1u) * width; }

uint brickItem(uint chunk, uint brick) { return items_at + kItemWords * (chunk * kBricks + brick); }
// coarse: 0 or 1
uint planeItem(uint seam, uint coarse) { return items_at + kItemWords * (chunk_count * kBricks + 2u * seam + coarse); }
