// The words that the mesher's shaders and the host share (runtime/backend/vulkan/batch_layout.h says the same in C++).
//
// One batch meshes many chunks. Places are in words from a buffer's beginning. A part is what is drawn as a whole: the
// body of a chunk, or one seam.

layout(std430, set = 0, binding = 0) restrict readonly buffer Batch { uint batch[]; };
layout(std430, set = 0, binding = 1) restrict buffer Scratch { uint scratch[]; };
layout(std430, set = 0, binding = 2) restrict buffer Parts { uint parts[]; };
layout(std430, set = 0, binding = 3) restrict buffer Vertices { uvec4 vertices[]; };
layout(std430, set = 0, binding = 4) restrict buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) restrict readonly buffer Tables { uint tables[]; };

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
const uint kChunkRowStarts = 6u;  // where in scratch: three words a row, what lies before it: vertices, indices, cells
const uint kChunkPart = 7u;     // the number of its body among the parts; kNoRoom where no body is asked for
const uint kChunkTape = 8u;     // eight more words, of the field's program (tape.glsl)

// A seam's record in batch.
const uint kSeamWords = 8u;
const uint kSeamChunk = 0u;    // number of its chunk in the batch
const uint kSeamFace = 1u;     // as Face
const uint kSeamSamples = 2u;  // where in scratch: Q of the 17^2 coarse samples of the face, a fastest
const uint kSeamSigns = 3u;    // where in scratch: a word for each b, bit a
const uint kSeamCounts = 4u;   // where in scratch: kSeamCountWords of running counts
const uint kSeamPart = 5u;     // its number among the parts
const uint kSeamCountWords = 352u;

// The head of the parts' buffer, and a record for each part behind it.
const uint kHeadDispatch = 0u;  // three words: workgroups for the batch's active cells
const uint kHeadCells = 3u;     // active cells of all bodies that have room
const uint kHeadVertices = 4u;  // of all parts that have room
const uint kHeadIndices = 5u;
const uint kHeadWords = 16u;
const uint kPartWords = 8u;
const uint kPartVertices = 0u;
const uint kPartIndices = 1u;
const uint kPartFirstVertex = 2u;  // kNoRoom: this part is not emitted
const uint kPartFirstIndex = 3u;
const uint kPartHash = 4u;    // two words
const uint kPartCells = 6u;   // a body: its active cells. A seam: its vertices on fine edges
const uint kPartMiddle = 7u;  // a body: its first place in the list of active cells. A seam: vertices on coarse edges
