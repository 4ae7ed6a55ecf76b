// How thick the fog is where a mesh has its solid: density, 0 to 1, from the quantised samples that meshes are made of.
//
// With d = -Q, the depth below the surface in 1024ths of a finest cell, w the width of the edge in the same steps and
// t = min(max(d / w, 0), 1), the density is
//   2 t^2            where t < 1/2
//   1 - 2 (1 - t)^2  elsewhere.
// That is the integral of the linear B-spline, the smooth step of second order. Each of its operations is monotone, so
// density never falls with depth, rounding included; of the usual cubic that cannot be said. It is 0 exactly where the
// sample is not solid, and 1 from depth w on.

// inverse_edge: 1 / w, for w from 2^-10 to 2^22, beyond which samples are clamped.
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

// As a texture of 8 bits holds it (UNORM): 0 to 255, to the nearest.
FN Int densityByte(Real density) {
  PRECISE Real steps = density * 255.0f;
  steps = steps + 0.5f;
  return toInt(steps);
}
