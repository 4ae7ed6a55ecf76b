#version 450
// Each of two bits of a specialization constant enables a branch, and each branch calls a function of its own.
layout(local_size_x = 1) in;
layout(constant_id = 0) const uint kWanted = 3u;
layout(std430, binding = 0) buffer Values { float values[]; };
#define has(bit) ((kWanted >> (bit) & 1u) != 0u)

float twice(float x) { return 2.0 * x; }
float squared(float x) { return x * x; }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (has(0u)) { if (i == 0u) values[i] = twice(values[i]); }
  if (has(1u)) { if (i == 1u) values[i] = squared(values[i]); }
}
