// Procedural noise for the appearance of surfaces. Only pictures use it: it does not affect derived data such as
// meshes.

uvec3 scramble(uvec3 v) {  // the hash pcg3d of Jarzynski and Olano, "Hash functions for GPU rendering"
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return v;
}

vec3 random3(ivec3 c) { return vec3(scramble(uvec3(c)) >> 8) * (1.0 / 16777216.0); }
vec3 gradientAt(ivec3 c) { return random3(c) * 2.0 - 1.0; }

// Loops over the neighbours of a point are marked [[dont_unroll]]: drivers inline hundreds of calls of these functions,
// and with unrolled loops, Mesa compiles slowly, especially large shaders.

// Returns gradient noise, about -1..1, in x, and its derivative in yzw.
vec4 noise(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  vec3 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec3 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (int k = 0; k < 8; ++k) {
    ivec3 corner = ivec3(k & 1, (k >> 1) & 1, k >> 2);
    vec3 away = vec3(corner), w = mix(1.0 - u, u, away), dw = mix(-du, du, away);
    vec3 gradient = gradientAt(ivec3(cell) + corner);
    float value = dot(gradient, f - away), weight = w.x * w.y * w.z;
    sum += vec4(weight * value, weight * gradient + value * dw * w.yzx * w.zxy);
  }
  return sum * 1.4;
}

// Returns the value of noise(p) without its derivative, which is faster.
float plainNoise(vec3 p) {
  vec3 cell = floor(p), f = p - cell, u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  float sum = 0.0;
  [[dont_unroll]] for (int k = 0; k < 8; ++k) {
    ivec3 corner = ivec3(k & 1, (k >> 1) & 1, k >> 2);
    vec3 away = vec3(corner), w = mix(1.0 - u, u, away);
    sum += w.x * w.y * w.z * dot(gradientAt(ivec3(cell) + corner), f - away);
  }
  return sum * 1.4;
}

// Returns the distance from p to the nearest border of a Voronoi cell; cells are about 1 wide.
float borderDistance(vec2 p, int seed) {
  vec2 cell = floor(p), f = p - cell;
  ivec2 i = ivec2(cell);
  vec2 nearest = vec2(0.0);
  float best = 8.0;
  [[dont_unroll]] for (int k = 0; k < 9; ++k) {
    ivec2 aside = ivec2(k % 3 - 1, k / 3 - 1);
    vec2 d = vec2(aside) + random3(ivec3(i + aside, seed)).xy - f;
    float l = dot(d, d);
    if (l < best) { best = l; nearest = d; }
  }
  float border = 8.0;
  [[dont_unroll]] for (int k = 0; k < 9; ++k) {
    ivec2 aside = ivec2(k % 3 - 1, k / 3 - 1);
    vec2 d = vec2(aside) + random3(ivec3(i + aside, seed)).xy - f;
    vec2 across = d - nearest;
    if (dot(across, across) > 1e-4) border = min(border, dot(0.5 * (nearest + d), normalize(across)));
  }
  return border;
}
