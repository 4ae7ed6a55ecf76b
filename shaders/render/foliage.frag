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
layout(location = 5) flat in float grown;
layout(location = 6) in float share;
layout(location = 7) flat in float height;
layout(location = 8) in float growth;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;  // w: below 0, how bright it is by how deep it lies, and 8 more for a bloom

// As wide as a sample at least, in steps of two: what is far away has fewer and larger ones, and does not flicker.
float sized(float size, float footprint) { return size * exp2(ceil(max(0.0, log2(1.6 * footprint / size)))); }

// The normal of the blade that stands there; zero: none does. tall: how high the tallest are; bloom: 1 a white flower,
// 2 a yellow one.
vec3 blade(vec3 at, float footprint, float tall, out float bloom) {
  float cell = sized(0.016, footprint);
  vec2 q = at.xz / cell, base = floor(q - 0.5);
  bloom = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 c = ivec2(base) + ivec2(i & 1, i >> 1);
    vec3 lot = random3(ivec3(c, 11)), more = random3(ivec3(c, 12));
    float own = tall * (0.35 + 0.65 * lot.z * more.z);
    if (height > own) continue;
    float along = height / own;
    vec2 lean = 1.7 * (more.xy - 0.5) * along * along;
    vec2 off = q - (vec2(c) + lot.xy + lean);
    bool flower = more.z > 0.88 && lot.z > 0.80 && along > 0.66;
    if (dot(off, off) > (flower ? 0.14 : 0.09 * (1.02 - along))) continue;
    if (flower) bloom = more.x > 0.45 ? 1.0 : 2.0;
    return normalize(vec3(0.5 * off.x + 0.25 * lean.x, 1.0, 0.5 * off.y + 0.25 * lean.y));
  }
  return vec3(0.0);
}

// How far leaves reach at a place of a crown, 0..1, in sprigs and between them; below 0 one sees through it. The rim is
// looser than the middle. facing: cosine between the eye and the surface.
float reachAt(float facing) {
  float rim = 1.0 - smoothstep(0.05, 0.6, facing);
  return smoothstep(-0.45, 0.6, growth) - step(growth, mix(-0.46, 0.0, rim));
}

vec3 leaf(vec3 at, vec3 n, float footprint, float reach) {
  float ends = 0.22 + 0.78 * reach;
  if (reach < 0.0 || height > ends) return vec3(0.0);
  float cell = sized(0.075, footprint), far = smoothstep(0.10, 0.35, cell);
  vec3 q = at / cell;
  // Cells in rows would be seen as rows.
  q += 0.45 * sin(1.7 * q.yzx + vec3(0.0, 2.0, 4.0));
  vec3 base = floor(q);
  vec3 lot = random3(ivec3(base) + ivec3(0, 0, 77)), turn = random3(ivec3(base) + ivec3(0, 0, 79));
  // The fewer the farther out. From afar single gaps would be noise: sprigs close, and gaps between them stay.
  if (lot.z < (0.08 + 0.72 * height / ends) * mix(1.0, 0.55, far)) return vec3(0.0);
  vec3 off = q - (base + 0.5 + 0.3 * (lot - 0.5));
  vec3 facing = normalize(turn * 2.0 - 1.0 + 0.6 * n + 1e-3);
  float thick = max(0.07, 0.6 * (offset.w + kind.w) / (kind.y * cell)) + 0.6 * far, across = dot(off, facing);
  if (abs(across) > thick || length(off - across * facing) > 0.48 + 0.4 * far) return vec3(0.0);
  return normalize(facing * (dot(facing, n) < 0.0 ? -0.6 : 0.6) + n);
}

void main() {
  bool is_second = false;
  if (share > 0.15) {
    float ragged = 0.5 + 0.22 * noise(root * 3.1).x + 0.10 * noise(root * 13.0).x;
    is_second = share > ragged;
  }
  if (grown != 3.0 && (grown == 2.0) != is_second) discard;
  bool lawn = kind.x == 0.0;
  float t = length(position - eye.xyz), footprint = t * eye.w;
  vec3 n = normalize(normal);
  vec3 at = position + offset.xyz;
  if (lawn && n.y < 0.72) discard;
  // Blades end gradually, some sooner than others. A crown has nothing else to show.
  if (lawn && t > kind.z * (0.6 + 0.4 * random3(ivec3(floor(at * 9.0))).x)) discard;
  // The deeper the less light comes there; far away all is as bright as it is on a mean.
  float near = 1.0 - smoothstep(0.3, 0.6, t / kind.z);
  float bright = lawn ? mix(1.0, mix(0.45, 1.25, pow(height, 0.8)), near) : mix(0.34, 1.5, pow(height, 0.8));
  vec4 made = vec4(position, float((is_second ? second : material) + 1u));
  vec3 rooted = root + offset.xyz;
  if (lawn && height == 0.0) {
    out_position = made;
    out_normal = vec4(n, -bright);
    return;
  }
  vec3 found;
  float bloom = 0.0;
  if (lawn) {
    found = blade(rooted, footprint, growth, bloom);
    // Flowers stand in company.
    if (bloom > 0.0 && plainNoise(rooted * 0.21 + 3.0) < 0.1) bloom = 0.0;
  } else {
    found = leaf(at, n, footprint, reachAt(dot(n, normalize(eye.xyz - position))));
  }
  if (found == vec3(0.0)) discard;
  out_position = made;
  out_normal = vec4(found, -bright - 8.0 * bloom);
}
