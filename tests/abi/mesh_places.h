#pragma once
// Computes the exact positions of mesh vertices.

#include "fixture.h"

/// An infinite world of bumpy balls, each with an anchor.
inline constexpr const char* kBlobs =
    "sgm 1; units m;\n"
    "domain infinite;\n"
    "layer main cell 16m reach 9m { start Blob; }\n"
    "rule Blob { at(cell.point(jitter 0.5)) { displace 0.4m*fractal(2m) amp 0.4m { sphere(rand(3m, 7m)); } } "
    "anchor spawn \"middle\"; }\n";

using Place = std::array<int64_t, 3>;

/// Returns a vertex's exact world position in 1/256 units.
inline Place placeOf(const sgm_mesh_view& view, uint32_t index) {
  const sgm_vertex& v = view.vertices[index];
  const std::array<int16_t, 3> p{v.x, v.y, v.z};
  Place place{};
  for (size_t axis = 0; axis < 3; ++axis)
    place[axis] = int64_t{view.origin[axis]} * 256 + int64_t{p[axis]} * view.cell_units;
  return place;
}
