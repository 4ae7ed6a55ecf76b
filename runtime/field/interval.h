#pragma once
// Bounds of the results of the float evaluators over a box of positions, including rounding: exact arithmetic on
// intervals, widened by each op's stated error (ops.def).

#include "field/program.h"

namespace sgm {

/// A closed interval with finite ends (magnitudes are clamped to 1e37).
struct FloatInterval {
  double lo = 0, hi = 0;
};

/// A box of positions, in units: it contains all positions that one position register (a place, program.h) may hold.
struct PositionBox {
  FloatInterval x, y, z;
};

PositionBox positionBox(const IntBox& box);

/// Returns the relative error that ops.def states for the op.
double statedError(Op op);

/// Returns the sum of the sizes of a primitive that affect its value. The relative error of the op (ops.def) refers to
/// this sum plus the distance of the position from the primitive's centre.
double sizeSum(Op op, const uint32_t* params);

/// Returns bounds of an op that reads a position. t: the operand of power_morph; ignored by other ops.
FloatInterval boundPosition(Op op, const uint32_t* params, const PositionBox& box, FloatInterval t);

/// Returns bounds of an op on operands a, b, c. Does not support accumulating ops and warps.
FloatInterval boundOperands(Op op, const uint32_t* params, FloatInterval a, FloatInterval b, FloatInterval c);

/// Returns bounds of the value at the end of a round union. nearest, sum: bounds of the union's two registers (the
/// smallest operand, and the sum of the amounts of boundRoundShare()).
FloatInterval boundRoundEnd(const uint32_t* params, FloatInterval nearest, FloatInterval sum);
FloatInterval boundSumEnd(const uint32_t* params, FloatInterval sum);
/// Returns bounds of the amount that one operand adds to the sum of a round union. d: bounds of the operand.
FloatInterval boundRoundShare(const uint32_t* params, FloatInterval d);
/// boundRoundUnion() returns bounds of the round union of the field (a) and a smooth group (b; program.h) whose blend
/// has the width k > 0; boundRoundCut() returns bounds of the field minus the group.
FloatInterval boundRoundUnion(FloatInterval a, FloatInterval b, double k);
FloatInterval boundRoundCut(FloatInterval a, FloatInterval b, double k);

}  // namespace sgm
