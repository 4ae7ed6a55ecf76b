#pragma once
// Bounds of the results of the float evaluators over a box of positions, including rounding: exact arithmetic on
// intervals, widened by each op's stated error (ops.def).

#include "field/program.h"

namespace sgm {

/// Closed; both ends finite (magnitudes are clamped to 1e37).
struct Interval {
  double lo = 0, hi = 0;
};

/// A box of positions at one place, in units.
struct PlaceBox {
  Interval x, y, z;
};

PlaceBox placeBox(const IntBox& box);

/// The op's relative error in ops.def.
double statedError(Op op);

/// The sum of the sizes in a primitive's value, apart from its offset: its rounding error is relative to the sum of
/// both.
double sizeSum(Op op, const uint32_t* params);

/// Bounds of an op that reads a position (t: the operand of power_morph).
Interval boundPosition(Op op, const uint32_t* params, const PlaceBox& box, Interval t);

/// Bounds of an op on operands; not for accumulating ops and warps.
Interval boundOperands(Op op, const uint32_t* params, Interval a, Interval b, Interval c);

/// The end of a round union or a sum.
Interval boundRoundEnd(const uint32_t* params, Interval nearest, Interval sum);
Interval boundSumEnd(const uint32_t* params, Interval sum);
/// The contribution of one operand to a round union's sum.
Interval boundRoundShare(const uint32_t* params, Interval d);
/// A field and a smooth group (program.h) of width k > 0: their round union, and the field minus the group.
Interval boundRoundUnion(Interval a, Interval b, double k);
Interval boundRoundCut(Interval a, Interval b, double k);

}  // namespace sgm
