// Evaluates noise on a block that is part of a lattice. Much of the work of an octave is common to many samples: the
// position within a period depends on one axis only, and all samples in a period share the gradients at its corners.
// Both are computed once, and each sample looks up the gradients at its corners. A gradient has at most two components
// that are not 0, so the sum of three products has the same bits in every order. Included by evaluate_lists.inl.

/// maximum number of noise periods along an axis; their corners are one more, that is, kRow
inline constexpr size_t kMaxNoisePeriods = 7;
inline constexpr size_t kMaxNoiseRows = kEvalBlock / kRow;

/// The data of one axis of a block for one octave. Each word is repeated kRow times, because a vector contains whole
/// rows of points.
struct NoiseAxis {
  size_t periods = 0;  ///< number of noise periods that contain the coordinates
  /// index of the period of each coordinate, relative to the period of the first coordinate
  uint8_t period[kMaxNoiseRows];
  /// lattice coordinates of the corners: the beginning of each period, and the end of the last one
  alignas(64) uint32_t corner[(kMaxNoisePeriods + 1) * kRow];
  alignas(64) uint32_t rest[kMaxNoiseRows * kRow];   ///< position of each coordinate within its period, 0 to 1
  alignas(64) uint32_t faded[kMaxNoiseRows * kRow];  ///< smoothed position of each coordinate within its period
};

/// Computes the data of the axis for `count` coordinates from `origin` on. Returns false if they lie in more than
/// kMaxNoisePeriods periods.
SGM_KERNEL bool placeAxis(NoiseAxis& axis, uint32_t origin, int32_t step, size_t count, int period, float inv_period) {
  alignas(64) uint32_t cell[kMaxNoiseRows], rest[kMaxNoiseRows], faded[kMaxNoiseRows];
  for (size_t i = 0; i < kMaxNoiseRows; ++i) cell[i] = origin + static_cast<uint32_t>(step) * static_cast<uint32_t>(i);
  for (size_t i = 0; i < count; i += kLanes) {
    const LatticePlace p = latticePlace(loadInt(cell + i), period, inv_period);
    const Real f = toReal(p.rest) * inv_period;
    storeInt(p.cell, cell + i);
    storeReal(f, rest + i);
    storeReal(fade(f), faded + i);
  }
  uint32_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t beyond = cell[i] - cell[0];
    if (beyond >= kMaxNoisePeriods) return false;
    axis.period[i] = static_cast<uint8_t>(beyond);
    last = beyond > last ? beyond : last;
    for (size_t lane = 0; lane < kRow; ++lane) {
      axis.rest[i * kRow + lane] = rest[i];
      axis.faded[i * kRow + lane] = faded[i];
    }
  }
  axis.periods = last + 1;
  for (uint32_t i = 0; i <= axis.periods; ++i) {
    for (size_t lane = 0; lane < kRow; ++lane) axis.corner[i * kRow + lane] = cell[0] + i;
  }
  return true;
}

/// Gradients at the corners of all periods of a block, in rows along x; the rows of a slice are consecutive.
struct NoiseCorners {
  static constexpr size_t kWords = (kMaxNoisePeriods + 1) * (kMaxNoisePeriods + 1) * kRow + kRow;
  alignas(64) uint32_t x[kWords], y[kWords], z[kWords];

  SGM_KERNEL void fill(uint32_t first_x, const NoiseAxis& rows, const NoiseAxis& slices, uint seed) {
    alignas(64) uint32_t along[kLanes];
    for (size_t i = 0; i < kLanes; ++i) along[i] = first_x + static_cast<uint32_t>(i % kRow);
    const size_t height = rows.periods + 1, count = height * (slices.periods + 1);
    for (size_t row = 0; row < count; row += kLanes / kRow) {
      const size_t next = row + 1 < count ? row + 1 : row;
      const Int cy = toIntBits(loadRows(rows.corner + row % height * kRow, rows.corner + next % height * kRow));
      const Int cz = toIntBits(loadRows(slices.corner + row / height * kRow, slices.corner + next / height * kRow));
      const Vec3 g = latticeGradient(hashLattice(loadInt(along), cy, cz, seed));
      storeReal(g.x, x + row * kRow);
      storeReal(g.y, y + row * kRow);
      storeReal(g.z, z + row * kRow);
    }
  }
};

/// The data of one octave for a block. It is large, so all octaves use the same object, one after the other.
struct NoiseBlock {
  NoiseAxis columns, rows, slices;
  NoiseCorners corners;
  /// for each lane: the period along x, and `rest` and `faded` as in NoiseAxis
  alignas(64) uint32_t column[kLanes], rest[kLanes], faded[kLanes];

  SGM_KERNEL bool place(const BlockLattice& at, Params P, int period, float inv_period, uint seed) {
    const auto from = [](int32_t origin, int32_t own) {
      return static_cast<uint32_t>(origin) - static_cast<uint32_t>(own);
    };
    if (!placeAxis(columns, from(at.origin.x, PI(P, 0)), at.step, kRow, period, inv_period)) return false;
    if (!placeAxis(rows, from(at.origin.y, PI(P, 1)), at.step, at.rows, period, inv_period)) return false;
    if (!placeAxis(slices, from(at.origin.z, PI(P, 2)), at.step, at.slices, period, inv_period)) return false;
    corners.fill(columns.corner[0], rows, slices, seed);
    for (size_t i = 0; i < kLanes; ++i) {
      const size_t lane = i % kRow;
      column[i] = static_cast<uint32_t>(columns.period[lane] + i - lane);
      rest[i] = columns.rest[lane * kRow];
      faded[i] = columns.faded[lane * kRow];
    }
    return true;
  }

  /// Evaluates the samples of two rows, given by their indices along y and z. With 8 lanes, a vector holds only one
  /// row, so the second one is ignored.
  SGM_KERNEL Real sample(size_t y0, size_t z0, size_t y1, size_t z1) const {
    const auto of = [&](const uint32_t* words, size_t a, size_t b) {
      return loadRows(words + a * kRow, words + b * kRow);
    };
    const Real fx = loadReal(rest), gx = fx - 1.0f;
    const Real fy = of(rows.rest, y0, y1), fz = of(slices.rest, z0, z1);
    const Int near = loadInt(column), far = wrapAdd(near, broadcastInt(1));
    const Real zero = broadcast(0.0f), u = loadReal(faded);
    const Int none = broadcastInt(0);
    const size_t height = rows.periods + 1;
    const size_t row0 = slices.period[z0] * height + rows.period[y0],
                 row1 = slices.period[z1] * height + rows.period[y1];
    // Interpolates along an edge of the noise cell that is parallel to x. up: 1 if the edge is on the cell's high side
    // in y, otherwise 0; behind: the same in z.
    const auto edge = [&](size_t up, size_t behind) {
      const size_t a = row0 + behind * height + up, b = row1 + behind * height + up;
      const Real slope = of(corners.x, a, b);
      Real across = of(corners.y, a, b) * (up != 0 ? fy - 1.0f : fy);
      Real deep = of(corners.z, a, b) * (behind != 0 ? fz - 1.0f : fz);
      across = across + deep;
      Real first = lookUp(slope, near) * fx, second = lookUp(slope, far) * gx;
      first = first + lookUp(across, near);
      second = second + lookUp(across, far);
      return mixCorners(makeDual(first, zero, zero, zero, none), makeDual(second, zero, zero, zero, none), u, zero, 0);
    };
    const Real v = of(rows.faded, y0, y1), w = of(slices.faded, z0, z1);
    const Dual front = mixCorners(edge(0, 0), edge(1, 0), v, zero, 1);
    const Dual back = mixCorners(edge(0, 1), edge(1, 1), v, zero, 1);
    return mixCorners(front, back, w, zero, 2).v;
  }
};

/// Computes the same result as opNoise for a whole block at once. Returns the number of instructions processed: 1, or 0
/// if the caller must evaluate the noise sample by sample.
SGM_KERNEL size_t latticeNoise(const BlockFrame& f, const Instr& in, Params P, size_t n) {
  if (f.lattice == nullptr || in.place != 0) return 0;
  const size_t height = f.lattice->rows, depth = f.lattice->slices;
  size_t longest = kRow > height ? kRow : height;
  longest = longest > depth ? longest : depth;
  const int64_t finest = QI(P, 6 + 2 * (PI(P, 3) - 1));
  if (f.lattice->step * static_cast<int64_t>(longest - 1) > static_cast<int64_t>(kMaxNoisePeriods) * finest) return 0;
  uint32_t* const out = f.registers + in.dst * kRegisterWords<false>;
  NoiseBlock block;
  float weight = PF(P, 5);
  for (int k = 0; k < PI(P, 3); ++k, weight = weight * 0.5f) {
    if (!block.place(*f.lattice, P, QI(P, 6 + 2 * k), QF(P, 7 + 2 * k), PU(P, 4) + 0x9E3779B9u * static_cast<uint>(k)))
      return 0;
    size_t y = 0, z = 0;
    // Moves to the next row of the block, but not beyond the last row: lanes beyond the last row repeat it, and their
    // results are ignored.
    const auto step = [&] {
      if (y + 1 < height) {
        ++y;
      } else if (z + 1 < depth) {
        y = 0;
        ++z;
      }
    };
    for (size_t i = 0; i < n; i += kLanes) {
      const size_t y0 = y, z0 = z;
      if constexpr (kLanes > kRow) step();
      const Real before = k == 0 ? broadcast(0.0f) : loadReal(out + i);
      const Real own = block.sample(y0, z0, y, z) * weight;
      storeReal(before + own, out + i);
      step();
    }
  }
  for (size_t i = 0; i < n; i += kLanes) storeReal(flushReal(clampReal(loadReal(out + i), -1.0f, 1.0f)), out + i);
  return 1;
}
