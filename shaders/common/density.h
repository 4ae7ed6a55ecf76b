// Density, 0 to 1, of a field that is drawn as fog instead of as a solid mesh. It is computed from the same quantised
// samples Q as a mesh.
//
// Let d = -Q be the depth below the surface in 1024ths of a finest cell, w the width of the fog's soft edge in the same
// unit, and t = min(max(d / w, 0), 1). Then the density is
//   2 t^2            where t < 1/2
//   1 - 2 (1 - t)^2  elsewhere.
// This is the integral of the linear B-spline, a smooth step of second order. Each of its operations is monotone, so
// that density never decreases with depth, even after rounding; the usual cubic smooth step does not guarantee this.
// Density is exactly 0 if the sample is not solid, and 1 from depth w on.

// Returns the density of a quantised sample. inverse_edge: 1 / w, where w is 2^-10 to 2^22; 2^22 is the largest
// magnitude of a quantised sample.
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
