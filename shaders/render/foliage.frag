#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Draws the ground between blades of grass: the taller the blades, the darker the ground.
#include "render/foliage.glsl"
#include "render/noise.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 3) flat in uint second;
layout(location = 4) flat in float grown;
layout(location = 5) in float share;
layout(location = 6) in float growth;
layout(location = 0) out vec4 out_position;
// w: if below 0, minus the brightness, which decreases with the depth of the point in the foliage
layout(location = 1) out vec4 out_normal;

void main() {
  bool is_second = false;
  if (share > 0.15) {
    float ragged = 0.5 + 0.22 * noise(position * 3.1).x + 0.10 * noise(position * 13.0).x;
    is_second = share > ragged;
  }
  if (grown != 3.0 && (grown == 2.0) != is_second) discard;
  vec3 n = normalize(normal);
  if (n.y < 0.72) discard;
  float t = length(position - eye.xyz);
  if (t > offset.w) discard;
  out_position = vec4(position, float((is_second ? second : material) + 1u));
  out_normal = vec4(n, -mix(1.0, mix(0.62, 0.32, growth), nearness(t)));
}
