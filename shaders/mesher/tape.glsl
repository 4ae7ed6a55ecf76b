// How a shader stores a field program (backend/vulkan/tape.h): records are in a private array (the window), and the
// current record is in registers. The words of a record are spread over the lanes of a subgroup: each lane stores four
// of 32 words, and gets the words of other lanes by subgroup shuffles. This is fast on software Vulkan. There, reading
// a buffer is a loop over the lanes, which takes hundreds of cycles, for one word as for four; reading an array with a
// variable index is eight loads; and a shuffle is one instruction. On hardware, all of these operations are fast.
//
// Requires that all lanes of a subgroup are active, as in all control flow here, and that subgroups have at least 8
// lanes.

// number of slots for values; the last slot is constant and contains a value farther away than any other
const uint kSlots = 65u;
const uint kFarSlot = 64u;
const uint kWindow = 128u;  // number of pieces of records in the window; a piece has 32 words
// pieces of records, 32 words each; in each group of 8 lanes, lane l (0..7) stores the words 4 l to 4 l + 3
uvec4 window[kWindow];
uvec4 record;               // this lane's four words of the current record
// the words of `record` if that record has the kind of the current loop (sweep.glsl), otherwise zeroes
uvec4 own;
uint record_at;             // index of the current record in the window
uint record_number;         // number of the current record in the list

uint wordOfRecord(uint i) {
  uint k = i & 3u;
  return subgroupShuffle(k == 0u ? own.x : k == 1u ? own.y : k == 2u ? own.z : own.w, i >> 2);
}

// Returns parameter word i of the current record, for an i that is not a compile-time constant. The first 28 parameter
// words are the words 2 to 29 of the record; the others are its words from 32 on.
uint farWord(uint i) {
  uint k = i < 28u ? i + 2u : i + 4u;
  uvec4 piece = window[record_at + (k >> 5)];
  uint c = k & 3u;
  return subgroupShuffle(c == 0u ? piece.x : c == 1u ? piece.y : c == 2u ? piece.z : piece.w, (k >> 2) & 7u);
}

// Masks of the kinds of op that occur. Code for other kinds is not compiled, because software Vulkan would run it at
// least once per sweep.
layout(constant_id = 1) const uint kKindsLow = 0xFFFFFFFFu;
layout(constant_id = 2) const uint kKindsHigh = 0xFFFFFFFFu;
#define OCCURS(NUMBER) ((((NUMBER) < 32u ? kKindsLow >> ((NUMBER) & 31u) : kKindsHigh >> ((NUMBER) & 31u)) & 1u) != 0u)
#define kHasThird ((kKindsHigh & kSomeReadsThird) != 0u)
#define HOW(P, BIT) ((PU(P, kHowWord) & (BIT)) != 0u)

#define PU(P, i) wordOfRecord(uint(i) + 2u)
#define QU(P, i) wordOfRecord(uint(i) + 2u)
#define RU(P, i) farWord(uint(i))
#define gatherReal(P, i) uintBitsToFloat(batch[wordOfRecord(12u) + uint(i)])
