#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Stores what is visible at a sample: its position, normal and material. A later pass lights each sample once (deferred
// shading).
#include "render/noise.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 3) in vec2 texture_at;
layout(location = 4) flat in uint second;
layout(location = 5) in float share;
layout(location = 0) out vec4 out_position;  // position; w: material + 1, or 0 for the background
layout(location = 1) out vec4 out_normal;    // normal; w: number of the checkerboard's field, 0 if there is no
                                             // checkerboard

// Returns the field of a checkerboard at texture coordinates: 1 or 2; 3 on a line along u, 4 on a line along v; 1.5 if
// a field is smaller than a sample.
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
  // The viewport is flipped vertically, and so is the sign of dFdy. Therefore gl_FrontFacing decides on which side of
  // the facet the normal is.
  vec3 n = length2 > 0.01 ? normal * inversesqrt(length2) : (gl_FrontFacing ? -facet : facet);
  // Two kinds of stone meet along a ragged line, because only paint would blend evenly.
  float ragged = 0.5 + 0.22 * noise(position * 3.1).x + 0.10 * noise(position * 13.0).x;
  out_position = vec4(position, float((share > ragged ? second : material) + 1u));
  out_normal = vec4(n, chequers(texture_at));
}
