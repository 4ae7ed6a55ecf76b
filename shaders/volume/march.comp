#version 450
#extension GL_GOOGLE_include_directive : require
// Marches a ray through the volume for each pixel, front to back: the light that comes to the eye, and the share of what
// is behind that still shows. An engine lays that over its scene.
#include "volume/volume.glsl"
#include "volume/scattering.glsl"
#include "render/noise.glsl"
#include "render/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 4) uniform sampler3D lit_volume;
layout(std430, binding = 5) writeonly buffer Light { vec4 light[]; };  // by pixel; w: transmittance

const float kStep = 0.7;     // cells
const float kOpaque = 0.004;  // less than half a step of 8 bits shows through

vec3 sourceAt(vec3 place, float cosine) {
  vec3 lit_place = place * (vec3(frame.lit_size.xyz) - 1.0) / volumeEnd();
  vec2 lit = textureLod(lit_volume, (lit_place + 0.5) / vec3(frame.lit_size.xyz), 0.0).rg;
  vec3 sun = frame.sun_light.rgb * scattered(cosine, lit.x, frame.sun.w, frame.size.w);
  vec3 around = mix(frame.ground_light.rgb, frame.sky_light.rgb, lit.y);
  return frame.up.w * (sun + around);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.picture.xy))) return;
  vec2 centre = (vec2(pixel) + 0.5) / vec2(frame.picture.xy) * 2.0 - 1.0;
  vec3 view = normalize(frame.forward.xyz + centre.x * frame.right.xyz - centre.y * frame.up.xyz);
  vec3 d = withoutZeros(view), from = placeOf(frame.eye.xyz);
  vec2 ends = crossing(from, d, vec3(0.0), volumeEnd());
  float cosine = dot(view, frame.sun.xyz), transmittance = 1.0;
  // Each pixel samples its steps elsewhere: banding becomes noise, finer than what is seen.
  float jitter = random3(ivec3(pixel, 11)).x;
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
      // Exact where the medium is uniform over the step (Hillaire 2015, "Physically based and unified volumetric
      // rendering in Frostbite").
      float passed = exp(-extinction * step_length * frame.corner.w);
      float clear = exp(-t * frame.corner.w / frame.forward.w);
      sum += transmittance * (1.0 - passed) * mix(haze, sourceAt(place, cosine), clear);
      transmittance *= passed;
    }
    t += max(step_length, 1e-3);
  }
  light[pixel.y * frame.picture.x + pixel.x] = vec4(sum, transmittance);
}
