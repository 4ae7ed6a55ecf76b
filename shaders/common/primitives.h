// Primitives: each returns the signed distance in units, negative inside, with its gradient per world unit. No
// primitive has a slope above 1. The parameters P of every primitive begin with its label (0) and its centre as
// integers (1-3). Primitives with a frame continue with the rotation from world to local axes, nine numbers by row
// (4-12). Further parameters are listed at each primitive. The CPU computes all reciprocals among the parameters.

FN Vec3 offsetFrom(Int px, Int py, Int pz, Params P) {
  return makeVec3(toReal(saturatingSub(px, broadcastInt(PI(P, 1)))), toReal(saturatingSub(py, broadcastInt(PI(P, 2)))),
                  toReal(saturatingSub(pz, broadcastInt(PI(P, 3)))));
}

FN Real dotRow(Vec3 d, float x, float y, float z) {
  PRECISE Real a = d.x * x;
  PRECISE Real b = d.y * y;
  PRECISE Real c = d.z * z;
  PRECISE Real r = a + b;
  r = r + c;
  return r;
}

FN Vec3 toLocal(Int px, Int py, Int pz, Params P) {
  Vec3 d = offsetFrom(px, py, pz, P);
  return makeVec3(dotRow(d, PF(P, 4), PF(P, 5), PF(P, 6)), dotRow(d, PF(P, 7), PF(P, 8), PF(P, 9)),
                  dotRow(d, PF(P, 10), PF(P, 11), PF(P, 12)));
}

// Rotates a local gradient to world axes.
FN Dual fromLocal(Real v, Real gx, Real gy, Real gz, Params P) {
  Vec3 g = makeVec3(gx, gy, gz);
  return makeDual(v, dotRow(g, PF(P, 4), PF(P, 7), PF(P, 10)), dotRow(g, PF(P, 5), PF(P, 8), PF(P, 11)),
                  dotRow(g, PF(P, 6), PF(P, 9), PF(P, 12)), broadcastInt(PI(P, 0)));
}

// Returns the squared length. Squares below 1e-15 count as 0, because devices would disagree on the direction of a
// denormal.
FN Real lengthSquared2(Real x, Real y) {
  PRECISE Real a = x * x;
  PRECISE Real b = y * y;
  PRECISE Real r = a + b;
  return sel(r > 1.0e-30f, r, broadcast(0.0f));
}

FN Real lengthSquared3(Vec3 p) {
  PRECISE Real a = p.x * p.x;
  PRECISE Real b = p.y * p.y;
  PRECISE Real c = p.z * p.z;
  PRECISE Real r = a + b;
  r = r + c;
  return sel(r > 1.0e-30f, r, broadcast(0.0f));
}

// Signed distance, in a plane, to the corner where two half-planes meet. a, b: exact signed distances to their borders.
// Outside, the corner is round; inside, the nearer border counts. ga, gb: share of each border's normal in the
// gradient.
struct Corner {
  Real v, ga, gb;
};
FN Corner cornerDistance(Real a, Real b) {
  PRECISE Real zero = broadcast(0.0f);
  PRECISE Real pa = maxReal(a, zero);
  PRECISE Real pb = maxReal(b, zero);
  PRECISE Real inner = minReal(maxReal(a, b), zero);
  PRECISE Real s = lengthSquared2(pa, pb);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real outer = s * inv;
  Bool outside = s > 0.0f;
  Bool by_a = a > b;
  PRECISE Real ra = pa * inv;
  PRECISE Real rb = pb * inv;
  PRECISE Real one = broadcast(1.0f);
  Corner r;
  PRECISE Real v = outer + inner;
  r.v = v;
  r.ga = sel(outside, ra, sel(by_a, one, zero));
  r.gb = sel(outside, rb, sel(by_a, zero, one));
  return r;
}

// A ball. Parameters: 4 radius. No frame.
FN Dual opSphere(Int px, Int py, Int pz, Params P) {
  Vec3 d = offsetFrom(px, py, pz, P);
  PRECISE Real s = lengthSquared3(d);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real v = s * inv;
  v = v - PF(P, 4);
  PRECISE Real gx = d.x * inv;
  PRECISE Real gy = d.y * inv;
  PRECISE Real gz = d.z * inv;
  return makeDual(v, gx, gy, gz, broadcastInt(PI(P, 0)));
}

// A box. Parameters: 13-15 half extents.
FN Dual opBox(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real zero = broadcast(0.0f);
  PRECISE Real one = broadcast(1.0f);
  PRECISE Real ax = absReal(q.x) - PF(P, 13);
  PRECISE Real ay = absReal(q.y) - PF(P, 14);
  PRECISE Real az = absReal(q.z) - PF(P, 15);
  Vec3 o = makeVec3(maxReal(ax, zero), maxReal(ay, zero), maxReal(az, zero));
  PRECISE Real s = lengthSquared3(o);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real inner = minReal(maxReal(ax, maxReal(ay, az)), zero);
  PRECISE Real v = s * inv;
  v = v + inner;
  Bool outside = s > 0.0f;
  Bool by_x = (ax > ay) && (ax > az);
  Bool by_y = (ay > az);
  PRECISE Real ox = o.x * inv;
  PRECISE Real oy = o.y * inv;
  PRECISE Real oz = o.z * inv;
  PRECISE Real gx = sel(outside, ox, sel(by_x, one, zero)) * signOf(q.x);
  PRECISE Real gy = sel(outside, oy, sel(by_x, zero, sel(by_y, one, zero))) * signOf(q.y);
  PRECISE Real gz = sel(outside, oz, sel(by_x || by_y, zero, one)) * signOf(q.z);
  return fromLocal(v, gx, gy, gz, P);
}

// A cylinder along local y. Parameters: 13 radius, 14 half height.
FN Dual opCylinder(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real s = lengthSquared2(q.x, q.z);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real a = s * inv;
  a = a - PF(P, 13);
  PRECISE Real b = absReal(q.y) - PF(P, 14);
  Corner c = cornerDistance(a, b);
  PRECISE Real side = c.ga * inv;
  PRECISE Real gx = q.x * side;
  PRECISE Real gz = q.z * side;
  PRECISE Real gy = c.gb * signOf(q.y);
  return fromLocal(c.v, gx, gy, gz, P);
}

// A truncated cone along local y. Parameters: 13 bottom radius, 14 top radius, 15 half height, 16-17 outward normal of
// the slanted side (radial, y), 18 length of the slanted side, 19-20 its unit direction from the bottom rim to the top
// rim (radial, y).
FN Dual opTruncone(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real zero = broadcast(0.0f);
  PRECISE Real s = lengthSquared2(q.x, q.z);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real radial = s * inv;
  PRECISE Real ex = radial - PF(P, 13);
  PRECISE Real ey = q.y + PF(P, 15);
  PRECISE Real sn = ex * PF(P, 16);
  PRECISE Real sm = ey * PF(P, 17);
  PRECISE Real side = sn + sm;
  PRECISE Real tn = ex * PF(P, 19);
  PRECISE Real tm = ey * PF(P, 20);
  PRECISE Real along = tn + tm;
  PRECISE Real cap = absReal(q.y) - PF(P, 15);
  Bool top = q.y > 0.0f;
  PRECISE Real rim = sel(top, broadcast(PF(P, 14)), broadcast(PF(P, 13)));
  PRECISE Real over = radial - rim;
  PRECISE Real cx = maxReal(over, zero);
  PRECISE Real cy = maxReal(cap, zero);
  // In the half-plane of radius and y, the slanted side is a line segment, whose ends are the rims. The distance of a
  // point beside the segment is measured to the segment's line; the distance of a point beyond an end, to that end.
  PRECISE Real held = clampReal(along, 0.0f, PF(P, 18));
  PRECISE Real past = along - held;
  PRECISE Real slant2 = lengthSquared2(side, past);
  PRECISE Real cap2 = lengthSquared2(cx, cy);
  Bool inside = (side <= 0.0f) && (cap <= 0.0f);
  Bool on_cap = (cap > 0.0f) && (cap2 < slant2);
  PRECISE Real s2 = sel(on_cap, cap2, slant2);
  PRECISE Real inv2 = rsqrtReal(s2);
  PRECISE Real outer = s2 * inv2;
  PRECISE Real inner = maxReal(side, cap);
  PRECISE Real v = sel(inside, inner, outer);
  Bool within = absReal(past) <= 0.0f;
  PRECISE Real a = side * PF(P, 16);
  PRECISE Real b = past * PF(P, 19);
  PRECISE Real wr = a + b;
  wr = wr * inv2;
  a = side * PF(P, 17);
  b = past * PF(P, 20);
  PRECISE Real wy = a + b;
  wy = wy * inv2;
  wr = sel(within, broadcast(PF(P, 16)), wr);
  wy = sel(within, broadcast(PF(P, 17)), wy);
  PRECISE Real kr = cx * inv2;
  PRECISE Real ky = cy * inv2;
  ky = ky * signOf(q.y);
  PRECISE Real outer_r = sel(on_cap, kr, wr);
  PRECISE Real outer_y = sel(on_cap, ky, wy);
  Bool inner_cap = cap > side;
  PRECISE Real inner_r = sel(inner_cap, zero, broadcast(PF(P, 16)));
  PRECISE Real inner_y = sel(inner_cap, signOf(q.y), broadcast(PF(P, 17)));
  PRECISE Real gr = sel(inside, inner_r, outer_r);
  PRECISE Real gy = sel(inside, inner_y, outer_y);
  gr = gr * inv;
  PRECISE Real gx = q.x * gr;
  PRECISE Real gz = q.z * gr;
  return fromLocal(v, gx, gy, gz, P);
}

// A capsule: a ball swept from the centre along a world vector. Parameters: 4-6 vector, 7 reciprocal of its squared
// length (0 for a sphere), 8 radius. No frame.
FN Dual opCapsule(Int px, Int py, Int pz, Params P) {
  Vec3 d = offsetFrom(px, py, pz, P);
  PRECISE Real h = dotRow(d, PF(P, 4), PF(P, 5), PF(P, 6)) * PF(P, 7);
  h = clampReal(h, 0.0f, 1.0f);
  PRECISE Real ox = h * PF(P, 4);
  PRECISE Real oy = h * PF(P, 5);
  PRECISE Real oz = h * PF(P, 6);
  ox = d.x - ox;
  oy = d.y - oy;
  oz = d.z - oz;
  PRECISE Real s = lengthSquared3(makeVec3(ox, oy, oz));
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real v = s * inv;
  v = v - PF(P, 8);
  ox = ox * inv;
  oy = oy * inv;
  oz = oz * inv;
  return makeDual(v, ox, oy, oz, broadcastInt(PI(P, 0)));
}

// A torus around local y. Parameters: 13 radius of the ring, 14 radius of the tube.
FN Dual opTorus(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real s = lengthSquared2(q.x, q.z);
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real t = s * inv;
  t = t - PF(P, 13);
  PRECISE Real s2 = lengthSquared2(t, q.y);
  PRECISE Real inv2 = rsqrtReal(s2);
  PRECISE Real v = s2 * inv2;
  v = v - PF(P, 14);
  PRECISE Real side = t * inv2;
  side = side * inv;
  PRECISE Real gx = q.x * side;
  PRECISE Real gy = q.y * inv2;
  PRECISE Real gz = q.z * side;
  return fromLocal(v, gx, gy, gz, P);
}

// An ellipsoid: returns (|q / radii| - 1) * smallest radius. Parameters: 13-15 reciprocal radii, 16 smallest radius.
FN Dual opEllipsoid(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real ux = q.x * PF(P, 13);
  PRECISE Real uy = q.y * PF(P, 14);
  PRECISE Real uz = q.z * PF(P, 15);
  PRECISE Real s = lengthSquared3(makeVec3(ux, uy, uz));
  PRECISE Real inv = rsqrtReal(s);
  PRECISE Real v = s * inv;
  v = v - 1.0f;
  v = v * PF(P, 16);
  PRECISE Real k = inv * PF(P, 16);
  PRECISE Real gx = ux * PF(P, 13);
  gx = gx * k;
  PRECISE Real gy = uy * PF(P, 14);
  gy = gy * k;
  PRECISE Real gz = uz * PF(P, 15);
  gz = gz * k;
  return fromLocal(v, gx, gy, gz, P);
}

// Returns (||q / radii||_n - 1) * smallest radius, where ||.||_n is the norm with exponent n; its gradient is in local
// axes.
FN Dual superquadricLocal(Vec3 q, Real ix, Real iy, Real iz, Real smallest, Real n) {
  PRECISE Real ux = absReal(q.x) * ix;
  PRECISE Real uy = absReal(q.y) * iy;
  PRECISE Real uz = absReal(q.z) * iz;
  PRECISE Real m = maxReal(maxReal(ux, maxReal(uy, uz)), broadcast(1e-12f));
  PRECISE Real inv_m = recipReal(m);
  PRECISE Real wx = minReal(ux * inv_m, broadcast(1.0f));
  PRECISE Real wy = minReal(uy * inv_m, broadcast(1.0f));
  PRECISE Real wz = minReal(uz * inv_m, broadcast(1.0f));
  PRECISE Real s = powReal(wx, n) + powReal(wy, n);
  s = s + powReal(wz, n);
  PRECISE Real e = log2Real(s) * recipReal(n);
  PRECISE Real root = exp2Real(e);
  PRECISE Real v = m * root;
  v = v - 1.0f;
  v = v * smallest;
  PRECISE Real inv_root = recipReal(root);
  PRECISE Real n1 = n - 1.0f;
  PRECISE Real gx = wx * inv_root;
  gx = powReal(minReal(gx, broadcast(1.0f)), n1) * ix;
  gx = gx * smallest;
  gx = gx * signOf(q.x);
  PRECISE Real gy = wy * inv_root;
  gy = powReal(minReal(gy, broadcast(1.0f)), n1) * iy;
  gy = gy * smallest;
  gy = gy * signOf(q.y);
  PRECISE Real gz = wz * inv_root;
  gz = powReal(minReal(gz, broadcast(1.0f)), n1) * iz;
  gz = gz * smallest;
  gz = gz * signOf(q.z);
  return makeDual(v, gx, gy, gz, broadcastInt(0));
}

// A superquadric. Parameters: 13-15 reciprocal radii, 16 smallest radius, 17 exponent n >= 2.
FN Dual opSuperquadric(Int px, Int py, Int pz, Params P) {
  Dual d = superquadricLocal(toLocal(px, py, pz, P), broadcast(PF(P, 13)), broadcast(PF(P, 14)), broadcast(PF(P, 15)),
                             broadcast(PF(P, 16)), broadcast(PF(P, 17)));
  return fromLocal(d.v, d.x, d.y, d.z, P);
}

// Returns the power morph at t: a superquadric. Its radii are interpolated between the parameters 13-15 (t = 0) and
// 16-18 (t = 1), and its exponent is 2 / (1 - t + t * 2 / kMaxPower). Parameter 19 is 2 / kMaxPower.
FN Dual powerMorphAt(Vec3 q, Real t, Params P) {
  PRECISE Real k = 1.0f - t;
  PRECISE Real ax = k * PF(P, 13);
  PRECISE Real bx = t * PF(P, 16);
  PRECISE Real rx = ax + bx;
  ax = k * PF(P, 14);
  bx = t * PF(P, 17);
  PRECISE Real ry = ax + bx;
  ax = k * PF(P, 15);
  bx = t * PF(P, 18);
  PRECISE Real rz = ax + bx;
  PRECISE Real e = t * PF(P, 19);
  e = k + e;
  PRECISE Real n = recipReal(e) * 2.0f;
  return superquadricLocal(q, recipReal(rx), recipReal(ry), recipReal(rz), minReal(rx, minReal(ry, rz)), n);
}

// Returns the value, and the part of the gradient due to the position. The other part is the gradient of t times
// opPowerMorphSlope.
FN Dual opPowerMorph(Int px, Int py, Int pz, Dual t, Params P) {
  Dual d = powerMorphAt(toLocal(px, py, pz, P), clampReal(t.v, 0.0f, 1.0f), P);
  return fromLocal(d.v, d.x, d.y, d.z, P);
}

// Returns df/dt, the derivative of the power morph by t. It has no short closed form; a difference over 1/64 of the
// range is exact enough for a normal.
FN Real opPowerMorphSlope(Int px, Int py, Int pz, Dual t, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real before = clampReal(t.v - 0.0078125f, 0.0f, 1.0f);
  PRECISE Real after = clampReal(t.v + 0.0078125f, 0.0f, 1.0f);
  PRECISE Real width = after - before;
  Dual d0 = powerMorphAt(q, before, P);
  Dual d1 = powerMorphAt(q, after, P);
  PRECISE Real slope = d1.v - d0.v;
  slope = slope * recipReal(sel(width > 0.0f, width, broadcast(1.0f)));
  return sel((t.v > 0.0f) && (t.v < 1.0f), slope, broadcast(0.0f));
}

FN Dual addSlope(Dual d, Dual t, Real slope) {
  PRECISE Real x = t.x * slope;
  x = d.x + x;
  PRECISE Real y = t.y * slope;
  y = d.y + y;
  PRECISE Real z = t.z * slope;
  z = d.z + z;
  return makeDual(d.v, holdReal(x), holdReal(y), holdReal(z), d.label);
}

// A half-space, which is solid below the local plane y = 0.
FN Dual opHalfspace(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  PRECISE Real zero = broadcast(0.0f);
  return fromLocal(q.y, zero, broadcast(1.0f), zero, P);
}

// A prism: a polygon in local x and z, counter-clockwise seen from +y, between local y = -h and h. Parameters: 13 half
// height h, 14 number of corners, then for each corner: x, z, the edge to the next corner x, z, and the reciprocals of
// the edge's squared length and of its length.
FN Dual opPrism(Int px, Int py, Int pz, Params P) {
  Vec3 q = toLocal(px, py, pz, P);
  int count = PI(P, 14);
  PRECISE Real best = broadcast(3.0e38f);
  PRECISE Real gx = broadcast(0.0f);
  PRECISE Real gz = broadcast(0.0f);
  Bool on_edge = best < 0.0f;
  Bool inside = best < 0.0f;
  for (int k = 0; k < count; ++k) {
    int at = 15 + 6 * k;
    PRECISE Real wx = q.x - RF(P, at);
    PRECISE Real wz = q.z - RF(P, at + 1);
    PRECISE Real a = wx * RF(P, at + 2);
    PRECISE Real b = wz * RF(P, at + 3);
    PRECISE Real h = a + b;
    h = h * RF(P, at + 4);
    PRECISE Real held = clampReal(h, 0.0f, 1.0f);
    PRECISE Real dx = held * RF(P, at + 2);
    dx = wx - dx;
    PRECISE Real dz = held * RF(P, at + 3);
    dz = wz - dz;
    PRECISE Real s = lengthSquared2(dx, dz);
    Bool nearer = s < best;
    Bool middle = (h > 0.0f) && (h < 1.0f);
    PRECISE Real nx = broadcast(-RF(P, at + 3)) * RF(P, at + 5);
    PRECISE Real nz = broadcast(RF(P, at + 2)) * RF(P, at + 5);
    best = sel(nearer, s, best);
    gx = sel(nearer, sel(middle, nx, dx), gx);
    gz = sel(nearer, sel(middle, nz, dz), gz);
    on_edge = (nearer && middle) || (on_edge && !nearer);
    // Even-odd rule for inside or outside: counts the edges that cross the point's z on the side of +x.
    Real this_z = broadcast(RF(P, at + 1));
    PRECISE Real next_z = this_z + RF(P, at + 3);
    PRECISE Real c = wz * RF(P, at + 2);
    PRECISE Real e = wx * RF(P, at + 3);
    Bool upward = (this_z <= q.z) && (q.z < next_z);
    Bool downward = (next_z <= q.z) && (q.z < this_z);
    Bool cross = (upward && (c > e)) || (downward && (c < e));
    inside = (inside && !cross) || (!inside && cross);
  }
  PRECISE Real inv = rsqrtReal(best);
  PRECISE Real a = best * inv;
  a = sel(inside, -a, a);
  PRECISE Real turn = sel(inside, -inv, inv);
  PRECISE Real px2 = gx * turn;
  PRECISE Real pz2 = gz * turn;
  gx = sel(on_edge, gx, px2);
  gz = sel(on_edge, gz, pz2);
  PRECISE Real b = absReal(q.y) - PF(P, 13);
  Corner c = cornerDistance(a, b);
  PRECISE Real hx = gx * c.ga;
  PRECISE Real hz = gz * c.ga;
  PRECISE Real hy = c.gb * signOf(q.y);
  return fromLocal(c.v, hx, hy, hz, P);
}

// Returns the kernel max(0, 1 - x)^3 and its derivative.
FN Corner kernelOf(Real x) {
  PRECISE Real k = 1.0f - x;
  k = maxReal(k, broadcast(0.0f));
  PRECISE Real k2 = k * k;
  PRECISE Real v = k2 * k;
  PRECISE Real slope = k2 * -3.0f;
  Corner r;
  r.v = v;
  r.ga = slope;
  r.gb = slope;
  return r;
}

// Returns the weight of a ball in a sum, by a kernel with compact support. The kernel takes the squared distance, so no
// square root is needed. Parameters: 4 reciprocal of the squared support radius. No frame.
FN Dual opBlob(Int px, Int py, Int pz, Params P) {
  Vec3 d = offsetFrom(px, py, pz, P);
  PRECISE Real x = lengthSquared3(d) * PF(P, 4);
  Corner k = kernelOf(x);
  PRECISE Real s = k.ga * PF(P, 4);
  s = s * 2.0f;
  PRECISE Real gx = d.x * s;
  PRECISE Real gy = d.y * s;
  PRECISE Real gz = d.z * s;
  return makeDual(k.v, gx, gy, gz, broadcastInt(PI(P, 0)));
}
