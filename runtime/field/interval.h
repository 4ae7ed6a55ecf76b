#pragma once
// Bounds of the results of the float evaluators over a box of positions, including rounding: exact arithmetic on
// intervals, widened by each op's stated error (ops.def).

#include "field/program.h"

namespace sgm {

/// A closed interval with finite ends (magnitudes are clamped to 1e37).
struct Interval {
  double lo = 0, hi = 0;
};

/// A box of positions, in units: it contains all positions that one position register (a place, program.h) may hold.
struct PlaceBox {
  Interval x, y, z;
};

PlaceBox placeBox(const IntBox& box);

/// Returns the relative error that ops.def states for the op.
double statedError(Op op);

/// Returns the sum of the sizes of a primitive that affect its value. The relative error of the op (ops.def) refers to
/// this sum plus the distance of the position from the primitive's centre.
double sizeSum(Op op, const uint32_t* params);

/// Returns bounds of an op that reads a position. t: the operand of power_morph; ignored by other ops.
Interval boundPosition(Op op, const uint32_t* params, const PlaceBox& box, Interval t);

/// Returns bounds of an op on operands a, b, c. Does not support accumulating ops and warps.
Interval boundOperands(Op op, const uint32_t* params, Interval a, Interval b, Interval c);

/// Returns bounds of the value at the end of a round union. nearest, sum: bounds of the union's two registers (the
/// smallest operand, and the sum of the amounts of boundRoundShare()).
Interval boundRoundEnd(const uint32_t* params, Interval nearest, Interval sum);
Interval boundSumEnd(const uint32_t* params, Interval sum);
/// Returns bounds of the amount that one operand adds to the sum of a round union. d: bounds of the operand.
Interval boundRoundShare(const uint32_t* params, Interval d);
/// boundRoundUnion() returns bounds of the round union of the field (a) and a smooth group (b; program.h) whose blend
/// has the width k > 0; boundRoundCut() returns bounds of the field minus the group.
Interval boundRoundUnion(Interval a, Interval b, double k);
Interval boundRoundCut(Interval a, Interval b, double k);

}  // namespace sgm
