#pragma once
// A field program in the order and form in which the mesher's shaders run it (shaders/mesher/tape.glsl).
//
// A shader sweeps over all kinds of op and takes, of each kind, as many instructions in a row as there are: software
// Vulkan executes both sides of every branch, so that a switch would cost it all ops for each instruction, and hardware
// likes long runs of one op as well. Hence the order: within a block as many instructions as possible of one kind stand
// together, those first that others read; ops that only join values count as one kind first, and are then sorted among
// themselves. Values live in slots, each written once and read any number of times before its slot is used again. The
// folds of groups (field/program.h) are instructions too, and keep their order. A union of primitives is no instruction
// of its own: each takes the minimum of itself and its operand, which is far for the first. Nor is what a mix or a
// morph goes by where that is constant, nor the weight that a sum adds (tape_fuse.h).

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kTapeSlots = 64;
inline constexpr uint32_t kFarSlot =
    kTapeSlots;  ///< never written: farther than anything; stands where an instruction has no operand
inline constexpr uint32_t kTapeRecordWords = 32;
inline constexpr uint32_t kMostTapeRecords = 1024;
inline constexpr uint32_t kMostTapeLayers = 64;

/// Instructions that are no Op: numbers from Op::count on.
enum class TapeOp : uint32_t {
  fold = static_cast<uint32_t>(
      Op::count),  ///< a group into the field, or into what its layer takes away; or that out of it
  smooth,          ///< a smooth group into the field
  count
};

/// Where a program lies in a batch's words.
struct Tape {
  uint32_t headers = 0;  ///< place in units of four words: one header a record
  uint32_t records = 0;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;
  uint64_t kinds = 0;  ///< bit by instruction: which of them occur; and those at its end (record_header.h)
};

/// Reused from program to program.
struct TapeScratch {
  struct Node {
    uint32_t kind = 0, place = 0, params = 0, group = 0, layer = 0, order = 0, stage = 0, step = 0;
    bool ends_layer = false;   ///< a fold, not of a group: what the layer takes away goes out of the field
    bool layer_cuts = false;   ///< of a layer's end: something is taken away
    bool gone = false;         ///< part of those that read it
    bool by_constant = false;  ///< of a mix or a morph: `by` takes the place of c
    bool morphs = false;       ///< of a sum: it adds the morph of a and c by `by`, or,
    bool weighs = false;       ///< after that, the kernel with these params
    float by = 0;
    int32_t dst = -1, second = -1, a = -1, b = -1, c = -1;  ///< values; -1: none

    bool is(Op op) const { return kind == static_cast<uint32_t>(op); }
  };
  struct Value {
    uint32_t stage = 0, rank = 0, kind = 0, step = 0, last = 0;
    uint32_t uses = 0;   ///< by all that make or read it
    int32_t maker = -1;  ///< number of the node that makes all of it; -1: several make it
    int32_t slot = -1, renamed = -1;
    bool in_block = false;
  };
  explicit TapeScratch(std::pmr::memory_resource* memory) : nodes(memory), values(memory) {}
  /// f(number) of each value that n makes or reads.
  template <class F>
  static void forEachValue(const Node& n, F&& f) {
    for (const int32_t v : {n.a, n.b, n.c, n.dst, n.second}) {
      if (v >= 0) f(static_cast<size_t>(v));
    }
  }
  std::pmr::vector<Node> nodes;
  std::pmr::vector<Value> values;
};

/// Appends the program's records and headers to words. false, and words as before, where a shader's bounds do not hold
/// it: more records, layers, octaves, words of one record, or values at one time than there may be. Throws
/// std::bad_alloc.
bool appendTape(const ProgramView& program, TapeScratch& scratch, std::pmr::vector<uint32_t>& words, Tape& tape);

}  // namespace sgm
