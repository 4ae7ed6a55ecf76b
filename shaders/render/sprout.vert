#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Draws an instance: a blade, a leaf or a blossom, as a triangle strip of seven vertices, of which leaves and blossoms
// use six.
#include "render/foliage.glsl"
#include "render/noise.glsl"

layout(location = 0) in vec4 root;    // position of the root; w: length of the blade or leaf in metres
layout(location = 1) in vec4 normal;  // normal of the surface on which it grows; w: width of the blade or leaf in
                                      // metres
layout(location = 2) in uint material;
layout(location = 3) in uint lot;   // random number of the instance
layout(location = 4) in uint form;  // kind of plant part: SproutForm of runtime/tools/render/foliage.h
layout(location = 5) in float bright;
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out float out_told;
layout(location = 3) flat out uint out_material;

const uint kBlade = 0u, kLeaf = 1u, kDry = 4u;
// Outline of a leaf from its stalk to its tip: positions along and across it.
const vec2 kOutline[7] = vec2[7](vec2(0.0, 0.0), vec2(0.30, -0.42), vec2(0.34, 0.44), vec2(0.66, -0.40), vec2(0.70, 0.38),
                                 vec2(1.0, 0.0), vec2(1.0, 0.0));

void placeLeaf(vec3 dice, vec3 more) {
  vec3 n = normal.xyz;
  // Leaves turn towards the light and outwards, and hang a little.
  vec3 facing = normalize(2.0 * dice - 1.0 + 0.5 * n + vec3(0.0, 0.45, 0.0) + 1e-3);
  vec3 along = normalize(cross(facing, 2.0 * more - 1.0 + vec3(0.013, 0.007, 0.011)) + 0.35 * n - vec3(0.0, 0.30, 0.0));
  vec3 across = normalize(cross(facing, along));
  facing = cross(along, across);
  vec2 at = kOutline[gl_VertexIndex];
  float fold = (0.5 + 0.6 * dice.x) * abs(at.y), droop = -0.30 * at.x * at.x * more.y;
  out_position = root.xyz + along * (root.w * (at.x - 0.5)) + across * (normal.w * at.y) + facing * (normal.w * fold + root.w * droop);
  vec3 bent = facing - across * (0.55 * at.y);
  out_normal = normalize(bent * (dot(facing, n) < 0.0 ? -0.65 : 0.65) + n);
  out_told = bright;
}

void placeBlossom(vec3 dice) {
  vec3 facing = normalize(vec3(dice.x - 0.5, 1.0, dice.y - 0.5));
  vec3 along = normalize(cross(facing, vec3(dice.z, 0.3, 1.0 - dice.z)));
  vec3 across = cross(facing, along);
  vec2 at = kOutline[gl_VertexIndex] - vec2(0.5, 0.0);
  out_position = root.xyz + root.w * (along * at.x + across * at.y);
  out_normal = facing;
  out_told = 1.0 + 4.0 * float(form - 1u);
}

void placeBlade(vec3 dice, vec3 more) {
  vec3 up = normalize(normal.xyz + vec3(0.0, 2.0, 0.0)), to_eye = eye.xyz - root.xyz;
  float t = length(to_eye), angle = 6.2831853 * dice.x;
  vec3 lean = vec3(cos(angle), 0.0, sin(angle)), facing = normalize(lean + 0.9 * to_eye / t * vec3(1.0, 0.0, 1.0) + 1e-3);
  vec3 across = normalize(cross(up, facing));
  int row = gl_VertexIndex / 2;
  float along = float(row) / 3.0, side = row == 3 ? 0.0 : gl_VertexIndex % 2 == 0 ? -0.5 : 0.5;
  bool dry = form == kDry;
  float bend = (dry ? 0.25 : 0.75) * (0.12 + dice.y * dice.y), shape = dry ? 1.0 : 1.0 - 0.55 * along * along;
  vec3 stem = root.w * (up * (along - 0.35 * bend * along * along) + lean * (bend * along * along));
  // The ears of dry stalks are wider than their stems.
  float wide = normal.w * (dry && row == 2 ? 2.4 : shape);
  out_position = root.xyz - up * 0.01 + stem + across * (wide * side);
  vec3 face = normalize(across * (1.2 * side) + cross(across, up + 2.0 * bend * along * lean));
  if (dot(face, to_eye) < 0.0) face = -face;
  out_normal = normalize(face * 0.55 + up + lean * (0.5 * bend * along));
  float lit = mix(1.0, mix(0.34, 1.22, pow(along, 0.8)), nearness(t)) * bright;
  out_told = lit + (dry ? 12.0 : 0.0);
}

void main() {
  ivec3 drawn = ivec3(int(lot >> 1), 5, 7);
  vec3 dice = random3(drawn), more = random3(drawn + ivec3(0, 1, 0));
  if (form == kLeaf) {
    placeLeaf(dice, more);
  } else if (form == kBlade || form == kDry) {
    placeBlade(dice, more);
  } else {
    placeBlossom(dice);
  }
  out_material = material;
  gl_Position = view_projection * vec4(out_position, 1.0);
}
