#pragma once
// Derives leaf shapes from primitives.

#include <cstdint>
#include <initializer_list>

#include "derive/interpret/cell_context.h"
#include "derive/interpret/env.h"

namespace sgm::interpret {

/// Derives a call of a primitive. A leaf with an invalid size is left out, with a note. node: the call.
void addPrimitive(Primitive kind, const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env,
                  ShapeList& out);

/// Derives the primitive `ca`: the voxels of a cellular automaton in the whole cell (voxels.cpp).
void addAutomaton(const ExprNode& node, uint32_t ordinal, CellContext& c, const Env& env, ShapeList& out);

/// Returns the exponent of a superquadric: 2 at squareness 0, kMaxPower at 1.
double exponentOfSquare(double square);

}  // namespace sgm::interpret
