// Items are boxes of samples that are pruned, sampled and given attributes as a whole. An item is either a brick or a
// plane. A brick contains 8^3 samples of a chunk, and one more layer of samples on the chunk's high faces. A plane
// contains the samples of a seam; there is one plane for the chunk's own field and one for the coarser level's field.

const uint kBricks = 64u;      // number of bricks in a chunk, x fastest
const uint kBrickSamples = 8u;
const uint kItemWords = 8u;
const uint kItemList = 0u;     // offset in `scratch` of the list of records that the item's pruned program consists of
const uint kItemCount = 1u;    // number of records in this list; 0 for a uniform brick
const uint kItemFlags = 2u;
const uint kItemInitial = 3u;  // value of the field before the first record of the list, as float bits; the next word
                               // is the value's label
const uint kItemLabel = 4u;
const uint kItemScale = 5u;    // factor from units to quantised values Q, as float bits
const uint kItemOwner = 6u;    // offset in `batch` of the chunk's record (for a brick) or of the seam's record (for a
                               // plane)
// for a brick: mask of its eight parts that are completely solid; from bit 8 on, of those completely void
const uint kItemParts = 7u;
const uint kItemSolid = 1u;    // it is proven that all samples are solid
const uint kItemEmpty = 2u;    // it is proven that no sample is solid

// Brick b of a chunk contains the samples from firstOfBrick(b) to lastOfBrick(b) on each axis.
uvec3 firstOfBrick(uint b) { return uvec3(b & 3u, b >> 2 & 3u, b >> 4) * kBrickSamples; }
uvec3 lastOfBrick(uint b) {
  uvec3 first = firstOfBrick(b);
  return first + kBrickSamples - uvec3(lessThan(first, uvec3(24u)));
}

// A brick has eight parts, x fastest: 4^3 samples each, and one more layer on the chunk's high faces.
uvec3 firstOfPart(uint b, uint part) { return firstOfBrick(b) + 4u * uvec3(part & 1u, part >> 1 & 1u, part >> 2); }
uvec3 lastOfPart(uint b, uint part) {
  uvec3 first = firstOfPart(b, part);
  return first + 4u - uvec3(lessThan(first, uvec3(28u)));
}

// An entry in a list of records: the record's offset, in units of 32 words, and one of the following values, which says
// how pruning has changed the record.
const uint kKept = 0u;
// only the first operand is left, so the record is a copy; for a fold (a record that joins a group of shapes to its
// layer): the influence box need not be tested
const uint kFirstAlone = 1u;
const uint kSecondAlone = 2u;

#include "mesher/record_header.h"

// Flags of a fold, the record that joins a group of shapes to its layer. They are in its seventh parameter word. Bit 0:
// the group is cut out of the layer; bit 1: the group's influence box must be tested; kEndsLayer: the record is not a
// group, but the end of a layer.
const uint kEndsLayer = 4u;

// A pruning job: one program, and all boxes for which it is pruned.
const uint kJobWords = 12u;
const uint kJobHeaders = 0u;  // offset in `batch` of the first record header, in vectors of four words
const uint kJobRecords = 1u;
// kind of boxes: 0: bricks of a chunk; 1: planes of its seams; 2: these planes in the coarser level's field
const uint kJobKind = 2u;
const uint kJobChunk = 3u;    // index of the chunk in the batch
const uint kJobFirstSeam = 4u;
const uint kJobSeams = 5u;
const uint kJobLists = 6u;    // offset in `scratch` of the lists of records that stay: one per box, with space for all
                              // records
const uint kJobInitial = 7u;  // initial value of the field, as float bits; the next two words: its label, and the
                              // factor from units to Q
const uint kJobLabel = 8u;
const uint kJobScale = 9u;

// Long work is divided, because software Vulkan ends all loops of an invocation after 65,535 rounds in total (Mesa's
// guard against endless loops). Sampling is divided into slices: each is an entry in the list of sampled items (number
// of the item, of the slice, and of slices). Attributes are divided into units with a limited number of vertices.
const uint kMaxRounds = 60000u;
const uint kMaxSlices = 16u;
// Returns an upper bound of the number of loop rounds in a sweep over this number of records, for all kinds of op and
// all octaves of noise.
uint roundsOf(uint records) { return 64u * records + 64u; }
uint sampledEntry(uint item, uint slice, uint slices) { return item | slice << 20 | slices << 26; }
uint itemOfEntry(uint entry) { return entry & 0xFFFFFu; }
uint sliceOfEntry(uint entry) { return entry >> 20 & 63u; }
uint slicesOfEntry(uint entry) { return entry >> 26; }

// A unit of work of the pass that computes attributes: a range of the vertices of one item. It contains the number of
// the item, the first vertex, and the number of vertices. For a brick, the first vertex is an index into the list of
// vertices by brick; for a plane, an index among the vertices that are evaluated with the plane's field.
const uint kUnitWords = 4u;
uint verticesOfUnit(uint records, uint width) { return max(kMaxRounds / roundsOf(records), 1u) * width; }

uint brickItem(uint chunk, uint brick) { return items_at + kItemWords * (chunk * kBricks + brick); }
// coarse: 0 or 1
uint planeItem(uint seam, uint coarse) { return items_at + kItemWords * (chunk_count * kBricks + 2u * seam + coarse); }
