// Lists the triangles of a loop in pre-order, from the apexes of its chords. The chords that still have to be divided
// form a chain along the loop. The chain is stored as the index of the point where its first chord starts, and a mask
// with one bit for each point where a chord ends.

struct Chords {
  uint from, ends;
};

Chords wholeLoop(uint n) { return Chords(0u, 1u << (n - 1u)); }
bool anyLeft(Chords c) { return c.ends >> c.from > 1u; }
uint endOfFirst(Chords c) { return c.from + 1u + uint(findLSB(c.ends >> (c.from + 1u))); }

// Divides the first chord at its apex into two chords. A chord that is a side of the loop is dropped.
void cutFirst(inout Chords c, uint apex) {
  c.ends |= 1u << apex;
  c.from += uint(findLSB(~(c.ends >> (c.from + 1u))));
}
