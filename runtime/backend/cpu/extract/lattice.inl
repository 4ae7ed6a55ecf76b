// The input of the lists of crossed edges and active cells, and the packing of their elements. See mesh_kernels.h;
// cells.inl lists the definitions that the including file must provide.

FN uint64_t wordMask(size_t word, size_t count) {
  const size_t first = word * 64;
  return count >= first + 64 ? ~uint64_t{0} : count <= first ? 0 : (uint64_t{1} << (count - first)) - 1;
}

/// Returns, as a mask, the groups of words in which four adjacent rows may have crossed edges or active cells. The
/// other groups are proven uniform together with the next group, into which the last cells of a group reach.
FN uint64_t mixedGroups(const SignLattice& lattice, const size_t (&y)[2], const size_t (&z)[2]) {
  const size_t group = lattice.group(), groups = group == 1 ? lattice.words : (lattice.words + group - 1) / group;
  if (lattice.words == 1 || lattice.uniform == nullptr) return wordMask(0, groups);
  uint64_t empty = ~uint64_t{0}, solid = ~uint64_t{0};
  for (size_t i = 0; i < 4; ++i) {
    const uint64_t* row = lattice.uniformRow(y[i & 1], z[i >> 1]);
    empty &= row[0];
    solid &= row[1];
  }
  // Groups after the last one count as both void and solid, because no edge begins behind the end of a row.
  constexpr uint64_t kLast = uint64_t{1} << 63;
  return ~((empty & (empty >> 1 | kLast)) | (solid & (solid >> 1 | kLast))) & wordMask(0, groups);
}

/// For rows first..last - 1, at most 64, of one word each: bit i is set if row first + i, the next row and the two rows
/// above them are neither all void nor all solid.
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

/// Packs an active cell of a layer: the index of its lowest sample in the plane; which edges beyond the cell are
/// crossed (index into CellSteps::of_high); and its case.
constexpr uint64_t packedCell(size_t place, uint32_t beyond, uint32_t cell_case) {
  return uint64_t{place} << 16 | beyond << 8 | cell_case;
}

/// Sets, for each sample at which a crossed edge starts, the number of its first vertex. `edges`: the list of a plane;
/// its first edge has number `first`.
inline void numberOwners(const uint32_t* edges, size_t count, size_t first, size_t size_x, uint32_t* numbers) {
  // In reverse order, so that the number of a sample's first edge is written last.
  for (size_t i = count; i-- > 0;)
    numbers[(edges[i] >> kPlaceBits & kPlaceMask) * size_x + (edges[i] & kPlaceMask)] =
        static_cast<uint32_t>(first + i);
}
