#version 450
#extension GL_GOOGLE_include_directive : require
// Composites the light of the volume over the sky.
#include "volume/volume.glsl"
#include "render/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 5) readonly buffer Light { vec4 light[]; };
// pixels of the picture, three words each, in the format of runtime/tools/render/lens.h
layout(std430, binding = 6) writeonly buffer Pixels { uint pixels[]; };

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.picture.xy))) return;
  uint at = pixel.y * frame.picture.x + pixel.x;
  vec2 centre = (vec2(pixel) + 0.5) / vec2(frame.picture.xy) * 2.0 - 1.0;
  vec3 d = normalize(frame.forward.xyz + centre.x * frame.right.xyz - centre.y * frame.up.xyz);
  vec3 seen = (light[at].rgb + light[at].w * sky(d)) * frame.eye.w;
  uvec3 exposed = exposedPixel(toneMap(seen), min(seen, vec3(1000.0)));
  for (int word = 0; word < 3; ++word) pixels[3u * at + uint(word)] = exposed[word];
}
