#version 450
#extension GL_GOOGLE_include_directive : require
// Where a layer passes through a blade or a leaf it is seen; elsewhere it lets what is behind it show.
#include "render/foliage.glsl"
#include "render/noise.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 root;
layout(location = 2) in vec3 normal;
layout(location = 3) flat in uint material;
layout(location = 4) flat in uint second;
layout(location = 5) flat in vec2 grown;
layout(location = 6) in float share;
layout(location = 7) flat in float height;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;  // w: below 0, how bright it is by how deep it lies

// As wide as a sample at least, in steps of two: what is far away has fewer and larger ones, and does not flicker.
float sized(float size, float footprint) { return size * exp2(ceil(max(0.0, log2(1.6 * footprint / size)))); }

// The normal of the blade that stands there; zero: none does.
vec3 blade(vec3 at, float footprint) {
  float cell = sized(0.016, footprint);
  vec2 q = at.xz / cell, base = floor(q - 0.5);
  for (int i = 0; i < 4; ++i) {
    ivec2 c = ivec2(base) + ivec2(i & 1, i >> 1);
    vec3 lot = random3(ivec3(c, 11)), more = random3(ivec3(c, 12));
    float tall = 0.35 + 0.65 * lot.z * more.z;
    if (height > tall) continue;
    float along = height / tall;
    vec2 lean = 1.4 * (more.xy - 0.5) * along * along;
    vec2 off = q - (vec2(c) + lot.xy + lean);
    if (dot(off, off) > 0.09 * (1.02 - along)) continue;
    return normalize(vec3(0.5 * off.x + 0.25 * lean.x, 1.0, 0.5 * off.y + 0.25 * lean.y));
  }
  return vec3(0.0);
}

vec3 leaf(vec3 at, vec3 n, float footprint) {
  float cell = sized(0.075, footprint);
  vec3 q = at / cell, base = floor(q);
  vec3 lot = random3(ivec3(base) + ivec3(0, 0, 77)), turn = random3(ivec3(base) + ivec3(0, 0, 79));
  // The fewer the farther out: a crown's edge is loose.
  if (lot.z < 0.15 + 0.75 * height) return vec3(0.0);
  vec3 off = q - (base + 0.5 + 0.3 * (lot - 0.5));
  vec3 facing = normalize(turn * 2.0 - 1.0 + 0.6 * n + 1e-3);
  float thick = max(0.07, 0.6 * offset.w / (kind.y * cell)), across = dot(off, facing);
  if (abs(across) > thick || length(off - across * facing) > 0.46) return vec3(0.0);
  return normalize(facing * (dot(facing, n) < 0.0 ? -0.5 : 0.5) + n);
}

void main() {
  float ragged = 0.5 + 0.22 * noise(root * 3.1).x + 0.10 * noise(root * 13.0).x;
  bool is_second = share > ragged;
  if ((is_second ? grown.y : grown.x) == 0.0) discard;
  float t = length(position - eye.xyz), footprint = t * eye.w;
  vec3 n = normalize(normal);
  vec3 at = position + offset.xyz;
  if (kind.x == 0.0 && n.y < 0.72) discard;
  // They end gradually, some sooner than others.
  if (t > kind.z * (0.6 + 0.4 * random3(ivec3(floor(at * 9.0))).x)) discard;
  // The deeper the less light comes there; far away all is as bright as it is on a mean.
  float near = 1.0 - smoothstep(0.3, 0.6, t / kind.z);
  float bright = mix(1.0, mix(kind.x == 0.0 ? 0.45 : 0.5, kind.x == 0.0 ? 1.25 : 1.5, pow(height, 0.8)), near);
  vec4 made = vec4(position, float((is_second ? second : material) + 1u));
  if (height == 0.0) {
    out_position = made;
    out_normal = vec4(n, -bright);
    return;
  }
  vec3 found = kind.x == 0.0 ? blade(root + offset.xyz, footprint) : leaf(at, n, footprint);
  if (found == vec3(0.0)) discard;
  out_position = made;
  out_normal = vec4(found, -bright);
}
