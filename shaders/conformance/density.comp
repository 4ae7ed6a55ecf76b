#version 450
#extension GL_GOOGLE_include_directive : require
// Computes the density of samples. The conformance test compares the results with those of the C++ function, bit by
// bit.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Samples { int samples[]; };
// for each sample: the bits of the float density, then the density as a byte
layout(std430, binding = 1) writeonly buffer Densities { uint densities[]; };
layout(push_constant) uniform Push { uint count, inverse_edge_bits; };

#define PU(P, i) 0u
#include "common/portable.h"
#include "common/real.h"
#include "common/density.h"

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  float density = densityOf(samples[i], uintBitsToFloat(inverse_edge_bits));
  densities[2u * i] = floatBitsToUint(density);
  densities[2u * i + 1u] = uint(densityByte(density));
}
