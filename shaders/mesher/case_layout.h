// Offsets of the marching-cubes case tables in the words of binding 5, for GLSL and C++ (backend/vulkan/case_tables.h).

// The case of a cube has four words: its edges in the order of its loops, four bits each (two words); the lengths of
// its loops, three bits each; and a bit for each chord that chordMask forbids (mesh/tables.h). Chord (i, j) of a loop
// of n points has bit i + (j - 1) (j - 2) / 2, after the (n - 1) (n - 2) / 2 bits of each previous loop.
const uint kCubeCases = 0u;

// The case of a seam cell has one word: the offset of its loops in kSeamBytes and, from bit kSeamTrianglesShift on, its
// number of triangles.
const uint kSeamCases = 1024u;
const uint kSeamTrianglesShift = 20u;

// The faces on which each edge of a seam cell lies, as a mask, one word per edge.
const uint kSeamFaces = 9216u;

// The bytes of kSeamLoops (mesh/tables.h), four per word, the first in the lowest bits.
const uint kSeamBytes = 9236u;
const uint kTableWords = 33820u;
