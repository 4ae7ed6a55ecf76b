#version 450
// Draws a blade or a leaf into the buffers that store what is visible.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float told;
layout(location = 3) flat in uint material;
layout(location = 0) out vec4 out_position;
// w: a negative number that contains the brightness and, in multiples of four, the kind of plant part: see growing() in
// shade.comp
layout(location = 1) out vec4 out_normal;

void main() {
  out_position = vec4(position, float(material + 1u));
  out_normal = vec4(normalize(normal), -told);
}
