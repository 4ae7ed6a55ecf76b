// Triangulates a loop of at most seven points in the way that mesh/triangulate.h defines: by dynamic programming over
// chords, without branches and memory accesses. Values beyond the loop's n points are computed, but not used.

const uint kPoints = 7u;

// Packs a vertex's position into one word, modulo 1024 on each axis. This suffices, because the points of a cell are at
// most 256 apart.
uint packPlace(uvec2 vertex) {
  return (vertex.x & 0x3FFu) | (vertex.x >> 6 & 0xFFC00u) | (vertex.y & 0x3FFu) << 20;
}
uvec3 highBits(uint place) { return uvec3(place << 22, place << 12, place << 2) & 0xFFC00000u; }
ivec3 placeFrom(uvec3 origin, uint place) { return ivec3(highBits(place) - origin) >> 22; }

ivec3 crossOf(ivec3 a, ivec3 b) { return a.yzx * b.zxy - a.zxy * b.yzx; }
int norm(ivec3 v) {
  ivec3 a = abs(v);
  return a.x + a.y + a.z;
}

// The best triangulation of the part of a loop between two points: the one whose smallest triangle is largest. best:
// size of this smallest triangle; -1 if the chord between the two points is forbidden. apexes: apexes of the triangles
// in pre-order, three bits each.
struct Piece {
  int best;
  uint apexes;
};

void tryApex(inout Piece piece, Piece left, Piece right, ivec3 area, uint apex, uint left_triangles) {
  int smallest = min(min(left.best, right.best), norm(area));
  bool better = smallest > piece.best;
  piece.best = better ? smallest : piece.best;
  piece.apexes = better ? apex | left.apexes << 3 | right.apexes << (3u + 3u * left_triangles) : piece.apexes;
}

void forbid(inout Piece piece, uint forbidden, uint i, uint j) {
  if ((forbidden >> (i + (j - 1u) * (j - 2u) / 2u) & 1u) != 0u) piece.best = -1;
}

// Positions of the loop's points. Global, because an array argument would be copied element by element.
uint place[kPoints];

// Returns the apexes of the triangles of a loop of n points. forbidden: a mask with one bit per chord (case_layout.h).
uint chooseApexes(uint n, uint forbidden) {
  const Piece side = Piece(0x7FFFFFFF, 0u), none = Piece(-1, 0u);
  uvec3 origin = highBits(place[0]);
  ivec3 p[kPoints];  // all array indices are constants, so the compiler keeps these arrays in registers
  Piece piece[kPoints * kPoints];
  // twice the area of the triangle of point 0 and two others; the area of any other triangle is a sum of three of these
  ivec3 area[kPoints * kPoints];
#define AT(i, j) [(i) * kPoints + (j)]
#define POINT(i) p[i] = placeFrom(origin, place[i]); piece AT(i - 1u, i) = side;
#define AREA(i, j) area AT(i, j) = crossOf(p[i], p[j]);
#define CHORD(i, j) piece AT(i, j) = none;
#define TRY(i, k, j, twice_area) tryApex(piece AT(i, j), piece AT(i, k), piece AT(k, j), twice_area, k, k - i - 1u);
#define FIRST(k, j) TRY(0u, k, j, area AT(k, j))
#define OTHER(i, k, j) TRY(i, k, j, area AT(i, k) + area AT(k, j) - area AT(i, j))
#define CLOSE(i, j) forbid(piece AT(i, j), forbidden, i, j);
  POINT(1u) POINT(2u) POINT(3u) POINT(4u) POINT(5u) POINT(6u)
  AREA(1u, 2u) AREA(1u, 3u) AREA(1u, 4u) AREA(1u, 5u) AREA(1u, 6u)
  AREA(2u, 3u) AREA(2u, 4u) AREA(2u, 5u) AREA(2u, 6u)
  AREA(3u, 4u) AREA(3u, 5u) AREA(3u, 6u)
  AREA(4u, 5u) AREA(4u, 6u)
  AREA(5u, 6u)
  CHORD(0u, 2u) FIRST(1u, 2u) CLOSE(0u, 2u)
  CHORD(1u, 3u) OTHER(1u, 2u, 3u) CLOSE(1u, 3u)
  CHORD(2u, 4u) OTHER(2u, 3u, 4u) CLOSE(2u, 4u)
  CHORD(3u, 5u) OTHER(3u, 4u, 5u) CLOSE(3u, 5u)
  CHORD(4u, 6u) OTHER(4u, 5u, 6u) CLOSE(4u, 6u)
  CHORD(0u, 3u) FIRST(1u, 3u) FIRST(2u, 3u) CLOSE(0u, 3u)
  CHORD(1u, 4u) OTHER(1u, 2u, 4u) OTHER(1u, 3u, 4u) CLOSE(1u, 4u)
  CHORD(2u, 5u) OTHER(2u, 3u, 5u) OTHER(2u, 4u, 5u) CLOSE(2u, 5u)
  CHORD(3u, 6u) OTHER(3u, 4u, 6u) OTHER(3u, 5u, 6u) CLOSE(3u, 6u)
  CHORD(0u, 4u) FIRST(1u, 4u) FIRST(2u, 4u) FIRST(3u, 4u) CLOSE(0u, 4u)
  CHORD(1u, 5u) OTHER(1u, 2u, 5u) OTHER(1u, 3u, 5u) OTHER(1u, 4u, 5u) CLOSE(1u, 5u)
  CHORD(2u, 6u) OTHER(2u, 3u, 6u) OTHER(2u, 4u, 6u) OTHER(2u, 5u, 6u) CLOSE(2u, 6u)
  CHORD(0u, 5u) FIRST(1u, 5u) FIRST(2u, 5u) FIRST(3u, 5u) FIRST(4u, 5u) CLOSE(0u, 5u)
  CHORD(1u, 6u) OTHER(1u, 2u, 6u) OTHER(1u, 3u, 6u) OTHER(1u, 4u, 6u) OTHER(1u, 5u, 6u) CLOSE(1u, 6u)
  CHORD(0u, 6u) FIRST(1u, 6u) FIRST(2u, 6u) FIRST(3u, 6u) FIRST(4u, 6u) FIRST(5u, 6u)
  uint apexes = n == 3u ? piece AT(0u, 2u).apexes : piece AT(0u, 3u).apexes;
  apexes = n < 5u ? apexes : n == 5u ? piece AT(0u, 4u).apexes : piece AT(0u, 5u).apexes;
  return n < 7u ? apexes : piece AT(0u, 6u).apexes;
#undef AT
#undef POINT
#undef AREA
#undef CHORD
#undef TRY
#undef FIRST
#undef OTHER
#undef CLOSE
}
