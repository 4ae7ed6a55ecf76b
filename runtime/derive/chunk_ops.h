#pragma once
// Whole-chunk operations on what a cell derived to.

#include <cstdint>

#include "derive/shape.h"

namespace sgm {

/// Moves everything by an integer offset in units: frames, group bounds, anchors, sweeps, the anchors of coordinates
/// and the origins of noise. The field of the result at p + offset is that of the chunk at p, to the bit. Positions
/// saturate at the ends of the world. `cell` is left as it is.
void translate(GrammarChunk& chunk, Int3 offset);

/// Hash of everything that a mesh or a game can see: all but the notes and the order of memory. Equal on every machine.
uint64_t hashChunk(const GrammarChunk& chunk);

}  // namespace sgm
