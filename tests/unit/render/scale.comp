#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer In { int numbers[]; };
layout(std430, binding = 1) buffer Out { int results[]; };
layout(push_constant) uniform Push { int factor; int count; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i < count) results[i] += factor * numbers[i];
}
