#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Marches rays through the volume for each pixel, front to back. The result is the light that reaches the eye, and the
// transmittance, the share of the background that remains visible. An engine draws it over its scene.
#include "volume/volume.glsl"
#include "volume/scattering.glsl"
#include "render/noise.glsl"
#include "render/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 4) uniform sampler3D lit_volume;
layout(std430, binding = 5) writeonly buffer Light { vec4 light[]; };  // light for each pixel; w: transmittance

const float kStep = 0.7;     // length of a step in cells
const float kOpaque = 0.004;  // transmittance at which a ray ends: less than half an 8-bit brightness step is visible
                              // through the volume

// Returns the light that a place sends to the eye. turn: random numbers 0..1, which shift the place where the light
// volume is read by up to half a point in each direction; otherwise the cells of the light volume would be visible.
vec3 sourceAt(vec3 place, float cosine, vec3 turn) {
  vec3 lit_place = place * (vec3(frame.lit_size.xyz) - 1.0) / volumeEnd() + turn - 0.5;
  vec2 lit = textureLod(lit_volume, (lit_place + 0.5) / vec3(frame.lit_size.xyz), 0.0).rg;
  vec3 sun = frame.sun_light.rgb * scattered(cosine, lit.x, frame.sun.w, frame.size.w);
  vec3 around = mix(frame.ground_light.rgb, frame.sky_light.rgb, lit.y);
  return frame.up.w * (sun + around);
}

// Returns the light along a ray from the eye (rgb), and the transmittance (a). turn: numbers that differ from ray to
// ray.
vec4 march(vec3 view, ivec2 turn) {
  vec3 d = withoutZeros(view), from = placeOf(frame.eye.xyz);
  vec2 ends = crossing(from, d, vec3(0.0), volumeEnd());
  float cosine = dot(view, frame.sun.xyz), transmittance = 1.0;
  // The start of each ray is jittered, so that banding becomes noise that is too fine to be visible.
  float jitter = random3(ivec3(turn, 0)).x;
  int steps = 0;
  vec3 sum = vec3(0.0), haze = hazeIn(view);
  for (float t = max(ends.x, 0.0); t < ends.y && transmittance > kOpaque;) {
    float ahead = emptyAhead(from, d, t);
    if (ahead > 0.0) {
      t += ahead;
      continue;
    }
    float step_length = min(kStep, ends.y - t);
    vec3 place = from + d * (t + jitter * step_length);
    float extinction = extinctionAt(place);
    if (extinction > 0.0) {
      // This integration of a step is exact if the medium is uniform over the step (Hillaire 2015, "Physically based
      // and unified volumetric rendering in Frostbite").
      float passed = exp(-extinction * step_length * frame.corner.w);
      float clear = exp(-t * frame.corner.w / frame.forward.w);
      vec3 source = sourceAt(place, cosine, random3(ivec3(turn, ++steps)));
      sum += transmittance * (1.0 - passed) * mix(haze, source, clear);
      transmittance *= passed;
    }
    t += max(step_length, 1e-3);
  }
  return vec4(sum, transmittance);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.picture.xy))) return;
  // The rays of a pixel go through the middles of side * side equal squares of the pixel.
  int side = int(frame.picture.z);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < side * side; ++i) {
    ivec2 sub_pixel = ivec2(pixel) * side + ivec2(i % side, i / side);
    vec2 at = (vec2(sub_pixel) + 0.5) / vec2(frame.picture.xy * frame.picture.z) * 2.0 - 1.0;
    sum += march(normalize(frame.forward.xyz + at.x * frame.right.xyz - at.y * frame.up.xyz), sub_pixel);
  }
  light[pixel.y * frame.picture.x + pixel.x] = sum / float(side * side);
}
