#include "backend/vulkan/tape_ops.h"

#include <array>

#include "backend/vulkan/tape.h"

namespace sgm {

namespace {

constexpr uint32_t kKinds = static_cast<uint32_t>(TapeOp::count);

constexpr std::array<uint32_t, kKinds> makeRanks() {
  std::array<uint32_t, kKinds> ranks{};
#include "sweep_ranks.inl"
  for (uint32_t kind = static_cast<uint32_t>(Op::count); kind < kKinds; ++kind) ranks[kind] = kind;
  return ranks;
}

}  // namespace

uint32_t sweepRank(uint32_t kind) {
  static constexpr std::array<uint32_t, kKinds> kRanks = makeRanks();
  return kRanks[kind];
}

OpShape shapeOf(Op op) {
  switch (op) {
#define SGM_FORM_CONSTANT \
  OpShape { 0, false, 1 }
#define SGM_FORM_POSITION \
  OpShape { 0, true, 0 }
#define SGM_FORM_POSITION_1 \
  OpShape { 1, true, 0 }
#define SGM_FORM_UNARY \
  OpShape { 1, false, 0 }
#define SGM_FORM_UNARY_P \
  OpShape { 1, false, 2 }
#define SGM_FORM_BINARY \
  OpShape { 2, false, 0 }
#define SGM_FORM_TERNARY \
  OpShape { 3, false, 0 }
#define SGM_FORM_COPY \
  OpShape { 1, false, 0 }
#define SGM_FORM_ROUND_BEGIN \
  OpShape { 0, false, 0 }
#define SGM_FORM_ROUND_ADD \
  OpShape { 1, false, 1 }
#define SGM_FORM_ROUND_END \
  OpShape { 2, false, 1 }
#define SGM_FORM_SUM_BEGIN \
  OpShape { 0, false, 0 }
#define SGM_FORM_SUM_ADD \
  OpShape { 1, false, 0 }
#define SGM_FORM_SUM_END \
  OpShape { 2, false, 2 }
#define SGM_FORM_WARP \
  OpShape { 3, false, 0 }
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return SGM_FORM_##form;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return {};
}

uint32_t parameterWords(Op op, const uint32_t* p) {
  switch (op) {
    case Op::noise:
      return 6 + 2 * p[3];
    case Op::sweep:
      return 1 + 9 * p[0];
    case Op::prism:
      return 15 + 6 * p[14];
    case Op::lattice:
      return 10;  // number of words without the samples: writeLattice() appends these separately
    default:
      return shapeOf(op).position ? 21 : shapeOf(op).words;
  }
}

}  // namespace sgm
