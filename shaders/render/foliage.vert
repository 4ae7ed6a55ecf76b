#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Draws the shaded ground between the blades of a lawn, as a layer on the lawn's own surface.
#include "render/foliage.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
// x: which of the two materials is a lawn; y: height of the blades (Foliage::ground in runtime/tools/render/foliage.h)
layout(location = 3) in vec2 grown;
layout(location = 4) in uint second;
layout(location = 5) in float share;
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out uint out_material;
layout(location = 3) flat out uint out_second;
layout(location = 4) flat out float out_grown;
layout(location = 5) out float out_share;
layout(location = 6) out float out_growth;

void main() {
  vec3 n = dot(normal, normal) > 0.01 ? normalize(normal) : vec3(0.0, 1.0, 0.0);
  out_position = position + 0.002 * n;
  out_normal = n;
  out_material = material;
  out_second = second;
  out_grown = grown.x;
  out_share = share;
  out_growth = grown.y;
  gl_Position = view_projection * vec4(out_position, 1.0);
}
