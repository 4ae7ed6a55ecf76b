// A volume of density: where it lies, what it is made of, and how a ray goes through it.

// Laid out as VolumeFrame in runtime/tools/render/volume_pass.cpp. Lengths in metres.
layout(std140, binding = 0) uniform Frame {
  vec4 eye;         // w: exposure
  vec4 forward;     // w: distance after which about two thirds of the light is lost to haze
  vec4 right;       // half the picture's width at distance 1; w: extinction at density 1, per metre
  vec4 up;          // half its height; w: albedo, the share of the light that is scattered and not lost
  vec4 sun;         // towards the sun; w: the mean cosine of the phase function
  vec4 corner;      // first point of the volume; w: spacing
  vec4 sun_light;   // irradiance of a plane that faces the sun
  vec4 sky_light;   // radiance from above, from below
  vec4 ground_light;
  uvec4 size;       // points; w: octaves of scattering
  uvec4 lit_size;   // points of the volume of light
  uvec4 picture;    // width, height, rays on each side of a pixel
} frame;

layout(binding = 1) uniform sampler3D density_volume;
// 1 where a brick of kBrick^3 cells, with the points on its faces, has any density.
layout(std430, binding = 2) readonly buffer Bricks { uint bricks[]; };
const float kBrick = 8.0;

// Places in the volume count in cells from its first point: 0 to volumeEnd().
vec3 volumeEnd() { return vec3(frame.size.xyz) - 1.0; }
vec3 placeOf(vec3 p) { return (p - frame.corner.xyz) / frame.corner.w; }

float extinctionAt(vec3 place) {
  return textureLod(density_volume, (place + 0.5) / vec3(frame.size.xyz), 0.0).r * frame.right.w;
}

// Where a ray enters and leaves a box: nowhere if y <= x (Kay and Kajiya 1986). No component of d is 0.
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

// How far from t on the ray there is nothing for sure: 0 in a brick that has density.
float emptyAhead(vec3 from, vec3 d, float t) {
  ivec3 brick = brickAt(from + d * t);
  if (!isEmpty(brick)) return 0.0;
  float end = crossing(from, d, vec3(brick) * kBrick, vec3(brick + 1) * kBrick).y;
  return max(end - t, 0.0) + 1e-3;
}
