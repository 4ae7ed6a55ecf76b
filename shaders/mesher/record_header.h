// The meaning of the headers and records of a tape (a field program for shaders), for GLSL and C++
// (backend/vulkan/tape.cpp).

// The header of a record is one vector: the first two words of the record, its offset in units of 32 words, and these
// flags.
const uint kOperands = 3u;  // bits 0, 1: number of operands; an unused operand before a used one is counted
const uint kReadsPosition = 4u;
const uint kBeginsTwo = 8u;  // the record sets the initial values of two slots
const uint kAddsTo = 16u;    // the record adds to the values of two slots
const uint kEndsRound = 32u;
const uint kMakesPlace = 64u;
const uint kChooses = 128u;  // pruning may reduce the record to one of its first two operands
const uint kAddsRound = 256u;
const uint kCuts = 512u;  // for a fold, which joins a group of shapes to its layer: the group is cut from the
                          // layer; for the end of a layer: the layer has cuts
const uint kIsFold = 1024u;
const uint kIsSmooth = 2048u;
const uint kIsLayerEnd = 4096u;

// Parameter words of a record that contain additional parameters of a mix, of a morph, or of the value that a sum adds.
// These ops have few parameters of their own, so the words are free.
const uint kByWord = 2u;         // for a mix, a morph, or a sum that adds a morph: constant value of the parameter t
const uint kHowWord = 3u;        // word that contains these bits:
const uint kHowByConstant = 1u;  // bit, for a mix or a morph: the parameter t is the constant in the word kByWord, not
                                 // the third operand
const uint kHowMorphs = 2u;      // bit, for a sum: the value that is added is the morph of the sum's first and third
                                 // operands
const uint kHowWeighs = 4u;      // bit, for a sum: the kernel weight of the value is added instead of the value

// Flags for a whole tape: which variants of instructions occur. They are stored in the upper word of the mask of kinds.
const uint kSomeReadsThird = 0x80000000u;  // the tape has a mix or a morph that takes its parameter t from an operand
const uint kSomeMorphs = 0x40000000u;      // the tape has a sum that adds a morph
const uint kSomeWeighs = 0x20000000u;      // the tape has a sum that adds the kernel weight of a value
