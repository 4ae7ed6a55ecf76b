// Elementary functions, computed by + - * and integer operations only. The stated maximum errors are tested.

// Minimum and maximum. For two zeroes of different signs, it is undefined which one is returned, because compilers use
// one instruction for these functions. Later code removes the signs of zeroes (unsignedZero). On the CPU, vector
// instructions replace these functions and give the same bits (wide.h).
#ifndef SGM_VECTOR_FORMS
FN Real minReal(Real a, Real b) { return sel(a < b, a, b); }
FN Real maxReal(Real a, Real b) { return sel(a > b, a, b); }
#endif
FN Real absReal(Real a) { return sel(a < 0.0f, -a, a); }
FN Real clampReal(Real x, float lo, float hi) { return minReal(maxReal(x, broadcast(lo)), broadcast(hi)); }
FN Real signOf(Real a) { return sel(a < 0.0f, broadcast(-1.0f), broadcast(1.0f)); }

// Returns 1 / sqrt(x) for normal x > 0, with a relative error below 3e-7, by three Newton steps from an integer first
// guess. The result at 0 is finite, so that x * rsqrt(x) is 0 there.
FN Real rsqrtReal(Real x) {
  PRECISE Real y = bitsToReal(0x5F375A86u - (realToBits(x) >> 1));
  PRECISE Real h = x * 0.5f;
  PRECISE Real a = h * y;
  a = a * y;
  a = 1.5f - a;
  y = y * a;
  a = h * y;
  a = a * y;
  a = 1.5f - a;
  y = y * a;
  a = h * y;
  a = a * y;
  a = 1.5f - a;
  y = y * a;
  return y;
}

// Returns sqrt(x) for x >= 0, with a relative error below 4e-7; exact at 0.
FN Real sqrtReal(Real x) {
  PRECISE Real r = x * rsqrtReal(x);
  return r;
}

// Returns 1 / x for 2^-120 < x < 2^120, with a relative error below 2e-7. Outside of this range, Newton's steps
// overflow or yield denormals, and even the sign of the result may be wrong; callers keep x in the range (settleReal).
FN Real recipReal(Real x) {
  PRECISE Real y = bitsToReal(0x7EF311C7u - realToBits(x));
  PRECISE Real e = x * y;
  e = 2.0f - e;
  y = y * e;
  e = x * y;
  e = 2.0f - e;
  y = y * e;
  e = x * y;
  e = 2.0f - e;
  y = y * e;
  return y;
}

// Returns a / b for 2^-120 < |b| < 2^120, and 0 if b = 0.
FN Real divideReal(Real a, Real b) {
  PRECISE Real m = absReal(b);
  PRECISE Real r = a * recipReal(sel(m > 0.0f, m, broadcast(1.0f)));
  r = r * signOf(b);
  return sel(m > 0.0f, r, broadcast(0.0f));
}

// Clamps the results of expressions, including gradients, to a magnitude of 1e18; settleReal also replaces magnitudes
// below 1e-30 by 0. So a product of two results never overflows (and infinity times 0 never yields NaN), no product is
// a denormal, which some devices keep and others flush, and reciprocals stay in their range. Vulkan defines none of
// these cases.
FN Real holdReal(Real x) { return clampReal(x, -1.0e18f, 1.0e18f); }
#ifndef SGM_VECTOR_FORMS
FN Real flushReal(Real x) { return sel((x < -1.0e-30f) || (x > 1.0e-30f), x, broadcast(0.0f)); }
#endif
FN Real settleReal(Real x) { return flushReal(holdReal(x)); }

#ifndef SGM_VECTOR_FORMS
// Returns the largest integer <= x, for |x| < 2^31; never a negative zero.
FN Real floorReal(Real x) {
  PRECISE Real r = toReal(toInt(x));
  PRECISE Real lower = r - 1.0f;
  return sel(r > x, lower, r);
}
#endif

// Returns 2^x with x clamped to [-126, 126], with a relative error below 3e-7.
FN Real exp2Real(Real x) {
  PRECISE Real c = clampReal(x, -126.0f, 126.0f);
  PRECISE Real whole = c + 0.5f;
  whole = floorReal(whole);
  PRECISE Real f = c - whole;
  PRECISE Real p = f * 1.5403530393381609e-4f;
  p = p + 1.3333558146428443e-3f;
  p = p * f;
  p = p + 9.6181291076284772e-3f;
  p = p * f;
  p = p + 5.5504108664821580e-2f;
  p = p * f;
  p = p + 2.4022650695910071e-1f;
  p = p * f;
  p = p + 6.9314718055994531e-1f;
  p = p * f;
  p = p + 1.0f;
  PRECISE Real scale = bitsToReal(toUintBits(wrapAdd(toInt(whole), 127)) << 23);
  p = p * scale;
  return p;
}

// Returns log2(x) for normal x > 0, with an absolute error below 4e-7 * max(1, |log2 x|); about -127 at 0.
FN Real log2Real(Real x) {
  Uint bits = realToBits(x);
  Int exponent = wrapSub(toIntBits(bits >> 23), 127);
  PRECISE Real m = bitsToReal((bits & 0x007FFFFFu) | 0x3F800000u);
  Bool big = m > 1.41421356f;
  PRECISE Real half_m = m * 0.5f;
  m = sel(big, half_m, m);
  PRECISE Real e = toReal(exponent);
  PRECISE Real e1 = e + 1.0f;
  e = sel(big, e1, e);
  PRECISE Real up = m - 1.0f;
  PRECISE Real down = m + 1.0f;
  PRECISE Real s = up * recipReal(down);
  PRECISE Real s2 = s * s;
  PRECISE Real p = s2 * 0.32059890f;
  p = p + 0.41219858f;
  p = p * s2;
  p = p + 0.57707802f;
  p = p * s2;
  p = p + 0.96179669f;
  p = p * s2;
  p = p + 2.88539008f;
  p = p * s;
  PRECISE Real r = e + p;
  return r;
}

// Returns a^n for 0 <= a <= 1 and 1 <= n <= 20, with an absolute error below 1e-5; for a = 0 the result is below
// 2^-126.
FN Real powReal(Real a, Real n) {
  PRECISE Real l = log2Real(a);
  PRECISE Real e = n * l;
  return exp2Real(e);
}

#ifndef SGM_VECTOR_FORMS
// Returns p - c, saturated to int32, because a half-space or a domain may be farther away than an int32 can represent.
FN Int saturatingSub(Int p, Int c) {
  Int d = wrapSub(p, c);
  Bool overflow = ((p ^ c) & (p ^ d)) < 0;
  Int limit = sel(p < 0, broadcastInt(-2147483647 - 1), broadcastInt(2147483647));
  return sel(overflow, limit, d);
}
#endif

// Returns floor(f * scale + 0.5), clamped to +-2^22 (arithmetic contract, rule 3).
FN Int quantise(Real f, float scale) {
  PRECISE Real q = f * scale;
  q = q + 0.5f;
  q = clampReal(q, -4194304.0f, 4194304.0f);
  return toInt(floorReal(q));
}
