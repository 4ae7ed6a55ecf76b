// Fair-weather clouds behind the scene: small cumulus at one height and, far above, streaks of cirrus. They depend only
// on the view direction, so that they do not move while the eye moves. The including file must include
// render/noise.glsl.

// Returns the distance in metres, along a direction, to a height above a spherical earth. up: sine of the direction's
// elevation.
float wayTo(float level, float up) {
  const float kEarth = 6.371e6;
  float b = kEarth * up, c = level * (2.0 * kEarth + level);
  return c / (sqrt(b * b + c) + b);
}

const float kCloudBase = 1250.0;  // height of the clouds' base, in metres above the land
const float kCloudDepth = 800.0;

// Returns how far inside a cumulus cloud a position is, horizontally: 0 at the border, up to 1 in the middle, below 0
// outside. If it is certainly below `least`, returns only an upper bound.
float cumulusAt(vec2 at, float least) {
  vec3 p = vec3(at.x, 900.0, at.y) / 7300.0;
  float heap = -0.40, size = 0.55;
  for (int i = 0; i < 3; ++i) {
    heap += size * plainNoise(p);
    if (i == 1 && heap < least - 0.40) return heap;
    size = i == 0 ? 1.0 : 0.36;
    p *= i == 0 ? 4.8 : 2.5;
  }
  return heap;
}

// Returns the value of cumulusAt() below which there is no cloud at this height. share: height above the cloud's base,
// divided by the cloud's depth.
float leastHeap(float share) { return 0.76 * share * share - 0.24; }

// Returns the density of cumulus, 0..1. heap: value of cumulusAt() there; share: height above the cloud's base, divided
// by the cloud's depth. Bases are flat, tops are heaped.
float cumulusDensity(vec3 p, float heap, float share, int octaves) {
  float body = 1.25 * heap - 0.95 * share * share - 0.3 * (1.0 - smoothstep(0.0, 0.10, share)) - 0.14;
  if (body <= -0.5) return 0.0;
  vec3 q = p / 310.0;
  float size = 0.55;
  for (int i = 0; i < octaves; ++i) {
    body += size * (abs(plainNoise(q)) - (i == 0 ? 0.0 : 0.28));
    q *= 2.6;
    size *= 0.54;
  }
  return smoothstep(0.0, 0.34, body);
}

// Parameters of a cloud layer, relative to the eye.
struct CloudLayer {
  float base;    // height of the layer's base above the eye, in metres
  float beyond;  // minimum distance of clouds in metres
  int steps;     // number of steps of a ray
};

// Returns the light of cumulus in direction d (rgb), and its transmittance (a). turn: position of the first sample
// within a step, 0..1.
vec4 cumulus(CloudLayer layer, vec3 d, vec3 to_sun, vec3 sun_light, vec3 behind, float turn) {
  const int kShort = 4;
  const float kLost = 0.0075;  // extinction per metre at full density
  int steps = layer.steps;
  float step_share = 1.0 / float(steps), base = layer.base, beyond = layer.beyond;
  if (d.y < 0.012) return vec4(0.0, 0.0, 0.0, 1.0);
  float begin = wayTo(base, d.y), way = wayTo(base + kCloudDepth, d.y) - begin;
  if (begin + way < beyond) return vec4(0.0, 0.0, 0.0, 1.0);
  float through = 1.0, forward = pow(max(dot(d, to_sun), 0.0), 8.0);
  vec3 sum = vec3(0.0);
  // Long steps are subdivided where there may be cloud; the cloud's outline is interpolated between the ends of the
  // step.
  float after = -1.0;
  for (int i = -1; i < steps && through > 0.02; ++i) {
    float low = step_share * (float(i) + turn), before = after, least = leastHeap(max(low, 0.0));
    after = cumulusAt(d.xz * (begin + (low + step_share) * way), least);
    if (beyond > 0.0) after -= 1.0 - smoothstep(beyond, 1.3 * beyond, begin + (low + step_share) * way);
    if (i < 0 || max(before, after) <= least) continue;
    for (int k = 0; k < kShort; ++k) {
      float part = float(k) / float(kShort), share = low + step_share * part, heap = mix(before, after, part);
      vec3 p = d * (begin + share * way);
      // `density`: the density at this position. `deep`: the density summed up along the way to the sun.
      float density = 0.0, deep = 0.0;
      for (int j = 0; j < 3; ++j) {
        float ahead = j == 0 ? 0.0 : 22.0 * exp2(1.6 * float(j));
        // Near positions are assumed to be as far inside the cloud's outline as this one; the farthest, slightly less.
        float at = share + to_sun.y * ahead / kCloudDepth, other = j == 2 ? heap - 0.08 : heap;
        float one = cumulusDensity(p + to_sun * ahead, other, at, j == 0 ? 3 : 1);
        if (j == 0) density = one;
        else deep += 0.8 * ahead * one;
        if (density <= 0.0) break;
      }
      if (density <= 0.0) continue;
      float lit = 0.62 * exp(-kLost * deep) + 0.38 * exp(-0.22 * kLost * deep);
      vec3 light = sun_light * (0.52 * lit * (1.0 + 1.2 * forward)) + vec3(0.30, 0.36, 0.44) * (0.55 + 0.75 * share);
      float passed = exp(-kLost * density * min(step_share / float(kShort) * way, 260.0));
      sum += through * (1.0 - passed) * light;
      through *= passed;
    }
  }
  // Haze hides distant clouds.
  float shown = smoothstep(0.012, 0.05, d.y), clear = exp(-begin / 21000.0);
  return vec4(shown * mix(behind * (1.0 - through), sum, clear), mix(1.0, through, shown));
}

// Returns how much of the sky cirrus hides, 0..1: streaks along the wind, in patches.
float cirrus(vec3 d) {
  if (d.y < 0.02) return 0.0;
  vec2 at = d.xz * wayTo(8500.0, d.y), along = vec2(0.83 * at.x + 0.56 * at.y, 0.83 * at.y - 0.56 * at.x);
  float patches = 0.0, streaks = 0.0, size = 1.0;
  vec2 apart = vec2(1.0 / 11000.0, 1.0 / 1900.0);
  for (int i = 0; i < 6; ++i) {
    float n = plainNoise(vec3(i == 0 ? along / 15000.0 : i == 1 ? along / 8000.0 : along * apart, 9.0 - float(i)));
    if (i == 0) patches = smoothstep(-0.1, 0.7, n);
    if (patches == 0.0) return 0.0;
    if (i == 1) along += vec2(300.0, 700.0) * n;
    if (i < 2) continue;
    streaks += size * n;
    apart *= vec2(2.1, 2.4);
    size *= 0.52;
  }
  return 0.42 * patches * smoothstep(-0.35, 1.2, streaks) * smoothstep(0.02, 0.16, d.y);
}
