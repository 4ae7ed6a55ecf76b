// The input of the lists of crossed edges and active cells, and the packing of their elements. See mesh_kernels.h;
// cells.inl lists the definitions that the including file must provide.

FN uint64_t wordMask(size_t word, size_t count) {
  const size_t first = word * 64;
  return count >= first + 64 ? ~uint64_t{0} : count <= first ? 0 : (uint64_t{1} << (count - first)) - 1;
}

/// Returns a mask of the groups of words in which four adjacent rows may have crossed edges or active cells. If the bit
/// of a group is 0, the samples of this group and of the next one in these rows are all void or all solid. The next
/// group matters because the last cells of a group reach into it.
FN uint64_t mixedGroups(const SignLattice& lattice, const size_t (&y)[2], const size_t (&z)[2]) {
  const size_t group = lattice.group(), groups = group == 1 ? lattice.words : (lattice.words + group - 1) / group;
  if (lattice.words == 1 || lattice.uniform == nullptr) return wordMask(0, groups);
  uint64_t empty = ~uint64_t{0}, solid = ~uint64_t{0};
  for (size_t i = 0; i < 4; ++i) {
    const uint64_t* row = lattice.uniformRow(y[i & 1], z[i >> 1]);
    empty &= row[0];
    solid &= row[1];
  }
  // No edge begins behind the end of a row. So the missing group behind the last group counts as both void and solid.
  constexpr uint64_t kLast = uint64_t{1} << 63;
  return ~((empty & (empty >> 1 | kLast)) | (solid & (solid >> 1 | kLast))) & wordMask(0, groups);
}

/// Finds mixed places among the rows first..last - 1 (at most 64 rows, one word each). A place consists of the row
/// first + i, the next row, and the two rows above them. Bit i of the result is set if the samples of these four rows
/// are neither all void nor all solid.
FN uint64_t mixedRows(const SignLattice& lattice, size_t z, size_t z_above, size_t first, size_t last) {
  const uint64_t *low = lattice.row(0, z), *high = lattice.row(0, z_above), solid = wordMask(0, lattice.size[0]);
  uint64_t mixed = 0;
  for (size_t y = first; y < last; ++y) {
    const size_t next = y + 1 < lattice.size[1] ? y + 1 : y;
    const uint64_t some = low[y] | low[next] | high[y] | high[next], every = low[y] & low[next] & high[y] & high[next];
    mixed |= static_cast<uint64_t>((some != 0) & (every != solid)) << (y - first);
  }
  return mixed;
}

/// A crossed edge of a plane is packed as its axis, then the y and x of the sample at which it starts.
inline constexpr int kPlaceBits = 14;
inline constexpr uint32_t kPlaceMask = (1u << kPlaceBits) - 1;

/// Packs an active cell of a layer into one number: `place`, the index of its lowest sample in the plane; `beyond`,
/// which edges beyond the cell are crossed (the index into CellSteps::of_high); and `cell_case`, its marching cubes
/// case.
constexpr uint64_t packedCell(size_t place, uint32_t beyond, uint32_t cell_case) {
  return uint64_t{place} << 16 | beyond << 8 | cell_case;
}

/// Numbers vertices. For each sample at which crossed edges start, writes to `numbers` the number of the vertex on the
/// first of these edges. `edges`: the list of crossed edges of a plane; the vertex on its first edge has the number
/// `first`.
inline void numberOwners(const uint32_t* edges, size_t count, size_t first, size_t size_x, uint32_t* numbers) {
  // The loop runs backwards: of several edges that start at the same sample, the first one is written last, so its
  // number remains.
  for (size_t i = count; i-- > 0;)
    numbers[(edges[i] >> kPlaceBits & kPlaceMask) * size_x + (edges[i] & kPlaceMask)] =
        static_cast<uint32_t>(first + i);
}
