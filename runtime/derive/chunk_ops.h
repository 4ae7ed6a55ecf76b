#pragma once
// Operations on a whole derived chunk.

#include <cstdint>

#include "derive/shape.h"

namespace sgm {

/// Moves everything by an integer offset in units: frames, group bounds, anchors, sweeps, the anchors of coordinates
/// and the origins of noise. The field of the result at p + offset equals that of the chunk at p, to the bit. Positions
/// saturate at the ends of the world. `cell` is unchanged.
void translate(GrammarChunk& chunk, Int3 offset);

/// Hash of everything visible to a mesh or a game: all except notes and the order in memory. Equal on every machine.
uint64_t hashChunk(const GrammarChunk& chunk);

}  // namespace sgm
