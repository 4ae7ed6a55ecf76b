// What the shading pass knows. Laid out as Frame in runtime/tools/render/frame.h.
const uint kMaxLamps = 8u;  // the headlamp first

layout(std140, binding = 3) uniform Frame {
  mat4 view_projection;
  vec4 eye;             // w: angle of one sample in radians
  vec4 pattern_offset;  // from the scene's origin to the patterns' own, metres; w: exposure
  vec4 forward;         // w: fog distance, metres
  vec4 right;           // half the picture's width at distance 1
  vec4 up;              // half its height
  vec4 sun;             // towards the sun; w: ambient light
  vec4 lamp_position[kMaxLamps];  // w: reach, metres
  vec4 lamp_colour[kMaxLamps];
  uvec4 size;    // width and height in pixels, samples on each side of a pixel, background (0 cave, 1 sky)
  uvec4 counts;  // lamps, materials, 1 where there are clouds
  // Around the world: its height; its material, below 0: none, from 1e6: meadows; 1 where it is bare. w: clouds of fair
  // weather, 1: all over the sky, below 0: beyond so many metres, 0: none.
  vec4 land;
} frame;

// Whether the land around the world has no green.
bool isBare() { return frame.land.z > 0.5; }

struct Material { vec4 colour_roughness; uvec4 pattern; };  // pattern.y: relief, float bits
layout(std430, binding = 4) readonly buffer Materials { Material materials[]; };
layout(std430, binding = 5) writeonly buffer Pixels { uint pixels[]; };  // three words each: runtime/tools/render/lens.h
layout(binding = 0) uniform sampler2D position_plane;
layout(binding = 1) uniform sampler2D normal_plane;
