#version 450
// A lamp that the camera carries over its shoulder, and a little light from everywhere; a colour for each material.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 0) out vec4 colour;

const vec3 kColours[4] = vec3[](vec3(0.30, 0.29, 0.28), vec3(0.34, 0.27, 0.19), vec3(0.62, 0.55, 0.44),
                                vec3(0.22, 0.29, 0.36));
const vec3 kLamp = vec3(1.5, 2.0, 0.5);  // metres from the camera

void main() {
  const vec3 n = normalize(normal);
  const vec3 to_lamp = kLamp - position;
  const float away = dot(to_lamp, to_lamp);
  const float lamp = max(dot(n, to_lamp), 0.0) * inversesqrt(away) * 2.2 / (1.0 + 0.01 * away);
  const vec3 around = mix(vec3(0.05, 0.06, 0.09), vec3(0.16, 0.15, 0.14), 0.5 + 0.5 * n.y);
  colour = vec4(kColours[material % 4u] * (lamp + around), 1.0);
}
