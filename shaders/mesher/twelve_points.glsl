// Where a loop of up to 12 points is cut: mesh/triangulate.cpp as it stands there.

const uint kLongestLoop = 12u;

struct Point {
  uint place;  // in the cell, ten bits an axis
  uint rest;   // number of the vertex, and from bit 16 on the faces of its edge
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

// A chord in a word: the largest possible smallest triangle of its piece, and in four bits the apex that reaches it.
uint apexOf(uint chord) { return chord & 15u; }
int bestOf(uint chord) { return int(chord) >> 4; }

// An invocation's own. As arguments they would be copied, element by element.
Point loop[kLongestLoop];
uint chord[kLongestLoop * kLongestLoop];

// Fills the chords of the loop of n points.
void cutLoop(uint n) {
  const int side = 0x7FFFFFF;  // more than any triangle
  uint i = 0u, span = 2u;
  do {
    uint j = i + span, k = i + 1u, chosen = 0u;
    int largest = -1;
    ivec3 from = placeOf(loop[i]), to = placeOf(loop[j]);
    do {
      int left = k == i + 1u ? side : bestOf(chord[i * kLongestLoop + k]);
      int right = j == k + 1u ? side : bestOf(chord[k * kLongestLoop + j]);
      int smallest = min(min(left, right), measureOf(from, placeOf(loop[k]), to));
      chosen = smallest > largest ? k : chosen;
      largest = max(largest, smallest);
      ++k;
    } while (k < j);
    if (span + 1u < n && shareFace(loop[i], loop[j])) largest = -1;
    chord[i * kLongestLoop + j] = uint(largest) << 4 | chosen;
    ++i;
    if (i + span >= n) {
      i = 0u;
      ++span;
    }
  } while (span < n);
}
