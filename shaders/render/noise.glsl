// Procedural noise for surfaces. Pictures only: nothing here feeds derived data.

uvec3 scramble(uvec3 v) {  // Jarzynski and Olano, "Hash functions for GPU rendering" (pcg3d)
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return v;
}

vec3 random3(ivec3 c) { return vec3(scramble(uvec3(c)) >> 8) * (1.0 / 16777216.0); }
vec3 gradientAt(ivec3 c) { return random3(c) * 2.0 - 1.0; }

// Gradient noise, about -1..1 in x, with its derivative in yzw.
vec4 noise(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  ivec3 i = ivec3(cell);
  vec3 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec3 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  vec3 ga = gradientAt(i), gb = gradientAt(i + ivec3(1, 0, 0));
  vec3 gc = gradientAt(i + ivec3(0, 1, 0)), gd = gradientAt(i + ivec3(1, 1, 0));
  vec3 ge = gradientAt(i + ivec3(0, 0, 1)), gf = gradientAt(i + ivec3(1, 0, 1));
  vec3 gg = gradientAt(i + ivec3(0, 1, 1)), gh = gradientAt(i + ivec3(1, 1, 1));
  float va = dot(ga, f), vb = dot(gb, f - vec3(1, 0, 0));
  float vc = dot(gc, f - vec3(0, 1, 0)), vd = dot(gd, f - vec3(1, 1, 0));
  float ve = dot(ge, f - vec3(0, 0, 1)), vf = dot(gf, f - vec3(1, 0, 1));
  float vg = dot(gg, f - vec3(0, 1, 1)), vh = dot(gh, f - vec3(1, 1, 1));
  float k1 = vb - va, k2 = vc - va, k3 = ve - va;
  float k4 = va - vb - vc + vd, k5 = va - vc - ve + vg, k6 = va - vb - ve + vf;
  float k7 = -va + vb + vc - vd + ve - vf - vg + vh;
  float value = va + u.x * k1 + u.y * k2 + u.z * k3 + u.x * u.y * k4 + u.y * u.z * k5 + u.z * u.x * k6 +
                u.x * u.y * u.z * k7;
  vec3 slope = ga + u.x * (gb - ga) + u.y * (gc - ga) + u.z * (ge - ga) + u.x * u.y * (ga - gb - gc + gd) +
               u.y * u.z * (ga - gc - ge + gg) + u.z * u.x * (ga - gb - ge + gf) +
               u.x * u.y * u.z * (-ga + gb + gc - gd + ge - gf - gg + gh) +
               du * (vec3(k1, k2, k3) + u.yzx * vec3(k4, k5, k6) + u.zxy * vec3(k6, k4, k5) + u.yzx * u.zxy * k7);
  return vec4(value, slope) * 1.4;
}

// The same noise without its derivative, for what is asked often.
float plainNoise(vec3 p) {
  vec3 cell = floor(p), f = p - cell, u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec4 low, high;
  for (int k = 0; k < 4; ++k) {
    ivec3 corner = ivec3(k & 1, k >> 1, 0);
    low[k] = dot(gradientAt(ivec3(cell) + corner), f - vec3(corner));
    corner.z = 1;
    high[k] = dot(gradientAt(ivec3(cell) + corner), f - vec3(corner));
  }
  vec4 v = mix(low, high, u.z);
  vec2 w = mix(v.xz, v.yw, u.x);
  return 1.4 * mix(w.x, w.y, u.y);
}

// Distance from p to the nearest border of a Voronoi cell, in cells.
float borderDistance(vec2 p, int seed) {
  vec2 cell = floor(p), f = p - cell;
  ivec2 i = ivec2(cell);
  vec2 nearest = vec2(0.0);
  float best = 8.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      vec2 d = vec2(x, y) + random3(ivec3(i + ivec2(x, y), seed)).xy - f;
      float l = dot(d, d);
      if (l < best) { best = l; nearest = d; }
    }
  }
  float border = 8.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      vec2 d = vec2(x, y) + random3(ivec3(i + ivec2(x, y), seed)).xy - f;
      vec2 across = d - nearest;
      if (dot(across, across) > 1e-4) border = min(border, dot(0.5 * (nearest + d), normalize(across)));
    }
  }
  return border;
}
