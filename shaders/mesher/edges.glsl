// The crossed edges that start at the samples of one row. They determine the numbers of the vertices: sorted by sample,
// then x-edge, y-edge, z-edge. The signs of a row are two words: samples 0..31 and sample 32. In a plane (for seams),
// there are only edges along x and y.

struct RowEdges {
  uint x;
  uvec2 y, z;  // masks of crossed edges along y and z, with one bit per sample as in the signs
};

// Returns the signs of a row shifted by one sample, so that bit x is the sign of sample x + 1.
uint shifted(uvec2 row) { return row.x >> 1 | row.y << 31; }

// Returns the crossed edges of a row. above: the next row in y; behind: the next row in z. If there is no such row, any
// value may be passed.
RowEdges crossedEdges(uvec2 row, uvec2 above, uvec2 behind, uint y, uint z) {
  return RowEdges(row.x ^ shifted(row), y < 32u ? row ^ above : uvec2(0u), z < 32u ? row ^ behind : uvec2(0u));
}

uint bitsOf(uvec2 words) { return bitCount(words.x) + bitCount(words.y); }

uint verticesOf(RowEdges e) { return bitCount(e.x) + bitsOf(e.y) + bitsOf(e.z); }

// Returns a mask of the samples before x, 0 <= x <= 32, in the first word of a row.
uint bitsBefore(uint x) { return x < 32u ? (1u << x) - 1u : 0xFFFFFFFFu; }

// Returns the number of crossed edges (each has one vertex) that start at the row's samples before sample x.
uint verticesBefore(RowEdges e, uint x) {
  uint before = bitsBefore(x);
  return bitCount(e.x & before) + bitCount(e.y.x & before) + bitCount(e.z.x & before);
}

// Returns a mask of three bits: bit 0, 1, 2 is set if the edge from sample x along x, y, z is crossed.
uint ownedEdges(RowEdges e, uint x) {
  uvec3 owned = x < 32u ? uvec3(e.x, e.y.x, e.z.x) >> x : uvec3(0u, e.y.y, e.z.y);
  return (owned.x & 1u) | (owned.y & 1u) << 1 | (owned.z & 1u) << 2;
}

// Returns ownedEdges for samples x and x + 1, three bits each; x < 32.
uint ownedByTwo(RowEdges e, uint x) {
  uvec3 here = uvec3(e.x, e.y.x, e.z.x) >> x & 1u, next = uvec3(e.x >> 1, shifted(e.y), shifted(e.z)) >> x & 1u;
  return here.x | here.y << 1 | here.z << 2 | next.x << 3 | next.y << 4 | next.z << 5;
}

// Returns the number of the vertex on an edge. owned: mask of crossed edges of one sample, or of several in a row;
// edge: bit in this mask; first: number of the vertex on the first of these edges.
uint vertexOnEdge(uint first, uint owned, uint edge) { return first + bitCount(owned & ((1u << edge) - 1u)); }

// Returns the position of the crossing on an edge, in 1/256 of the edge, from the samples at its ends (mesh/vertex.h).
uint crossing(int q0, int q1) {
  uint a = uint(abs(q0)), sum = a + uint(abs(q1));
  return clamp((512u * a + sum) / (2u * sum), 1u, 255u);
}
