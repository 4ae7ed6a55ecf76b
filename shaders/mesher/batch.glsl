// The words that the mesher's shaders and the host share (the same definitions in C++:
// runtime/backend/vulkan/batch_layout.h).
//
// A batch consists of many chunks. Offsets are in words from the beginning of a buffer, and multiples of four. A part
// is a mesh that is drawn as a whole: the body of a chunk, or one seam.

layout(std430, set = 0, binding = 0) readonly buffer Batch { uint batch[]; };
layout(std430, set = 0, binding = 1) buffer Scratch { uint scratch[]; };
layout(std430, set = 0, binding = 2) buffer Parts { uint parts[]; };
layout(std430, set = 0, binding = 3) restrict buffer Vertices { uvec4 vertices[]; };
layout(std430, set = 0, binding = 4) restrict buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) readonly buffer Tables { uint tables[]; };

// The same words as vectors of two and four: on a software device, reading four words at once takes as long as one.
layout(std430, set = 0, binding = 0) readonly buffer BatchFours { uvec4 batch_fours[]; };
layout(std430, set = 0, binding = 1) buffer ScratchPairs { uvec2 scratch_pairs[]; };
layout(std430, set = 0, binding = 1) buffer ScratchFours { uvec4 scratch_fours[]; };
layout(std430, set = 0, binding = 2) buffer PartFours { uvec4 part_fours[]; };
layout(std430, set = 0, binding = 5) readonly buffer TableFours { uvec4 table_fours[]; };

const uint kSide = 33u;        // samples on each axis
const uint kCells = 32u;       // cells on each axis
const uint kRows = 1089u;      // rows of samples, with index y + 33 z
const uint kCoarseSide = 17u;  // coarse samples along a side of a face
const uint kNoRoom = 0xFFFFFFFFu;

// The record of a chunk in `batch`; the following constants are offsets from its beginning.
const uint kChunkWords = 16u;
const uint kChunkOrigin = 0u;   // three words, in units
const uint kChunkCell = 3u;     // in units
const uint kChunkSamples = 4u;  // offset in scratch of the chunk's samples: Q of all 33^3, x fastest
const uint kChunkSigns = 5u;    // offset in scratch of the signs: two words per row, samples 0..31 and sample 32
const uint kChunkRows = 6u;     // offset in scratch of kRowsWords words: the counts of the rows
const uint kChunkPart = 7u;     // index of its body among the parts; kNoRoom: no body is requested
const uint kChunkFaces = 8u;    // of a chunk without a body: the faces that have seams, bit (1 << Face); otherwise 0

// The counts of a chunk's rows. Four words per row: the numbers of vertices, of indices and of active cells before the
// row, and a mask of the row's active cells. Behind them: the number of rows that have active cells, and a list of
// these rows.
const uint kRowWords = 4u;
const uint kActiveRows = 4356u;
const uint kActiveRowList = 4357u;
const uint kRowsWords = 5384u;

// The record of a seam in `batch`.
const uint kSeamWords = 8u;
const uint kSeamChunk = 0u;    // index of its chunk in the batch
const uint kSeamFace = 1u;     // number of a Face
const uint kSeamSamples = 2u;  // offset in scratch of Q of the 17^2 coarse samples of the face, a fastest
const uint kSeamSigns = 3u;    // offset in scratch of the coarse signs: one word for each b, with bit a
const uint kSeamCounts = 4u;   // offset in scratch of kSeamCountWords words: the counts
const uint kSeamPart = 5u;     // its index among the parts

// The counts of a seam, as offsets in words from kSeamCounts. The number of a row is that of its first vertex.
const uint kSeamFineRows = 0u;      // 33
const uint kSeamCoarseRows = 33u;   // 17
const uint kSeamLateralRows = 50u;  // 17
const uint kSeamActive = 67u;       // number of active cells
// for each active cell: a + 16 b, and from bit 8 on the number of triangles before it
const uint kSeamCells = 68u;
const uint kSeamPlane = 324u;       // two words for each b: the chunk's signs on the face, bit a
const uint kSeamCountWords = 392u;

// The head of the parts' buffer; a record for each part follows.
const uint kHeadDispatch = 0u;  // three words: numbers of workgroups for the batch's active cells
const uint kHeadCells = 3u;     // number of active cells of all bodies for which there is memory
const uint kHeadVertices = 4u;  // number of vertices of all parts for which there is memory
const uint kHeadIndices = 5u;
const uint kHeadSampled = 6u;   // three words: numbers of workgroups, one for each slice of an item that is sampled
const uint kHeadEntries = 9u;   // number of entries in the list of vertices by brick
const uint kHeadUnits = 10u;    // three words: numbers of workgroups, one for each unit of attributes
const uint kHeadWords = 16u;
const uint kPartWords = 8u;
const uint kPartVertices = 0u;
const uint kPartIndices = 1u;
const uint kPartFirstVertex = 2u;  // kNoRoom: there is no memory for the part, which is not written
const uint kPartFirstIndex = 3u;   // kNoRoom: same as above
const uint kPartHash = 4u;         // two words
const uint kPartCells = 6u;        // body: number of its active cells; seam: number of its vertices on fine edges
// body: kNoRoom; after allocation, its first index in the list of active cells. Seam: number of its vertices on coarse
// edges
const uint kPartMiddle = 7u;

// The sums follow the parts' records, if they are requested. For each part: twice its area, the three components of its
// cross product, and six times its volume, each as a low and a high word (sums.comp). Initially zero.
const uint kSumWords = 10u;

// An active cell in scratch, packed (cells.glsl).
const uint kCellWords = 4u;
