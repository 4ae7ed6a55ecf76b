// Runs arrays of points through the interpreter in blocks. Include this file instead of evaluate_kernel.inl, which it
// includes. The including file also defines signMask(p, count), whose bit i is the sign of p[i]; this function may read
// p up to the end of its last vector.

#ifndef SGM_ONE_BY_ONE  // tests define it to run one instruction after another, without lists of primitives
#define SGM_LISTS
#include "field/operands.inl"
#endif
#include "field/evaluate_kernel.inl"
#undef SGM_LISTS

#define SGM_EACH for (size_t i = 0; i < n; i += kLanes)

template <bool kGradient>
inline BlockFrame makeFrame(EvalScratch& scratch) {
  constexpr size_t registers = (kMaxRegisters + 2) * kRegisterWords<kGradient>;
  constexpr size_t places = size_t{kMaxPlaces} * 3 * kEvalBlock;
  constexpr size_t jacobians = kGradient ? size_t{kMaxPlaces} * 9 * kEvalBlock : 0;
  uint32_t* words = scratch.reserve(registers + places + jacobians + 16);
  // Whole vectors must not cross cache lines, so the block starts at the next multiple of 64 bytes.
  words += (16 - (reinterpret_cast<uintptr_t>(words) / sizeof(uint32_t)) % 16) % 16;
  return {words, words + registers, words + registers + places};
}

// Copies the positions of a block's points to place 0, which holds the positions before any warp. Repeats the last
// point to fill whole vectors.
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

/// Writes the x and y coordinates of points to place 0 (the positions before any warp), slice by slice, for `padded`
/// points.
inline void loadSlices(const BlockFrame& f, const LatticeBox& box, size_t padded) {
  uint32_t *x = f.places, *y = f.places + kEvalBlock, row[kEvalBlock];
  const size_t width = box.size[0];
  for (size_t i = 0; i < width; ++i) row[i] = static_cast<uint32_t>(box.origin.x + static_cast<int32_t>(i) * box.step);
  size_t at = 0;
  for (size_t j = 0; at + width <= padded; j = j + 1 == box.size[1] ? 0 : j + 1, at += width) {
    const auto height = static_cast<uint32_t>(box.origin.y + static_cast<int32_t>(j) * box.step);
    if (width == kRow) {  // most blocks have this width, and a copy of constant size is faster
      memcpy(x + at, row, kRow * sizeof(uint32_t));
      for (size_t i = 0; i < kRow; ++i) y[at + i] = height;
    } else {
      memcpy(x + at, row, width * sizeof(uint32_t));
      for (size_t i = 0; i < width; ++i) y[at + i] = height;
    }
  }
  for (; at < padded; ++at) {
    x[at] = row[0];
    y[at] = y[0];
  }
}

inline void evaluateBox(const ProgramView& program, const LatticeBox& box, EvalScratch& scratch,
                        const LatticeSamples& out) {
  if (box.size[0] > kRow) {  // a wide box is divided into columns that are as wide as a row
    LatticeBox first = box, rest = box;
    first.size[0] = kRow;
    rest.size[0] -= kRow;
    rest.origin.x = static_cast<int32_t>(static_cast<uint32_t>(box.origin.x) +
                                         static_cast<uint32_t>(box.step) * static_cast<uint32_t>(kRow));
    LatticeSamples beside = out;
    beside.q += kRow;
    beside.first_bit += kRow;
    evaluateBox(program, first, scratch, out);
    evaluateBox(program, rest, scratch, beside);
    return;
  }
  BlockFrame f = makeFrame<false>(scratch);
  const size_t width = box.size[0], slice = width * box.size[1], most = kEvalBlock / slice;
  size_t loaded = 0;
  for (size_t first = 0; first < box.size[2]; first += most) {
    const size_t slices = box.size[2] - first < most ? box.size[2] - first : most;
    const size_t count = slices * slice, n = (count + kLanes - 1) / kLanes * kLanes;
    if (loaded < n) loadSlices(f, box, n);
    loaded = loaded < n ? n : loaded;
    uint32_t* z = f.places + 2 * kEvalBlock;
    for (size_t k = 0; k < slices; ++k) {
      const auto at = static_cast<uint32_t>(box.origin.z + static_cast<int32_t>(first + k) * box.step);
      const size_t end = k + 1 == slices ? n : (k + 1) * slice;
      for (size_t i = k * slice; i < end; ++i) z[i] = at;
    }
    const BlockLattice lattice{{box.origin.x, box.origin.y, static_cast<int32_t>(z[0])}, box.step, box.size[1], slices};
    f.lattice = width == kRow ? &lattice : nullptr;
    runBlock<false>(program, f, n);
    uint32_t* q = f.registers;
    SGM_EACH storeInt(quantise(loadDual<false>(f, kFoldRegister, i).v, program.q_scale), q + i);
    for (size_t k = first; k < first + slices; ++k) {
      for (size_t j = 0; j < box.size[1]; ++j, q += width) {
        int32_t* to = out.q + j * out.row + k * out.plane;
        if (width == kRow) {
          memcpy(to, q, kRow * sizeof(int32_t));
        } else {
          memcpy(to, q, width * sizeof(int32_t));
        }
        out.signs[j + k * out.sign_plane] |= signMask(q, width) << out.first_bit;
      }
    }
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
