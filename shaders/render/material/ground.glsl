// Materials of the ground, and plants on it.

// Sand, soil, mud: grains and ripples.
Surface granular(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 0.5).x + 0.5 * noise(at.p * 2.2).x;
  float grain = fineNoise(at.p * 60.0, 0.017, at.footprint) + fineNoise(at.p * 210.0, 0.005, at.footprint);
  s.albedo = at.colour * (1.0 + 0.16 * broad + 0.14 * grain);
  vec4 relief_slope = relief(at.p, 0.35, 6, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.11 * at.relief);
  s.specular = 0.03;
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.012 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Sand and snow moved by the wind: ripples across the wind, in fields that end where the ground is firm; on sand, also
// small stones that the wind has left behind.
Surface windblown(Spot at) {
  Surface s = granular(at);
  float flat_share = smoothstep(0.80, 0.94, at.n.y);
  const float kSoil = 0.3;  // a material darker than this is soil or mud, which the wind does not move
  if (at.sheltered || flat_share <= 0.0 || at.colour.r < kSoil) return s;
  vec2 q = at.p.xz;
  vec4 broad = noise(vec3(q * 0.16, 31.0)), patches = noise(vec3(q * 0.9, 17.0));
  float fine = noise(vec3(q * 4.3, 9.0)).x;
  float firm = smoothstep(-0.05, 0.35, broad.x + 0.35 * patches.x + 0.10 * fine);
  // Ripples run across the wind. Their crests meander, divide and join, and their lee side is steep.
  const float kLength = 0.115;
  vec2 wind = normalize(vec2(0.86, 0.51));
  float phase = dot(q, wind) / kLength + 1.1 * patches.y + 0.32 * fine + 2.6 * broad.y;
  float crest = fract(phase), seen = visible(0.8 * kLength, at.footprint) * flat_share * (1.0 - firm);
  float slope = crest < 0.70 ? 1.0 / 0.70 : -1.0 / 0.30;
  slope *= smoothstep(0.0, 0.10, min(crest, 1.0 - crest)) * smoothstep(0.0, 0.10, abs(crest - 0.70));
  vec2 tilt = slope * wind * (0.75 + 0.5 * noise(vec3(q * 2.1, 3.0)).x) * seen;
  s.normal = bend(s.normal, vec3(tilt.x, 0.0, tilt.y), 0.17 * at.relief);
  s.albedo *= 1.0 + seen * (crest < 0.70 ? 0.05 * crest : -0.10);
  s.albedo *= mix(vec3(1.0), vec3(0.90, 0.87, 0.84), flat_share * firm);
  const float kSand = 0.75;  // a material brighter than this is snow, which has no stones
  if (max(at.colour.r, at.colour.g) > kSand) return s;
  const float kStones = 0.05;
  float near = visible(0.9 * kStones, at.footprint) * flat_share, many = 0.40 * firm - 0.14 + 0.16 * patches.z;
  if (near <= 0.0 || many <= 0.0) return s;
  vec3 way = -vec3(at.to_eye.x, dot(at.to_eye, at.n), at.to_eye.z), to_light = vec3(at.light.x, dot(at.light, at.n), at.light.z);
  vec2 bent = q + 0.006 * noise(at.p * 23.0).yz;
  Strewn stone = strewnAt(bent, way, kStones, many, 97);
  vec2 open = mix(vec2(1.0), lightAmong(stone, to_light, kStones, many, 97), near);
  float shown = stone.there * near;
  vec3 own = at.colour * mix(vec3(0.42, 0.40, 0.42), vec3(0.95, 0.88, 0.82), stone.lot.y);
  s.albedo = mix(s.albedo, own, shown) * mix(open.y, open.x, 0.6 * length(at.light));
  s.normal = normalize(mix(s.normal, stone.normal, 0.8 * shown));
  return s;
}

// Gravel: stones of two sizes over fine material, larger ones on smaller ones; each has its height, shadow and colour.
Surface gravelly(Spot at) {
  Chart chart = chartOf(at.p, abs(at.n.y) > 0.6 ? vec3(0.0, 1.0, 0.0) : at.n);
  const float kLarge = 0.062, kSmall = 0.024;
  Surface s = granular(at);
  // Stones are sorted by water and wheels: coarse in one place, fine in another, with dust in between.
  float sorted = noise(at.p * 0.43 + 3.0).x + 0.5 * noise(at.p * 1.3 + 12.0).x;
  float many = clamp(0.42 + 0.45 * sorted, 0.08, 0.85), strewn_small = clamp(0.95 + 0.75 * sorted, 0.35, 1.0);
  s.albedo *= 1.0 - 0.14 * clamp(sorted, -1.0, 1.0);
  float seen = visible(0.9 * kLarge, at.footprint), fine = visible(kSmall, at.footprint);
  if (seen <= 0.0) return s;
  vec2 bent = chart.at + 0.007 * noise(at.p * 21.0).yz;
  float grain = fineNoise(at.p * 90.0, 0.011, at.footprint);
  vec3 way = -vec3(dot(at.to_eye, chart.along), dot(at.to_eye, at.n), dot(at.to_eye, chart.up));
  vec3 to_light = vec3(dot(at.light, chart.along), dot(at.light, at.n), dot(at.light, chart.up));
  Strewn large = strewnAt(bent, way, kLarge, many, 91), small = large;
  vec2 open = mix(vec2(1.0), lightAmong(large, to_light, kLarge, many, 91), seen);
  if (large.there == 0.0 && fine > 0.0) {
    small = strewnAt(bent, way, kSmall, strewn_small, 93);
    open *= mix(vec2(1.0), lightAmong(small, to_light, kSmall, strewn_small, 93), fine);
  }
  float shown = small.there * (large.there > 0.0 ? seen : fine);
  vec3 lot = small.lot;
  vec3 stone = at.colour * (0.62 + 0.66 * lot.x) * mix(vec3(1.10, 0.99, 0.88), vec3(0.90, 0.97, 1.06), lot.y);
  s.albedo = mix(0.8 * s.albedo, stone * (1.0 + 0.18 * grain), shown);
  s.albedo *= mix(open.y, open.x, 0.6 * length(at.light));
  vec3 normal = chart.along * small.normal.x + at.n * small.normal.y + chart.up * small.normal.z;
  s.normal = normalize(mix(s.normal, normal + 0.5 * (s.normal - at.n), shown * min(1.0, at.relief)));
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.1 * (1.0 - fine));
  return s;
}

// Grass: blades in all directions, clumps, and dry patches.
Surface grassy(Spot at) {
  Surface s = surfaceOf(at);
  vec4 clump = noise(at.p * 3.1), broad = noise(at.p * 0.22 + 3.0);
  float blade = fineNoise(at.p * vec3(38.0, 9.0, 38.0), 0.03, at.footprint) +
                fineNoise(at.p * vec3(120.0, 20.0, 120.0), 0.009, at.footprint);
  vec3 dry = mix(at.colour, vec3(0.30, 0.255, 0.14), 0.42), lush = at.colour * vec3(0.62, 0.90, 0.52);
  s.albedo = mix(at.colour, dry, smoothstep(0.1, 0.8, broad.x + 0.4 * clump.x));
  s.albedo = mix(s.albedo, lush, 0.75 * smoothstep(-0.1, 0.6, -broad.x + 0.3 * noise(at.p * 1.1).x));
  // Unmown grass is high and pale, in areas with clear borders; from far away, tussocks are dark dots.
  float stand = noise(at.p * 0.045 + 11.0).x + 0.35 * noise(at.p * 0.19).x + 0.12 * clump.x;
  s.albedo = mix(s.albedo, vec3(0.205, 0.180, 0.085) * (1.0 + 0.2 * clump.x), 0.55 * smoothstep(0.16, 0.34, stand));
  float tussock = smoothstep(0.15, 0.6, fineNoise(at.p * 1.6 + 5.0, 0.6, at.footprint));
  s.albedo *= mix(vec3(1.0), vec3(0.60, 0.68, 0.55), 0.7 * tussock);
  // Patches of clover and moss, and places where the grass is trodden thin.
  float clover = smoothstep(0.22, 0.42, noise(at.p * 0.55 + 21.0).x + 0.30 * noise(at.p * 2.7).x);
  s.albedo = mix(s.albedo, at.colour * vec3(0.58, 0.86, 0.72), 0.7 * clover);
  float worn = smoothstep(0.42, 0.75, noise(at.p * 0.33 + 60.0).x + 0.35 * clump.x + 0.2 * noise(at.p * 8.0).x);
  s.albedo = mix(s.albedo, vec3(0.185, 0.150, 0.090), 0.6 * worn);
  s.albedo *= 1.0 + 0.30 * blade + 0.14 * clump.x;
  // Slopes that are too steep for grass show the soil.
  float bare = 1.0 - smoothstep(0.60, 0.80, at.n.y + 0.12 * clump.x);
  s.albedo = mix(s.albedo, vec3(0.20, 0.155, 0.105) * (1.0 + 0.3 * clump.x), 0.8 * bare);
  vec4 relief_slope = relief(at.p, 0.30, 6, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.26 * at.relief);
  s.roughness = 0.95;
  s.specular = 0.02;
  s.translucency = 0.25;
  return s;
}

// Foliage of a tree's crown: each leaf has its own direction.
Surface leafy(Spot at) {
  Surface s = surfaceOf(at);
  vec3 w = planeWeights(at.n);
  vec2 plane = w.x > w.y && w.x > w.z ? at.p.zy : w.y > w.z ? at.p.xz : at.p.xy;
  Block b = cellAt(plane + 0.06 * noise(at.p * 5.0).yz, 0.065, 0.02, 31);
  float seen = visible(0.06, at.footprint), sprig = noise(at.p * 4.5 + 7.0).x;
  vec4 clump = noise(at.p * 1.3);
  s.albedo = at.colour * (1.0 + 0.35 * clump.x) * mix(vec3(1.0), vec3(1.3, 1.12, 0.7), 0.5 * b.lot.x * seen);
  s.albedo *= mix(0.85, mix(0.62, 1.0, smoothstep(0.0, 0.016, b.edge)) * (0.62 + 0.7 * b.lot.y), seen);
  s.albedo *= 0.55 + 0.45 * smoothstep(-0.6, 0.0, sprig);
  // Trees and their branches differ in hue.
  float hue = noise(at.p * 0.07 + 30.0).x + 0.4 * noise(at.p * 0.75 + 50.0).x;
  s.albedo *= mix(vec3(0.84, 0.97, 1.0), vec3(1.22, 1.06, 0.76), smoothstep(-0.7, 0.7, hue));
  vec3 turn = vec3(b.lot.x, b.lot.y, b.lot.z) - 0.5;
  vec4 relief_slope = relief(at.p, 0.9, 4, 0, at.footprint);
  s.normal = bend(at.n, 2.4 * turn * seen + 0.9 * relief_slope.xyz, 0.8 * at.relief);
  s.roughness = 0.6;
  s.specular = 0.03;
  s.translucency = 0.5;
  return s;
}

// Bark: ridges along the stem with furrows between them. Thatch: straw down the slope.
Surface fibrous(Spot at) {
  Surface s = surfaceOf(at);
  Chart chart = chartOf(at.p, at.n);
  // Furrows are where a noise is zero, which gives long lines that divide and join, with plates between them.
  vec3 q = vec3(at.p.x * 16.0, at.p.y * 0.50, at.p.z * 16.0) + vec3(0.30, 0.06, 0.30) * noise(at.p * 3.1).yzw;
  vec4 ridge = noise(q), narrow = noise(q * 2.3 + 11.0), fine = noise(q * 7.1);
  float seen = visible(0.07, at.footprint), close = visible(0.03, at.footprint), grain = fine.x * visible(0.012, at.footprint);
  float furrow = (1.0 - smoothstep(0.04, 0.36, abs(ridge.x) + 0.12 * fine.x)) * seen;
  furrow = max(furrow, 0.6 * (1.0 - smoothstep(0.0, 0.34, abs(narrow.x) + 0.15 * fine.x)) * close);
  float broad = noise(at.p * 1.3).x;
  s.albedo = at.colour * (1.0 + 0.16 * broad + 0.22 * ridge.x * seen + 0.25 * grain);
  // Weathered bark is grey, with green algae in patches.
  s.albedo = mix(s.albedo, vec3(dot(s.albedo, vec3(0.34))) * vec3(1.04, 1.02, 0.94), 0.30 + 0.40 * smoothstep(-0.3, 0.4, broad));
  s.albedo *= mix(vec3(1.0), vec3(0.40, 0.37, 0.35), furrow);
  vec3 slope = (sign(ridge.x) * ridge.yzw * (1.0 - smoothstep(0.1, 0.4, abs(ridge.x))) * seen +
                0.6 * sign(narrow.x) * narrow.yzw * (1.0 - smoothstep(0.1, 0.4, abs(narrow.x))) * close + 0.35 * fine.yzw * close) *
               vec3(1.0, 0.25, 1.0);
  s.normal = bend(at.n, -slope, -0.45 * at.relief);
  s.specular = 0.02;
  return s;
}

// Moss in cushions.
Surface mossy(Spot at) {
  Surface s = surfaceOf(at);
  vec4 cushion = noise(at.p * 9.0);
  float fine = fineNoise(at.p * 90.0, 0.011, at.footprint);
  s.albedo = at.colour * (1.0 + 0.35 * cushion.x + 0.3 * fine + 0.25 * noise(at.p * 1.1).x);
  vec4 relief_slope = relief(at.p, 0.16, 5, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.5 * at.relief);
  s.roughness = 1.0;
  s.specular = 0.01;
  s.translucency = 0.2;
  return s;
}
