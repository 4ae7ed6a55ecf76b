#version 450
// Transforms a vertex of the library's format to clip space. Positions stay integers until the last step: chunks of any
// level that share a vertex compute the same three numbers, so that no gap shows between them.
layout(location = 0) in ivec4 place;       // x, y, z in 1/256 of the chunk's cell edge, from its origin; material
layout(location = 1) in vec2 octahedral;   // the normal
layout(location = 2) in ivec4 chunk;       // the chunk's origin minus the camera's position, and the chunk's cell edge, in units
layout(location = 0) out vec3 position;    // metres from the camera
layout(location = 1) out vec3 normal;
layout(location = 2) flat out uint material;
layout(push_constant) uniform View { mat4 view_projection; };

vec3 unpackNormal(vec2 n) {
  const vec2 side = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  const float w = 1.0 - abs(n.x) - abs(n.y);
  return normalize(vec3(w >= 0.0 ? n : (1.0 - abs(n.yx)) * side, w));
}

void main() {
  const ivec3 steps = chunk.xyz * 256 + place.xyz * chunk.w;
  position = vec3(steps) * (1.0 / (256.0 * 1024.0));
  normal = unpackNormal(octahedral);
  material = uint(place.w) & 0xFFFFu;
  gl_Position = view_projection * vec4(position, 1.0);
}
