#pragma once
// Properties of ops that tapes need: the number of operands, whether the op reads a position, the number of parameter
// words, and its turn in a sweep.

#include <cstdint>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kFirstWords = 28;  ///< number of parameter words that fit into the first 32 words of a record

struct OpShape {
  uint32_t operands = 0;
  bool position = false;
  uint32_t words = 0;  ///< maximum number of parameter words of an op that does not read a position
};

OpShape shapeOf(Op op);

/// Returns the turn of a kind of instruction (an Op or a TapeOp) within a sweep.
uint32_t sweepRank(uint32_t kind);

/// Returns the number of parameter words of an op. p: its parameters.
uint32_t parameterWords(Op op, const uint32_t* p);

}  // namespace sgm
