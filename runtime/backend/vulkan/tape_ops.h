#pragma once
// Properties of ops for tapes: the number of values read, whether they read the position, the words of parameters, and
// their turn in a sweep.

#include <cstdint>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kFirstWords = 28;  ///< of parameters, among a record's first 32 words

struct OpShape {
  uint32_t operands = 0;
  bool position = false;
  uint32_t words = 0;  ///< the most words of parameters, if it does not read a position
};

OpShape shapeOf(Op op);

/// The turn of a kind of instruction (TapeOp) within a sweep.
uint32_t sweepRank(uint32_t kind);

/// The largest number of parameter words of an op. p: its parameters.
uint32_t parameterWords(Op op, const uint32_t* p);

}  // namespace sgm
