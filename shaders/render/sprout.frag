#version 450
// A blade or a leaf where it is seen.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float told;
layout(location = 3) flat in uint material;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;  // w: below 0, how bright it is, and by fours what it is: growing(), shade.comp

void main() {
  out_position = vec4(position, float(material + 1u));
  out_normal = vec4(normalize(normal), -told);
}
