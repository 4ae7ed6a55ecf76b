#pragma once
// Properties of ops that tapes need: the number of operands, whether the op reads a position, the number of parameter
// words, and the op's turn in a sweep (when a shader runs it, relative to other ops).

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

/// Returns the rank of a kind of instruction (an Op or a TapeOp) within a sweep: a shader runs kinds of lower rank
/// first.
uint32_t sweepRank(uint32_t kind);

/// Returns the number of parameter words of an op. p: its parameters.
uint32_t parameterWords(Op op, const uint32_t* p);

}  // namespace sgm
