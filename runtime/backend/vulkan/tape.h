#pragma once
// A field program in the order and form in which the mesher's shaders run it (shaders/mesher/tape.glsl).
//
// A shader sweeps over all kinds of op, and runs all consecutive instructions of each kind: software Vulkan executes
// both sides of every branch, so a switch would cost it all ops for each instruction, and hardware also prefers long
// runs of one op. Hence the order: within a block, as many instructions of one kind as possible stand together, first
// those whose results others read; ops that only join values first count as one kind, and are then sorted among
// themselves. Values live in slots; each is written once and read any number of times before its slot is reused. The
// folds of groups (field/program.h) are instructions, too, and keep their order. Some operations are part of other
// instructions (tape_fuse.h): a union of primitives, where each takes the minimum of itself and its operand (the first
// one's operand is far); the parameter of a mix or morph if it is constant; and the weight that a sum adds.
// morph goes by where that is constant, nor the weight that a sum adds (tape_fuse.h).

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kTapeSlots = 64;
inline constexpr uint32_t kFarSlot = kTapeSlots;  ///< never written, farther than anything: replaces a missing operand
inline constexpr uint32_t kTapeRecordWords = 32;
inline constexpr uint32_t kMostTapeRecords = 1024;
inline constexpr uint32_t kMostTapeLayers = 64;

/// Instructions that are not an Op: numbers from Op::count on.
enum class TapeOp : uint32_t {
  fold = static_cast<uint32_t>(
      Op::count),  ///< joins a group to the field or to its layer's cuts; or subtracts these from the field
  smooth,          ///< joins a smooth group to the field
  count
};

/// The location of a program in a batch's words.
struct Tape {
  uint32_t headers = 0;  ///< offset in units of four words: one header a record
  uint32_t records = 0;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;
  uint64_t kinds = 0;  ///< bit by instruction: the kinds that occur; flags at the end (record_header.h)
};

/// Reused from program to program.
struct TapeScratch {
  struct Node {
    uint32_t kind = 0, place = 0, params = 0, group = 0, layer = 0, order = 0, stage = 0, step = 0;
    bool ends_layer = false;   ///< a fold, not of a group: subtracts the layer's cuts from the field
    bool layer_cuts = false;   ///< for a layer's end: there are cuts
    bool gone = false;         ///< merged into the nodes that read it
    bool by_constant = false;  ///< for a mix or a morph: `by` replaces c
    bool morphs = false;       ///< for a sum: it adds the morph of a and c by `by`, or,
    bool weighs = false;       ///< after that, the kernel with these params
    float by = 0;
    int32_t dst = -1, second = -1, a = -1, b = -1, c = -1;  ///< indices of values; -1: none

    bool is(Op op) const { return kind == static_cast<uint32_t>(op); }
  };
  struct Value {
    uint32_t stage = 0, rank = 0, kind = 0, step = 0, last = 0;
    uint32_t uses = 0;   ///< by all nodes that make or read it
    int32_t maker = -1;  ///< index of the node that makes all of it; -1: several make it
    int32_t slot = -1, renamed = -1;
    bool in_block = false;
  };
  explicit TapeScratch(std::pmr::memory_resource* memory) : nodes(memory), values(memory) {}
  /// Calls f(index) for each value that n makes or reads.
  template <class F>
  static void forEachValue(const Node& n, F&& f) {
    for (const int32_t v : {n.a, n.b, n.c, n.dst, n.second}) {
      if (v >= 0) f(static_cast<size_t>(v));
    }
  }
  std::pmr::vector<Node> nodes;
  std::pmr::vector<Value> values;
};

/// Appends the program's records and headers to words. Returns false, with words unchanged, if a shader's limits are
/// exceeded: records, layers, octaves, words of a record, or simultaneous values. Throws std::bad_alloc.
bool appendTape(const ProgramView& program, TapeScratch& scratch, std::pmr::vector<uint32_t>& words, Tape& tape);

}  // namespace sgm
