// Where the case tables lie in the words of binding 5, as GLSL and as C++ (backend/vulkan/case_tables.h).

// A cube's case, four words: its edges in loop order, four bits each (two words); the loops' lengths from the first on,
// three bits each; and a bit for each chord that chordMask forbids (mesh/tables.h). Chord (i, j) of a loop of n points has bit
// i + (j - 1) (j - 2) / 2, behind the (n - 1) (n - 2) / 2 bits of each loop before.
const uint kCubeCases = 0u;

// A seam cell's case, a word: where its bytes begin in kSeamBytes, and from bit kSeamTrianglesShift on its triangles.
const uint kSeamCases = 1024u;
const uint kSeamTrianglesShift = 20u;

// The faces of a seam cell's edges, a word each.
const uint kSeamFaces = 9216u;

// kSeamLoops of mesh/tables.h, four bytes a word, the first lowest.
const uint kSeamBytes = 9236u;
const uint kTableWords = 33820u;
