// What masons, tilers and pavers laid.

// Joins stones and mortar: `joint` metres of mortar on each side of a block's edge.
Surface laid(Spot at, Block b, Chart chart, float joint, float size, vec3 stone, vec3 mortar, float tilt) {
  Surface s = surfaceOf(at);
  float seen = visible(0.5 * size, at.footprint);
  // A joint that is thinner than a sample darkens it by its share.
  float blur = 0.5 * at.footprint;
  float gap = (1.0 - smoothstep(max(0.6 * joint - blur, 0.0), 1.3 * joint + blur, b.edge)) * min(1.0, joint / blur);
  float grain = fineNoise(at.p * 23.0, 0.04, at.footprint) + fineNoise(at.p * 71.0, 0.014, at.footprint);
  float broad = noise(at.p * 0.6).x;
  // Far away a wall has the mean of both.
  float share = min(1.0, 2.5 * joint / size);
  vec3 mean = mix(stone, mortar, share);
  s.albedo = mix(mean, mix(stone, mortar, gap), seen) * (1.0 + 0.10 * grain + 0.13 * broad);
  vec4 relief_slope = relief(at.p, 0.10, 4, 1, at.footprint);
  vec3 slope = relief_slope.xyz * 0.22 + (chart.along * b.tilt.x + chart.up * b.tilt.y) * (tilt * visible(0.03, at.footprint));
  slope += (chart.along * (b.lot.y - 0.5) + chart.up * (b.lot.z - 0.5)) * (0.12 * seen);
  s.normal = bend(at.n, slope, 0.5 * at.relief);
  s.specular = 0.03;
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.012 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Rain washes walls in streaks and leaves dirt where it does not come.
float weathered(vec3 p, vec3 n) {
  float wall = 1.0 - smoothstep(0.4, 0.8, abs(n.y));
  float streak = noise(vec3(p.x * 2.3, p.y * 0.22, p.z * 2.3) + 17.0).x + 0.5 * noise(vec3(p.x, p.y * 0.3, p.z) * 5.1).x;
  return wall * smoothstep(0.15, 0.9, streak);
}

Surface brickwork(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.25, 0.075), 0.5, 0.0, 0.006);
  vec3 fired = at.colour * (0.72 + 0.5 * b.lot.x) * mix(vec3(1.0), vec3(1.15, 0.85, 0.75), b.lot.y * b.lot.y);
  fired = mix(at.colour, fired, visible(0.07, at.footprint)) * (1.0 - 0.22 * weathered(at.p, at.n));
  return laid(at, b, chart, 0.005, 0.075, fired, vec3(0.48, 0.45, 0.40), 0.8);
}

// Courses of dressed stone.
Surface ashlar(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.72, 0.34), 0.5, 0.45, 0.014);
  vec3 stone = at.colour * (0.84 + 0.32 * b.lot.x) * mix(vec3(1.0), vec3(1.06, 0.98, 0.86), b.lot.y);
  stone = mix(at.colour, stone, visible(0.3, at.footprint));
  stone *= 1.0 - 0.30 * weathered(at.p, at.n);
  return laid(at, b, chart, 0.005, 0.34, stone, at.colour * 0.62, 0.9);
}

// Walling of rough stones.
Surface rubble(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  vec2 bent = chart.at + 0.06 * vec2(noise(at.p * 2.1).x, noise(at.p * 2.1 + 50.0).x);
  Block b = cellAt(bent * vec2(0.72, 1.25), 0.36, 0.07, 61);
  vec3 stone = at.colour * (0.80 + 0.36 * b.lot.x) * mix(vec3(1.05, 0.98, 0.88), vec3(0.92, 0.95, 1.0), b.lot.y);
  stone = mix(at.colour, stone, visible(0.25, at.footprint)) * (1.0 - 0.25 * weathered(at.p, at.n));
  return laid(at, b, chart, 0.012, 0.36, stone, at.colour * 0.72, 1.1);
}

// Flags of a pavement.
Surface paving(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.75, 0.5), 0.5, 0.2, 0.008);
  vec3 stone = at.colour * (0.86 + 0.28 * b.lot.x);
  stone = mix(at.colour, stone, visible(0.4, at.footprint)) * (1.0 - 0.15 * smoothstep(0.2, 0.8, noise(at.p * 1.3).x));
  return laid(at, b, chart, 0.006, 0.5, stone, at.colour * 0.42, 0.7);
}

// Setts of a street, rounded by wheels.
Surface cobbles(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  // Rows are straight but for the ground, which has sunk under them.
  vec2 sunk = chart.at + 0.035 * noise(at.p * 0.55).yz;
  Block b = blockAt(sunk, vec2(0.15, 0.12), 0.5, 0.3, 0.05);
  vec3 stone = at.colour * (0.72 + 0.5 * b.lot.x) * mix(vec3(1.0), vec3(1.05, 0.97, 0.9), b.lot.y);
  stone = mix(at.colour, stone, visible(0.12, at.footprint));
  return laid(at, b, chart, 0.009, 0.12, stone, at.colour * 0.38, 1.2);
}

// Roofs are mended in pieces, and rows of one year differ from those of another.
float mended(vec2 at, float footprint) {
  Block piece = blockAt(at, vec2(2.3, 0.95), 0.4, 0.8, 0.1);
  float row = random3(ivec3(int(floor(at.y / 0.33)), 71, 3)).x - 0.5;
  return 1.0 + (0.30 * (piece.lot.x - 0.5) * visible(0.9, footprint)) + 0.20 * row * visible(0.33, footprint);
}

// Rows of clay tiles, round ones side by side, each row over the one below.
Surface roofTiles(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  const vec2 kTile = vec2(0.22, 0.32);
  vec2 q = chart.at / kTile;
  q.x += 0.02 * random3(ivec3(int(floor(q.y)), 3, 8)).x;
  ivec2 tile = ivec2(floor(q));
  vec2 f = q - floor(q);
  vec3 lot = random3(ivec3(tile, 12));
  float seen = visible(0.12, at.footprint);
  vec3 clay = at.colour * (0.72 + 0.5 * lot.x) * mix(vec3(1.0), vec3(0.82, 0.78, 0.72), lot.y * lot.y);
  float moss = smoothstep(0.25, 0.7, noise(at.p * 0.9 + 5.0).x + 0.5 * noise(at.p * 6.0).x);
  clay = mix(clay, vec3(0.16, 0.15, 0.10), 0.35 * moss);
  float valley = smoothstep(0.30, 0.5, abs(f.x - 0.5));
  float lip = smoothstep(0.90, 0.99, f.y) + 0.6 * (1.0 - smoothstep(0.0, 0.10, f.y));
  Surface s = surfaceOf(at);
  s.albedo = mix(at.colour * 0.86, clay * (1.0 - 0.6 * valley) * (1.0 - 0.7 * min(lip, 1.0)), seen);
  float grain = fineNoise(at.p * 40.0, 0.025, at.footprint);
  s.albedo *= (1.0 + 0.10 * grain) * mended(chart.at, at.footprint);
  vec3 slope = chart.along * (1.3 * sin(6.2831853 * (f.x - 0.5))) + chart.up * (0.25 - 0.8 * smoothstep(0.9, 1.0, f.y));
  slope += chart.along * (0.2 * (lot.z - 0.5));
  s.normal = bend(at.n, slope, 0.55 * at.relief * seen);
  s.roughness = roughened(at.roughness, 0.12 * (1.0 - seen));
  s.specular = 0.03;
  return s;
}

// Rows of slates that lap.
Surface slates(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.28, 0.20), 0.5, 0.25, 0.012);
  float seen = visible(0.10, at.footprint);
  vec3 tint = mix(vec3(1.0), mix(vec3(1.1, 1.0, 0.92), vec3(0.88, 0.96, 1.08), b.lot.y), 0.8);
  vec3 stone = at.colour * (0.66 + 0.6 * b.lot.x) * tint;
  float butt = smoothstep(0.085, 0.1, b.within.y), side = 1.0 - smoothstep(0.002, 0.006, b.edge);
  Surface s = surfaceOf(at);
  float lichen = smoothstep(0.35, 0.7, noise(at.p * 1.7).x + 0.5 * noise(at.p * 13.0).x);
  stone = mix(stone, vec3(0.34, 0.34, 0.28), 0.25 * lichen);
  s.albedo = mix(at.colour, stone * (1.0 - 0.55 * max(0.7 * side, butt)), seen) * mended(chart.at, at.footprint);
  vec3 slope = chart.up * (0.16 + 0.5 * butt) + (chart.along * (b.lot.y - 0.5) + chart.up * (b.lot.z - 0.5)) * 0.25;
  vec4 relief_slope = relief(at.p, 0.08, 3, 1, at.footprint);
  s.normal = bend(at.n, slope * seen + 0.25 * relief_slope.xyz, 0.6 * at.relief);
  s.roughness = roughened(at.roughness, 0.03 * relief_slope.w + 0.02 * (1.0 - seen));
  return s;
}
