#pragma once
// The judge: every op once more, in double precision and with the C library, from its geometric definition. Close to
// the float evaluators, never equal; interval bounds take its value at a box's centre.

#include "field/program.h"

namespace sgm {

/// Value in units of one primitive (sphere to prism; blob: its weight) at a position in units.
double referencePrimitive(Op op, const uint32_t* params, double x, double y, double z);

/// The power morph at t in 0..1.
double referencePowerMorph(const uint32_t* params, double t, double x, double y, double z);

/// The field in units at p.
double referenceField(const ProgramView& program, Int3 p);

}  // namespace sgm
