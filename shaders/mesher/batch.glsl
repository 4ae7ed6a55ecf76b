// Layout of the buffers that the mesher's shaders and the CPU share (the same definitions in C++:
// runtime/backend/vulkan/batch_layout.h).
//
// A batch consists of many chunks. Offsets are in words from the start of a buffer, and multiples of four. A part is a
// mesh that is drawn as a whole: the body of a chunk, or one seam.

layout(std430, set = 0, binding = 0) readonly buffer Batch { uint batch[]; };
layout(std430, set = 0, binding = 1) buffer Scratch { uint scratch[]; };
layout(std430, set = 0, binding = 2) buffer Parts { uint parts[]; };
layout(std430, set = 0, binding = 3) restrict buffer Vertices { uvec4 vertices[]; };
layout(std430, set = 0, binding = 4) restrict buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) readonly buffer Tables { uint tables[]; };

// The same buffers as vectors of two and four words: on a software device, reading four words at once takes as long as
// reading one.
layout(std430, set = 0, binding = 0) readonly buffer BatchFours { uvec4 batch_fours[]; };
layout(std430, set = 0, binding = 1) buffer ScratchPairs { uvec2 scratch_pairs[]; };
layout(std430, set = 0, binding = 1) buffer ScratchFours { uvec4 scratch_fours[]; };
layout(std430, set = 0, binding = 2) buffer PartFours { uvec4 part_fours[]; };
layout(std430, set = 0, binding = 5) readonly buffer TableFours { uvec4 table_fours[]; };

const uint kSide = 33u;        // samples along each axis of a chunk
const uint kCells = 32u;       // cells along each axis of a chunk
const uint kRows = 1089u;      // rows of samples in a chunk; the index of a row is y + 33 z
const uint kCoarseSide = 17u;  // samples of the coarser level along a side of a chunk's face
const uint kNoRoom = 0xFFFFFFFFu;

// The record of a chunk in `batch`. The constants below are offsets from its start.
const uint kChunkWords = 16u;
const uint kChunkOrigin = 0u;   // origin of the chunk: three words, in units
const uint kChunkCell = 3u;     // in units
const uint kChunkSamples = 4u;  // offset in `scratch` of the chunk's samples: quantised values Q of all 33^3, x fastest
const uint kChunkSigns = 5u;    // offset in `scratch` of the signs: two words per row, for samples 0..31 and sample 32
const uint kChunkRows = 6u;     // offset in `scratch` of the counts of the chunk's rows (kRowWords and below),
                                // kRowsWords words
const uint kChunkPart = 7u;     // index of the chunk's body among the parts; kNoRoom: no body is requested
const uint kChunkFaces = 8u;    // faces that have seams, bit (1 << Face), for a chunk whose body is not requested;
                                // otherwise 0

// The counts of a chunk's rows. Four words per row: the numbers of vertices, of indices and of active cells before the
// row, and a mask of the row's active cells. After all rows: the number of rows that have active cells, and a list of
// these rows.
const uint kRowWords = 4u;
const uint kActiveRows = 4356u;
const uint kActiveRowList = 4357u;
const uint kRowsWords = 5384u;

// The record of a seam in `batch`. The constants below are offsets from its start.
const uint kSeamWords = 8u;
const uint kSeamChunk = 0u;    // index of the seam's chunk in the batch
const uint kSeamFace = 1u;     // face of the chunk: value of the enum Face
const uint kSeamSamples = 2u;  // offset in `scratch` of the 17^2 coarse samples of the face: quantised values Q, a
                               // fastest
const uint kSeamSigns = 3u;    // offset in `scratch` of the coarse signs: one word per row b; its bit a is the sign of
                               // sample (a, b)
const uint kSeamCounts = 4u;   // offset in `scratch` of the seam's counts, kSeamCountWords words
const uint kSeamPart = 5u;     // index of the seam among the parts

// The counts of a seam: offsets in words from kSeamCounts. The first three arrays store, for each row of samples, the
// number of the row's first vertex.
const uint kSeamFineRows = 0u;      // 33
const uint kSeamCoarseRows = 33u;   // 17
const uint kSeamLateralRows = 50u;  // 17
const uint kSeamActive = 67u;       // number of active cells of the seam
// one word for each active cell (a, b): a + 16 b and, from bit 8 on, the number of triangles before this cell
const uint kSeamCells = 68u;
const uint kSeamPlane = 324u;       // two words for each row b: bit a is the sign of the chunk's own sample (a, b) on
                                    // the face
const uint kSeamCountWords = 392u;

// The header of the buffer `parts`. A record for each part follows.
const uint kHeadDispatch = 0u;  // three words for an indirect dispatch: numbers of workgroups for the batch's active
                                // cells
const uint kHeadCells = 3u;     // number of active cells of all bodies that fit into the buffers
const uint kHeadVertices = 4u;  // number of vertices of all parts that fit into the buffers
const uint kHeadIndices = 5u;
const uint kHeadSampled = 6u;   // three words for an indirect dispatch: one workgroup for each slice of an item that
                                // has to be sampled (a box of samples, items.glsl)
const uint kHeadEntries = 9u;   // number of entries in the list of vertices by brick (a box of 8^3 samples, items.glsl)
const uint kHeadUnits = 10u;    // three words for an indirect dispatch: one workgroup for each unit of attributes (some
                                // vertices whose attributes are computed together, items.glsl)
const uint kHeadWords = 16u;
const uint kPartWords = 8u;
const uint kPartVertices = 0u;
const uint kPartIndices = 1u;
const uint kPartFirstVertex = 2u;  // index of the part's first vertex; kNoRoom: the part does not fit into the buffers,
                                   // and is not written
const uint kPartFirstIndex = 3u;   // first index of the part; kNoRoom if the part does not fit
const uint kPartHash = 4u;         // two words
const uint kPartCells = 6u;        // for a body: number of its active cells; for a seam: number of its vertices on
                                   // edges of the finer level
// For a body: kNoRoom at first; after allocation, the position of its first cell in the list of active cells. For a
// seam: the number of its vertices on edges of the coarser level.
const uint kPartMiddle = 7u;

// The sums over triangles, if requested; they follow the records of the parts. For each part: twice its area, the three
// components of its cross product, and six times its volume, each as a low and a high word (sums.comp). Initially zero.
const uint kSumWords = 10u;

// size in words of an active cell in `scratch`, which is packed by packCell (cells.glsl)
const uint kCellWords = 4u;
