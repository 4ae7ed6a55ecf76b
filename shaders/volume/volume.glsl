// A density volume: its position, its medium, and how a ray crosses it.

// Uniforms with the same layout as VolumeFrame in runtime/tools/render/volume_pass.cpp. Lengths are in metres.
layout(std140, binding = 0) uniform Frame {
  vec4 eye;         // w: exposure
  vec4 forward;     // view direction; w: distance in metres after which haze has absorbed about two thirds of the light
  vec4 right;       // vector to the right in the picture, whose length is half the picture's width at distance 1; w:
                    // extinction per metre at density 1
  // vector upwards in the picture, whose length is half the picture's height at distance 1; w: albedo, the share of
  // light that is scattered and not absorbed
  vec4 up;
  vec4 sun;         // direction to the sun; w: mean cosine of the phase function
  vec4 corner;      // position of the volume's first point; w: distance between points
  vec4 sun_light;   // irradiance of the sun on a plane that faces it
  vec4 sky_light;   // radiance of the sky from above, and from below
  vec4 ground_light;
  uvec4 size;       // number of points on each axis of the volume; w: octaves of scattering
  uvec4 lit_size;   // number of points on each axis of the light volume
  uvec4 picture;    // width and height in pixels; rays per side of a pixel
} frame;

layout(binding = 1) uniform sampler3D density_volume;
// For each brick of kBrick^3 cells, including the points on its faces: 1 if it has any density, otherwise 0.
layout(std430, binding = 2) readonly buffer Bricks { uint bricks[]; };
const float kBrick = 8.0;

// Positions in the volume are in cells from its first point: 0 to volumeEnd().
vec3 volumeEnd() { return vec3(frame.size.xyz) - 1.0; }
vec3 placeOf(vec3 p) { return (p - frame.corner.xyz) / frame.corner.w; }

float extinctionAt(vec3 place) {
  return textureLod(density_volume, (place + 0.5) / vec3(frame.size.xyz), 0.0).r * frame.right.w;
}

// Returns the ray parameters at which a ray enters (x) and leaves (y) a box; it misses the box if y <= x (Kay and
// Kajiya 1986). No component of d may be 0.
vec2 crossing(vec3 from, vec3 d, vec3 lo, vec3 hi) {
  vec3 a = (lo - from) / d, b = (hi - from) / d;
  vec3 first = min(a, b), last = max(a, b);
  return vec2(max(max(first.x, first.y), first.z), min(min(last.x, last.y), last.z));
}

vec3 withoutZeros(vec3 d) { return mix(d, vec3(1e-7), lessThan(abs(d), vec3(1e-7))); }

ivec3 brickCount() { return ivec3(ceil(volumeEnd() / kBrick)); }
ivec3 brickAt(vec3 place) { return clamp(ivec3(floor(place / kBrick)), ivec3(0), brickCount() - 1); }
bool isEmpty(ivec3 brick) {
  ivec3 count = brickCount();
  return bricks[(brick.z * count.y + brick.y) * count.x + brick.x] == 0u;
}

// Returns the length of a stretch of the ray, from the parameter t on, in which there is certainly no density. Returns
// 0 if t lies in a brick that has density.
float emptyAhead(vec3 from, vec3 d, float t) {
  ivec3 brick = brickAt(from + d * t);
  if (!isEmpty(brick)) return 0.0;
  float end = crossing(from, d, vec3(brick) * kBrick, vec3(brick + 1) * kBrick).y;
  return max(end - t, 0.0) + 1e-3;
}
