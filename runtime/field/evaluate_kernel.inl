// The interpreter for every instruction set and device. Include this file in a namespace that defines
// shaders/common/common.h, kLanes, kEvalBlock, and loads and stores of Real and Int. If SGM_LISTS is defined,
// evaluate_lists.inl runs lists of primitives and keeps values in processor registers between them. Otherwise
// instructions run one by one, as on a GPU, whose register file holds the values anyway.

inline constexpr size_t kRow = 8;  ///< maximum number of points along x in a row of a block

/// The lattice of a block's points: full rows of points, `rows` rows per slice, and `slices` slices.
struct BlockLattice {
  Int3 origin;
  int32_t step;
  size_t rows, slices;
};

struct BlockFrame {
  uint32_t* registers;
  uint32_t* places;
  uint32_t* jacobians;
  const BlockLattice* lattice = nullptr;  ///< null if the points are not on a lattice
};

// The words of a register of a program: one plane of kEvalBlock words for its value; in gradient mode, four more planes
// for gradient and label.
template <bool kGradient>
inline constexpr size_t kRegisterWords = kEvalBlock * (kGradient ? 5 : 1);
inline constexpr size_t kFoldRegister = kMaxRegisters;
inline constexpr size_t kCutRegister = kMaxRegisters + 1;

template <bool kGradient>
FN Dual loadDual(const BlockFrame& f, size_t r, size_t i) {
  const uint32_t* p = f.registers + r * kRegisterWords<kGradient> + i;
  if constexpr (kGradient) {
    return makeDual(loadReal(p), loadReal(p + kEvalBlock), loadReal(p + 2 * kEvalBlock), loadReal(p + 3 * kEvalBlock),
                    loadInt(p + 4 * kEvalBlock));
  } else {
    const Real zero = broadcast(0.0f);
    return makeDual(loadReal(p), zero, zero, zero, broadcastInt(0));
  }
}

template <bool kGradient>
FN void storeDual(const BlockFrame& f, size_t r, size_t i, const Dual& d) {
  uint32_t* p = f.registers + r * kRegisterWords<kGradient> + i;
  storeReal(d.v, p);
  if constexpr (kGradient) {
    storeReal(d.x, p + kEvalBlock);
    storeReal(d.y, p + 2 * kEvalBlock);
    storeReal(d.z, p + 3 * kEvalBlock);
    storeInt(d.label, p + 4 * kEvalBlock);
  }
}

FN Int loadPlace(const BlockFrame& f, size_t place, size_t axis, size_t i) {
  return loadInt(f.places + (place * 3 + axis) * kEvalBlock + i);
}
FN Real loadJacobian(const BlockFrame& f, size_t place, size_t entry, size_t i) {
  return loadReal(f.jacobians + (place * 9 + entry) * kEvalBlock + i);
}

// Converts the gradient of a value that was evaluated at a warped place to the gradient with respect to the sample's
// own position, by the transposed Jacobian of the warp.
template <bool kGradient>
FN Dual toWorld(const BlockFrame& f, size_t place, size_t i, const Dual& d) {
  if constexpr (!kGradient) {
    return d;
  } else {
    if (place == 0) return d;
    Real g[3];
    for (size_t j = 0; j < 3; ++j) {
      Real a = d.x * loadJacobian(f, place, j, i);
      Real b = d.y * loadJacobian(f, place, 3 + j, i);
      Real c = d.z * loadJacobian(f, place, 6 + j, i);
      a = a + b;
      g[j] = holdReal(a + c);
    }
    return makeDual(d.v, g[0], g[1], g[2], d.label);
  }
}

template <bool kGradient>
FN void warpPlace(const BlockFrame& f, const Instr& in, size_t i) {
  const uint8_t source[3] = {in.a, in.b, in.c};
  for (size_t axis = 0; axis < 3; ++axis) {
    const Dual w = loadDual<kGradient>(f, source[axis], i);
    Real moved = clampReal(w.v, -1048576.0f, 1048576.0f) * 1024.0f;
    moved = moved + 0.5f;
    const Int at = wrapAdd(loadPlace(f, in.place, axis, i), toInt(floorReal(moved)));
    storeInt(at, f.places + (in.dst * size_t{3} + axis) * kEvalBlock + i);
    if constexpr (kGradient) {
      const Real slope[3] = {w.x, w.y, w.z};
      for (size_t j = 0; j < 3; ++j) {
        Real d = slope[j] * 1024.0f;
        d = loadJacobian(f, in.place, axis * 3 + j, i) + d;
        storeReal(holdReal(d), f.jacobians + (in.dst * size_t{9} + axis * 3 + j) * kEvalBlock + i);
      }
    }
  }
}

#define SGM_EACH for (size_t i = 0; i < n; i += kLanes)
#define SGM_FORM_CONSTANT(FUNCTION) SGM_EACH storeDual<kGradient>(f, in.dst, i, FUNCTION(P));
#define SGM_FORM_POSITION(FUNCTION)                                                                                  \
  SGM_EACH storeDual<kGradient>(                                                                                     \
      f, in.dst, i,                                                                                                  \
      toWorld<kGradient>(f, in.place, i,                                                                             \
                         FUNCTION(loadPlace(f, in.place, 0, i), loadPlace(f, in.place, 1, i),                        \
                                  loadPlace(f, in.place, 2, i), P)));
#define SGM_FORM_POSITION_1(FUNCTION)                                                                       \
  SGM_EACH {                                                                                                \
    const Int px = loadPlace(f, in.place, 0, i), py = loadPlace(f, in.place, 1, i);                         \
    const Int pz = loadPlace(f, in.place, 2, i);                                                            \
    const Dual t = loadDual<kGradient>(f, in.a, i);                                                         \
    const Dual by_place = toWorld<kGradient>(f, in.place, i, FUNCTION(px, py, pz, t, P));                   \
    storeDual<kGradient>(f, in.dst, i, addSlope(by_place, t, opPowerMorphSlope(px, py, pz, t, P)));         \
  }
#define SGM_FORM_UNARY(FUNCTION) \
  SGM_EACH storeDual<kGradient>(f, in.dst, i, FUNCTION(loadDual<kGradient>(f, in.a, i)));
#define SGM_FORM_UNARY_P(FUNCTION) \
  SGM_EACH storeDual<kGradient>(f, in.dst, i, FUNCTION(loadDual<kGradient>(f, in.a, i), P));
#define SGM_FORM_BINARY(FUNCTION)         \
  SGM_EACH storeDual<kGradient>(f, in.dst, i, \
                                FUNCTION(loadDual<kGradient>(f, in.a, i), loadDual<kGradient>(f, in.b, i)));
#define SGM_FORM_TERNARY(FUNCTION)                                                                                  \
  SGM_EACH storeDual<kGradient>(f, in.dst, i,                                                                       \
                                FUNCTION(loadDual<kGradient>(f, in.a, i), loadDual<kGradient>(f, in.b, i),          \
                                         loadDual<kGradient>(f, in.c, i)));
#define SGM_FORM_COPY(FUNCTION) SGM_EACH storeDual<kGradient>(f, in.dst, i, loadDual<kGradient>(f, in.a, i));
#define SGM_FORM_ROUND_BEGIN(FUNCTION)                    \
  SGM_EACH {                                              \
    storeDual<kGradient>(f, in.dst, i, farAway());   \
    storeDual<kGradient>(f, in.b, i, nothing());       \
  }
#define SGM_FORM_ROUND_ADD(FUNCTION)                                                                                \
  SGM_EACH {                                                                                                        \
    const Dual d = loadDual<kGradient>(f, in.a, i);                                                                 \
    storeDual<kGradient>(f, in.dst, i, opMinimum(loadDual<kGradient>(f, in.dst, i), d));                            \
    storeDual<kGradient>(f, in.b, i, roundAccumulate(loadDual<kGradient>(f, in.b, i), d, PF(P, 0)));                \
  }
#define SGM_FORM_ROUND_END(FUNCTION) \
  SGM_EACH storeDual<kGradient>(f, in.dst, i, \
                                opRoundEnd(loadDual<kGradient>(f, in.a, i), loadDual<kGradient>(f, in.b, i), P));
#define SGM_FORM_SUM_BEGIN(FUNCTION)                    \
  SGM_EACH {                                                          \
    if constexpr (kGradient) storeDual<kGradient>(f, in.dst, i, nothing()); \
    storeDual<kGradient>(f, in.b, i, nothing());                      \
  }
#define SGM_FORM_SUM_ADD(FUNCTION)                                                                      \
  SGM_EACH {                                                                                            \
    const Dual d = loadDual<kGradient>(f, in.a, i);                                                     \
    storeDual<kGradient>(f, in.dst, i, sumHeaviest(loadDual<kGradient>(f, in.dst, i), d));              \
    storeDual<kGradient>(f, in.b, i, opAdd(loadDual<kGradient>(f, in.b, i), d));                        \
  }
#define SGM_FORM_SUM_END(FUNCTION) \
  SGM_EACH storeDual<kGradient>(f, in.dst, i, \
                                opSumEnd(loadDual<kGradient>(f, in.a, i), loadDual<kGradient>(f, in.b, i), P));
#define SGM_FORM_WARP(FUNCTION) SGM_EACH warpPlace<kGradient>(f, in, i);

template <bool kGradient>
SGM_KERNEL void runInstr(const BlockFrame& f, const Instr& in, Params P, size_t n) {
  switch (in.op) {
#define SGM_OP(NAME, FUNCTION, FORM, ERROR) \
  case Op::NAME: {                          \
    SGM_FORM_##FORM(FUNCTION)               \
  } break;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
}

// Joins the value of one group to the field. A group that cuts sharply is joined instead to the union of such cuts,
// which is removed from the field at the end of the layer (program.h). A smooth cut is removed from the field at once.
template <bool kGradient>
SGM_KERNEL void foldGroup(const BlockFrame& f, const ProgramGroup& g, size_t n) {
  const bool smooth = g.smooth > 0;
  const size_t into = g.cut && !smooth ? kCutRegister : kFoldRegister;
  SGM_EACH {
    const Dual before = loadDual<kGradient>(f, into, i), own = loadDual<kGradient>(f, g.result, i);
    Dual after = before;
    if (!smooth) {
      after = opMinimum(before, own);
    } else if (g.cut) {
      after = roundCut(before, own, g.smooth);
    } else {
      after = roundUnion(before, own, g.smooth);
    }
    if (g.guarded) {
      const Int px = loadPlace(f, 0, 0, i), py = loadPlace(f, 0, 1, i), pz = loadPlace(f, 0, 2, i);
      const Bool inside = !(px < g.influence.lo.x) && !(py < g.influence.lo.y) && !(pz < g.influence.lo.z) &&
                          !(px > g.influence.hi.x) && !(py > g.influence.hi.y) && !(pz > g.influence.hi.z);
      after = selDual(inside, after, before);
    }
    storeDual<kGradient>(f, into, i, after);
  }
}

#ifdef SGM_LISTS
#include "field/evaluate_lists.inl"
#else
template <bool kGradient>
SGM_KERNEL bool runAlone(const ProgramView&, const BlockFrame&, const ProgramGroup&, size_t) {
  return false;
}
template <bool kGradient>
SGM_KERNEL void runInstrs(const ProgramView& program, const BlockFrame& f, const ProgramGroup& g, size_t n) {
  for (const Instr& in : program.instrs.subspan(g.first, g.count))
    runInstr<kGradient>(f, in, program.params.data() + in.params, n);
}
#endif

// Runs the program on a block of n points, where n is a multiple of kLanes. f.places contains the points' positions as
// place 0.
template <bool kGradient>
SGM_KERNEL void runBlock(const ProgramView& program, const BlockFrame& f, size_t n) {
  const Real zero = broadcast(0.0f);
  SGM_EACH storeDual<kGradient>(f, kFoldRegister, i,
                                makeDual(broadcast(program.initial), zero, zero, zero,
                                         broadcastInt(static_cast<int32_t>(program.initial_label))));
  if constexpr (kGradient) {
    for (size_t entry = 0; entry < 9; ++entry) {
      const Real e = broadcast(entry % 4 == 0 ? 1.0f : 0.0f);
      SGM_EACH storeReal(e, f.jacobians + entry * kEvalBlock + i);
    }
  }
  for (size_t k = 0; k < program.groups.size(); ++k) {
    const ProgramGroup& g = program.groups[k];
    const bool cuts = g.cut && g.smooth == 0;
    const bool first_cut = cuts && (k == 0 || !program.groups[k - 1].cut || program.groups[k - 1].layer != g.layer);
    if (first_cut) SGM_EACH storeDual<kGradient>(f, kCutRegister, i, farAway());
    if (!runAlone<kGradient>(program, f, g, n)) {
      runInstrs<kGradient>(program, f, g, n);
      foldGroup<kGradient>(f, g, n);
    }
    const bool last_cut = cuts && (k + 1 == program.groups.size() || program.groups[k + 1].layer != g.layer);
    if (last_cut) {
      SGM_EACH storeDual<kGradient>(
          f, kFoldRegister, i, opCut(loadDual<kGradient>(f, kFoldRegister, i), loadDual<kGradient>(f, kCutRegister, i)));
    }
  }
}

#undef SGM_EACH
#undef SGM_FORM_CONSTANT
#undef SGM_FORM_POSITION
#undef SGM_FORM_POSITION_1
#undef SGM_FORM_UNARY
#undef SGM_FORM_UNARY_P
#undef SGM_FORM_BINARY
#undef SGM_FORM_TERNARY
#undef SGM_FORM_COPY
#undef SGM_FORM_ROUND_BEGIN
#undef SGM_FORM_ROUND_ADD
#undef SGM_FORM_ROUND_END
#undef SGM_FORM_SUM_BEGIN
#undef SGM_FORM_SUM_ADD
#undef SGM_FORM_SUM_END
#undef SGM_FORM_WARP
