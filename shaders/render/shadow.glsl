// Which light reaches a point: compares its depth with that of the light's tile. Tiles as runtime/cli/render/shadow.h
// lays them out; depth is reversed, so that what is nearer to the light is greater.
const int kLampTile = 512, kSunTile = 2048;
const float kLampNear = 0.02, kLampRange = 4.5;

// Share of the texels around `at` (in texels of the tile) that the light passes, weighed bilinearly.
float passing(vec2 at, ivec2 corner, int tile, float limit) {
  vec2 base = floor(at - 0.5), f = at - 0.5 - base;
  ivec2 i = ivec2(base), last = ivec2(tile - 1);
  float a = texelFetch(shadow_plane, corner + clamp(i, ivec2(0), last), 0).r <= limit ? 1.0 : 0.0;
  float b = texelFetch(shadow_plane, corner + clamp(i + ivec2(1, 0), ivec2(0), last), 0).r <= limit ? 1.0 : 0.0;
  float c = texelFetch(shadow_plane, corner + clamp(i + ivec2(0, 1), ivec2(0), last), 0).r <= limit ? 1.0 : 0.0;
  float d = texelFetch(shadow_plane, corner + clamp(i + ivec2(1, 1), ivec2(0), last), 0).r <= limit ? 1.0 : 0.0;
  return mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
}

// turn: random numbers 0..1 that spread the samples of one pixel over the lamp's soft edge.
float lampReaches(uint lamp, vec3 p, vec3 n, vec2 turn) {
  vec3 from = p - frame.lamp_position[lamp].xyz;
  float away = max(max(abs(from.x), abs(from.y)), abs(from.z));
  // A texel's width at this distance, grown where light grazes the wall: the wall must not shade itself.
  float texel = 2.0 * away / float(kLampTile);
  float grazing = 1.0 - abs(dot(n, from)) / max(length(from), 1e-6);
  from += n * (texel * (1.5 + 3.5 * grazing) + 0.005);
  vec3 m = abs(from);
  int axis = m.x >= m.y && m.x >= m.z ? 0 : m.y >= m.z ? 1 : 2;
  float major = from[axis];
  vec2 across = axis == 0 ? from.zy : axis == 1 ? from.xz : from.xy;
  if ((axis == 2) == (major < 0.0)) across.x = -across.x;  // as planLamp turns the tiles
  ivec2 corner = ivec2((axis * 2 + (major < 0.0 ? 1 : 0)) * kLampTile, int(lamp) * kLampTile);
  vec2 at = (across / abs(major) * 0.5 + 0.5) * float(kLampTile) + (turn - 0.5) * 3.0;
  return passing(at, corner, kLampTile, kLampNear / abs(major) * 1.004);
}

float sunReaches(vec3 p, vec3 n, vec2 turn) {
  float texel = 2.0 / (float(kSunTile) * length(vec3(frame.sun_view_projection[0].x, frame.sun_view_projection[1].x,
                                                     frame.sun_view_projection[2].x)));
  vec4 clip = frame.sun_view_projection * vec4(p + n * (3.0 * texel), 1.0);
  vec2 at = (clip.xy * 0.5 + 0.5) * float(kSunTile) + (turn - 0.5) * 4.0;
  return passing(at, ivec2(0), kSunTile, clip.z + 1.5 / float(kSunTile));
}
