#version 450
// Depth as a light sees it.
layout(location = 0) in vec3 position;
layout(push_constant) uniform View { mat4 view_projection; };

void main() { gl_Position = view_projection * vec4(position, 1.0); }
