#version 450
// Projects the vertices of the mesh. Positions are in metres from the scene's origin.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material;
layout(location = 3) in vec2 texture_at;
layout(location = 4) in uint second;
layout(location = 5) in float share;
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) flat out uint out_material;
layout(location = 3) out vec2 out_texture;
layout(location = 4) flat out uint out_second;
layout(location = 5) out float out_share;
layout(push_constant) uniform View { mat4 view_projection; };

void main() {
  out_position = position;
  out_normal = normal;
  out_material = material;
  out_texture = texture_at;
  out_second = second;
  out_share = share;
  gl_Position = view_projection * vec4(position, 1.0);
}
