// Interpolates samples on a lattice of integer positions, linearly along each axis and exactly at the lattice's points.
// The samples of a host field (a field that the engine computes) are multiples of 1/1024 unit. So a difference of two
// samples is never a denormal, which devices treat differently. A position on the border of two cells gets exactly the
// sample there, with weight 1. So two lattices that share points agree at these points, even if they begin at different
// positions.

// Along one axis: the lattice cell that contains a position, the position t in this cell (0 to 1), and the factor that
// converts sampleSlope() to the slope per unit. A position outside of the inner cells is moved to the nearest point of
// them; there the factor is 0, because the value is constant.
struct SamplePlace {
  Int cell;
  Real t;
  Real slope;
};

// Integer arithmetic decides in which cell a position lies. Within 2^20 cells, the rounded product is the right cell or
// a neighbour; beyond that, it is clamped to the last cell. No position is placed in the first or the last cell of an
// axis: their outer samples serve only for slopes.
FN SamplePlace samplePlace(Int p, int origin, int spacing, int count, float inverse) {
  Int d = saturatingSub(p, broadcastInt(origin));
  d = sel(d < 0, broadcastInt(0), d);
  d = sel(d > 1073741824, broadcastInt(1073741824), d);
  PRECISE Real u = toReal(d) * inverse;
  Int cell = toInt(floorReal(u));
  Int rest = wrapSub(d, wrapMul(cell, broadcastInt(spacing)));
  cell = sel(rest < 0, wrapSub(cell, broadcastInt(1)), cell);
  cell = sel(rest >= broadcastInt(spacing), wrapAdd(cell, broadcastInt(1)), cell);
  Bool before = cell < 1;
  Bool behind = cell > count - 3;
  cell = sel(before, broadcastInt(1), cell);
  cell = sel(behind, broadcastInt(count - 3), cell);
  rest = wrapSub(d, wrapMul(cell, broadcastInt(spacing)));
  SamplePlace r;
  r.cell = cell;
  PRECISE Real t = toReal(rest) * inverse;
  r.t = clampReal(t, 0.0f, 1.0f);
  r.slope = sel(before || behind, broadcast(0.0f), broadcast(0.5f * inverse));
  return r;
}

FN Real mixSamples(Real a, Real b, Real t) {
  PRECISE Real r = b - a;
  r = r * t;
  r = a + r;
  return r;
}

// Returns the slope along a row of samples, per cell, times two. Interpolates between the central differences at the
// two ends of the cell, so that the slope is continuous from cell to cell.
FN Real sampleSlope(Params P, Int at, Int step, Real t) {
  PRECISE Real near = gatherReal(P, wrapAdd(at, step)) - gatherReal(P, wrapSub(at, step));
  PRECISE Real far = gatherReal(P, wrapAdd(wrapAdd(at, step), step)) - gatherReal(P, at);
  return mixSamples(near, far, t);
}

// Returns the slopes (sampleSlope) along an axis, interpolated between the four rows of a cell by tb and tc.
FN Real slopeInCell(Params P, Int at, Int along, Int b, Int c, Real t, Real tb, Real tc) {
  Real low = mixSamples(sampleSlope(P, at, along, t), sampleSlope(P, wrapAdd(at, b), along, t), tb);
  Int next = wrapAdd(at, c);
  Real high = mixSamples(sampleSlope(P, next, along, t), sampleSlope(P, wrapAdd(next, b), along, t), tb);
  return mixSamples(low, high, tc);
}

// Interpolates the samples of a lattice. Parameters: 1-3 origin, 4 spacing in units, 5-7 number of points along x, y, z
// (at least 4 each), 8 reciprocal of the spacing, 9 limit: a value of at least this magnitude counts as far away, and
// becomes +-1e18, 10 and following: the samples in units, x fastest.
FN Dual opLattice(Int px, Int py, Int pz, Params P) {
  SamplePlace x = samplePlace(px, PI(P, 1), PI(P, 4), PI(P, 5), PF(P, 8));
  SamplePlace y = samplePlace(py, PI(P, 2), PI(P, 4), PI(P, 6), PF(P, 8));
  SamplePlace z = samplePlace(pz, PI(P, 3), PI(P, 4), PI(P, 7), PF(P, 8));
  Int row = broadcastInt(PI(P, 5));
  Int layer = broadcastInt(PI(P, 5) * PI(P, 6));
  Int at = wrapAdd(wrapAdd(wrapMul(z.cell, layer), wrapMul(y.cell, row)), wrapAdd(x.cell, broadcastInt(10)));
  Int one = broadcastInt(1);
  Int at_y = wrapAdd(at, row);
  Int at_z = wrapAdd(at, layer);
  Int at_yz = wrapAdd(at_y, layer);
  PRECISE Real a0 = gatherReal(P, at);
  PRECISE Real a1 = gatherReal(P, wrapAdd(at, one));
  PRECISE Real b0 = gatherReal(P, at_y);
  PRECISE Real b1 = gatherReal(P, wrapAdd(at_y, one));
  PRECISE Real c0 = gatherReal(P, at_z);
  PRECISE Real c1 = gatherReal(P, wrapAdd(at_z, one));
  PRECISE Real d0 = gatherReal(P, at_yz);
  PRECISE Real d1 = gatherReal(P, wrapAdd(at_yz, one));

  Real a = mixSamples(a0, a1, x.t);
  Real b = mixSamples(b0, b1, x.t);
  Real c = mixSamples(c0, c1, x.t);
  Real d = mixSamples(d0, d1, x.t);
  Real low = mixSamples(a, b, y.t);
  Real high = mixSamples(c, d, y.t);
  Real v = mixSamples(low, high, z.t);

  PRECISE Real gx = slopeInCell(P, at, one, row, layer, x.t, y.t, z.t) * x.slope;
  PRECISE Real gy = slopeInCell(P, at, row, one, layer, y.t, x.t, z.t) * y.slope;
  PRECISE Real gz = slopeInCell(P, at, layer, one, row, z.t, x.t, y.t) * z.slope;

  Real zero = broadcast(0.0f);
  Bool above = v >= PF(P, 9);
  Bool below = v <= -PF(P, 9);
  Bool far = above || below;
  v = sel(above, broadcast(1.0e18f), sel(below, broadcast(-1.0e18f), v));
  return makeDual(v, sel(far, zero, gx), sel(far, zero, gy), sel(far, zero, gz), broadcastInt(PI(P, 0)));
}
