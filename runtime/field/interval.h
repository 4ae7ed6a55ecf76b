#pragma once
// Bounds of what the float evaluators can return over a box of positions, their rounding included: exact arithmetic on
// intervals, widened by each op's stated error (ops.def).

#include "field/program.h"

namespace sgm {

/// Closed; both ends finite (magnitudes are held to 1e37).
struct Interval {
  double lo = 0, hi = 0;
};

/// A box of positions of one place, in units.
struct PlaceBox {
  Interval x, y, z;
};

PlaceBox placeBox(const IntBox& box);

/// The op's relative error in ops.def.
double statedError(Op op);

/// The sizes that enter a primitive's value beside its offset: its rounding is relative to the sum of both.
double sizeSum(Op op, const uint32_t* params);

/// Bounds of an op that reads a position (t: the operand of power_morph).
Interval boundPosition(Op op, const uint32_t* params, const PlaceBox& box, Interval t);

/// Bounds of an op over operands; accumulating and place-changing ops are not among them.
Interval boundOperands(Op op, const uint32_t* params, Interval a, Interval b, Interval c);

/// Where a round union or a sum ends.
Interval boundRoundEnd(const uint32_t* params, Interval nearest, Interval sum);
Interval boundSumEnd(const uint32_t* params, Interval sum);
/// One operand's share of a round union's sum.
Interval boundRoundShare(const uint32_t* params, Interval d);
/// A field and a smooth group (program.h) of width k > 0: their round union, and the field without the group.
Interval boundRoundUnion(Interval a, Interval b, double k);
Interval boundRoundCut(Interval a, Interval b, double k);

}  // namespace sgm
