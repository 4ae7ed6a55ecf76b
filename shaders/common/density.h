// The density of fog, 0 to 1, which replaces the solid of a mesh. It is computed from the same quantised samples as
// meshes.
//
// With d = -Q, the depth below the surface in 1024ths of a finest cell, w the width of the edge in the same unit, and t
// = min(max(d / w, 0), 1), the density is
//   2 t^2            where t < 1/2
//   1 - 2 (1 - t)^2  elsewhere.
// This is the integral of the linear B-spline, a smooth step of second order. Each of its operations is monotone, so
// that density never decreases with depth, even after rounding; the usual cubic smooth step does not guarantee this.
// Density is exactly 0 if the sample is not solid, and 1 from depth w on.

// Returns the density of a quantised sample. inverse_edge: 1 / w, for w from 2^-10 to 2^22, beyond which samples are
// clamped.
FN Real densityOf(Int q, float inverse_edge) {
  PRECISE Real t = toReal(wrapSub(broadcastInt(0), q)) * inverse_edge;
  t = clampReal(t, 0.0f, 1.0f);
  PRECISE Real rise = t * t;
  rise = rise + rise;
  PRECISE Real rest = 1.0f - t;
  rest = rest * rest;
  rest = rest + rest;
  rest = 1.0f - rest;
  return sel(t < 0.5f, rise, rest);
}

// Converts a density to a byte as in an 8-bit texture (UNORM): 0 to 255, rounded to the nearest integer.
FN Int densityByte(Real density) {
  PRECISE Real steps = density * 255.0f;
  steps = steps + 0.5f;
  return toInt(steps);
}
