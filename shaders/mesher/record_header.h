// The meaning of the headers and records of a tape, for GLSL and C++ (backend/vulkan/tape.cpp).

// A record's header is one vector: the record's first two words, its offset in units of 32 words, and the following
// flags.
const uint kOperands = 3u;        // bits 0, 1: index of its last operand
const uint kReadsPosition = 4u;
const uint kBeginsTwo = 8u;       // it makes two values
const uint kAddsTo = 16u;         // it adds to two values
const uint kEndsRound = 32u;
const uint kMakesPlace = 64u;
const uint kChooses = 128u;       // pruning may reduce it to one of its first two operands
const uint kAddsRound = 256u;
const uint kCuts = 512u;          // of a fold: it joins the cuts; of a layer's end: the layer has cuts
const uint kIsFold = 1024u;
const uint kIsSmooth = 2048u;
const uint kIsLayerEnd = 4096u;

// Words for additional parameters of a mix, a morph, or what is added to a sum; these ops have fewer parameters of
// their own.
const uint kByWord = 2u;   // the constant parameter of a mix or a morph, or of the morph that is added to a sum
const uint kHowWord = 3u;  // the word with these bits:
const uint kHowByConstant = 1u;  // of a mix or a morph: the parameter is kByWord, not the third operand
const uint kHowMorphs = 2u;      // of a sum: it adds the morph of its first and third operand
const uint kHowWeighs = 4u;      // of a sum: what it adds is weighted by a kernel

// Flags in the upper word of the kinds of instructions in a tape.
const uint kSomeReadsThird = 0x80000000u;  // a mix or a morph has an operand as its parameter
const uint kSomeMorphs = 0x40000000u;      // a sum adds morphs
const uint kSomeWeighs = 0x20000000u;      // a sum weighs what it adds by a kernel
