#ifdef SGM_ROWS
#include "field/evaluate_noise.inl"
#endif

// Runs lists of primitives that are joined by one union or sum, and keeps values in processor registers between
// primitives. Such lists make up most of a typical program. The operations and their order are the same as for single
// instructions, so the results are bitwise equal. Included by evaluate_kernel.inl.

template <Op kOp>
FN Dual primitiveAt(Int px, Int py, Int pz, Params P) {
  if constexpr (kOp == Op::sphere) return opSphere(px, py, pz, P);
  if constexpr (kOp == Op::box) return opBox(px, py, pz, P);
  if constexpr (kOp == Op::capsule) return opCapsule(px, py, pz, P);
  if constexpr (kOp == Op::truncone) return opTruncone(px, py, pz, P);
  if constexpr (kOp == Op::blob) return opBlob(px, py, pz, P);
}

/// Counts the consecutive pairs of instructions at the beginning of `instrs`: a primitive, then an instruction that
/// combines the primitive with the same accumulator as `add`. All these primitives write the same register, so later
/// instructions can read only the result of the last one.
SGM_KERNEL size_t pairsOf(std::span<const Instr> instrs, Op primitive, const Instr& add) {
  size_t pairs = 0;
  for (; 2 * pairs + 1 < instrs.size(); ++pairs) {
    const Instr &p = instrs[2 * pairs], &a = instrs[2 * pairs + 1];
    if (p.op != primitive || p.place != 0 || p.dst != instrs[0].dst) break;
    if (a.op != add.op || a.a != p.dst || a.dst != add.dst || a.b != add.b) break;
  }
  return pairs;
}

/// Processes kTogether vectors of points, from point i on. Within a vector, each addition must wait for the previous
/// one. Meanwhile the additions of the other vectors run, so several vectors together take little more time than one.
template <bool kGradient, Op kPrimitive, Op kAdd, size_t kTogether>
FN void addPairsAt(const ProgramView& program, const BlockFrame& f, std::span<const Instr> instrs, size_t pairs,
                   size_t i) {
  const Instr& add = instrs[1];
  // In a sum, the first accumulator holds the operand with the largest weight. This operand only determines the label,
  // so the accumulator is needed only in gradient mode.
  constexpr bool kFirst = kGradient || kAdd != Op::sum_add;
  Int px[kTogether], py[kTogether], pz[kTogether];
  Dual first[kTogether], second[kTogether], d[kTogether];
  for (size_t v = 0; v < kTogether; ++v) {
    const size_t at = i + v * kLanes;
    px[v] = loadPlace(f, 0, 0, at);
    py[v] = loadPlace(f, 0, 1, at);
    pz[v] = loadPlace(f, 0, 2, at);
    second[v] = loadDual<kGradient>(f, add.b, at);
    first[v] = d[v] = nothing();
    if constexpr (kFirst) first[v] = loadDual<kGradient>(f, add.dst, at);
  }
  for (size_t pair = 0; pair < pairs; ++pair) {
    const Params own = program.params.data() + instrs[2 * pair].params;
    for (size_t v = 0; v < kTogether; ++v) {
      d[v] = primitiveAt<kPrimitive>(px[v], py[v], pz[v], own);
      if constexpr (kAdd == Op::sum_add) {
        if constexpr (kFirst) first[v] = sumHeaviest(first[v], d[v]);
        second[v] = opAdd(second[v], d[v]);
      } else {
        first[v] = opMinimum(first[v], d[v]);
        second[v] = roundAccumulate(second[v], d[v], PF((program.params.data() + instrs[2 * pair + 1].params), 0));
      }
    }
  }
  for (size_t v = 0; v < kTogether; ++v) {
    const size_t at = i + v * kLanes;
    if constexpr (kFirst) storeDual<kGradient>(f, add.dst, at, first[v]);
    storeDual<kGradient>(f, add.b, at, second[v]);
    storeDual<kGradient>(f, instrs[0].dst, at, d[v]);
  }
}

template <bool kGradient, Op kPrimitive, Op kAdd>
SGM_KERNEL size_t addPairs(const ProgramView& program, const BlockFrame& f, std::span<const Instr> instrs, size_t n) {
  const size_t pairs = pairsOf(instrs, kPrimitive, instrs[1]);
  size_t i = 0;
  // Gradient mode processes one vector of points at a time instead of several together, since even one vector uses many
  // processor registers there.
  if constexpr (!kGradient) {
    constexpr size_t kTogether = 2;
    for (; i + kTogether * kLanes <= n; i += kTogether * kLanes)
      addPairsAt<kGradient, kPrimitive, kAdd, kTogether>(program, f, instrs, pairs, i);
  }
  for (; i < n; i += kLanes) addPairsAt<kGradient, kPrimitive, kAdd, 1>(program, f, instrs, pairs, i);
  return 2 * pairs;
}

/// If `instrs` begins with a list (primitives that one union or sum joins), runs the list and returns its number of
/// instructions. Otherwise returns 0.
template <bool kGradient>
SGM_KERNEL size_t runList(const ProgramView& program, const BlockFrame& f, std::span<const Instr> instrs, size_t n) {
#ifdef SGM_ROWS
  if constexpr (!kGradient && kLanes >= 8) {
    if (instrs[0].op == Op::noise) return latticeNoise(f, instrs[0], program.params.data() + instrs[0].params, n);
  }
#endif
  if (instrs.size() < 2 || instrs[0].place != 0 || instrs[1].a != instrs[0].dst) return 0;
  if (instrs[1].op == Op::sum_add && instrs[0].op == Op::blob)
    return addPairs<kGradient, Op::blob, Op::sum_add>(program, f, instrs, n);
  if (instrs[1].op != Op::round_add) return 0;
  switch (instrs[0].op) {
    case Op::sphere:
      return addPairs<kGradient, Op::sphere, Op::round_add>(program, f, instrs, n);
    case Op::box:
      return addPairs<kGradient, Op::box, Op::round_add>(program, f, instrs, n);
    case Op::capsule:
      return addPairs<kGradient, Op::capsule, Op::round_add>(program, f, instrs, n);
    case Op::truncone:
      return addPairs<kGradient, Op::truncone, Op::round_add>(program, f, instrs, n);
    default:
      return 0;
  }
}

template <bool kGradient, Op kPrimitive>
SGM_KERNEL void foldPrimitive(const ProgramView& program, const BlockFrame& f, const ProgramGroup& g, size_t n) {
  const size_t into = g.cut ? kCutRegister : kFoldRegister;
  const Params params = program.params.data() + program.instrs[g.first].params;
  SGM_EACH {
    const Dual own =
        primitiveAt<kPrimitive>(loadPlace(f, 0, 0, i), loadPlace(f, 0, 1, i), loadPlace(f, 0, 2, i), params);
    storeDual<kGradient>(f, into, i, opMinimum(loadDual<kGradient>(f, into, i), own));
  }
}

/// Runs a group that consists of one primitive and whose samples need no test against its influence box
/// (ProgramGroup::guarded), and joins its value to the field. Returns false for all other groups.
template <bool kGradient>
SGM_KERNEL bool runAlone(const ProgramView& program, const BlockFrame& f, const ProgramGroup& g, size_t n) {
  if (g.count != 1 || g.guarded || g.smooth > 0 || program.instrs[g.first].place != 0) return false;
  switch (program.instrs[g.first].op) {
    case Op::sphere:
      foldPrimitive<kGradient, Op::sphere>(program, f, g, n);
      return true;
    case Op::box:
      foldPrimitive<kGradient, Op::box>(program, f, g, n);
      return true;
    case Op::capsule:
      foldPrimitive<kGradient, Op::capsule>(program, f, g, n);
      return true;
    case Op::truncone:
      foldPrimitive<kGradient, Op::truncone>(program, f, g, n);
      return true;
    default:
      return false;
  }
}

/// Constants that have not been written to memory yet, where a register has one value for each point of the block. Most
/// constants are operands of arithmetic, which uses them directly, so they are never written to memory.
struct HeldConstants {
  uint32_t held = 0;  ///< mask of the registers whose constants are held, one bit each
  float value[kMaxRegisters] = {};

  SGM_KERNEL bool has(size_t r) const { return held >> r & 1; }
  FN Dual of(size_t r) const {
    const Real zero = broadcast(0.0f);
    return makeDual(broadcast(value[r]), zero, zero, zero, broadcastInt(0));
  }
  SGM_KERNEL void hold(size_t r, Params P) {
    held |= 1u << r;
    value[r] = PF(P, 0);
  }
  SGM_KERNEL void forget(uint32_t registers) { held &= ~registers; }
  /// Writes held constants to the memory of their registers, for those registers that are needed. registers: mask of
  /// the registers that are needed.
  template <bool kGradient>
  SGM_KERNEL void settle(const BlockFrame& f, uint32_t registers, size_t n) {
    const uint32_t wanted = held & registers;
    if (wanted == 0) return;
    for (size_t r = 0; r < kMaxRegisters; ++r) {
      if (wanted >> r & 1) SGM_EACH storeDual<kGradient>(f, r, i, of(r));
    }
    held &= ~wanted;
  }
};

SGM_KERNEL uint32_t writtenMask(const Instr& in) {
  switch (in.op) {
    case Op::warp:
      return 0;
    case Op::round_begin:
    case Op::round_add:
    case Op::sum_begin:
    case Op::sum_add:
      return 1u << in.dst | 1u << in.b;
    default:
      return 1u << in.dst;
  }
}

/// Runs an operation that has exactly one constant operand; returns false for all other operations.
template <bool kGradient>
SGM_KERNEL bool runWithConstant(const BlockFrame& f, const Instr& in, const HeldConstants& constants, size_t n) {
#define SGM_WITH(NAME, FUNCTION)                                                                                  \
  case Op::NAME:                                                                                                  \
    if (constants.has(in.a)) {                                                                                    \
      const Dual a = constants.of(in.a);                                                                          \
      SGM_EACH storeDual<kGradient>(f, in.dst, i, FUNCTION(a, loadDual<kGradient>(f, in.b, i)));                  \
    } else {                                                                                                      \
      const Dual b = constants.of(in.b);                                                                          \
      SGM_EACH storeDual<kGradient>(f, in.dst, i, FUNCTION(loadDual<kGradient>(f, in.a, i), b));                  \
    }                                                                                                             \
    return true;
  if (constants.has(in.a) == constants.has(in.b)) return false;
  switch (in.op) {
    SGM_WITH(add, opAdd)
    SGM_WITH(subtract, opSubtract)
    SGM_WITH(multiply, opMultiply)
    SGM_WITH(minimum, opMinimum)
    SGM_WITH(maximum, opMaximum)
    default:
      return false;
  }
#undef SGM_WITH
}

/// Runs all instructions of one group of the program, for the n points of the block.
template <bool kGradient>
SGM_KERNEL void runInstrs(const ProgramView& program, const BlockFrame& f, const ProgramGroup& g, size_t n) {
  const std::span<const Instr> instrs = program.instrs.subspan(g.first, g.count);
  HeldConstants constants;
  for (size_t at = 0; at < instrs.size();) {
    const Instr& in = instrs[at];
    const Params P = program.params.data() + in.params;
    if (in.op == Op::constant) {
      constants.hold(in.dst, P);
      ++at;
      continue;
    }
    if (const size_t done = runList<kGradient>(program, f, instrs.subspan(at), n); done > 0) {
      // The list has overwritten the register that its first instruction writes, so a constant held for this register
      // is obsolete. The accumulators of a list contain no constants.
      constants.forget(1u << in.dst);
      at += done;
      continue;
    }
    if (!runWithConstant<kGradient>(f, in, constants, n)) {
      constants.settle<kGradient>(f, operandMask(in), n);
      runInstr<kGradient>(f, in, P, n);
    }
    constants.forget(writtenMask(in));
    ++at;
  }
  constants.settle<kGradient>(f, 1u << g.result, n);
}
