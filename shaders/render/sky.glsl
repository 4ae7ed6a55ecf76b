// The background, and the conversion of light to pixels. The including file must define frame.sun, the direction to the
// sun.

#define FN
#include "render/illumination.h"

// Returns the visible sky in a direction. Below the horizon, land fades into haze with distance.
vec3 sky(vec3 d) {
  vec3 low = skyLight(normalize(vec3(d.x, max(d.y, 0.004), d.z)), frame.sun.xyz);
  return d.y >= 0.0 ? low : mix(low, vec3(0.205, 0.225, 0.20), 0.85 * exp(0.05 / min(d.y, -1e-4)));
}

// Returns the light of haze in direction d, where haze hides everything behind it.
vec3 hazeIn(vec3 d) { return sky(normalize(vec3(d.x, max(d.y, 0.03), d.z))); }

// Tone mapping: Narkowicz's fit of the ACES curve, mixed with a simple exposure, because the deep shadows of film would
// look too black outdoors.
vec3 toneMap(vec3 c) {
  c *= 0.8;
  vec3 film = clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
  return mix(film, 1.0 - exp(-1.35 * c), 0.4);
}

// Packs a pixel in the format of ExposedPixel in runtime/tools/render/lens.h.
uvec3 exposedPixel(vec3 film, vec3 light) {
  return uvec3(packHalf2x16(film.rg), packHalf2x16(vec2(film.b, light.r)), packHalf2x16(light.gb));
}
