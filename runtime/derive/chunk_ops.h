#pragma once
// Operations on a whole grammar chunk.

#include <cstdint>

#include "derive/shape.h"

namespace sgm {

/// Moves all content by an integer offset in units: frames, group bounds, anchors, sweeps, the origins of coordinates
/// and of noise. The field of the result at p + offset equals that of the original at p, bit for bit. Positions
/// saturate at the ends of the world. `cell` is unchanged.
void translate(GrammarChunk& chunk, Int3 offset);

/// Returns a hash of the whole chunk, including the order and the indices of its elements, except its notes and its set
/// of parameters. Equal on every machine.
uint64_t hashChunk(const GrammarChunk& chunk);

}  // namespace sgm
