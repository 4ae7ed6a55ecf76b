#pragma once
// What a tape has to know of an op: how many values it reads, whether it reads the position, how many words of
// parameters, when a sweep comes to it.

#include <cstdint>

#include "field/program.h"

namespace sgm {

inline constexpr uint32_t kFirstWords = 28;  ///< of parameters, in a record's first 32 words

struct OpShape {
  uint32_t operands = 0;
  bool position = false;
  uint32_t words = 0;  ///< of parameters, at most, where it does not read a position
};

OpShape shapeOf(Op op);

/// The turn of a kind of instruction (TapeOp) within a sweep.
uint32_t sweepRank(uint32_t kind);

/// How many words of parameters an op has, at most. p: its parameters.
uint32_t parameterWords(Op op, const uint32_t* p);

}  // namespace sgm
