// An active cell (one that the surface crosses), as list_cells.comp passes it to triangles.comp: its case, and data to
// compute the numbers of its vertices. A cell touches four rows of samples, with index y + 2 z. For each row it has:
// the number of the first vertex on an edge that starts at sample x or a later one; and which edges from samples x
// (bits 0..2) and x + 1 (bits 3..5) are crossed. A body has fewer than 2^17 vertices and 2^19 indices, and the
// numbers of the first vertices at a sample and at the next sample in y differ by at most 99.

struct ActiveCell {
  uint cell_case;
  uvec4 first; // for each row: number of the first vertex
  // for rows 0 to 2: crossed edges from samples x and x + 1; in row 3, the cell's only edge is the x-edge from sample x
  uvec3 owned;
  uint index;   // position of the cell's first index in the part
  uint part;
};

uvec4 packCell(ActiveCell cell) {
  return uvec4(cell.first.x | (cell.first.y - cell.first.x) << 17 | cell.cell_case << 24,
               cell.first.z | (cell.first.w - cell.first.z) << 17 | cell.owned.x << 24,
               cell.index | cell.owned.y << 19 | cell.owned.z << 25, cell.part);
}

ActiveCell unpackCell(uvec4 words) {
  uvec2 low = words.xy & 0x1FFFFu, high = low + (words.xy >> 17 & 0x7Fu);
  return ActiveCell(words.x >> 24, uvec4(low.x, high.x, low.y, high.y),
                    uvec3(words.y >> 24, words.z >> 19 & 0x3Fu, words.z >> 25), words.z & 0x7FFFFu, words.w);
}
