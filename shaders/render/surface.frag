#version 450
// What is seen at a sample: where it lies, which way it faces, what it is made of. Lit later, once.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 0) out vec4 out_position;  // w: material + 1; 0 is the background
layout(location = 1) out vec4 out_normal;

void main() {
  vec3 facet = cross(dFdx(position), dFdy(position));
  float area = dot(facet, facet);
  facet = area > 0.0 ? facet * inversesqrt(area) : vec3(0.0, 1.0, 0.0);
  float length2 = dot(normal, normal);
  // The viewport is turned upside down, and so is the sense of dFdy: the facet's side is settled by the front face.
  vec3 n = length2 > 0.01 ? normal * inversesqrt(length2) : (gl_FrontFacing ? -facet : facet);
  out_position = vec4(position, float(material + 1u));
  out_normal = vec4(n, 0.0);
}
