// Triangulates a flat loop of up to 12 points, with the same result as triangulateFlatLoop of mesh/triangulate_any.h.

const uint kLongestLoop = 12u;

struct Point {
  uint place;  // position of the point in the cell, ten bits per axis
  // number of the point's vertex; from bit 16 on, mask of the cell faces on which the vertex's grid edge lies
  uint rest;
};

Point packPoint(uvec3 place, uint faces, uint vertex) {
  return Point(place.x | place.y << 10 | place.z << 20, vertex | faces << 16);
}
uint vertexOf(Point p) { return p.rest & 0xFFFFu; }
bool shareFace(Point a, Point b) { return (a.rest & b.rest) >> 16 != 0u; }
ivec3 placeOf(Point p) { return ivec3(uvec3(p.place, p.place >> 10, p.place >> 20) & 0x3FFu); }

int measureOf(ivec3 a, ivec3 b, ivec3 c) {
  ivec3 u = b - a, v = c - a, n = abs(u.yzx * v.zxy - u.zxy * v.yzx);
  return n.x + n.y + n.z;
}

// Returns the apex of a chord's best triangle. A chord is stored in one word: the apex in the lowest four bits, and
// above them the size of the smallest triangle in the best triangulation of the chord's part of the loop. Among the
// triangulations with the least total area, the best is the one whose smallest triangle is largest.
uint apexOf(uint chord) { return chord & 15u; }
int bestOf(uint chord) { return int(chord) >> 4; }

// Global variables, because array arguments would be copied element by element.
Point loop[kLongestLoop];
uint chord[kLongestLoop * kLongestLoop];
int total[kLongestLoop * kLongestLoop];  // for each chord: minimum total area of the triangles in its part of the loop

// For each chord of the loop of n points, computes the best triangulation of the part that the chord cuts off.
void cutLoop(uint n) {
  const int side = 0x7FFFFFF;  // larger than the size of any triangle
  const int never = 1 << 24;   // larger than the area of any loop
  uint i = 0u, span = 2u;
  do {
    uint j = i + span, k = i + 1u, chosen = 0u;
    int largest = -1, least = never;
    ivec3 from = placeOf(loop[i]), to = placeOf(loop[j]);
    do {
      bool first = k == i + 1u, last = k + 1u == j;
      uint left = i * kLongestLoop + k, right = k * kLongestLoop + j;
      int measure = measureOf(from, placeOf(loop[k]), to);
      int area = (first ? 0 : total[left]) + (last ? 0 : total[right]) + measure;
      int smallest = min(min(first ? side : bestOf(chord[left]), last ? side : bestOf(chord[right])), measure);
      bool better = area < least || (area == least && smallest > largest);
      chosen = better ? k : chosen;
      least = better ? area : least;
      largest = better ? smallest : largest;
      ++k;
    } while (k < j);
    if (span + 1u < n && shareFace(loop[i], loop[j])) {
      least = never;
      largest = -1;
    }
    chord[i * kLongestLoop + j] = uint(largest) << 4 | chosen;
    total[i * kLongestLoop + j] = least;
    ++i;
    if (i + span >= n) {
      i = 0u;
      ++span;
    }
  } while (span < n);
}
