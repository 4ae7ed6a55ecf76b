// An active cell on its way from the list to the triangles: its case, and all that the numbers of its vertices follow
// from. Rows are those of samples that the cell touches, y + 2 z; of each the number of the first vertex that sample x
// or a later one owns, and the owned edges of samples x (bits 0..2) and x + 1 (bits 3..5). A body has fewer than 2^17
// vertices and 2^19 indices, and at most 99 vertices between a sample and the one above.

struct ActiveCell {
  uint cell_case;
  uvec4 first;  // by row
  uvec3 owned;  // by row; of row 3 a cell has the x-edge of sample x alone
  uint index;   // the first of its indices, in its part
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
