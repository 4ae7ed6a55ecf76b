// How a shader holds a program (backend/vulkan/tape.h): records in a private window, the current one in registers, its
// words handed around by shuffles. What it costs on software Vulkan decides this: a read of a buffer there is a loop
// over the lanes, hundreds of cycles for one word as for four; an array that is indexed at run time is eight loads; and
// a shuffle is one instruction. Hardware has no quarrel with any of it.
//
// Needs: every lane of a subgroup active, which all of a workgroup's control flow here grants; subgroups of 8 or more.

const uint kSlots = 65u;    // of values; the last is never written: farther than anything
const uint kFarSlot = 64u;
const uint kWindow = 128u;  // records in sight
uvec4 window[kWindow];      // lane l of 8 holds words 4 l to 4 l + 3
uvec4 record;               // the current one
uvec4 own;                  // what an op reads of it (sweep.glsl)
uint record_at;             // its place in the window
uint record_number;         // how many came before it

uint wordOfRecord(uint i) {
  uint k = i & 3u;
  return subgroupShuffle(k == 0u ? own.x : k == 1u ? own.y : k == 2u ? own.z : own.w, i >> 2);
}

// A parameter whose number is no constant: in the first 28, or in what follows the first 32 words.
uint farWord(uint i) {
  uint k = i < 28u ? i + 2u : i + 4u;
  uvec4 piece = window[record_at + (k >> 5)];
  uint c = k & 3u;
  return subgroupShuffle(c == 0u ? piece.x : c == 1u ? piece.y : c == 2u ? piece.z : piece.w, (k >> 2) & 7u);
}

// Only kinds of op that occur are compiled in on software Vulkan: it would run each of them at least once a sweep.
layout(constant_id = 1) const uint kKindsLow = 0xFFFFFFFFu;
layout(constant_id = 2) const uint kKindsHigh = 0xFFFFFFFFu;
#define OCCURS(NUMBER) ((((NUMBER) < 32u ? kKindsLow >> ((NUMBER) & 31u) : kKindsHigh >> ((NUMBER) & 31u)) & 1u) != 0u)
#define kHasThird ((kKindsHigh & kSomeReadsThird) != 0u)
#define HOW(P, BIT) ((PU(P, kHowWord) & (BIT)) != 0u)

#define PU(P, i) wordOfRecord(uint(i) + 2u)
#define QU(P, i) wordOfRecord(uint(i) + 2u)
#define RU(P, i) farWord(uint(i))
#define gatherReal(P, i) uintBitsToFloat(batch[wordOfRecord(12u) + uint(i)])
