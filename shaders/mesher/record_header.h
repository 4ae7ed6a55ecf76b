// What a header says of its record, as GLSL and as C++ (backend/vulkan/tape.cpp).

// A header of a record (one vector: its first two words, its place in units of 32 words, and what it is).
const uint kOperands = 3u;        // bits 0, 1: how many slots it reads
const uint kReadsPosition = 4u;
const uint kBeginsTwo = 8u;       // makes two values
const uint kAddsTo = 16u;         // adds to two values
const uint kEndsRound = 32u;
const uint kMakesPlace = 64u;
const uint kChooses = 128u;       // may come down to one of its first two operands
const uint kAddsRound = 256u;
const uint kCuts = 512u;          // of a fold: into what is taken away. Of a layer's end: there is such
const uint kIsFold = 1024u;
const uint kIsSmooth = 2048u;
const uint kIsLayerEnd = 4096u;

// Of the parameters of a mix, a morph and what is added to a sum.
const uint kBy = 2u;          // the constant that it goes by
const uint kHow = 3u;         // bits:
const uint kByConstant = 1u;  // a mix, a morph: by that, not by its third operand. A sum: adds the morph by it
const uint kWeighs = 2u;      // a sum: adds the kernel of its operand
