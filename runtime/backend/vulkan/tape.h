#pragma once
// A field program in the order and form in which the mesher's shaders run it (shaders/mesher/tape.glsl).
//
// A shader sweeps repeatedly over all kinds of ops, and in each step of a sweep runs all consecutive instructions of
// one kind. A loop with a switch would be slower: software Vulkan executes both sides of every branch, so that each
// instruction would cost as much as all ops together, and hardware also prefers long runs of one op.
//
// Hence the order of instructions: within a block, as many instructions of one kind as possible stand together, and
// instructions whose results others read come first. Ops that only join values are sorted as if they were one kind, and
// then by kind among themselves.
//
// Values are stored in slots; a slot is written once and read any number of times before it is reused. The folds of
// groups (field/program.h) are instructions, too, and keep their order.
//
// Some operations are merged into other instructions (tape_fuse.h). In a union of primitives, the operand of each
// primitive is the union of the primitives before it (for the first primitive: kFarSlot); the primitive takes the
// minimum of its own value and this operand. A mix or morph includes its parameter, if the parameter is constant. A sum
// includes the weight that it adds.

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kTapeSlots = 64;
/// number of the slot that holds a constant, a distance greater than any other value. No instruction writes this slot;
/// it stands for a missing operand.
inline constexpr uint32_t kFarSlot = kTapeSlots;
inline constexpr uint32_t kTapeRecordWords = 32;
inline constexpr uint32_t kMaxTapeRecords = 1024;
inline constexpr uint32_t kMaxTapeLayers = 64;

/// The instructions that are not an Op; their numbers start at Op::count. They combine groups, layers and cuts
/// (field/program.h).
enum class TapeOp : uint32_t {
  /// adds a group to the field, or to the cuts of its layer; at the end of a layer, subtracts these cuts from the field
  fold = static_cast<uint32_t>(Op::count),
  smooth,  ///< blends a smooth group with the field
  count
};

/// The place of a tape in a batch's words.
struct Tape {
  uint32_t headers = 0;  ///< offset of the headers in the batch's words, in units of four words; one header per record
  uint32_t records = 0;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;
  uint64_t kinds = 0;  ///< one bit per kind of instruction in the tape; flags in the highest bits (record_header.h)
};

/// Working memory for building tapes, reused for further programs.
struct TapeScratch {
  struct Node {
    uint32_t kind = 0, place = 0, params = 0, group = 0, layer = 0, order = 0, stage = 0, step = 0;
    bool ends_layer = false;   ///< for a fold without a group: true if it subtracts the layer's cuts from the field
    bool layer_cuts = false;   ///< if ends_layer: true if the layer has cuts
    bool gone = false;         ///< true if the node was merged into the nodes that read it
    bool by_constant = false;  ///< for a mix or morph: its parameter is the constant `by`, not operand c
    bool morphs = false;       ///< for a sum: it adds the morph of a and c with the parameter `by`
    bool weighs = false;       ///< for a sum: the node also applies the kernel with these params to the added distance
    float by = 0;
    /// indices of the values that the node makes (dst, second) and reads (a, b, c); -1: none
    int32_t dst = -1, second = -1, a = -1, b = -1, c = -1;

    bool is(Op op) const { return kind == static_cast<uint32_t>(op); }
  };
  struct Value {
    uint32_t stage = 0, rank = 0, kind = 0, step = 0, last = 0;
    uint32_t uses = 0;   ///< number of times that nodes make or read the value
    int32_t maker = -1;  ///< index of the only node that makes the value; -1: several nodes make it
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

/// Appends the program's records and headers to `words`. Returns false, with `words` unchanged, if a limit of the
/// shaders is exceeded: records, layers, octaves, words of a record, or values that are needed at the same time. Throws
/// std::bad_alloc.
bool appendTape(const ProgramView& program, TapeScratch& scratch, std::pmr::vector<uint32_t>& words, Tape& tape);

}  // namespace sgm
