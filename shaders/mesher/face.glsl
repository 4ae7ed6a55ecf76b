// A face of a chunk as a plane of samples, with index a along axis u and b along v (mesh/seam.h).

uint axisOf(uint face) { return face >> 1; }
bool isHigh(uint face) { return (face & 1u) != 0u; }

// Returns the distance, in the array of a chunk's samples, between neighbours along an axis.
uint strideOf(uint axis) { return axis == 0u ? 1u : axis == 1u ? kSide : kSide * kSide; }

struct Plane {
  // in the array of the chunk's samples: index of the first sample of the face, and steps along u and v
  uint origin, step_u, step_v;
};

Plane planeOf(uint face) {
  uint axis = axisOf(face);
  return Plane(isHigh(face) ? kCells * strideOf(axis) : 0u, strideOf((axis + 1u) % 3u), strideOf((axis + 2u) % 3u));
}

// Returns a point of the face's plane in the chunk's axes. u, v: coordinates in the plane; high: coordinate of a high
// face; all in the same unit.
uvec3 pointOf(uint face, uint u, uint v, uint high) {
  uint axis = axisOf(face), w = isHigh(face) ? high : 0u;
  return axis == 0u ? uvec3(w, u, v) : axis == 1u ? uvec3(v, w, u) : uvec3(u, v, w);
}

// Return the crossed edges of a row of the face: fineEdges() for the chunk's own (fine) samples, coarseEdges() for the
// samples of the coarser level.
RowEdges fineEdges(uvec2 row, uvec2 above, uint b) { return crossedEdges(row, above, uvec2(0u), b, kCells); }
RowEdges coarseEdges(uint row, uint above, uint b) {
  return RowEdges((row ^ row >> 1) & 0xFFFFu, b + 1u < kCoarseSide ? uvec2(row ^ above, 0u) : uvec2(0u), uvec2(0u));
}

// Returns a mask of lateral edges: bit a is set if the fine and the coarse sample at corner a differ in sign.
uint lateralEdges(uvec2 fine, uint coarse) {
  uint even = fine.x & 0x55555555u;  // the fine signs at samples 0, 2, .. 30, which are then moved to adjacent bits
  even = (even | even >> 1) & 0x33333333u;
  even = (even | even >> 2) & 0x0F0F0F0Fu;
  even = (even | even >> 4) & 0x00FF00FFu;
  even = (even | even >> 8) & 0x0000FFFFu;
  return (even | fine.y << 16) ^ coarse;
}

// Returns the marching-cubes case of a seam cell, from the signs of the fine rows 2 b .. 2 b + 2 and the coarse rows b
// and b + 1.
uint seamCase(uvec2 f0, uvec2 f1, uvec2 f2, uint c0, uint c1, uint a) {
  uvec3 low = uvec3(f0.x, f1.x, f2.x) >> (2u * a) & 7u, last = a == 15u ? uvec3(f0.y, f1.y, f2.y) << 2 : uvec3(0u);
  uvec3 rows = low | last;
  return rows.x | rows.y << 3 | rows.z << 6 | (c0 >> a & 3u) << 9 | (c1 >> a & 3u) << 11;
}
