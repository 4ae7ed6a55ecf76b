#version 450
#extension GL_GOOGLE_include_directive : require
// Lays the volume's light over the sky.
#include "volume/volume.glsl"
#include "render/noise.glsl"
#include "render/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 5) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 6) writeonly buffer Pixels { uint pixels[]; };

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.picture.xy))) return;
  uint at = pixel.y * frame.picture.x + pixel.x;
  vec2 centre = (vec2(pixel) + 0.5) / vec2(frame.picture.xy) * 2.0 - 1.0;
  vec3 d = normalize(frame.forward.xyz + centre.x * frame.right.xyz - centre.y * frame.up.xyz);
  vec3 colour = encodeSrgb(toneMap((light[at].rgb + light[at].w * sky(d)) * frame.eye.w));
  colour += (random3(ivec3(pixel, 7)) - 0.5) / 255.0;
  uvec3 bytes = uvec3(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
  pixels[at] = bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}
