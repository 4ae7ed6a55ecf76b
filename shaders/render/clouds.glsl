// The sky on a day of fair weather, with its clouds.

#include "render/cloud_layer.glsl"

// Returns the height of the clouds' base above the eye, in metres.
float cloudBase() {
  return kCloudBase - (frame.land.y < 0.0 ? 0.0 : clamp(frame.eye.y - frame.land.x, 0.0, kCloudBase - 150.0));
}

// Returns the light of the sky in a direction, with the sun's disc and clouds.
vec3 fairSky(vec3 d, float turn) {
  vec3 to_sun = frame.sun.xyz, clear = sky(d), c = clear;
  float s = dot(d, to_sun);
  c += vec3(9.0, 8.0, 6.5) * smoothstep(0.99996, 0.99998, s);
  c = mix(c, vec3(0.86, 0.89, 0.92) + 0.35 * sunLight() * pow(max(s, 0.0), 12.0), cirrus(d));
  // If the clouds are only a little above the eye, paths through them are longer, so more steps are needed.
  CloudLayer layer = CloudLayer(cloudBase(), max(-frame.land.w, 0.0), frame.land.w < 0.0 ? 84 : 28);
  vec4 near = cumulus(layer, d, to_sun, sunLight(), clear, turn);
  return c * near.a + near.rgb;
}

// Returns the share of sunlight that reaches the land through the clouds. from_eye: horizontal position in metres,
// relative to the eye.
float sunOnLand(vec2 from_eye) {
  if (frame.land.w == 0.0) return 1.0;
  vec3 to_sun = frame.sun.xyz;
  vec2 at = from_eye + to_sun.xz / max(to_sun.y, 0.1) * cloudBase();
  return mix(0.22, 1.0, 1.0 - smoothstep(-0.02, 0.30, 1.25 * cumulusAt(at, -1.0) - 0.08));
}
