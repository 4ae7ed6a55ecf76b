#version 450
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kAdd = 0;
layout(constant_id = 1) const int kTimes = 1;
layout(std430, binding = 0) readonly buffer In { int numbers[]; };
layout(std430, binding = 1) writeonly buffer Out { int results[]; };
layout(push_constant) uniform Push { int count; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i < count) results[i] = kTimes * numbers[i] + kAdd;
}
