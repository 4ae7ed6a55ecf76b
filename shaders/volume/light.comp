#version 450
#extension GL_GOOGLE_include_directive : require
// Precomputes, for points of the volume, the light from the sun and the sky, so that rays from the eye need not compute
// it.
#include "volume/volume.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
// for each point: optical depth towards the sun, and share of the sky's light
layout(rgba16f, binding = 3) writeonly uniform image3D lit_volume;

// Returns the optical depth along a ray, by steps of one cell, sampled in the middle of each step.
float opticalDepth(vec3 from, vec3 direction) {
  vec3 d = withoutZeros(direction);
  float end = crossing(from, d, vec3(0.0), volumeEnd()).y, depth = 0.0;
  for (float t = 0.0; t < end;) {
    float ahead = emptyAhead(from, d, t);
    if (ahead > 0.0) {
      t += ahead;
      continue;
    }
    float step_length = min(1.0, end - t);
    depth += extinctionAt(from + d * (t + 0.5 * step_length)) * step_length;
    t += max(step_length, 1e-3);
  }
  return depth * frame.corner.w;
}

// Returns the share of the sky's light that reaches a place. Skylight has been scattered many times, so it is absorbed
// slowly: like the third octave (order of scattering) in scattered(). It is traced straight up and to four sides,
// because a single direction would cause streaks.
float skyShare(vec3 place) {
  float sum = 0.0;
  const vec3 kFrom[] =
      vec3[](vec3(0, 1, 0), vec3(0.6, 0.8, 0), vec3(-0.6, 0.8, 0), vec3(0, 0.8, 0.6), vec3(0, 0.8, -0.6));
  for (int i = 0; i < kFrom.length(); ++i) sum += exp(-0.25 * opticalDepth(place, kFrom[i]));
  return sum / float(kFrom.length());
}

// True if march.comp may read this point of the light volume to light a place that has density: it reads points up to
// 1.5 point distances away from the place on each axis.
bool isSeen(vec3 place, vec3 apart) {
  ivec3 lo = brickAt(place - 1.5 * apart), hi = brickAt(place + 1.5 * apart);
  for (int i = 0; i < 8; ++i) {
    bvec3 high = bvec3((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
    if (!isEmpty(mix(lo, hi, high))) return true;
  }
  return false;
}

void main() {
  uvec3 at = gl_GlobalInvocationID;
  if (any(greaterThanEqual(at, frame.lit_size.xyz))) return;
  vec3 apart = volumeEnd() / (vec3(frame.lit_size.xyz) - 1.0), place = vec3(at) * apart;
  if (!isSeen(place, apart)) return;
  imageStore(lit_volume, ivec3(at), vec4(opticalDepth(place, frame.sun.xyz), skyShare(place), 0.0, 0.0));
}
