// Arrays of points through the interpreter, in blocks; included where evaluate_kernel.inl would be.

#include "field/evaluate_kernel.inl"

#define SGM_EACH for (size_t i = 0; i < n; i += kLanes)

template <bool kGradient>
inline BlockFrame makeFrame(EvalScratch& scratch) {
  constexpr size_t registers = (kMaxRegisters + 2) * kRegisterWords<kGradient>;
  constexpr size_t places = size_t{kMaxPlaces} * 3 * kEvalBlock;
  constexpr size_t jacobians = kGradient ? size_t{kMaxPlaces} * 9 * kEvalBlock : 0;
  uint32_t* words = scratch.reserve(registers + places + jacobians + 16);
  // Whole vectors must not straddle cache lines: the block starts at the next multiple of 64 bytes.
  words += (16 - (reinterpret_cast<uintptr_t>(words) / sizeof(uint32_t)) % 16) % 16;
  return {words, words + registers, words + registers + places};
}

// Copies a block's points to place 0, the last one repeated up to whole vectors.
inline size_t loadPoints(const BlockFrame& f, const Points& points, size_t first, size_t count) {
  const size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  const int32_t* axes[3] = {points.x + first, points.y + first, points.z + first};
  for (size_t axis = 0; axis < 3; ++axis) {
    uint32_t* out = f.places + axis * kEvalBlock;
    memcpy(out, axes[axis], count * sizeof(uint32_t));
    for (size_t i = count; i < padded; ++i) out[i] = out[count - 1];
  }
  return padded;
}

inline void evaluateSamples(const ProgramView& program, const Points& points, EvalScratch& scratch, int32_t* q) {
  const BlockFrame f = makeFrame<false>(scratch);
  for (size_t first = 0; first < points.count; first += kEvalBlock) {
    const size_t count = points.count - first < kEvalBlock ? points.count - first : kEvalBlock;
    const size_t n = loadPoints(f, points, first, count);
    runBlock<false>(program, f, n);
    uint32_t* out = f.registers;
    SGM_EACH storeInt(quantise(loadDual<false>(f, kFoldRegister, i).v, program.q_scale), out + i);
    memcpy(q + first, out, count * sizeof(int32_t));
  }
}

inline void evaluateAttributes(const ProgramView& program, const Points& points, EvalScratch& scratch,
                               const Attributes& out) {
  const BlockFrame f = makeFrame<true>(scratch);
  for (size_t first = 0; first < points.count; first += kEvalBlock) {
    const size_t count = points.count - first < kEvalBlock ? points.count - first : kEvalBlock;
    const size_t n = loadPoints(f, points, first, count);
    runBlock<true>(program, f, n);
    SGM_EACH {
      const Dual d = loadDual<true>(f, kFoldRegister, i);
      storeDual<true>(f, kFoldRegister, i,
                      makeDual(unsignedZero(d.v), unsignedZero(d.x), unsignedZero(d.y), unsignedZero(d.z), d.label));
    }
    const uint32_t* fold = f.registers + kFoldRegister * kRegisterWords<true>;
    if (out.value) memcpy(out.value + first, fold, count * sizeof(float));
    if (out.gradient_x) memcpy(out.gradient_x + first, fold + kEvalBlock, count * sizeof(float));
    if (out.gradient_y) memcpy(out.gradient_y + first, fold + 2 * kEvalBlock, count * sizeof(float));
    if (out.gradient_z) memcpy(out.gradient_z + first, fold + 3 * kEvalBlock, count * sizeof(float));
    if (out.label) memcpy(out.label + first, fold + 4 * kEvalBlock, count * sizeof(uint32_t));
    if (out.normal_x && out.normal_y) {
      uint32_t* packed = f.registers;
      SGM_EACH {
        const Dual d = loadDual<true>(f, kFoldRegister, i);
        const PackedNormal p = packNormal(d.x, d.y, d.z);
        storeInt(p.x, packed + i);
        storeInt(p.y, packed + kEvalBlock + i);
      }
      for (size_t i = 0; i < count; ++i) {
        out.normal_x[first + i] = static_cast<int16_t>(static_cast<int32_t>(packed[i]));
        out.normal_y[first + i] = static_cast<int16_t>(static_cast<int32_t>(packed[kEvalBlock + i]));
      }
    }
  }
}

#undef SGM_EACH
