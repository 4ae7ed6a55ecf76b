// Ops that combine values: expressions, hard and round set operations, sums, morphs, displacement. P: the op's
// parameter words, listed by number.

FN Int mergeLabels(Int cutter, Int under) {
  Int material = cutter & 0xFFFF;
  Int tag = wrapSub(cutter, material);
  Int under_material = under & 0xFFFF;
  Int under_tag = wrapSub(under, under_material);
  return sel(material == 0, under_material, material) | sel(tag == 0, under_tag, tag);
}

FN Dual selDual(Bool c, Dual a, Dual b) {
  return makeDual(sel(c, a.v, b.v), sel(c, a.x, b.x), sel(c, a.y, b.y), sel(c, a.z, b.z), sel(c, a.label, b.label));
}

FN Dual opConstant(Params P) {
  PRECISE Real zero = broadcast(0.0f);
  return makeDual(broadcast(PF(P, 0)), zero, zero, zero, broadcastInt(0));
}

// Returns the coordinate of a position along an axis, in metres. Parameters: 1-3 origin, 4-6 row of the rotation for
// this axis, divided by 1024.
FN Dual opCoordinate(Int px, Int py, Int pz, Params P) {
  Real v = dotRow(offsetFrom(px, py, pz, P), PF(P, 4), PF(P, 5), PF(P, 6));
  return makeDual(v, broadcast(PF(P, 4)), broadcast(PF(P, 5)), broadcast(PF(P, 6)), broadcastInt(0));
}

// Returns the parameter, 0..1, of the nearest point on a polyline. Parameters: 0 number of segments, then for segment k
// nine words from 1 + 9 k on: its start (3 integers), its vector (3), the reciprocal of its squared length, the share
// of the whole length before it, and its own share.
FN Dual opSweep(Int px, Int py, Int pz, Params P) {
  int count = PI(P, 0);
  PRECISE Real best = broadcast(3.0e38f);
  PRECISE Real v = broadcast(0.0f);
  PRECISE Real gx = broadcast(0.0f);
  PRECISE Real gy = broadcast(0.0f);
  PRECISE Real gz = broadcast(0.0f);
  for (int k = 0; k < count; ++k) {
    int at = 1 + 9 * k;
    Vec3 d = makeVec3(toReal(saturatingSub(px, broadcastInt(RI(P, at)))),
                      toReal(saturatingSub(py, broadcastInt(RI(P, at + 1)))),
                      toReal(saturatingSub(pz, broadcastInt(RI(P, at + 2)))));
    PRECISE Real h = dotRow(d, RF(P, at + 3), RF(P, at + 4), RF(P, at + 5)) * RF(P, at + 6);
    Bool middle = (h > 0.0f) && (h < 1.0f);
    h = clampReal(h, 0.0f, 1.0f);
    PRECISE Real ox = h * RF(P, at + 3);
    PRECISE Real oy = h * RF(P, at + 4);
    PRECISE Real oz = h * RF(P, at + 5);
    ox = d.x - ox;
    oy = d.y - oy;
    oz = d.z - oz;
    PRECISE Real s = lengthSquared3(makeVec3(ox, oy, oz));
    Bool nearer = s < best;
    best = sel(nearer, s, best);
    PRECISE Real u = h * RF(P, at + 8);
    u = u + RF(P, at + 7);
    v = sel(nearer, u, v);
    PRECISE Real slope = sel(middle, broadcast(RF(P, at + 6)) * RF(P, at + 8), broadcast(0.0f));
    PRECISE Real sx = slope * RF(P, at + 3);
    PRECISE Real sy = slope * RF(P, at + 4);
    PRECISE Real sz = slope * RF(P, at + 5);
    gx = sel(nearer, sx, gx);
    gy = sel(nearer, sy, gy);
    gz = sel(nearer, sz, gz);
  }
  return makeDual(flushReal(v), gx, gy, gz, broadcastInt(0));
}

FN Dual opNegate(Dual a) { return makeDual(-a.v, -a.x, -a.y, -a.z, a.label); }

FN Dual opAbsolute(Dual a) { return selDual(a.v < 0.0f, opNegate(a), a); }

FN Dual opFloor(Dual a) {
  PRECISE Real zero = broadcast(0.0f);
  return makeDual(floorReal(clampReal(a.v, -1.0e9f, 1.0e9f)), zero, zero, zero, a.label);
}

// Limits the magnitude of an expression's result and its gradient (see settleReal).
FN Dual settled(Real v, Real x, Real y, Real z, Int label) {
  return makeDual(settleReal(v), settleReal(x), settleReal(y), settleReal(z), label);
}

FN Dual opSquareRoot(Dual a) {
  PRECISE Real c = sel(a.v > 1.0e-30f, a.v, broadcast(0.0f));
  PRECISE Real inv = rsqrtReal(c);
  PRECISE Real v = c * inv;
  PRECISE Real k = sel(c > 0.0f, inv * 0.5f, broadcast(0.0f));
  PRECISE Real x = a.x * k;
  PRECISE Real y = a.y * k;
  PRECISE Real z = a.z * k;
  return settled(v, x, y, z, a.label);
}

FN Dual opAdd(Dual a, Dual b) {
  PRECISE Real v = a.v + b.v;
  PRECISE Real x = a.x + b.x;
  PRECISE Real y = a.y + b.y;
  PRECISE Real z = a.z + b.z;
  return settled(v, x, y, z, a.label);
}

FN Dual opSubtract(Dual a, Dual b) {
  PRECISE Real v = a.v - b.v;
  PRECISE Real x = a.x - b.x;
  PRECISE Real y = a.y - b.y;
  PRECISE Real z = a.z - b.z;
  return settled(v, x, y, z, a.label);
}

// Returns p * a + q * b, for the gradients of products and quotients.
FN Real twoProducts(Real p, Real a, Real q, Real b) {
  PRECISE Real s = p * a;
  PRECISE Real t = q * b;
  PRECISE Real r = s + t;
  return r;
}

// The operands are already limited in magnitude (settleReal), so the product cannot overflow.
FN Dual opMultiply(Dual a, Dual b) {
  PRECISE Real p = flushReal(a.v);
  PRECISE Real q = flushReal(b.v);
  PRECISE Real v = p * q;
  return settled(v, twoProducts(p, b.x, q, a.x), twoProducts(p, b.y, q, a.y), twoProducts(p, b.z, q, a.z), a.label);
}

FN Dual opDivide(Dual a, Dual b) {
  PRECISE Real inv = holdReal(divideReal(broadcast(1.0f), flushReal(b.v)));
  PRECISE Real v = flushReal(a.v) * inv;
  v = settleReal(v);
  PRECISE Real k = -v * inv;
  k = settleReal(k);
  return settled(v, twoProducts(inv, a.x, k, b.x), twoProducts(inv, a.y, k, b.y), twoProducts(inv, a.z, k, b.z),
                 a.label);
}

FN Dual opMinimum(Dual a, Dual b) { return selDual(b.v < a.v, b, a); }
FN Dual opMaximum(Dual a, Dual b) { return selDual(b.v > a.v, b, a); }

// Removes b from a. The surface of the cut has b's material or, if b has none, the material of a there.
FN Dual opCut(Dual a, Dual b) {
  Dual n = opNegate(b);
  n.label = mergeLabels(b.label, a.label);
  return selDual(n.v > a.v, n, a);
}

FN Dual opLess(Dual a, Dual b) {
  PRECISE Real zero = broadcast(0.0f);
  return makeDual(sel(a.v < b.v, broadcast(1.0f), zero), zero, zero, zero, broadcastInt(0));
}

// A smooth step. Parameters: 0 lower edge, 1 reciprocal of (upper edge - lower edge), which is negative for a falling
// step.
FN Dual opSmoothstep(Dual a, Params P) {
  PRECISE Real t = a.v - PF(P, 0);
  t = t * PF(P, 1);
  t = clampReal(t, 0.0f, 1.0f);
  PRECISE Real u = t * -2.0f;
  u = u + 3.0f;
  PRECISE Real v = t * t;
  v = v * u;
  PRECISE Real k = 1.0f - t;
  k = k * t;
  k = k * 6.0f;
  k = k * PF(P, 1);
  PRECISE Real x = a.x * k;
  PRECISE Real y = a.y * k;
  PRECISE Real z = a.z * k;
  return settled(v, x, y, z, a.label);
}

// Returns (1 - c) a + c b: exactly a at c = 0, and exactly b at c = 1.
FN Dual opMix(Dual a, Dual b, Dual c) {
  PRECISE Real k = 1.0f - c.v;
  PRECISE Real slope = b.v - a.v;
  PRECISE Real x = slope * c.x;
  x = twoProducts(k, a.x, c.v, b.x) + x;
  PRECISE Real y = slope * c.y;
  y = twoProducts(k, a.y, c.v, b.y) + y;
  PRECISE Real z = slope * c.z;
  z = twoProducts(k, a.z, c.v, b.z) + z;
  return settled(twoProducts(k, a.v, c.v, b.v), x, y, z, a.label);
}

// Returns (1 - t) a + t b with t clamped to 0..1, and the label of a or b, whichever has more weight. The result is
// clamped, but denormals are kept: so it equals a at t <= 0 and b at t >= 1 to the bit, which pruning relies on.
FN Dual opMorph(Dual a, Dual b, Dual t) {
  PRECISE Real w = clampReal(t.v, 0.0f, 1.0f);
  PRECISE Real k = 1.0f - w;
  PRECISE Real slope = b.v - a.v;
  slope = sel((t.v > 0.0f) && (t.v < 1.0f), slope, broadcast(0.0f));
  PRECISE Real x = slope * t.x;
  x = twoProducts(k, a.x, w, b.x) + x;
  PRECISE Real y = slope * t.y;
  y = twoProducts(k, a.y, w, b.y) + y;
  PRECISE Real z = slope * t.z;
  z = twoProducts(k, a.z, w, b.z) + z;
  return makeDual(holdReal(twoProducts(k, a.v, w, b.v)), holdReal(x), holdReal(y), holdReal(z),
                  sel(w < 0.5f, a.label, b.label));
}

// Returns a + 1024 b, where a is in units and b in metres.
FN Dual opDisplace(Dual a, Dual b) {
  PRECISE Real v = b.v * 1024.0f;
  v = a.v + v;
  PRECISE Real x = b.x * 1024.0f;
  x = a.x + x;
  PRECISE Real y = b.y * 1024.0f;
  y = a.y + y;
  PRECISE Real z = b.z * 1024.0f;
  z = a.z + z;
  return settled(v, x, y, z, a.label);
}

// Initial values of accumulators. Minima begin with farAway(), which is larger than every value (kFar in
// runtime/field/program.h); sums begin with zero.
FN Dual farAway() {
  PRECISE Real zero = broadcast(0.0f);
  return makeDual(broadcast(1.0e30f), zero, zero, zero, broadcastInt(0));
}
FN Dual nothing() {
  PRECISE Real zero = broadcast(0.0f);
  return makeDual(zero, zero, zero, zero, broadcastInt(0));
}
// Adds an operand to a round union of any number of operands (design.md section 3). Its state is in two registers: the
// nearest operand, and the sum of max(k - d, 0)^2.
FN Dual roundAccumulate(Dual sum, Dual d, float k) {
  PRECISE Real h = k - d.v;
  h = clampReal(h, 0.0f, 1.0e9f);
  h = sel(h > 1.0e-15f, h, broadcast(0.0f));  // a smaller value is replaced by 0, because its square would be a
                                              // denormal
  PRECISE Real v = h * h;
  v = sum.v + v;
  PRECISE Real w = h * -2.0f;
  PRECISE Real x = w * d.x;
  x = sum.x + x;
  PRECISE Real y = w * d.y;
  y = sum.y + y;
  PRECISE Real z = w * d.z;
  z = sum.z + z;
  return makeDual(v, x, y, z, sum.label);
}
FN Dual roundEnd(Dual nearest, Dual sum, float k) {
  PRECISE Real inv = rsqrtReal(sum.v);
  PRECISE Real root = sum.v * inv;
  PRECISE Real v = maxReal(nearest.v, broadcast(k));
  v = v - root;
  // True if the sum is empty, or too small to have a meaningful direction.
  Bool apart = (nearest.v >= k) || (sum.v <= 0.0f);
  PRECISE Real w = inv * -0.5f;
  PRECISE Real x = sum.x * w;
  PRECISE Real y = sum.y * w;
  PRECISE Real z = sum.z * w;
  return makeDual(v, holdReal(sel(apart, nearest.x, x)), holdReal(sel(apart, nearest.y, y)),
                  holdReal(sel(apart, nearest.z, z)), nearest.label);
}
FN Dual opRoundEnd(Dual nearest, Dual sum, Params P) { return roundEnd(nearest, sum, PF(P, 0)); }

// Returns the round union of a field and one group of shapes. Unlike the round union of many operands, it equals the
// nearer operand to the bit if either operand is at least k, so that pruning may remove such a group. Rounding never
// makes it larger than the nearer operand.
FN Dual roundUnion(Dual a, Dual b, float k) {
  Dual nearest = opMinimum(a, b);
  Dual blended = roundEnd(nearest, roundAccumulate(roundAccumulate(nothing(), a, k), b, k), k);
  Bool blends = (a.v < k) && (b.v < k) && (blended.v < nearest.v);
  return selDual(blends, blended, nearest);
}
// Removes b from a, with a rounded edge. The label is the same as for opCut.
FN Dual roundCut(Dual a, Dual b, float k) {
  b.label = mergeLabels(b.label, a.label);
  return opNegate(roundUnion(opNegate(a), b, k));
}

// Returns a shape's weight in a sum of shapes, from the distance d to the shape: a kernel that is 0 beyond a support
// radius. Parameters: 0 reciprocal of the inner radius (the depth -d at which the kernel has its centre), 1 reciprocal
// of the squared support radius, which is given in inner radii.
FN Dual opKernel(Dual d, Params P) {
  PRECISE Real r = d.v * PF(P, 0);
  r = r + 1.0f;
  r = clampReal(r, 0.0f, 1.0e9f);
  PRECISE Real x = r * r;
  x = x * PF(P, 1);
  Corner k = kernelOf(x);
  PRECISE Real s = r * 2.0f;
  s = s * PF(P, 1);
  s = s * PF(P, 0);
  s = s * k.ga;
  PRECISE Real gx = d.x * s;
  PRECISE Real gy = d.y * s;
  PRECISE Real gz = d.z * s;
  return settled(k.v, gx, gy, gz, d.label);
}

// The state of a sum is in two registers: the operand with the largest weight (for its label), and the sum itself.
FN Dual sumHeaviest(Dual heaviest, Dual w) { return selDual(w.v > heaviest.v, w, heaviest); }

// Ends a sum: returns (threshold - sum) * length. Parameters: 0 threshold, 1 length.
FN Dual opSumEnd(Dual heaviest, Dual sum, Params P) {
  PRECISE Real v = PF(P, 0) - sum.v;
  v = v * PF(P, 1);
  float k = -PF(P, 1);
  PRECISE Real x = sum.x * k;
  PRECISE Real y = sum.y * k;
  PRECISE Real z = sum.z * k;
  return settled(v, x, y, z, heaviest.label);
}
