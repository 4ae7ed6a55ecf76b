#pragma once
// Computes bounds of a field over a box in float32 (shaders/common/bounds.h), and prunes its program to that box.

#include <algorithm>

#include "cuda/kernels/batch.h"
#include "cuda/kernels/field.h"

namespace sgm::cuda {

namespace bounding {

using at_point::bitsToReal;
using namespace at_point;

SGM_KERNEL float min(float a, float b) { return a < b ? a : b; }
SGM_KERNEL float max(float a, float b) { return a > b ? a : b; }
SGM_KERNEL float abs(float a) { return absReal(a); }
SGM_KERNEL float clamp(float x, float lo, float hi) { return min(max(x, lo), hi); }
SGM_KERNEL float floor(float x) { return floorReal(x); }

struct Box3 {
  int lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;
};

#define SGM_OP(name, function, form, error) inline constexpr uint kOp_##name = static_cast<uint>(Op::name);
#include "field/ops.def"
#undef SGM_OP

struct StatedErrors {
  SGM_KERNEL float operator[](uint op) const {
    switch (op) {
#define SGM_OP(name, function, form, error) \
  case kOp_##name:                          \
    return static_cast<float>(error);
#include "field/ops.def"
#undef SGM_OP
      default:
        return 0;
    }
  }
};
#define kStatedErrors (StatedErrors{})
#include "common/bounds.h"
#undef kStatedErrors

using Scalar = float;
using Bound = Mark;
using Places = Box3;
inline constexpr float kNever = 3.0e38f, kLess = 0.999998f, kMore = 1.000002f;

SGM_KERNEL float minOf(float a, float b) { return min(a, b); }
SGM_KERNEL float maxOf(float a, float b) { return max(a, b); }
SGM_KERNEL float floatOf(uint32_t word) { return uniformFloat(word); }
SGM_KERNEL Bounds boundsOf(Mark m) { return makeBounds(m.lo, m.hi); }
SGM_KERNEL Mark markOf(Bounds b) { return {b.lo, b.hi}; }

SGM_KERNEL float sumOfSizes(Params P, int first, int last) {
  float sum = 0;
  for (int i = first; i <= last; ++i) sum += abs(uniformFloat(P[i]));
  return sum;
}

/// Same as sizeSum in field/interval.h, but without a margin for rounding errors: positionBounds adds that margin.
SGM_KERNEL float sizesOf(Op op, Params P) {
  switch (op) {
    case Op::sphere:
      return sumOfSizes(P, 4, 4);
    case Op::capsule:
      return sumOfSizes(P, 4, 6) + sumOfSizes(P, 8, 8);
    case Op::box:
    case Op::truncone:
      return sumOfSizes(P, 13, 15);
    case Op::cylinder:
    case Op::torus:
      return sumOfSizes(P, 13, 14);
    case Op::ellipsoid:
    case Op::superquadric:
      return sumOfSizes(P, 16, 16);
    case Op::power_morph:
      return sumOfSizes(P, 13, 18);
    case Op::prism: {
      float corner = 0;
      for (int k = 0; k < static_cast<int>(P[14]); ++k) corner = max(corner, sumOfSizes(P, 15 + 6 * k, 18 + 6 * k));
      return sumOfSizes(P, 13, 13) + corner;
    }
    default:
      return 0;
  }
}

/// Returns the smallest and the largest sample of a lattice; the host appended both to the lattice's samples
/// (appendLattice in batch_plan.cpp).
SGM_KERNEL Bounds samplesOf(Params P) {
  const uint32_t at = 10 + P[5] * P[6] * P[7];
  return makeBounds(uniformFloat(P[at]), uniformFloat(P[at + 1]));
}

SGM_KERNEL float valueInMiddle(Op op, Params P, const Box3& box) {
  const int x = middleOf(box.lo_x, box.hi_x), y = middleOf(box.lo_y, box.hi_y), z = middleOf(box.lo_z, box.hi_z);
  switch (op) {
    case Op::sphere:
      return opSphere(x, y, z, P).v;
    case Op::box:
      return opBox(x, y, z, P).v;
    case Op::cylinder:
      return opCylinder(x, y, z, P).v;
    case Op::truncone:
      return opTruncone(x, y, z, P).v;
    case Op::capsule:
      return opCapsule(x, y, z, P).v;
    case Op::torus:
      return opTorus(x, y, z, P).v;
    case Op::ellipsoid:
      return opEllipsoid(x, y, z, P).v;
    case Op::superquadric:
      return opSuperquadric(x, y, z, P).v;
    case Op::halfspace:
      return opHalfspace(x, y, z, P).v;
    case Op::prism:
      return opPrism(x, y, z, P).v;
    default:
      return 0;  // for all other ops, the bounds do not depend on the value at the middle of the box
  }
}

SGM_KERNEL Mark boundPosition(Op op, Params P, const Box3& box, Mark t) {
  const float sizes = sizesOf(op, P);
  if (op == Op::power_morph) return markOf(powerMorphBounds(P, boundsOf(t), sizes, box));
  const Bounds samples = op == Op::lattice ? samplesOf(P) : makeBounds(0, 0);
  return markOf(positionBounds(static_cast<uint>(op), P, valueInMiddle(op, P, box), sizes, samples, box));
}

SGM_KERNEL Mark boundOperands(Op op, Params P, Mark a, Mark b, Mark c) {
  const bool has_parameters = op == Op::constant || op == Op::smoothstep || op == Op::kernel;
  const float p0 = has_parameters ? uniformFloat(P[0]) : 0;
  const float p1 = op == Op::smoothstep || op == Op::kernel ? uniformFloat(P[1]) : 0;
  return markOf(operandBounds(static_cast<uint>(op), boundsOf(a), boundsOf(b), boundsOf(c), p0, p1));
}

SGM_KERNEL Mark boundRoundShare(Params P, Mark d) { return markOf(roundShare(boundsOf(d), uniformFloat(P[0]))); }
SGM_KERNEL Mark boundRoundEnd(Params P, Mark nearest, Mark sum) {
  return markOf(roundEndRange(boundsOf(nearest), boundsOf(sum), uniformFloat(P[0])));
}
SGM_KERNEL Mark boundSumEnd(Params P, Mark sum) {
  return markOf(sumEndRange(boundsOf(sum), uniformFloat(P[0]), uniformFloat(P[1])));
}
SGM_KERNEL Mark boundRoundUnion(Mark a, Mark b, float k) {
  return markOf(roundUnionRange(boundsOf(a), boundsOf(b), k));
}
SGM_KERNEL Mark boundRoundCut(Mark a, Mark b, float k) {
  return markOf(negated(roundUnionRange(negated(boundsOf(a)), boundsOf(b), k)));
}

SGM_KERNEL Box3 movePlaces(const Box3& from, Mark x, Mark y, Mark z) {
  // A warp could move positions in the box beyond the end of the world along some axis. The bounds on that axis then
  // become the whole world.
  constexpr int kLowest = -2147483647 - 1, kHighest = 2147483647;
  Box3 to{movedTo(from.lo_x, x.lo, -1.0f), movedTo(from.lo_y, y.lo, -1.0f), movedTo(from.lo_z, z.lo, -1.0f),
          movedTo(from.hi_x, x.hi, 1.0f),  movedTo(from.hi_y, y.hi, 1.0f),  movedTo(from.hi_z, z.hi, 1.0f)};
  if (to.lo_x == kLowest || to.hi_x == kHighest) to.lo_x = kLowest, to.hi_x = kHighest;
  if (to.lo_y == kLowest || to.hi_y == kHighest) to.lo_y = kLowest, to.hi_y = kHighest;
  if (to.lo_z == kLowest || to.hi_z == kHighest) to.lo_z = kLowest, to.hi_z = kHighest;
  return to;
}

#include "field/prune_kernel.inl"

SGM_KERNEL Box3 placesOf(const IntBox& box) { return {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}; }

}  // namespace bounding

}  // namespace sgm::cuda
