// The words that the mesher's shaders and the host share (runtime/backend/vulkan/batch_layout.h says the same in C++).
//
// One batch meshes many chunks. Places are in words from a buffer's beginning, multiples of four. A part is what is
// drawn as a whole: the body of a chunk, or one seam.

layout(std430, set = 0, binding = 0) readonly buffer Batch { uint batch[]; };
layout(std430, set = 0, binding = 1) buffer Scratch { uint scratch[]; };
layout(std430, set = 0, binding = 2) buffer Parts { uint parts[]; };
layout(std430, set = 0, binding = 3) restrict buffer Vertices { uvec4 vertices[]; };
layout(std430, set = 0, binding = 4) restrict buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) readonly buffer Tables { uint tables[]; };

// The same words in pairs and fours: four words at once cost a software device as much as one.
layout(std430, set = 0, binding = 0) readonly buffer BatchFours { uvec4 batch_fours[]; };
layout(std430, set = 0, binding = 1) buffer ScratchPairs { uvec2 scratch_pairs[]; };
layout(std430, set = 0, binding = 1) buffer ScratchFours { uvec4 scratch_fours[]; };
layout(std430, set = 0, binding = 2) buffer PartFours { uvec4 part_fours[]; };
layout(std430, set = 0, binding = 5) readonly buffer TableFours { uvec4 table_fours[]; };

const uint kSide = 33u;        // samples on each axis
const uint kCells = 32u;       // cells on each axis
const uint kRows = 1089u;      // rows of samples, y + 33 z
const uint kCoarseSide = 17u;  // coarse samples along a side of a face
const uint kNoRoom = 0xFFFFFFFFu;

// A chunk's record in batch, from its place on.
const uint kChunkWords = 16u;
const uint kChunkOrigin = 0u;   // three words, units
const uint kChunkCell = 3u;     // units
const uint kChunkSamples = 4u;  // where in scratch its samples lie: Q of all 33^3, x fastest
const uint kChunkSigns = 5u;    // where in scratch: two words a row, samples 0..31 and sample 32
const uint kChunkRows = 6u;     // where in scratch: kRowsWords, what the census says of the rows
const uint kChunkPart = 7u;     // the number of its body among the parts; kNoRoom where no body is asked for
const uint kChunkFaces = 8u;    // 0, or of a chunk without a body the faces that it has seams on, bit (1 << Face)

// What the census says of a chunk's rows. Four words a row: the vertices, the indices and the active cells before it, and
// the active cells of its own, a bit each. Behind them how many rows have active cells, and which.
const uint kRowWords = 4u;
const uint kActiveRows = 4356u;
const uint kActiveRowList = 4357u;
const uint kRowsWords = 5384u;

// A seam's record in batch.
const uint kSeamWords = 8u;
const uint kSeamChunk = 0u;    // number of its chunk in the batch
const uint kSeamFace = 1u;     // as Face
const uint kSeamSamples = 2u;  // where in scratch: Q of the 17^2 coarse samples of the face, a fastest
const uint kSeamSigns = 3u;    // where in scratch: a word for each b, bit a
const uint kSeamCounts = 4u;   // where in scratch: kSeamCountWords
const uint kSeamPart = 5u;     // its number among the parts

// What the census of a seam leaves, in words from kSeamCounts on. A row's number is that of its first vertex.
const uint kSeamFineRows = 0u;      // 33
const uint kSeamCoarseRows = 33u;   // 17
const uint kSeamLateralRows = 50u;  // 17
const uint kSeamActive = 67u;       // how many cells are active
const uint kSeamCells = 68u;        // for each of them a + 16 b, and from bit 8 on the triangles before it
const uint kSeamPlane = 324u;       // two words for each b: the chunk's signs on the face, bit a
const uint kSeamCountWords = 392u;

// The head of the parts' buffer, and a record for each part behind it.
const uint kHeadDispatch = 0u;  // three words: workgroups for the batch's active cells
const uint kHeadCells = 3u;     // active cells of all bodies that have room
const uint kHeadVertices = 4u;  // of all parts that have room
const uint kHeadIndices = 5u;
const uint kHeadSampled = 6u;   // three words: workgroups, one a slice of an item that is sampled
const uint kHeadEntries = 9u;   // entries of the list of vertices by brick
const uint kHeadUnits = 10u;    // three words: workgroups, one a unit of attributes
const uint kHeadWords = 16u;
const uint kPartWords = 8u;
const uint kPartVertices = 0u;
const uint kPartIndices = 1u;
const uint kPartFirstVertex = 2u;  // kNoRoom: this part is not emitted
const uint kPartFirstIndex = 3u;   // kNoRoom as well
const uint kPartHash = 4u;         // two words
const uint kPartCells = 6u;        // a body: its active cells. A seam: its vertices on fine edges
const uint kPartMiddle = 7u;       // a body: kNoRoom, once allocated its first place in the list of active cells.
                                   // A seam: its vertices on coarse edges

// Behind the parts' records, where sums are asked for: for each part twice its area, its cross product's three and six
// times its volume, a low and a high word each (sums.comp). Zero at first.
const uint kSumWords = 10u;

// An active cell in scratch, packed (cells.glsl).
const uint kCellWords = 4u;
