// The crossed edges that the samples of one row own, and so the numbers of the vertices on them: by sample, then
// x-edge, y-edge, z-edge. A row's signs are two words, samples 0..31 and sample 32. A plane has x and y alone.

struct RowEdges {
  uint x;
  uvec2 y, z;  // bits as in signs
};

// The row's signs from sample 1 on.
uint shifted(uvec2 row) { return row.x >> 1 | row.y << 31; }

// `above` is the next row in y, `behind` in z; what they hold does not matter where there is none.
RowEdges crossedEdges(uvec2 row, uvec2 above, uvec2 behind, uint y, uint z) {
  return RowEdges(row.x ^ shifted(row), y < 32u ? row ^ above : uvec2(0u), z < 32u ? row ^ behind : uvec2(0u));
}

uint bitsOf(uvec2 words) { return bitCount(words.x) + bitCount(words.y); }

uint verticesOf(RowEdges e) { return bitCount(e.x) + bitsOf(e.y) + bitsOf(e.z); }

// The bits of samples before x, 0 <= x <= 32, of the first word of a row.
uint bitsBefore(uint x) { return x < 32u ? (1u << x) - 1u : 0xFFFFFFFFu; }

// How many vertices the samples before x own.
uint verticesBefore(RowEdges e, uint x) {
  uint before = bitsBefore(x);
  return bitCount(e.x & before) + bitCount(e.y.x & before) + bitCount(e.z.x & before);
}

// Bit axis: the edge along it that sample x owns is crossed.
uint ownedEdges(RowEdges e, uint x) {
  uvec3 owned = x < 32u ? uvec3(e.x, e.y.x, e.z.x) >> x : uvec3(0u, e.y.y, e.z.y);
  return (owned.x & 1u) | (owned.y & 1u) << 1 | (owned.z & 1u) << 2;
}

// The same of samples x and x + 1, three bits each; x < 32.
uint ownedByTwo(RowEdges e, uint x) {
  uvec3 here = uvec3(e.x, e.y.x, e.z.x) >> x & 1u, next = uvec3(e.x >> 1, shifted(e.y), shifted(e.z)) >> x & 1u;
  return here.x | here.y << 1 | here.z << 2 | next.x << 3 | next.y << 4 | next.z << 5;
}

// The number of the vertex on bit `edge` of a mask of owned edges (of one sample, or of some in a row), of which the
// first one's vertex has number `first`.
uint vertexOnEdge(uint first, uint owned, uint edge) { return first + bitCount(owned & ((1u << edge) - 1u)); }

// How far along its edge, in 1/256, the surface crosses (mesh/vertex.h).
uint crossing(int q0, int q1) {
  uint a = uint(abs(q0)), sum = a + uint(abs(q1));
  return clamp((512u * a + sum) / (2u * sum), 1u, 255u);
}
