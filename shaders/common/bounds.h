// Bounds of an evaluator's results over a box of positions, in float32. They are wider than the bounds on the CPU
// (field/interval.h): by ten roundings of the largest magnitude at every step, and by each op's stated error. The
// tightness of the bounds never affects a mesh, because a program gives the same bits whether it is pruned or not.
// Written in the subset of portable.h, for devices. Before this file, the including file must include common.h, and
// define kOp_NAME and kStatedErrors (ops.def), Box3 (a box of whole positions) and, in C++, min, max, abs, clamp and
// floor of floats.

struct Bounds {
  float lo, hi;
};

const float kMaxBound = 1.0e30f;
const float kHeldAt = 1.0e18f;  // maximum magnitude of an expression's result (real.h)

FN Bounds makeBounds(float lo, float hi) {
  Bounds b;
  b.lo = lo;
  b.hi = hi;
  return b;
}

FN float magnitudeOf(Bounds a) { return max(abs(a.lo), abs(a.hi)); }

FN Bounds widened(Bounds a, float by) {
  float slack = by + 1.0e-6f * magnitudeOf(a) + 1.0e-20f;
  return makeBounds(clamp(a.lo - slack, -kMaxBound, kMaxBound), clamp(a.hi + slack, -kMaxBound, kMaxBound));
}

FN Bounds clampedTo(Bounds a, float lo, float hi) { return makeBounds(clamp(a.lo, lo, hi), clamp(a.hi, lo, hi)); }
FN Bounds keptOf(Bounds a) { return clampedTo(a, -kHeldAt, kHeldAt); }
FN Bounds negated(Bounds a) { return makeBounds(-a.hi, -a.lo); }

FN Bounds productOf(Bounds a, Bounds b) {
  a = clampedTo(a, -kHeldAt, kHeldAt);
  b = clampedTo(b, -kHeldAt, kHeldAt);
  float p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return widened(makeBounds(min(min(p, q), min(r, s)), max(max(p, q), max(r, s))), 0.0f);
}

FN Bounds sumOf(Bounds a, Bounds b) {
  return widened(makeBounds(a.lo + b.lo, a.hi + b.hi), 1.0e-6f * (magnitudeOf(a) + magnitudeOf(b)));
}

// Returns bounds of (1 - t) a + t b over all t of an interval. The term is linear in t, so the ends of the interval
// suffice.
FN Bounds blendOf(Bounds a, Bounds b, Bounds t) {
  Bounds low = sumOf(productOf(a, makeBounds(1.0f - t.lo, 1.0f - t.lo)), productOf(b, makeBounds(t.lo, t.lo)));
  Bounds high = sumOf(productOf(a, makeBounds(1.0f - t.hi, 1.0f - t.hi)), productOf(b, makeBounds(t.hi, t.hi)));
  return widened(makeBounds(min(low.lo, high.lo), max(low.hi, high.hi)),
                 1.0e-6f * (magnitudeOf(a) + magnitudeOf(b)) * (1.0f + magnitudeOf(t)));
}

// Returns bounds of the kernel max(0, 1 - x)^3 (kernelOf in primitives.h). They are exactly 0 if the kernel is
// certainly 0, so that pruning may remove the operand.
FN Bounds kernelRange(Bounds x, float error) {
  float slack = (error + 1.0e-6f) * (1.0f + magnitudeOf(x));
  float low = max(0.0f, 1.0f - (x.hi + slack)), high = max(0.0f, 1.0f - max(0.0f, x.lo - slack));
  low = low * low * low;
  high = high * high * high;
  return makeBounds(max(0.0f, low - error - 1.0e-6f), high > 0.0f ? high + error + 1.0e-6f : 0.0f);
}

// Return bounds of the offsets of positions from a centre along one axis, and of squares of offsets.
FN Bounds offsetRange(int lo, int hi, int centre) {
  return widened(makeBounds(float(saturatingSub(lo, centre)), float(saturatingSub(hi, centre))), 0.0f);
}
FN Bounds squareOf(Bounds a) {
  float l = a.lo * a.lo, h = a.hi * a.hi;
  return widened(makeBounds(a.lo <= 0.0f && a.hi >= 0.0f ? 0.0f : min(l, h), max(l, h)), 0.0f);
}

// Returns bounds of an op that combines operands. number: the op; every caller passes a constant, so that the compiler
// keeps only this op's line.
FN Bounds operandBounds(uint number, Bounds a, Bounds b, Bounds c, float p0, float p1) {
  float error = kStatedErrors[number];
  if (number == kOp_constant) return makeBounds(p0, p0);
  if (number == kOp_copy) return a;
  if (number == kOp_negate) return negated(a);
  if (number == kOp_absolute) {
    return makeBounds(a.lo <= 0.0f && a.hi >= 0.0f ? 0.0f : min(abs(a.lo), abs(a.hi)), magnitudeOf(a));
  }
  if (number == kOp_floor) {
    Bounds h = clampedTo(a, -1.0e9f, 1.0e9f);
    return makeBounds(floor(h.lo), floor(h.hi));
  }
  if (number == kOp_square_root) {
    Bounds r = makeBounds(sqrtReal(max(a.lo, 0.0f)), sqrtReal(max(a.hi, 0.0f)));
    return widened(r, 2.0f * error * r.hi + 1.0e-14f);
  }
  if (number == kOp_add) return keptOf(sumOf(a, b));
  if (number == kOp_subtract) return keptOf(sumOf(a, negated(b)));
  if (number == kOp_multiply) {
    return widened(keptOf(productOf(a, b)), 1.0e-29f * (magnitudeOf(keptOf(a)) + magnitudeOf(keptOf(b))));
  }
  if (number == kOp_divide) {
    bool through = b.lo <= 1.0e-29f && b.hi >= -1.0e-29f;
    Bounds by = through ? makeBounds(1.0f, 1.0f) : b;
    Bounds inverse = widened(keptOf(makeBounds(divideReal(1.0f, by.hi), divideReal(1.0f, by.lo))), 1.0e-17f);
    Bounds r = widened(keptOf(productOf(a, inverse)), 1.0e-29f * magnitudeOf(inverse) + 1.0e-17f);
    return through ? makeBounds(-2.0e18f, 2.0e18f) : r;
  }
  if (number == kOp_less) return makeBounds(a.hi < b.lo ? 1.0f : 0.0f, a.lo < b.hi ? 1.0f : 0.0f);
  if (number == kOp_smoothstep) {
    Bounds t = productOf(makeBounds(a.lo - p0, a.hi - p0), makeBounds(p1, p1));
    t = widened(t, 4.0f * error * abs(p1) * (magnitudeOf(a) + abs(p0)));
    Bounds u = clampedTo(t, 0.0f, 1.0f);
    float low = u.lo * u.lo * (3.0f - 2.0f * u.lo) - error - 1.0e-6f;
    float high = u.hi * u.hi * (3.0f - 2.0f * u.hi) + error + 1.0e-6f;
    // The evaluators clamp t first. So the result is exactly 0 where t <= 0, and exactly 1 where t >= 1.
    return t.hi <= 0.0f   ? makeBounds(0.0f, 0.0f)
           : t.lo >= 1.0f ? makeBounds(1.0f, 1.0f)
                          : makeBounds(max(low, 0.0f), high);
  }
  if (number == kOp_mix) return keptOf(blendOf(a, b, c));
  if (number == kOp_minimum) return makeBounds(min(a.lo, b.lo), min(a.hi, b.hi));
  if (number == kOp_maximum) return makeBounds(max(a.lo, b.lo), max(a.hi, b.hi));
  if (number == kOp_cut) return makeBounds(max(a.lo, -b.hi), max(a.hi, -b.lo));
  if (number == kOp_morph) return keptOf(blendOf(a, b, clampedTo(c, 0.0f, 1.0f)));
  if (number == kOp_displace) return keptOf(sumOf(a, productOf(b, makeBounds(1024.0f, 1024.0f))));
  if (number == kOp_kernel) {
    Bounds r = widened(productOf(a, makeBounds(p0, p0)), 4.0f * error * (1.0f + magnitudeOf(a) * p0));
    r = clampedTo(makeBounds(r.lo + 1.0f, r.hi + 1.0f), 0.0f, 1.0e9f);
    return kernelRange(productOf(makeBounds(r.lo * r.lo, r.hi * r.hi), makeBounds(p1, p1)), error);
  }
  return makeBounds(-kMaxBound, kMaxBound);
}

FN Bounds roundShare(Bounds d, float k) {
  Bounds u = clampedTo(makeBounds(k - d.hi, k - d.lo), 0.0f, 1.0e9f);
  u = widened(u, 1.0e-6f * (k + min(magnitudeOf(d), 2.0e9f)));
  u = makeBounds(max(u.lo, 0.0f), u.hi);
  return makeBounds(u.lo * u.lo * 0.999998f, d.lo >= k ? 0.0f : u.hi * u.hi * 1.000002f);
}

FN Bounds roundEndRange(Bounds nearest, Bounds sum, float k) {
  Bounds top = makeBounds(max(nearest.lo, k), max(nearest.hi, k));
  Bounds root = makeBounds(sqrtReal(sum.lo), sqrtReal(sum.hi));
  return widened(makeBounds(top.lo - root.hi, top.hi - root.lo),
                 (kStatedErrors[kOp_round_end] + 1.0e-6f) * (magnitudeOf(top) + root.hi));
}

FN Bounds roundUnionRange(Bounds a, Bounds b, float k) {
  Bounds nearest = makeBounds(min(a.lo, b.lo), min(a.hi, b.hi));
  float u = clamp(k - a.lo, 0.0f, 1.0e9f), v = clamp(k - b.lo, 0.0f, 1.0e9f);
  float root = sqrtReal(u * u + v * v);
  float low = widened(makeBounds(k - root, k - root), (kStatedErrors[kOp_round_end] + 1.0e-6f) * (k + root)).lo;
  return u == 0.0f || v == 0.0f ? nearest : makeBounds(min(nearest.lo, low), nearest.hi);
}

FN Bounds sumEndRange(Bounds sum, float threshold, float size) {
  Bounds r = productOf(makeBounds(threshold - sum.hi, threshold - sum.lo), makeBounds(size, size));
  return widened(keptOf(r), (kStatedErrors[kOp_sum_end] + 2.0e-6f) * (abs(threshold) + sum.hi) * abs(size));
}

// Returns bounds of the field after the shapes that a layer adds and cuts. If pruning has removed all cuts of a layer,
// the record that ends the layer is missing. The shapes that the layer adds are then joined to the field together with
// those of the next layer.
FN Bounds layerJoined(Bounds field, Bounds adds, Bounds cuts) {
  return makeBounds(max(min(field.lo, adds.lo), -cuts.hi), max(min(field.hi, adds.hi), -cuts.lo));
}

FN int movedTo(int at, float by, float slack) {
  float to = float(at) + clamp(by, -1048576.0f, 1048576.0f) * 1024.0f;
  to = to + slack * (2.0f + 4.0e-7f * (abs(float(at)) + abs(to)));
  return to < -2147483000.0f ? -2147483647 - 1 : to > 2147483000.0f ? 2147483647 : int(to);
}

FN int middleOf(int lo, int hi) { return int(uint(lo) + ((uint(hi) - uint(lo)) >> 1)); }
FN float halfOf(int lo, int hi) { return float(uint(hi) - uint(lo)) * 0.5f + 1.0f; }

// Returns the maximum distance of a position in the box from its middle. An op with a slope of at most 1 (primitives.h)
// differs from its value at the middle by no more than this.
FN float reachOf(Box3 box) {
  float x = halfOf(box.lo_x, box.hi_x), y = halfOf(box.lo_y, box.hi_y), z = halfOf(box.lo_z, box.hi_z);
  return sqrtReal(x * x + y * y + z * z) * 1.00001f;
}

// Returns bounds of an op that reads a position. middle: value of the op at the middle of the box; sizes: sum of the
// sizes in the op's parameters, to which rounding errors are relative (sizeSum in field/interval.h); samples: for a
// lattice, the range of all its samples.
FN Bounds positionBounds(uint number, Params P, float middle, float sizes, Bounds samples, Box3 box) {
  float error = kStatedErrors[number];
  if (number == kOp_noise) return makeBounds(-1.0f, 1.0f);
  if (number == kOp_sweep) return makeBounds(-2.0e-6f, 1.0f + 2.0e-6f);
  if (number == kOp_lattice) {
    Bounds all = widened(samples, 2.0f * error * magnitudeOf(samples));
    float most = PF(P, 9);
    bool far = all.hi >= most || all.lo <= -most;
    return far ? makeBounds(-kHeldAt, kHeldAt) : all;
  }
  Bounds x = offsetRange(box.lo_x, box.hi_x, PI(P, 1)), y = offsetRange(box.lo_y, box.hi_y, PI(P, 2));
  Bounds z = offsetRange(box.lo_z, box.hi_z, PI(P, 3));
  if (number == kOp_coordinate) {
    x = productOf(x, makeBounds(PF(P, 4), PF(P, 4)));
    y = productOf(y, makeBounds(PF(P, 5), PF(P, 5)));
    z = productOf(z, makeBounds(PF(P, 6), PF(P, 6)));
    return widened(sumOf(sumOf(x, y), z), 4.0f * error * (magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z)));
  }
  if (number == kOp_blob) {
    Bounds d2 = sumOf(sumOf(squareOf(x), squareOf(y)), squareOf(z));
    d2 = makeBounds(max(d2.lo, 0.0f), d2.hi);
    return kernelRange(productOf(d2, makeBounds(PF(P, 4), PF(P, 4))), 2.0f * error);
  }
  float radius = reachOf(box);
  float farthest = magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z);
  return widened(makeBounds(middle - radius, middle + radius), 3.0f * error * (farthest + sizes));
}

// The contribution of one axis to both norms of a power morph. q: distance of the box's middle from the centre; a, b:
// radii at t = 0 and t = 1.
struct MorphAxis {
  float smallest, largest, nearest, farthest;
};
FN MorphAxis morphAxis(float q, float a, float b, Bounds t, float reach) {
  float r0 = (1.0f - t.lo) * a + t.lo * b, r1 = (1.0f - t.hi) * a + t.hi * b;
  MorphAxis m;
  m.smallest = min(r0, r1) * 0.99999f;
  m.largest = max(r0, r1) * 1.00001f;
  m.nearest = max(q - reach, 0.0f) * recipReal(m.largest);
  m.farthest = (q + reach) * recipReal(m.smallest);
  return m;
}

// If t increases, the exponent grows, so the norm decreases, and the radii change as well. Both effects are bounded
// separately, at both ends of t, by ||u||_max <= ||u||_n <= ||u||_2, each for the smaller and the larger radii.
FN Bounds powerMorphBounds(Params P, Bounds t, float sizes, Box3 box) {
  Bounds s = clampedTo(t, 0.0f, 1.0f);
  float radius = reachOf(box);
  Bounds x = offsetRange(box.lo_x, box.hi_x, PI(P, 1)), y = offsetRange(box.lo_y, box.hi_y, PI(P, 2));
  Bounds z = offsetRange(box.lo_z, box.hi_z, PI(P, 3));
  float all = magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z);
  float slack = 3.0f * kStatedErrors[kOp_power_morph] * (all + sizes);
  Vec3 local = toLocal(middleOf(box.lo_x, box.hi_x), middleOf(box.lo_y, box.hi_y), middleOf(box.lo_z, box.hi_z), P);
  float reach = radius + slack;
  MorphAxis u = morphAxis(abs(local.x), PF(P, 13), PF(P, 16), s, reach);
  MorphAxis v = morphAxis(abs(local.y), PF(P, 14), PF(P, 17), s, reach);
  MorphAxis w = morphAxis(abs(local.z), PF(P, 15), PF(P, 18), s, reach);
  float squares = u.farthest * u.farthest + v.farthest * v.farthest + w.farthest * w.farthest;
  float norm_low = max(u.nearest, max(v.nearest, w.nearest)) * 0.9999f - 1.0f;
  float norm_high = sqrtReal(squares) * 1.0001f - 1.0f;
  float smallest = min(u.smallest, min(v.smallest, w.smallest));
  float largest = min(u.largest, min(v.largest, w.largest));
  return widened(makeBounds(norm_low * (norm_low > 0.0f ? smallest : largest),
                            norm_high * (norm_high > 0.0f ? largest : smallest)),
                 slack);
}
