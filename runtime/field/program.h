#pragma once
// A field program: immutable straight-line code per group, and the fold that combines the values of the groups.
//
// At a point p the field f starts as `initial` (the domain: far inside or far outside). Only groups whose influence box
// contains p take part. In each layer, the groups that add come first: f = min(f, g) for the value g of each. Then the
// union of the groups that cut is removed: f = max(f, -min g). A smooth group is a layer of its own and blends with the
// existing field: by the round union of f and g, or, for a cut, by the negated round union of -f and g (roundUnion in
// shaders/common/combine.h). The influence boxes are part of the field's definition, so the value at p does not depend
// on the chunk that evaluates it. Everything is in units (1/1024 m). Programs can be shared between threads; evaluators
// have their own scratch.

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/fixed.h"

namespace sgm {

enum class Op : uint8_t {
#define SGM_OP(name, function, form, error) name,
#include "field/ops.def"
#undef SGM_OP
  count
};

const char* opName(Op op);

inline constexpr int kMaxRegisters = 32;  ///< per group
/// registers for positions: place 0 is the sample's position, the others are results of warps
inline constexpr int kMaxPlaces = 8;
/// The field's value, in units, if the domain is empty and no group has added a shape. It is larger than every other
/// value, so that a cut by an empty group removes nothing.
inline constexpr float kFar = 1.0e30f;

/// One operation. Usually, its operands are in the registers a, b and c, and it writes its result to the register dst.
/// Exceptions: an accumulator consists of the two registers dst and b; round_begin and sum_begin initialise both, and
/// round_add and sum_add update both with the operand in register a. A warp writes the warped position to the position
/// register dst. place: the position register that the op reads, if it is a warp or has the form POSITION or POSITION_1
/// (field/ops.def).
struct Instr {
  Op op = Op::constant;
  uint8_t dst = 0, a = 0, b = 0, c = 0, place = 0;
  uint16_t reserved = 0;
  uint32_t params = 0;  ///< index of the op's first parameter word
};
static_assert(sizeof(Instr) == 12);

struct ProgramGroup {
  IntBox influence;
  uint32_t first = 0, count = 0;  ///< range of indices of the group's instructions in ProgramView::instrs
  uint32_t layer = 0;             ///< all groups of a layer are consecutive: first those that add, then those that cut
  uint8_t result = 0;             ///< the register that holds the group's value
  bool cut = false;
  /// true: evaluators must test whether a sample lies in the influence box; false: all samples of this program are
  /// known to lie in it
  bool guarded = true;
  float smooth = 0;  ///< width of the blend in units, set only if the layer has no other group; 0: no blend
};

/// A program as the evaluators read it. Does not own the arrays.
struct ProgramView {
  std::span<const Instr> instrs;
  std::span<const uint32_t> params;
  std::span<const ProgramGroup> groups;
  float initial = kFar;
  uint32_t initial_label = 0;  ///< tag << 16 | material
  float q_scale = 1;           ///< converts units to quantised samples: 1024 / finest cell edge in units
};

struct FieldProgram {
  std::pmr::vector<Instr> instrs;
  std::pmr::vector<uint32_t> params;
  std::pmr::vector<ProgramGroup> groups;
  float initial = kFar;
  uint32_t initial_label = 0;
  float q_scale = 1;

  explicit FieldProgram(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : instrs(memory), params(memory), groups(memory) {}
  /// Copies a program; the copy's arrays are allocated from `memory`.
  FieldProgram(const FieldProgram& other, std::pmr::memory_resource* memory)
      : instrs(other.instrs, memory),
        params(other.params, memory),
        groups(other.groups, memory),
        initial(other.initial),
        initial_label(other.initial_label),
        q_scale(other.q_scale) {}

  ProgramView view() const { return {instrs, params, groups, initial, initial_label, q_scale}; }
};

inline constexpr uint32_t makeLabel(uint16_t material, uint16_t tag) { return uint32_t{tag} << 16 | material; }

/// Returns the scale for a finest cell of this many units. A field value f, in units, is quantised to floor(f * scale +
/// 0.5).
inline float quantiseScale(int32_t finest_cell_units) {
  return static_cast<float>(1024.0 / static_cast<double>(finest_cell_units));
}

}  // namespace sgm
