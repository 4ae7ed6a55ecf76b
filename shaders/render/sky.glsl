// What lies behind everything, and how light becomes a pixel. Whoever includes this has frame.sun, towards the sun.

#define FN
#include "render/illumination.h"

// What is seen of the sky in a direction. Land under the horizon lies in haze, the farther the more.
vec3 sky(vec3 d) {
  vec3 low = skyLight(normalize(vec3(d.x, max(d.y, 0.004), d.z)), frame.sun.xyz);
  return d.y >= 0.0 ? low : mix(low, vec3(0.205, 0.225, 0.20), 0.85 * exp(0.05 / min(d.y, -1e-4)));
}

// What the air between the eye and whatever lies in direction d adds, once it hides all of it.
vec3 hazeIn(vec3 d) { return sky(normalize(vec3(d.x, max(d.y, 0.03), d.z))); }

// Narkowicz's fit of the ACES curve, and a plain exposure beside it: film's deep shade would be too black out of doors.
vec3 toneMap(vec3 c) {
  c *= 0.8;
  vec3 film = clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
  return mix(film, 1.0 - exp(-1.35 * c), 0.4);
}

// A pixel as ExposedPixel of runtime/tools/render/lens.h has it.
uvec3 exposedPixel(vec3 film, vec3 light) {
  return uvec3(packHalf2x16(film.rg), packHalf2x16(vec2(film.b, light.r)), packHalf2x16(light.gb));
}
