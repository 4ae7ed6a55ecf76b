// Packed vertex attributes from a gradient: octahedral normals (Meyer et al. 2010) in two int16.

struct PackedNormal {
  Int x, y;
};

// Packs a gradient as a normal. The field increases from the solid to the void, so its gradient points out of the
// solid. A gradient of length 0 becomes +y.
FN PackedNormal packNormal(Real dx, Real dy, Real dz) {
  PRECISE Real gx = clampReal(dx, -1.0e18f, 1.0e18f);
  PRECISE Real gy = clampReal(dy, -1.0e18f, 1.0e18f);
  PRECISE Real gz = clampReal(dz, -1.0e18f, 1.0e18f);
  PRECISE Real sum = absReal(gx) + absReal(gy);
  sum = sum + absReal(gz);
  Bool level = !(sum > 1.0e-20f);
  PRECISE Real inv = recipReal(sel(level, broadcast(1.0f), sum));
  PRECISE Real x = sel(level, broadcast(0.0f), gx * inv);
  PRECISE Real y = sel(level, broadcast(1.0f), gy * inv);
  PRECISE Real z = sel(level, broadcast(0.0f), gz * inv);
  // The lower half of the octahedron (z < 0) is folded outwards over its edges.
  PRECISE Real fx = 1.0f - absReal(y);
  fx = fx * signOf(x);
  PRECISE Real fy = 1.0f - absReal(x);
  fy = fy * signOf(y);
  Bool fold = z < 0.0f;
  PRECISE Real ox = clampReal(sel(fold, fx, x), -1.0f, 1.0f) * 32767.0f;
  PRECISE Real oy = clampReal(sel(fold, fy, y), -1.0f, 1.0f) * 32767.0f;
  ox = ox + 0.5f;
  oy = oy + 0.5f;
  PackedNormal r;
  r.x = toInt(floorReal(ox));
  r.y = toInt(floorReal(oy));
  return r;
}

// Makes every zero positive, and denormals zero. Vulkan defines neither the sign of a zero result, which pruning may
// change, nor how denormals behave.
FN Real unsignedZero(Real x) { return flushReal(x); }
