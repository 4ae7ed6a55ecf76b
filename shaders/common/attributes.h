// Packed vertex attributes from a gradient: octahedral normals (Meyer et al. 2010) in two int16.

struct PackedNormal {
  Int x, y;
};

// Out of the solid is where the field grows. A gradient without length gives +y.
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
  // The octahedron's lower half (z < 0) folds over its edges.
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

// One sign for every zero: Vulkan does not promise a zero's sign, and pruning may turn it. Nor does it promise
// denormals.
FN Real unsignedZero(Real x) { return flushReal(x); }
