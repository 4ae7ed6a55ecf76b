#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Lights all samples of the picture, and averages them to pixels.
#include "render/frame.glsl"
#include "render/noise.glsl"
#include "render/patterns.h"
#include "render/materials.glsl"
#include "render/weather.glsl"
#include "render/light.glsl"
#include "render/traced.glsl"
#include "render/clouds.glsl"
#include "render/land.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Returns the direction and the share of the strongest light at a point (Spot::light).
vec3 lightOn(vec3 p, vec3 n, Traced traced) {
  const vec3 kSeen = vec3(0.2126, 0.7152, 0.0722);
  float all = dot(traced.light, kSeen);
  vec3 sum = all * traced.lean;
  if (frame.size.w == 1u) {
    float sun = dot(sunLight(), kSeen) * traced.open[0].x * max(dot(n, frame.sun.xyz), 0.0);
    return (sum + sun * frame.sun.xyz) / max(all + sun, 1e-6);
  }
  for (uint i = 0u; i < frame.counts.x; ++i) {
    vec3 away = frame.lamp_position[i].xyz - p;
    float d = length(away), lit = traced.open[i / 4u][i % 4u] * lampFall(d, frame.lamp_position[i].w);
    if (lit <= 0.0) continue;
    vec3 l = away / d;
    if (i == 0u) lit *= lampBeam(-dot(l, frame.forward.xyz));
    lit *= dot(frame.lamp_colour[i].rgb, kSeen) * max(dot(n, l), 0.0);
    sum += lit * l;
    all += lit;
  }
  return sum / max(all, 1e-6);
}

Surface surfaceAt(uint material, vec3 p, vec3 n, vec3 to_eye, float footprint, Traced traced) {
  Material m = materials[min(material, frame.counts.y - 1u)];
  Spot at = Spot(p, n, to_eye, m.colour_roughness.rgb, m.colour_roughness.w, uintBitsToFloat(m.pattern.y), footprint,
                 traced.wet, traced.depth, lightOn(p - frame.pattern_offset.xyz, n, traced), frame.size.w != 1u);
  Surface s = patterned(m.pattern.x, at);
  if (has(kSkyBit) && (kPatterns & kWeathering) != 0u && frame.size.w == 1u) weather(s, at, m.pattern.x, traced.lie, frame.land.y >= 0.0 && !isBare());
  return s;
}

// Returns a checkerboard that shows texture coordinates, instead of the material. field: value computed by
// surface.frag.
Surface chequered(float field, vec3 n) {
  Surface s;
  s.albedo = mix(vec3(0.16), vec3(0.55), clamp(field - 1.0, 0.0, 1.0));
  if (field > 2.5) s.albedo = field > 3.5 ? vec3(0.10, 0.42, 0.12) : vec3(0.50, 0.08, 0.06);
  s.normal = n;
  s.roughness = 0.8;
  s.specular = 0.03;
  s.translucency = 0.0;
  s.within = vec3(0.0);
  return s;
}

// Sets the appearance of blades and leaves from the value that sprout.vert stores (`told`): brightness by their depth
// in the foliage; white and yellow blossoms, and dry stalks. open: share of sunlight that reaches the point.
void growing(inout Surface s, float told, uint pattern, vec3 d, float open) {
  float kind = floor(told / 4.0), bright = told - 4.0 * kind;
  if (kind == 1.0 || kind == 2.0) {
    s.albedo = kind == 1.0 ? vec3(0.62, 0.61, 0.56) : vec3(0.60, 0.43, 0.04);
    return;
  }
  if (kind == 3.0) s.albedo = mix(s.albedo, vec3(0.30, 0.245, 0.125), 0.85);
  // Leaves near the tips are younger and brighter.
  bool leafy = pattern == kLeafy;
  s.albedo *= bright * mix(vec3(1.0), leafy ? vec3(1.18, 1.06, 0.72) : vec3(1.06, 1.0, 0.85), clamp(1.4 * (bright - 0.9), 0.0, 1.0));
  if (frame.size.w != 1u) return;
  // Leaves glow when they are seen against the sun.
  s.translucency = leafy ? 0.7 : 0.5;
  float against = max(dot(d, frame.sun.xyz), 0.0);
  s.within += s.albedo * vec3(1.30, 1.25, 0.40) * sunLight() * (open * 0.45 * against * against);
  if (!leafy) return;
  // Light from above and from the sun that has passed through other leaves of the crown, and so is green.
  vec3 above = 0.5 * skyLight(vec3(0.0, 1.0, 0.0), frame.sun.xyz) + 0.10 * sunLight() * max(frame.sun.y, 0.0);
  s.within += s.albedo * vec3(1.0, 1.15, 0.55) * above * (0.55 - 0.25 * s.normal.y);
}

vec3 lamps(Surface s, vec3 p, vec3 n, vec3 to_eye, Traced traced) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < frame.counts.x; ++i) {
    float lit = traced.open[i / 4u][i % 4u];
    vec3 away = frame.lamp_position[i].xyz - p;
    float d = length(away), fall = lampFall(d, frame.lamp_position[i].w);
    if (lit * fall <= 0.0) continue;
    vec3 l = away / d;
    if (i == 0u) fall *= lampBeam(-dot(l, frame.forward.xyz));
    sum += frame.lamp_colour[i].rgb * (fall * lit) * reflected(s, l, to_eye);
  }
  return sum;
}

vec3 sunlight(Surface s, vec3 to_eye, Traced traced) {
  return sunLight() * reflected(s, frame.sun.xyz, to_eye) * traced.open[0].x;
}

vec3 background(vec3 d) { return frame.size.w == 1u ? sky(d) : vec3(0.0022, 0.0025, 0.0030); }

vec3 haze(vec3 colour, vec3 d, float t) {
  float clear = exp(-t / frame.forward.w);
  if (frame.size.w == 1u) return mix(hazeIn(d), colour, clear);
  vec3 scattered = vec3(0.0);
  for (uint i = 1u; i < frame.counts.x; ++i) {
    float reach = frame.lamp_position[i].w;
    scattered += frame.lamp_colour[i].rgb * (reach * reach * glow(d, t, frame.lamp_position[i].xyz, reach));
  }
  return mix(background(d), colour, clear) + scattered * (0.010 / frame.forward.w);
}

// Returns what is visible outdoors in a direction without objects. overhead: the sky in this direction.
vec3 outdoors(vec3 d, vec3 overhead) {
  if (frame.land.y < 0.0 || !has(kSkyBit)) return overhead;
  vec3 own = frame.land.y >= 1e6 ? vec3(0.125, 0.150, 0.060) : materials[uint(frame.land.y)].colour_roughness.rgb;
  return land(d, overhead, own);
}

vec3 bodyAt(ivec2 at, vec3 d, vec3 overhead) {
  vec4 seen = texelFetch(position_plane, at, 0);
  vec3 turn = random3(ivec3(at, 1));
  if (seen.w == 0.0) return frame.size.w == 1u ? outdoors(d, overhead) : haze(background(d), d, 4.0 * frame.forward.w);
  vec4 facing = texelFetch(normal_plane, at, 0);
  vec3 p = seen.xyz, n = normalize(facing.xyz);
  float t = length(p - frame.eye.xyz);
  // At grazing angles, a sample covers more of the surface. Only half of the increase is used, which looks sharp
  // without flicker.
  float footprint = t * frame.eye.w / mix(1.0, max(0.25, abs(dot(n, d))), 0.5);
  Traced traced = tracedAt(at, p, n, t);
  Surface s = surfaceAt(uint(seen.w) - 1u, p + frame.pattern_offset.xyz, n, -d, footprint, traced);
  if (facing.w > 0.0) s = chequered(facing.w, n);
  if (facing.w < 0.0) growing(s, -facing.w, materials[min(uint(seen.w) - 1u, frame.counts.y - 1u)].pattern.x, d, traced.open[0].x);
  s.normal = turnedTo(-d, s.normal, n);
  // Screen-space occlusion is added, because there are too few traced rays to find occluders within a hand's breadth.
  float open = openness(at, p, n, t, clamp(0.02 * t, 0.10, 4.0), turn.y);
  vec3 colour = s.within;
  if (frame.size.w == 1u) {
    colour += sunlight(s, -d, traced);
  } else {
    colour += lamps(s, p, n, -d, traced);
  }
  colour += s.albedo * softOn(traced, n, s.normal) * mix(0.35, 1.0, open);
  float grazing = 1.0 - max(0.0, dot(s.normal, -d));
  vec3 shown = s.clear != vec3(0.0) ? s.clear : vec3(s.specular + (1.0 - s.specular) * pow(grazing, 5.0));
  colour += traced.mirror * shown;
  return haze(colour, d, t);
}

vec3 directionAt(vec2 place) {
  vec2 centre = place / vec2(planeSize()) * 2.0 - 1.0;
  return normalize(frame.forward.xyz + centre.x * frame.right.xyz - centre.y * frame.up.xyz);
}

vec3 sampleAt(ivec2 at, vec3 overhead) {
  vec3 d = directionAt(vec2(at) + 0.5);
  Clouds clouds = cloudsBefore(at);
  vec3 behind = clouds.through > 0.0 ? bodyAt(at, d, overhead) * clouds.through : vec3(0.0);
  if (clouds.through >= 1.0) return behind;
  float clear = exp(-clouds.distance / frame.forward.w);
  return mix(hazeIn(d) * (1.0 - clouds.through), clouds.light, clear) + behind;
}

// Returns the sky at a pixel. The sky is so smooth that it is computed once for all samples of the pixel.
vec3 skyOver(ivec2 pixel, int side) {
  if (frame.size.w != 1u || !has(kSkyBit)) return vec3(0.0);
  vec3 d = directionAt((vec2(pixel) + 0.5) * float(side));
  if (frame.land.w == 0.0) return sky(d);
  bool seen = false;
  for (int i = 0; i < side * side && !seen; ++i)
    seen = texelFetch(position_plane, pixel * side + ivec2(i % side, i / side), 0).w == 0.0;
  // Interleaved gradient noise (Jimenez, "Next generation post processing in Call of Duty", 2014).
  float turn = fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
  return seen ? fairSky(d, turn) : vec3(0.0);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size.xy))) return;
  int side = int(frame.size.z);
  vec2 from_centre = (vec2(pixel) + 0.5) / vec2(frame.size.xy) - 0.5;
  float vignette = frame.size.w == 1u ? 1.0 : 1.0 - 0.55 * dot(from_centre, from_centre);
  vec3 light = vec3(0.0), film = vec3(0.0), overhead = skyOver(ivec2(pixel), side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      vec3 seen = sampleAt(ivec2(pixel) * side + ivec2(x, y), overhead) * (frame.pattern_offset.w * vignette);
      light += min(seen, vec3(1000.0));
      film += toneMap(seen);
    }
  }
  uvec3 exposed = exposedPixel(film / float(side * side), light / float(side * side));
  uint at = 3u * (pixel.y * frame.size.x + pixel.x);
  for (int word = 0; word < 3; ++word) pixels[at + uint(word)] = exposed[word];
}
