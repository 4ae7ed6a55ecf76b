// Offsets of the case tables in the words of binding 5, for GLSL and C++ (backend/vulkan/case_tables.h).

// A cube's case has four words: its edges in loop order, four bits each (two words); the lengths of its loops, three
// bits each; and a bit for each chord that chordMask forbids (mesh/tables.h). Chord (i, j) of a loop of n points has
// bit i + (j - 1) (j - 2) / 2, behind the (n - 1) (n - 2) / 2 bits of each previous loop.
const uint kCubeCases = 0u;

// A seam cell's case has one word: the offset of its bytes in kSeamBytes and, from bit kSeamTrianglesShift on, its
// number of triangles.
const uint kSeamCases = 1024u;
const uint kSeamTrianglesShift = 20u;

// The face masks of a seam cell's edges, one word each.
const uint kSeamFaces = 9216u;

// The bytes of kSeamLoops (mesh/tables.h), four per word, the first in the lowest bits.
const uint kSeamBytes = 9236u;
const uint kTableWords = 33820u;
