// Light that ray tracing has found: for each pixel, and filtered for each square of 2 x 2 pixels
// (runtime/tools/render/light_planes.h). Each sample interpolates this light from neighbouring pixels that lie on the
// same surface.
struct DirectLight { uvec2 open; uvec2 mirror; };
struct SoftLight { vec4 light; vec4 lean; vec4 lie; };
layout(std430, binding = 2) readonly buffer Direct { DirectLight direct[]; };
layout(std430, binding = 6) readonly buffer Soft { SoftLight soft[]; };
const int kSoftPixels = 2;
// Clouds in front of the first sample of a pixel, as half floats: red, green, blue, and transmittance.
struct VapourLight { uvec2 light; float distance; float reserved; };
layout(std430, binding = 7) readonly buffer Vapour { VapourLight vapour[]; };

// Returns the weight, for a sample at p with normal n, of the traced light of another sample. It is small if the other
// sample lies on another surface.
float kinship(ivec2 at, vec3 p, vec3 n, float apart) {
  vec4 q = texelFetch(position_plane, at, 0);
  if (q.w == 0.0) return 0.0;
  float off = abs(dot(q.xyz - p, n)) / apart, facing = max(0.0, dot(n, texelFetch(normal_plane, at, 0).xyz));
  return exp(-min(off, 30.0)) * pow(facing, 8.0) + 1e-6;
}

// For a buffer with one element for each square of `scale` x `scale` samples: returns the indices of the four elements
// around a sample, and their weights.
void around(ivec2 at, int scale, ivec2 size, vec3 p, vec3 n, float apart, out ivec4 elements, out vec4 weights) {
  vec2 place = vec2(at) / float(scale), base = floor(place), f = place - base;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1);
    ivec2 element = clamp(ivec2(base) + offset, ivec2(0), size - 1);
    float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
    w = (w + 0.02) * kinship(element * scale, p, n, apart);
    elements[i] = element.y * size.x + element.x;
    weights[i] = w;
    sum += w;
  }
  weights /= max(sum, 1e-12);
}

struct Traced {
  vec4 open[2];  // visibility of the lights 0 to 3 and 4 to 7; light 0 is the sun
  vec3 light;    // mean radiance from all directions
  vec3 lean;
  vec3 mirror;
  float wet;    // 1 at the border of standing water
  float depth;  // depth of water in metres
  vec3 lie;     // exposure to weather, 0..1 each. x: share of directions in which a surface is near; y: how much a
                // ledge above keeps rain off; z: how near the foot of a wall is
};

Traced tracedAt(ivec2 at, vec3 p, vec3 n, float t) {
  Traced traced;
  traced.open[0] = vec4(0.0);
  traced.open[1] = vec4(0.0);
  traced.light = traced.lean = traced.mirror = traced.lie = vec3(0.0);
  traced.wet = traced.depth = 0.0;
  int side = int(frame.size.z);
  ivec2 pixels_size = ivec2(frame.size.xy), soft_size = (pixels_size + kSoftPixels - 1) / kSoftPixels;
  float apart = 2.0 * t * frame.eye.w * float(side);
  ivec4 elements;
  vec4 weights;
  around(at, side, pixels_size, p, n, apart, elements, weights);
  float met = 0.0;
  for (int i = 0; i < 4; ++i) {
    DirectLight d = direct[elements[i]];
    if (unpackHalf2x16(d.mirror.y).y < -1.5) continue;
    met += weights[i];
    traced.open[0] += weights[i] * unpackUnorm4x8(d.open.x);
    traced.open[1] += weights[i] * unpackUnorm4x8(d.open.y);
    vec2 last = unpackHalf2x16(d.mirror.y);
    traced.mirror += weights[i] * vec3(unpackHalf2x16(d.mirror.x), last.x);
    traced.wet += weights[i] * max(-last.y, 0.0);
    traced.depth += weights[i] * max(last.y, 0.0);
  }
  // None of the four pixels has a surface for which light was traced. This happens at the outermost leaves of foliage:
  // treat them as not occluded.
  if (met < 1e-3) {
    traced.open[0] = traced.open[1] = vec4(1.0);
  } else {
    traced.open[0] /= met;
    traced.open[1] /= met;
    traced.mirror /= met;
    traced.wet /= met;
    traced.depth /= met;
  }
  met = 0.0;
  around(at, side * kSoftPixels, soft_size, p, n, apart * float(kSoftPixels), elements, weights);
  for (int i = 0; i < 4; ++i) {
    traced.light += weights[i] * soft[elements[i]].light.rgb;
    traced.lean += weights[i] * soft[elements[i]].lean.xyz;
    traced.lie += weights[i] * soft[elements[i]].lie.xyz;
    met += weights[i] * soft[elements[i]].light.w;
  }
  if (met < 1e-3)
    traced.light = frame.size.w == 1u ? 0.5 * (skyLight(n, frame.sun.xyz) + skyLight(vec3(0.0, 1.0, 0.0), frame.sun.xyz))
                                      : vec3(frame.sun.w);
  else
    traced.light /= met, traced.lean /= met, traced.lie /= met;
  return traced;
}

// Returns the filtered light on a surface whose relief changes the normal from n to `turned`.
vec3 softOn(Traced traced, vec3 n, vec3 turned) {
  return traced.light * clamp(1.0 + 1.5 * dot(traced.lean, turned - n), 0.25, 2.5);
}

// The light and the transmittance of clouds in front of a sample, interpolated from neighbouring pixels. At the edges
// of objects, only pixels whose first sample is about as far away as this sample count.
struct Clouds {
  vec3 light;
  float through;
  float distance;  // mean distance of the clouds in metres
};

Clouds cloudsBefore(ivec2 at) {
  Clouds clouds = Clouds(vec3(0.0), 1.0, 0.0);
  if (frame.counts.z == 0u) return clouds;
  int side = int(frame.size.z);
  ivec2 size = ivec2(frame.size.xy);
  vec4 own = texelFetch(position_plane, at, 0);
  float t = length(own.xyz - frame.eye.xyz), sum = 0.0, seen = 0.0;
  vec2 place = vec2(at) / float(side), base = floor(place), f = place - base;
  vec4 light = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1);
    ivec2 pixel = clamp(ivec2(base) + offset, ivec2(0), size - 1);
    vec4 q = texelFetch(position_plane, pixel * side, 0);
    bool alike = (q.w == 0.0) == (own.w == 0.0) && (own.w == 0.0 || abs(length(q.xyz - frame.eye.xyz) - t) < 0.1 * t);
    float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
    w = (w + 0.001) * (alike ? 1.0 : 0.001);
    VapourLight v = vapour[pixel.y * size.x + pixel.x];
    vec4 one = vec4(unpackHalf2x16(v.light.x), unpackHalf2x16(v.light.y));
    light += w * one;
    clouds.distance += w * (1.0 - one.a) * v.distance;
    seen += w * (1.0 - one.a);
    sum += w;
  }
  clouds.light = light.rgb / sum;
  clouds.through = light.a / sum;
  clouds.distance /= max(seen, 1e-6);
  return clouds;
}
