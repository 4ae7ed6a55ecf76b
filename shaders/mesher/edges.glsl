// The crossed edges that start at the samples of one row, from which the numbers of the vertices follow: sorted by
// sample, then x-edge, y-edge, z-edge. The signs of a row are two words: samples 0..31 and sample 32. A plane has only
// edges along x and y.

struct RowEdges {
  uint x;
  uvec2 y, z;  // bits as in the signs
};

// Returns the row's signs from sample 1 on.
uint shifted(uvec2 row) { return row.x >> 1 | row.y << 31; }

// `above` is the next row in y, `behind` the next row in z; if there is no such row, its content does not matter.
RowEdges crossedEdges(uvec2 row, uvec2 above, uvec2 behind, uint y, uint z) {
  return RowEdges(row.x ^ shifted(row), y < 32u ? row ^ above : uvec2(0u), z < 32u ? row ^ behind : uvec2(0u));
}

uint bitsOf(uvec2 words) { return bitCount(words.x) + bitCount(words.y); }

uint verticesOf(RowEdges e) { return bitCount(e.x) + bitsOf(e.y) + bitsOf(e.z); }

// Returns the bits of the samples before x, 0 <= x <= 32, in the first word of a row.
uint bitsBefore(uint x) { return x < 32u ? (1u << x) - 1u : 0xFFFFFFFFu; }

// Returns the number of vertices on edges that start at samples before x.
uint verticesBefore(RowEdges e, uint x) {
  uint before = bitsBefore(x);
  return bitCount(e.x & before) + bitCount(e.y.x & before) + bitCount(e.z.x & before);
}

// Returns a mask of three bits: bit 0, 1, 2 is set if the edge from sample x along x, y, z is crossed.
uint ownedEdges(RowEdges e, uint x) {
  uvec3 owned = x < 32u ? uvec3(e.x, e.y.x, e.z.x) >> x : uvec3(0u, e.y.y, e.z.y);
  return (owned.x & 1u) | (owned.y & 1u) << 1 | (owned.z & 1u) << 2;
}

// Same as ownedEdges for samples x and x + 1, three bits each; x < 32.
uint ownedByTwo(RowEdges e, uint x) {
  uvec3 here = uvec3(e.x, e.y.x, e.z.x) >> x & 1u, next = uvec3(e.x >> 1, shifted(e.y), shifted(e.z)) >> x & 1u;
  return here.x | here.y << 1 | here.z << 2 | next.x << 3 | next.y << 4 | next.z << 5;
}

// Returns the number of the vertex on edge `edge` of a mask of crossed edges (of one sample, or of several in a row).
// first: the number of the vertex on the first of these edges.
uint vertexOnEdge(uint first, uint owned, uint edge) { return first + bitCount(owned & ((1u << edge) - 1u)); }

// Returns the position, in 1/256 of an edge, at which the surface crosses it (mesh/vertex.h).
uint crossing(int q0, int q1) {
  uint a = uint(abs(q0)), sum = a + uint(abs(q1));
  return clamp((512u * a + sum) / (2u * sum), 1u, 255u);
}
