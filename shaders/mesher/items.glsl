// What is pruned, sampled and given attributes as a whole: the bricks of a chunk, 8^3 samples and one more on its high
// faces; and the plane of a seam, once in the chunk's own field and once in the coarser level's.

const uint kBricks = 64u;      // of a chunk, x fastest
const uint kBrickSamples = 8u;
const uint kItemWords = 8u;
const uint kItemList = 0u;     // where in scratch its list of records begins
const uint kItemCount = 1u;    // how many; 0 for a uniform brick
const uint kItemFlags = 2u;
const uint kItemInitial = 3u;  // the field below all that is left, as bits, and its label
const uint kItemLabel = 4u;
const uint kItemScale = 5u;    // Q by unit, as bits
const uint kItemOwner = 6u;    // of a brick the chunk's record, of a plane the seam's, as places in batch
const uint kItemParts = 7u;    // of a brick: which of its eight parts are solid throughout; from bit 8, empty
const uint kItemSolid = 1u;    // proven: all samples are solid,
const uint kItemEmpty = 2u;    // or none is

// Brick b of a chunk covers samples first..last on each axis.
uvec3 firstOfBrick(uint b) { return uvec3(b & 3u, b >> 2 & 3u, b >> 4) * kBrickSamples; }
uvec3 lastOfBrick(uint b) {
  uvec3 first = firstOfBrick(b);
  return first + kBrickSamples - uvec3(lessThan(first, uvec3(24u)));
}

// Its eight parts, x fastest: 4^3 samples, and one more on the chunk's high faces.
uvec3 firstOfPart(uint b, uint part) { return firstOfBrick(b) + 4u * uvec3(part & 1u, part >> 1 & 1u, part >> 2); }
uvec3 lastOfPart(uint b, uint part) {
  uvec3 first = firstOfPart(b, part);
  return first + 4u - uvec3(lessThan(first, uvec3(28u)));
}

// An entry of a list: the record's place, in units of 32 words, and what became of it.
const uint kKept = 0u;
const uint kFirstAlone = 1u;   // only its first operand is left: a copy; of a fold: the influence box need not be asked
const uint kSecondAlone = 2u;

#include "mesher/record_header.h"

// Of a fold's own flags (its seventh parameter): bit 0, into what is taken away; bit 1, the influence box decides; and
// instead of a group the end of its layer.
const uint kEndsLayer = 4u;

// A job of pruning: one program, and all boxes that it is asked about.
const uint kJobWords = 12u;
const uint kJobHeaders = 0u;  // place of the first header, in vectors
const uint kJobRecords = 1u;
const uint kJobKind = 2u;     // 0 the bricks of a chunk; 1 the planes of its seams; 2 those in the coarser level's field
const uint kJobChunk = 3u;    // number in the batch
const uint kJobFirstSeam = 4u;
const uint kJobSeams = 5u;
const uint kJobLists = 6u;    // where in scratch each box gets room for a list of all records
const uint kJobInitial = 7u;  // bits; the label, Q by unit
const uint kJobLabel = 8u;
const uint kJobScale = 9u;

// Software Vulkan ends all loops of an invocation when they have come to 65,535 rounds together (a guard of Mesa's
// against endless ones), so long work is cut: sampling into slices, each an entry of the list of what is sampled (the
// item's number, the slice, how many there are), attributes into units of so many vertices.
const uint kMostRounds = 60000u;
const uint kMostSlices = 16u;
// Of a sweep over so many records, at most: all kinds of op for each, and the octaves of noise.
uint roundsOf(uint records) { return 64u * records + 64u; }
uint sampledEntry(uint item, uint slice, uint slices) { return item | slice << 20 | slices << 26; }
uint itemOfEntry(uint entry) { return entry & 0xFFFFFu; }
uint sliceOfEntry(uint entry) { return entry >> 20 & 63u; }
uint slicesOfEntry(uint entry) { return entry >> 26; }

// A unit of attributes: the item's number, the first of its vertices (of a brick: its place in the list of vertices by
// brick; of a plane: which of those that the plane's field decides), and how many.
const uint kUnitWords = 4u;
uint verticesOfUnit(uint records, uint width) { return max(kMostRounds / roundsOf(records), 1u) * width; }

uint brickItem(uint chunk, uint brick) { return items_at + kItemWords * (chunk * kBricks + brick); }
// coarse: 0 or 1
uint planeItem(uint seam, uint coarse) { return items_at + kItemWords * (chunk_count * kBricks + 2u * seam + coarse); }
