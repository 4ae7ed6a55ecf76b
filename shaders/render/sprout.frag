#version 450
// Draws the visible part of a blade or a leaf.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float told;
layout(location = 3) flat in uint material;
layout(location = 0) out vec4 out_position;
// w: below 0; contains the brightness and, in multiples of four, the kind: see growing() in shade.comp
layout(location = 1) out vec4 out_normal;

void main() {
  out_position = vec4(position, float(material + 1u));
  out_normal = vec4(normalize(normal), -told);
}
