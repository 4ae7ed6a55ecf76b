// What headers and records of a tape mean, as GLSL and as C++ (backend/vulkan/tape.cpp).

// A header of a record (one vector: its first two words, its place in units of 32 words, and what it is).
const uint kOperands = 3u;        // bits 0, 1: the number of its last operand
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

// Parameters of a mix, of a morph and of what is added to a sum, whose own are fewer: words,
const uint kByWord = 2u;   // the constant that a mix or a morph goes by, or the morph that is added
const uint kHowWord = 3u;  // bits:
const uint kHowByConstant = 1u;  // of a mix or a morph: by that, not by its third operand
const uint kHowMorphs = 2u;      // of a sum: it adds the morph of its first and third operand, or,
const uint kHowWeighs = 4u;      // after that, a kernel

// Kinds, beside those of instructions, bits of the upper word.
const uint kSomeReadsThird = 0x80000000u;  // some mix or morph goes by a value
const uint kSomeMorphs = 0x40000000u;      // some sum adds morphs,
const uint kSomeWeighs = 0x20000000u;      // or kernels
