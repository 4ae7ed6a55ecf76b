#pragma once
// The reference evaluator: computes every op in double precision, from its geometric definition. Its results have the
// same bits on every machine. They are close to those of the float evaluators, but not equal. Interval bounds are built
// from the reference value at a box's centre.

#include <bit>
#include <cstdint>

#include "field/program.h"

namespace sgm {

/// Decodes a parameter word of an operation: a float, or an int32.
inline double realAt(const uint32_t* params, int i) { return double{std::bit_cast<float>(params[i])}; }
inline double wholeAt(const uint32_t* params, int i) { return static_cast<double>(static_cast<int32_t>(params[i])); }

/// Returns the value in units of a primitive (Op::sphere to Op::prism, except power_morph), or the weight of a blob, at
/// a position in units.
double referencePrimitive(Op op, const uint32_t* params, double x, double y, double z);

/// Returns the value of the noise op at p, -1 to 1.
double referenceNoise(const uint32_t* params, Int3 p);

/// Returns the value of the op power_morph, in units, at a position in units. t: the progress of the morph, 0..1.
double referencePowerMorph(const uint32_t* params, double t, double x, double y, double z);

/// Returns the value of the field at p, in units.
double referenceField(const ProgramView& program, Int3 p);

}  // namespace sgm
