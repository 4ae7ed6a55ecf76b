// Surfaces made by masons, tilers and pavers.

// Combines stones and mortar to a wall. joint: width of mortar in metres on each side of a block's edge; rough: how
// uneven the stones are.
Surface laid(Spot at, Block b, Chart chart, float joint, float size, vec3 stone, vec3 mortar, float tilt, float rough) {
  Surface s = surfaceOf(at);
  float seen = visible(0.5 * size, at.footprint);
  // A joint thinner than a sample darkens the sample in proportion to its width.
  float blur = 0.5 * at.footprint;
  float gap = (1.0 - smoothstep(max(0.6 * joint - blur, 0.0), 1.3 * joint + blur, b.edge)) * min(1.0, joint / blur);
  float grain = fineNoise(at.p * 23.0, 0.04, at.footprint) + fineNoise(at.p * 71.0, 0.014, at.footprint);
  float broad = noise(at.p * 0.6).x;
  // From far away, a wall has the mean colour of stones and mortar; joints are darkened by shadow.
  float share = min(1.0, 1.5 * joint / size);
  vec3 mean = mix(stone, mortar, share);
  s.albedo = mix(mean, mix(stone, mortar, gap), seen) * (1.0 + 0.10 * grain + 0.13 * broad);
  vec4 relief_slope = relief(at.p, 0.10, 4, 1, at.footprint);
  // Stones are rounded: near their edges the surface slopes down.
  vec3 slope = relief_slope.xyz * rough - (chart.along * b.tilt.x + chart.up * b.tilt.y) * (tilt * visible(0.03, at.footprint));
  slope += (chart.along * (b.lot.y - 0.5) + chart.up * (b.lot.z - 0.5)) * (0.12 * seen);
  s.normal = bend(at.n, slope, 0.5 * at.relief);
  s.specular = 0.03;
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.012 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Returns how weathered a wall is: rain washes it in streaks, and dirt stays where no rain comes.
float weathered(vec3 p, vec3 n) {
  float wall = 1.0 - smoothstep(0.4, 0.8, abs(n.y));
  float streak = noise(vec3(p.x * 2.3, p.y * 0.22, p.z * 2.3) + 17.0).x + 0.5 * noise(vec3(p.x, p.y * 0.3, p.z) * 5.1).x;
  return wall * smoothstep(0.15, 0.9, streak);
}

Surface brickwork(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  const vec2 kBricks = vec2(0.25, 0.075);
  Block b = blockAt(chart.at, kBricks, 0.5, 0.0, 0.006);
  vec3 grey = vec3(dot(at.colour, vec3(0.35, 0.45, 0.2)));
  vec3 fired = mix(at.colour, grey, 0.24) * (0.66 + 0.5 * b.lot.x);
  fired *= mix(vec3(1.0), vec3(1.12, 0.88, 0.80), b.lot.y * b.lot.y);
  // Some bricks are darker, because one end was next to the fire.
  fired *= b.lot.z > 0.86 ? vec3(0.62, 0.66, 0.74) : vec3(1.0);
  vec3 mean = mix(at.colour, grey, 0.26) * 0.86;
  // Variation at larger scales, which is still visible where single bricks are too small: batches of different colour,
  // courses and soot.
  vec2 load = chart.at / vec2(0.9, 0.3);
  float loads = fineNoise(vec3(load, dot(at.p, at.n) * 0.3), 0.15, at.footprint) +
                0.8 * fineNoise(vec3(load * vec2(3.1, 2.3), 4.0), 0.06, at.footprint);
  float broad = plainNoise(at.p * vec3(0.23, 0.4, 0.23) + 31.0);
  vec3 wall = mix(mean, fired, visible(0.11, at.footprint)) * (1.0 - 0.22 * weathered(at.p, at.n));
  wall *= 1.0 + 0.16 * loads + 0.12 * broad;
  wall = mix(wall, grey * 0.62, 0.22 * smoothstep(0.0, 0.8, broad + 0.5 * loads));
  return laid(at, b, chart, 0.005, 0.075, wall, vec3(0.40, 0.37, 0.32), 0.8, 0.22);
}

// Courses of dressed stone.
Surface ashlar(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.72, 0.34), 0.5, 0.45, 0.014);
  vec3 stone = at.colour * (0.84 + 0.32 * b.lot.x) * mix(vec3(1.0), vec3(1.06, 0.98, 0.86), b.lot.y);
  stone = mix(at.colour, stone, visible(0.3, at.footprint));
  stone *= 1.0 - 0.30 * weathered(at.p, at.n);
  return laid(at, b, chart, 0.005, 0.34, stone, at.colour * 0.62, 0.9, 0.20);
}

// Walls of rough stones.
Surface rubble(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  vec2 bent = chart.at + 0.06 * vec2(noise(at.p * 2.1).x, noise(at.p * 2.1 + 50.0).x);
  Block b = cellAt(bent * vec2(0.72, 1.25), 0.36, 0.07, 61);
  vec3 stone = at.colour * (0.80 + 0.36 * b.lot.x) * mix(vec3(1.05, 0.98, 0.88), vec3(0.92, 0.95, 1.0), b.lot.y);
  stone = mix(at.colour, stone, visible(0.25, at.footprint)) * (1.0 - 0.25 * weathered(at.p, at.n));
  return laid(at, b, chart, 0.012, 0.36, stone, at.colour * 0.72, 1.1, 0.22);
}

// Flags of a pavement: some are new, some are cracked; there is dirt in the joints, and chewing gum everywhere.
Surface paving(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(0.75, 0.5), 0.5, 0.2, 0.008);
  float broad = noise(at.p * 1.3).x, fine = fineNoise(at.p * 7.0, 0.14, at.footprint);
  vec3 stone = at.colour * (0.80 + 0.34 * b.lot.x) * mix(vec3(1.04, 1.0, 0.93), vec3(0.95, 0.98, 1.02), b.lot.y);
  stone *= b.lot.z > 0.9 ? 0.82 : 1.0;
  stone = mix(at.colour * 0.97, stone, visible(0.4, at.footprint)) * (1.0 - 0.20 * smoothstep(0.1, 0.8, broad + 0.4 * fine));
  float dirt = (1.0 - smoothstep(0.0, 0.07, b.edge + 0.03 * fine)) * visible(0.1, at.footprint);
  stone *= 1.0 - 0.20 * dirt;
  float split = b.lot.z < 0.16 ? cracks(at.p + 0.04 * noise(at.p * 4.0).yzw, at.n, 0.6, 0.006, at.footprint) : 0.0;
  Block gum = cellAt(chart.at, 0.55, 1.0, 307);
  float trodden = step(gum.lot.x, 0.45) * (1.0 - smoothstep(0.010, 0.020, length(gum.within) + 0.004 * fine));
  stone *= (1.0 - 0.5 * split) * (1.0 - 0.38 * trodden * visible(0.03, at.footprint));
  return laid(at, b, chart, 0.007, 0.5, stone, at.colour * 0.34, 0.7, 0.06);
}

// Cobbles of a street, rounded and polished by wheels, with earth and moss between them.
Surface cobbles(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  // The rows of cobbles have sunk unevenly.
  vec2 sunk = chart.at + 0.06 * noise(at.p * 0.55).yz + 0.012 * noise(at.p * 2.6 + 3.0).yz;
  Block b = settAt(sunk, vec2(0.155, 0.125), 0.2, 0.06, 83);
  float seen = visible(0.12, at.footprint), broad = noise(at.p * 0.37).x, patchy = noise(at.p * 1.7 + 9.0).x;
  float grain = fineNoise(at.p * 60.0, 0.017, at.footprint) + 0.7 * fineNoise(at.p * 190.0, 0.006, at.footprint);
  // Stones come from several quarries: most are grey, some brown, some nearly black.
  vec3 stone = at.colour * (0.74 + 0.52 * b.lot.x) * mix(vec3(0.96, 1.0, 1.04), vec3(1.14, 0.98, 0.82), b.lot.y * b.lot.y);
  stone *= b.lot.z > 0.9 ? 0.62 : 1.0;
  // The tops of the stones are worn bright and smooth.
  float worn = smoothstep(0.012, 0.05, b.edge);
  stone *= (0.86 + 0.22 * worn) * (1.0 + 0.22 * grain);
  float blur = 0.5 * at.footprint, joint = 0.010 + 0.006 * patchy;
  float gap = (1.0 - smoothstep(max(0.55 * joint - blur, 0.0), 1.5 * joint + blur, b.edge)) * min(1.0, 1.4 * joint / blur);
  vec3 earth = vec3(0.085, 0.070, 0.052) * (1.0 + 0.4 * grain);
  float moss = smoothstep(0.05, 0.45, broad + 0.6 * patchy);
  earth = mix(earth, vec3(0.055, 0.066, 0.026) * (1.0 + 0.5 * grain), 0.8 * moss);
  vec3 far = mix(at.colour * 1.02, earth, 0.18);
  Surface s = surfaceOf(at);
  s.albedo = mix(far, mix(stone, earth, gap), seen) * (1.0 + 0.12 * broad);
  vec4 relief_slope = relief(at.p, 0.05, 3, 1, at.footprint);
  vec3 slope = relief_slope.xyz * 0.12;
  slope += (chart.along * b.tilt.x + chart.up * b.tilt.y) * (-1.5 * visible(0.05, at.footprint));
  slope += (chart.along * (b.lot.y - 0.5) + chart.up * (b.lot.z - 0.5)) * (0.16 * seen);
  s.normal = bend(at.n, slope, 0.5 * at.relief);
  s.specular = mix(0.035, 0.02, gap);
  s.roughness = mix(at.roughness, mix(at.roughness * (1.0 - 0.22 * worn), 0.95, gap), seen);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.010 * relief_slope.w + 0.04 * (1.0 - seen));
  return s;
}

// Returns the colour variation between parts of a roof: roofs are mended in pieces, and rows from different years
// differ.
float mended(vec2 at, float footprint) {
  Block piece = blockAt(at, vec2(2.3, 0.95), 0.4, 0.8, 0.1);
  float row = random3(ivec3(int(floor(at.y / 0.33)), 71, 3)).x - 0.5;
  return 1.0 + (0.30 * (piece.lot.x - 0.5) * visible(0.9, footprint)) + 0.20 * row * visible(0.33, footprint);
}

// Rows of round clay tiles side by side, each row overlapping the one below.
Surface roofTiles(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  const vec2 kTile = vec2(0.22, 0.32);
  vec2 q = chart.at / kTile;
  q.x += 0.02 * random3(ivec3(int(floor(q.y)), 3, 8)).x;
  ivec2 tile = ivec2(floor(q));
  vec2 f = q - floor(q);
  vec3 lot = random3(ivec3(tile, 12));
  float seen = visible(0.12, at.footprint);
  vec3 clay = at.colour * (0.83 + 0.26 * lot.x) * mix(vec3(1.0), vec3(0.86, 0.82, 0.76), lot.y * lot.y);
  float moss = smoothstep(0.25, 0.7, noise(at.p * 0.9 + 5.0).x + 0.5 * noise(at.p * 6.0).x);
  clay = mix(clay, vec3(0.16, 0.15, 0.10), 0.35 * moss);
  float valley = smoothstep(0.30, 0.5, abs(f.x - 0.5));
  float lip = smoothstep(0.90, 0.99, f.y) + 0.6 * (1.0 - smoothstep(0.0, 0.10, f.y));
  Surface s = surfaceOf(at);
  s.albedo = mix(at.colour * 0.86, clay * (1.0 - 0.42 * valley) * (1.0 - 0.7 * min(lip, 1.0)), seen);
  float grain = fineNoise(at.p * 40.0, 0.025, at.footprint);
  s.albedo *= (1.0 + 0.10 * grain) * mended(chart.at, at.footprint);
  vec3 slope = chart.along * (0.9 * sin(6.2831853 * (f.x - 0.5))) + chart.up * (0.25 - 0.8 * smoothstep(0.9, 1.0, f.y));
  slope += chart.along * (0.2 * (lot.z - 0.5));
  s.normal = bend(at.n, slope, 0.55 * at.relief * seen);
  s.roughness = roughened(at.roughness, 0.12 * (1.0 - seen));
  s.specular = 0.03;
  return s;
}

// Rows of overlapping slates.
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
