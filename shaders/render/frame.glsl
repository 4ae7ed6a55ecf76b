// The uniforms of the shading pass, with the same layout as struct Frame in runtime/tools/render/frame.h.
const uint kMaxLamps = 8u;  // the first lamp is the headlamp

layout(std140, binding = 3) uniform Frame {
  mat4 view_projection;
  vec4 eye;             // position of the eye; w: angle of a sample in radians
  vec4 pattern_offset;  // vector from the scene's origin to the patterns' origin, in metres; w: exposure
  vec4 forward;         // view direction; w: distance of fog in metres
  vec4 right;           // to the right in the picture; its length is half the picture's width at distance 1
  vec4 up;              // upwards in the picture; its length is half the picture's height at distance 1
  vec4 sun;             // direction to the sun; w: ambient light
  vec4 lamp_position[kMaxLamps];  // position of each lamp; w: range in metres
  vec4 lamp_colour[kMaxLamps];
  uvec4 size;    // width and height in pixels; samples per side of a pixel; background (0 cave, 1 sky)
  uvec4 counts;  // number of lamps, number of materials, 1 if there are clouds
  // The land around the world. x: its height; y: its material (below 0: no land; from 1e6 on: meadows); z: 1 if it is
  // bare. w: fair-weather clouds (1: everywhere; below 0: only beyond this many metres; 0: none).
  vec4 land;
} frame;

// True if no plants grow on the land around the world.
bool isBare() { return frame.land.z > 0.5; }

struct Material { vec4 colour_roughness; uvec4 pattern; };  // pattern.y: strength of the relief, as float bits
layout(std430, binding = 4) readonly buffer Materials { Material materials[]; };
// pixels of the picture, three words each, in the format of runtime/tools/render/lens.h
layout(std430, binding = 5) writeonly buffer Pixels { uint pixels[]; };
layout(binding = 0) uniform sampler2D position_plane;
layout(binding = 1) uniform sampler2D normal_plane;
