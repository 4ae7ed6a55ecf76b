#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// What is seen at a sample: where it lies, which way it faces, what it is made of. Lit later, once.
#include "render/noise.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 3) in vec2 texture_at;
layout(location = 4) flat in uint second;
layout(location = 5) in float share;
layout(location = 0) out vec4 out_position;  // w: material + 1; 0 is the background
layout(location = 1) out vec4 out_normal;    // w: what the chequers show, 0 where there are none

// 1 and 2: the fields; 3: a line along u, 4: along v. Where a field is smaller than a sample it is 1.5.
float chequers(vec2 at) {
  vec2 width = fwidth(at);
  if (width.x + width.y == 0.0) return 0.0;
  if (max(width.x, width.y) > 0.25) return 1.5;
  vec2 f = fract(at);
  const float kLine = 1.0 / 24.0;
  if (f.y < kLine) return 3.0;
  if (f.x < kLine) return 4.0;
  return (f.x < 0.5) != (f.y < 0.5) ? 1.0 : 2.0;
}

void main() {
  vec3 facet = cross(dFdx(position), dFdy(position));
  float area = dot(facet, facet);
  facet = area > 0.0 ? facet * inversesqrt(area) : vec3(0.0, 1.0, 0.0);
  float length2 = dot(normal, normal);
  // The viewport is turned upside down, and so is the sense of dFdy: the facet's side is settled by the front face.
  vec3 n = length2 > 0.01 ? normal * inversesqrt(length2) : (gl_FrontFacing ? -facet : facet);
  // One stone ends where another begins, along a ragged line; only paint would pass over evenly.
  float ragged = 0.5 + 0.22 * noise(position * 3.1).x + 0.10 * noise(position * 13.0).x;
  out_position = vec4(position, float((share > ragged ? second : material) + 1u));
  out_normal = vec4(n, chequers(texture_at));
}
