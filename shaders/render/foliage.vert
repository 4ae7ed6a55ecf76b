#version 450
#extension GL_GOOGLE_include_directive : require
// Layers over a lawn or a crown, one an instance: blades and leaves are where a layer passes through them (Kajiya and
// Kay's fur, as Lengyel drew it: "Real-time fur over arbitrary surfaces", 2001). Of lawns the first instance is the
// ground between the blades, in their shade; those of crowns begin within the crown, whose own surface is not drawn.
#include "render/foliage.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
layout(location = 3) in vec2 grown;  // as Foliage::vertices tells, runtime/cli/render/foliage.h
layout(location = 4) in uint second;
layout(location = 5) in float share;
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_root;
layout(location = 2) out vec3 out_normal;
layout(location = 3) flat out uint out_material;
layout(location = 4) flat out uint out_second;
layout(location = 5) flat out float out_grown;
layout(location = 6) out float out_share;
layout(location = 7) flat out float out_height;  // of the layer, 0..1
layout(location = 8) out float out_growth;       // likewise

void main() {
  vec3 n = dot(normal, normal) > 0.01 ? normalize(normal) : vec3(0.0, 1.0, 0.0);
  out_height = float(gl_InstanceIndex) / kind.y;
  // Blades grow upwards on a slope too.
  vec3 up = kind.x == 0.0 ? normalize(n + vec3(0.0, 2.0, 0.0)) : n;
  out_root = position;
  out_position = position + up * (mix(-kind.w, offset.w, out_height) + 0.002);
  out_normal = n;
  out_material = material;
  out_second = second;
  out_grown = grown.x;
  out_share = share;
  out_growth = grown.y;
  gl_Position = view_projection * vec4(out_position, 1.0);
}
