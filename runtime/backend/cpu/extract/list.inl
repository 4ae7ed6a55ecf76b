// Lists everything that follows from the signs of samples alone: crossed edges, active cells, their cases, and counts.
// See mesh_kernels.h; cells.inl lists the definitions that the including file must provide.

/// The signs of a row at the 64 samples of a word, and the signs at each sample's successor. The row's last sample
/// counts as its own successor, so that no edge begins there.
struct RowSigns {
  uint64_t low, high;
};

FN RowSigns signsOf(const SignLattice& lattice, const uint64_t* row, size_t word) {
  const uint64_t low = row[word];
  if (word + 1 < lattice.words) return {low, low >> 1 | row[word + 1] << 63};
  return {low, low >> 1 | (low & uint64_t{1} << (lattice.size[0] - 1) % 64)};
}

/// Calls f(word), in order, for the words of the groups that `wanted` selects. Bit i stands for the group of
/// lattice.group() words that starts at word i * lattice.group().
template <class F>
FN void forWords(const SignLattice& lattice, uint64_t wanted, F&& f) {
  const size_t group = lattice.group();
  for (; wanted != 0; wanted &= wanted - 1) {
    const size_t first = static_cast<size_t>(std::countr_zero(wanted)) * group;
    for (size_t word = first; word < std::min(first + group, lattice.words); ++word) f(word);
  }
}

/// For each case of a cell: which edges along x are crossed. Bits 0, 1 and 2 stand for the edges in the rows (y, z),
/// (y + 1, z) and (y, z + 1).
struct CaseEdges {
  uint8_t along_x[256];
};
constexpr CaseEdges makeCaseEdges() {
  CaseEdges edges{};
  for (unsigned c = 0; c < 256; ++c) {
    const unsigned crossed = c ^ c >> 1;
    edges.along_x[c] = static_cast<uint8_t>((crossed & 1) | (crossed >> 2 & 1) << 1 | (crossed >> 4 & 1) << 2);
  }
  return edges;
}
inline constexpr CaseEdges kCaseEdges = makeCaseEdges();

/// The active cells of a word, with the data from which their cases are made.
struct WordCells {
  const uint64_t* corner;  ///< signs at the cells' eight corners, in the order of a case's bits; then one unused word
  uint32_t next_case;      ///< case of the cell after the word's last cell; 0 if there is none
  /// one bit per cell: whether the edge along y beyond the cell, from y + 1 to y + 2, is crossed; [0]: the edge at low
  /// x, [1]: the edge at high x
  uint64_t along_y[2];
  uint64_t active;
  size_t place;  ///< index of the word's first cell in the plane
};

/// Calls f(bit, mask) for each set bit: with the bit's index, and with the word in which only this bit is set. At the
/// end, it may also call f(64, 0). The number of set bits is unpredictable, so a branch for each bit would cost more
/// than a call without effect.
template <class F>
FN void forBits(uint64_t bits, F&& f) {
  do {
    for (int i = 0; i < 2; ++i) {
      f(static_cast<size_t>(std::countr_zero(bits)), bits & (~bits + 1));
      bits &= bits - 1;
    }
  } while (bits != 0);
}

/// Lists a word's crossed edges and active cells one bit after the other.
struct OneByOne {
  /// Appends packed crossed edges to `out`. x, y, z: bits of the samples at which crossed edges along these axes start,
  /// for 64 samples from `first` on. Returns the number of edges.
  FN static size_t edges(uint64_t x, uint64_t y, uint64_t z, uint32_t first, uint32_t* out) {
    uint32_t* next = out;
    forBits(x | y | z, [&](size_t bit, uint64_t mask) {
      const uint32_t sample = first + static_cast<uint32_t>(bit);
      const int along_x = std::popcount(x & mask), along_y = std::popcount(y & mask);
      next[0] = sample;
      next += along_x;
      next[0] = sample | 1u << 2 * kPlaceBits;
      next += along_y;
      next[0] = sample | 2u << 2 * kPlaceBits;
      next += std::popcount(z & mask);
    });
    return static_cast<size_t>(next - out);
  }

  /// Appends the packed active cells; returns the number of their triangles.
  FN static uint64_t cells(const WordCells& word, uint64_t* out) {
    uint8_t cases[64 + 1];
    spreadBits<8>(word.corner, cases);
    cases[64] = static_cast<uint8_t>(word.next_case);
    uint64_t triangles = 0;
    forBits(word.active, [&](size_t bit, uint64_t mask) {
      const uint32_t cell_case = cases[bit];
      const auto along_y =
          static_cast<uint32_t>((word.along_y[0] >> (bit & 63) & 1) + (word.along_y[1] >> (bit & 63) & 1) * 2);
      *out++ = packedCell(word.place + bit, kCaseEdges.along_x[cases[std::min<size_t>(bit, 63) + 1]] | along_y << 3,
                          cell_case);
      triangles += mask != 0 ? kCubeTriangles[cell_case] : 0;
    });
    return triangles;
  }
};

/// Lists the crossed edges that start in rows first_row..last_row - 1 of plane z, sorted by sample and axis, like the
/// vertices. Also lists, in canonical order, the active cells between these rows and the plane above.
inline ListCounts listRows(const SignLattice& lattice, size_t z, size_t first_row, size_t last_row, uint32_t* edges,
                           uint64_t* cells) {
  ListCounts counts;
  const bool above = z + 1 < lattice.size[2];
  const size_t zs[2] = {z, above ? z + 1 : z};
  const auto listRow = [&](size_t y) {
    const bool has_cells = above && y + 1 < lattice.size[1];
    const size_t ys[2] = {y, y + 1 < lattice.size[1] ? y + 1 : y};
    const uint64_t* const rows[4] = {lattice.row(ys[0], zs[0]), lattice.row(ys[1], zs[0]), lattice.row(ys[0], zs[1]),
                                     lattice.row(ys[1], zs[1])};
    const uint64_t* beyond_row = y + 2 < lattice.size[1] ? lattice.row(y + 2, z) : rows[1];
    forWords(lattice, mixedGroups(lattice, ys, zs), [&](size_t word) {
      uint64_t corner[8 + 1];  // the eight corners, and one more word, because spreadBits may read it
      uint64_t some = 0, every = ~uint64_t{0};
      for (size_t i = 0; i < 4; ++i) {
        const RowSigns s = signsOf(lattice, rows[i], word);
        corner[2 * i] = s.low;
        corner[2 * i + 1] = s.high;
        some |= s.low | s.high;
        every &= s.low & s.high;
      }
      corner[8] = 0;
      // If all corners of the word's cells have equal signs, the word has no active cell. No crossed edge starts in the
      // word either, since both ends of such an edge are among these corners.
      if ((some & ~every) == 0) return;
      const uint64_t x = corner[0] ^ corner[1], y_edges = corner[0] ^ corner[2], z_edges = corner[0] ^ corner[4];
      if ((x | y_edges | z_edges) != 0) {
        const auto first = static_cast<uint32_t>(y << kPlaceBits | word * 64);
        counts.vertices += OneByOne::edges(x, y_edges, z_edges, first, edges + counts.vertices);
      }
      const uint64_t active = has_cells ? some & ~every & wordMask(word, lattice.size[0] - 1) : 0;
      if (active == 0) return;
      uint32_t next_case = 0;
      if (active >> 63 != 0 && word + 1 < lattice.words) {
        for (size_t i = 0; i < 4; ++i) {
          const RowSigns s = signsOf(lattice, rows[i], word + 1);
          next_case |= static_cast<uint32_t>((s.low & 1) << 2 * i | (s.high & 1) << (2 * i + 1));
        }
      }
      const RowSigns beyond = signsOf(lattice, beyond_row, word);
      counts.triangles += OneByOne::cells({corner,
                                           next_case,
                                           {corner[2] ^ beyond.low, corner[3] ^ beyond.high},
                                           active,
                                           y * lattice.size[0] + word * 64},
                                          cells + counts.cells);
      counts.cells += static_cast<uint64_t>(std::popcount(active));
    });
  };
  if (lattice.words > 1) {
    for (size_t y = first_row; y < last_row; ++y) listRow(y);
    return counts;
  }
  for (size_t first = first_row; first < last_row; first += 64) {
    uint64_t mixed = mixedRows(lattice, z, zs[1], first, std::min(first + 64, last_row));
    for (; mixed != 0; mixed &= mixed - 1) listRow(first + static_cast<size_t>(std::countr_zero(mixed)));
  }
  return counts;
}
