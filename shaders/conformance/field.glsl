// Evaluates a field program point by point, with all values and attributes. The conformance test compares the results
// with those of the scalar evaluator, bit by bit. This shader is simple rather than fast, and interprets the same
// program words as the CPU. Included by field.comp and field_rte.comp, which differ only in the rounding mode that they
// require.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer InstrWords { uint instrs[]; };  // three words per instruction: struct Instr
                                                                            // of program.h
layout(std430, binding = 1) readonly buffer ParamWords { uint params[]; };
// eleven words per group of shapes: see conformance_vulkan.cpp
layout(std430, binding = 2) readonly buffer GroupWords { uint groups[]; };
layout(std430, binding = 3) readonly buffer PointWords { int points[]; };   // x, y, z of each point
// for each point: quantised value, value, gradient, normal x y, label
layout(std430, binding = 4) buffer ResultWords { uint results[]; };

layout(push_constant) uniform Push {
  uint point_count, group_count, initial_bits, initial_label, scale_bits;
};

#include "common/common.h"

#include "program_limits.glsl"

Dual registers[kMaxRegisters];
ivec3 places[kMaxPlaces];
mat3 jacobians[kMaxPlaces];  // Jacobian of each warped position: column j contains d place / d sample_j

// All `precise` arithmetic is in functions whose arguments are values, and must not read global arrays directly:
// glslang traces `precise` backwards through all assignments to such an array, which takes extremely long. Function
// calls end this search.
float alongColumn(Dual d, vec3 column) {
  PRECISE Real a = d.x * column.x;
  PRECISE Real b = d.y * column.y;
  PRECISE Real c = d.z * column.z;
  a = a + b;
  PRECISE Real r = a + c;
  return holdReal(r);
}

Dual toWorld(uint place, Dual d) {
  if (place == 0u) return d;
  mat3 j = jacobians[place];
  return makeDual(d.v, alongColumn(d, j[0]), alongColumn(d, j[1]), alongColumn(d, j[2]), d.label);
}

int moved(int at, float w) {
  PRECISE Real m = clampReal(w, -1048576.0f, 1048576.0f) * 1024.0f;
  m = m + 0.5f;
  return at + toInt(floorReal(m));
}

vec3 steepened(vec3 column, float x, float y, float z) {
  PRECISE Real a = x * 1024.0f;
  a = column.x + a;
  PRECISE Real b = y * 1024.0f;
  b = column.y + b;
  PRECISE Real c = z * 1024.0f;
  c = column.z + c;
  return vec3(holdReal(a), holdReal(b), holdReal(c));
}

void run(uint at) {
  uint w0 = instrs[3u * at], w1 = instrs[3u * at + 1u];
  uint P = instrs[3u * at + 2u];
  uint op = w0 & 0xFFu, dst = w0 >> 8 & 0xFFu, ra = w0 >> 16 & 0xFFu, rb = w0 >> 24;
  uint rc = w1 & 0xFFu, place = w1 >> 8 & 0xFFu;
  int x = places[place].x, y = places[place].y, z = places[place].z;

#define FORM_CONSTANT(FUNCTION) registers[dst] = FUNCTION(P);
#define FORM_POSITION(FUNCTION) registers[dst] = toWorld(place, FUNCTION(x, y, z, P));
#define FORM_POSITION_1(FUNCTION)                                           \
  {                                                                         \
    Dual t = registers[ra];                                                 \
    Dual by_place = toWorld(place, FUNCTION(x, y, z, t, P));                \
    registers[dst] = addSlope(by_place, t, opPowerMorphSlope(x, y, z, t, P)); \
  }
#define FORM_UNARY(FUNCTION) registers[dst] = FUNCTION(registers[ra]);
#define FORM_UNARY_P(FUNCTION) registers[dst] = FUNCTION(registers[ra], P);
#define FORM_BINARY(FUNCTION) registers[dst] = FUNCTION(registers[ra], registers[rb]);
#define FORM_TERNARY(FUNCTION) registers[dst] = FUNCTION(registers[ra], registers[rb], registers[rc]);
#define FORM_COPY(FUNCTION) registers[dst] = registers[ra];
#define FORM_ROUND_BEGIN(FUNCTION) \
  registers[dst] = farAway(); \
  registers[rb] = nothing();
#define FORM_ROUND_ADD(FUNCTION)                                              \
  {                                                                           \
    Dual d = registers[ra];                                                   \
    registers[dst] = opMinimum(registers[dst], d);                            \
    registers[rb] = roundAccumulate(registers[rb], d, PF(P, 0));              \
  }
#define FORM_ROUND_END(FUNCTION) registers[dst] = opRoundEnd(registers[ra], registers[rb], P);
#define FORM_SUM_BEGIN(FUNCTION) \
  registers[dst] = nothing(); \
  registers[rb] = nothing();
#define FORM_SUM_ADD(FUNCTION)                                 \
  {                                                            \
    Dual d = registers[ra];                                    \
    registers[dst] = sumHeaviest(registers[dst], d);           \
    registers[rb] = opAdd(registers[rb], d);                   \
  }
#define FORM_SUM_END(FUNCTION) registers[dst] = opSumEnd(registers[ra], registers[rb], P);
#define FORM_WARP(FUNCTION)                                                                                    \
  {                                                                                                            \
    Dual wx = registers[ra], wy = registers[rb], wz = registers[rc];                                           \
    places[dst] = ivec3(moved(x, wx.v), moved(y, wy.v), moved(z, wz.v));                                       \
    mat3 from = jacobians[place];                                                                              \
    jacobians[dst] = mat3(steepened(from[0], wx.x, wy.x, wz.x), steepened(from[1], wx.y, wy.y, wz.y),          \
                          steepened(from[2], wx.z, wy.z, wz.z));                                               \
  }

  switch (op) {
#include "op_cases.glsl"
  }
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= point_count) return;
  ivec3 p = ivec3(points[3u * i], points[3u * i + 1u], points[3u * i + 2u]);
  places[0] = p;
  jacobians[0] = mat3(1.0f);
  Dual field = makeDual(uintBitsToFloat(initial_bits), 0.0f, 0.0f, 0.0f, int(initial_label));
  Dual cuts = farAway();
  for (uint g = 0u; g < group_count; ++g) {
    uint at = 11u * g;
    ivec3 lo = ivec3(groups[at], groups[at + 1u], groups[at + 2u]);
    ivec3 hi = ivec3(groups[at + 3u], groups[at + 4u], groups[at + 5u]);
    uint first = groups[at + 6u], count = groups[at + 7u], result = groups[at + 8u], flags = groups[at + 9u];
    bool cut = (flags & 1u) != 0u, guarded = (flags & 2u) != 0u;
    if ((flags & 4u) != 0u) cuts = farAway();
    for (uint k = 0u; k < count; ++k) run(first + k);
    bool inside = !guarded || (all(greaterThanEqual(p, lo)) && all(lessThanEqual(p, hi)));
    float smooth_width = uintBitsToFloat(groups[at + 10u]);
    Dual own = registers[result];
    if (smooth_width > 0.0f) {
      Dual blended = field;
      if (cut) blended = roundCut(field, own, smooth_width); else blended = roundUnion(field, own, smooth_width);
      field = selDual(inside, blended, field);
      continue;
    }
    Dual before = cut ? cuts : field;
    Dual after = selDual(inside, opMinimum(before, own), before);
    if (cut) cuts = after; else field = after;
    if ((flags & 8u) != 0u) field = opCut(field, cuts);
  }
  float v = unsignedZero(field.v), gx = unsignedZero(field.x), gy = unsignedZero(field.y), gz = unsignedZero(field.z);
  PackedNormal n = packNormal(gx, gy, gz);
  uint out_at = 8u * i;
  results[out_at] = uint(quantise(field.v, uintBitsToFloat(scale_bits)));
  results[out_at + 1u] = floatBitsToUint(v);
  results[out_at + 2u] = floatBitsToUint(gx);
  results[out_at + 3u] = floatBitsToUint(gy);
  results[out_at + 4u] = floatBitsToUint(gz);
  results[out_at + 5u] = uint(n.x);
  results[out_at + 6u] = uint(n.y);
  results[out_at + 7u] = uint(field.label);
}
