// Gradient noise on an integer lattice (Perlin 2002, with an integer hash). It is equally precise everywhere in the
// world, because the position in the lattice cell is computed in integers before it is converted to a float.

FN Uint hashLattice(Int x, Int y, Int z, uint seed) {
  Uint h = toUintBits(wrapMul(x, broadcastInt(-1640531535))) ^ toUintBits(wrapMul(y, broadcastInt(-2048144777))) ^
           toUintBits(wrapMul(z, broadcastInt(-1028477379))) ^ seed;
  h = h ^ (h >> 15);
  h = h * 0x2C1B3C6Du;
  h = h ^ (h >> 12);
  h = h * 0x297A2D39u;
  h = h ^ (h >> 15);
  return h;
}

struct LatticePlace {
  Int cell, rest;
};

// Computes cell = floor(offset / period) and the remainder, exactly for every int32 offset and period >= 1. Two rounds
// suffice: the first guess is wrong by the rounding of a large offset to float, the second by at most one. The guess is
// clamped to the largest float below 2^31, because the largest offsets would round up to 2^31, which is not an int32.
FN LatticePlace latticePlace(Int offset, int period, float inv_period) {
  PRECISE Real guess = toReal(offset) * inv_period;
  Int cell = toInt(floorReal(minReal(guess, broadcast(2147483520.0f))));
  Int rest = wrapSub(offset, wrapMul(cell, broadcastInt(period)));
  Int step = toInt(floorReal(toReal(rest) * inv_period));
  cell = wrapAdd(cell, step);
  rest = wrapSub(rest, wrapMul(step, broadcastInt(period)));
  Bool below = rest < 0;
  cell = sel(below, wrapSub(cell, broadcastInt(1)), cell);
  rest = sel(below, wrapAdd(rest, broadcastInt(period)), rest);
  Bool above = rest >= period;
  cell = sel(above, wrapAdd(cell, broadcastInt(1)), cell);
  rest = sel(above, wrapSub(rest, broadcastInt(period)), rest);
  LatticePlace r;
  r.cell = cell;
  r.rest = rest;
  return r;
}

// Returns one of the twelve directions from a cube's centre to its edges, as a vector of -1, 0, 1. The table has 16
// entries, so four directions occur twice.
#ifdef SGM_LANE_TABLES
FN Vec3 latticeGradient(Uint h) {
  constexpr float kX[16] = {1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0, 1, 0, -1, 0};
  constexpr float kY[16] = {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1};
  constexpr float kZ[16] = {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1, 0, 1, 0, -1};
  return makeVec3(lookUp16(kX, h), lookUp16(kY, h), lookUp16(kZ, h));
}
#else
FN Vec3 latticeGradient(Uint h) {
  Int k = toIntBits(h & 15u);
  PRECISE Real s1 = sel(toIntBits(h & 1u) == 0, broadcast(1.0f), broadcast(-1.0f));
  PRECISE Real s2 = sel(toIntBits(h & 2u) == 0, broadcast(1.0f), broadcast(-1.0f));
  Bool first_x = k < 8;
  Bool second_y = k < 4;
  Bool second_x = (k == 12) || (k == 14);
  PRECISE Real zero = broadcast(0.0f);
  PRECISE Real gx = sel(first_x, s1, sel(second_x, s2, zero));
  PRECISE Real gy = sel(first_x, zero, s1);
  gy = sel(second_y, s2, gy);
  PRECISE Real gz = sel(second_y || second_x, zero, s2);
  return makeVec3(gx, gy, gz);
}
#endif

FN Real fade(Real t) {
  PRECISE Real a = t * 6.0f;
  a = a - 15.0f;
  a = a * t;
  a = a + 10.0f;
  PRECISE Real c = t * t;
  c = c * t;
  PRECISE Real r = c * a;
  return r;
}

FN Real fadeSlope(Real t) {
  PRECISE Real a = t - 1.0f;
  a = a * t;
  PRECISE Real r = a * a;
  r = r * 30.0f;
  return r;
}

FN Dual cornerTerm(Int x, Int y, Int z, uint seed, Real fx, Real fy, Real fz) {
  Vec3 g = latticeGradient(hashLattice(x, y, z, seed));
  PRECISE Real a = g.x * fx;
  PRECISE Real b = g.y * fy;
  PRECISE Real c = g.z * fz;
  PRECISE Real v = a + b;
  v = v + c;
  return makeDual(v, g.x, g.y, g.z, broadcastInt(0));
}

// Interpolates between a and b: returns a + (b - a) w with its gradient. slope: the derivative of w along `axis`.
FN Dual mixCorners(Dual a, Dual b, Real w, Real slope, int axis) {
  PRECISE Real d = b.v - a.v;
  PRECISE Real v = d * w;
  v = a.v + v;
  PRECISE Real s = d * slope;
  PRECISE Real x = b.x - a.x;
  x = x * w;
  x = a.x + x;
  PRECISE Real y = b.y - a.y;
  y = y * w;
  y = a.y + y;
  PRECISE Real z = b.z - a.z;
  z = z * w;
  z = a.z + z;
  PRECISE Real xs = x + s;
  PRECISE Real ys = y + s;
  PRECISE Real zs = z + s;
  return makeDual(v, axis == 0 ? xs : x, axis == 1 ? ys : y, axis == 2 ? zs : z, broadcastInt(0));
}

// Returns one octave of noise; its gradient is per unit.
FN Dual noiseOctave(Int ox, Int oy, Int oz, int period, float inv_period, uint seed) {
  LatticePlace px = latticePlace(ox, period, inv_period);
  LatticePlace py = latticePlace(oy, period, inv_period);
  LatticePlace pz = latticePlace(oz, period, inv_period);
  Int x1 = wrapAdd(px.cell, broadcastInt(1));
  Int y1 = wrapAdd(py.cell, broadcastInt(1));
  Int z1 = wrapAdd(pz.cell, broadcastInt(1));
  PRECISE Real fx = toReal(px.rest) * inv_period;
  PRECISE Real fy = toReal(py.rest) * inv_period;
  PRECISE Real fz = toReal(pz.rest) * inv_period;
  PRECISE Real gx = fx - 1.0f;
  PRECISE Real gy = fy - 1.0f;
  PRECISE Real gz = fz - 1.0f;
  Dual a0 = cornerTerm(px.cell, py.cell, pz.cell, seed, fx, fy, fz);
  Dual a1 = cornerTerm(x1, py.cell, pz.cell, seed, gx, fy, fz);
  Dual b0 = cornerTerm(px.cell, y1, pz.cell, seed, fx, gy, fz);
  Dual b1 = cornerTerm(x1, y1, pz.cell, seed, gx, gy, fz);
  Dual c0 = cornerTerm(px.cell, py.cell, z1, seed, fx, fy, gz);
  Dual c1 = cornerTerm(x1, py.cell, z1, seed, gx, fy, gz);
  Dual d0 = cornerTerm(px.cell, y1, z1, seed, fx, gy, gz);
  Dual d1 = cornerTerm(x1, y1, z1, seed, gx, gy, gz);
  PRECISE Real u = fade(fx);
  PRECISE Real v = fade(fy);
  PRECISE Real w = fade(fz);
  PRECISE Real us = fadeSlope(fx);
  PRECISE Real vs = fadeSlope(fy);
  PRECISE Real ws = fadeSlope(fz);
  Dual a = mixCorners(a0, a1, u, us, 0);
  Dual b = mixCorners(b0, b1, u, us, 0);
  Dual c = mixCorners(c0, c1, u, us, 0);
  Dual d = mixCorners(d0, d1, u, us, 0);
  Dual e = mixCorners(a, b, v, vs, 1);
  Dual f = mixCorners(c, d, v, vs, 1);
  Dual r = mixCorners(e, f, w, ws, 2);
  PRECISE Real rx = r.x * inv_period;
  PRECISE Real ry = r.y * inv_period;
  PRECISE Real rz = r.z * inv_period;
  return makeDual(r.v, rx, ry, rz, broadcastInt(0));
}

// Returns the sum of several octaves of noise, clamped to -1..1. Parameters: 0-2 origin, 3 number of octaves to
// evaluate (at least one), 4 seed, 5 gain that normalises the sum, then for each octave its period and the period's
// reciprocal.
FN Dual opNoise(Int px, Int py, Int pz, Params P) {
  Int ox = wrapSub(px, broadcastInt(PI(P, 0)));
  Int oy = wrapSub(py, broadcastInt(PI(P, 1)));
  Int oz = wrapSub(pz, broadcastInt(PI(P, 2)));
  int octaves = PI(P, 3);
  float weight = PF(P, 5);
  PRECISE Real v = broadcast(0.0f);
  PRECISE Real x = broadcast(0.0f);
  PRECISE Real y = broadcast(0.0f);
  PRECISE Real z = broadcast(0.0f);
  int k = 0;
  do {  // not `for`: software Vulkan runs the body of a `for` loop once more than its count
    Dual o = noiseOctave(ox, oy, oz, QI(P, 6 + 2 * k), QF(P, 7 + 2 * k), PU(P, 4) + 0x9E3779B9u * uint(k));
    PRECISE Real a = o.v * weight;
    v = v + a;
    a = o.x * weight;
    x = x + a;
    a = o.y * weight;
    y = y + a;
    a = o.z * weight;
    z = z + a;
    weight = weight * 0.5f;
    ++k;
  } while (k < octaves);
  v = clampReal(v, -1.0f, 1.0f);
  return makeDual(flushReal(v), x, y, z, broadcastInt(0));
}
