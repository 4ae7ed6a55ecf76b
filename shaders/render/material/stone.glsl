// Natural stone: beds, stains, cracks, flowstone.

// Weathered basalt: dark and even; brown where its surface has weathered, browner and paler where people walk and water
// runs. It has no beds and no mineral deposits, but many small pits; joints divide its columns; and crusts of lichen
// grow on it, most of all in the sun.
Surface basaltic(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.21 + 5.0), patches = noise(p * 0.9 + 40.0), mottle = noise(p * 3.7 + 9.0);
  float fine = fineNoise(p * 23.0, 0.045, footprint);
  float grain = fineNoise(p * 71.0, 0.014, footprint) + 0.7 * fineNoise(p * 190.0, 0.0052, footprint);
  float top = smoothstep(0.55, 0.85, n.y + 0.08 * mottle.x);
  vec3 albedo = at.colour * (1.0 + 0.20 * broad.x + 0.16 * patches.x + 0.14 * mottle.x + 0.14 * fine + 0.20 * grain);
  vec3 skin = at.colour * vec3(1.75, 1.50, 1.22);
  float weathered = smoothstep(-0.35, 0.55, patches.y + 0.45 * broad.y + 0.35 * mottle.y + 0.2 * fine);
  albedo = mix(albedo, skin * (1.0 + 0.16 * fine + 0.22 * grain), weathered * mix(0.42, 0.72, top));

  // Cross joints divide a column into drums of unequal height. Their seams are thin, and chipped in places.
  float wall = 1.0 - smoothstep(0.35, 0.65, abs(n.y)), seam = 0.0;
  if (wall > 0.0) {
    vec3 drum = floor(p / vec3(0.47, 100.0, 0.41) + 0.35 * patches.yxw * vec3(1.0, 0.0, 1.0));
    float height = p.y / 0.46 + random3(ivec3(int(drum.x), 77, int(drum.z))).x * 7.0 + 0.05 * mottle.x;
    float from_seam = abs(fract(height + 0.3 * random3(ivec3(int(drum.x), int(floor(height)), int(drum.z))).y) - 0.5) * 0.46;
    seam = (1.0 - smoothstep(0.004, 0.016, from_seam + 0.006 * mottle.z)) * visible(0.03, footprint) * wall;
    albedo *= 1.0 - 0.55 * seam;
  }
  float pits = smoothstep(0.34, 0.52, fineNoise(p * 41.0 + 3.0, 0.025, footprint)) * smoothstep(-0.3, 0.4, patches.z);
  albedo *= 1.0 - 0.5 * pits;

  // Lichens: pale crusts in rounded patches with dark rims, and a little orange.
  float stays = (1.0 - at.wet) * smoothstep(-0.55, 0.15, n.y + 0.3 * broad.w);
  float crust = noise(p * 15.0 + 21.0).x + 0.45 * noise(p * 37.0 + 4.0).x + 0.30 * patches.w + 0.30 * broad.z;
  float lichen = stays * smoothstep(0.48, 0.64, crust);
  albedo = mix(albedo, vec3(0.250, 0.250, 0.220) * (1.0 + 0.22 * fine + 0.15 * grain), 0.50 * lichen);
  float orange = stays * smoothstep(0.78, 0.90, noise(p * 13.0 + 63.0).x + 0.30 * patches.y - 0.3 * broad.z + 0.3 * fine);
  albedo = mix(albedo, vec3(0.28, 0.175, 0.055) * (1.0 + 0.2 * grain), 0.35 * orange);

  vec4 relief_slope = relief(p, 0.24, 6, 1, footprint);
  vec3 slope = relief_slope.xyz * mix(0.75, 1.1, weathered);
  slope -= noise(p * 41.0 + 3.0).yzw * (0.5 * pits);
  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.27 * at.relief);
  s.roughness = clamp(at.roughness + 0.14 * weathered, 0.10, 1.0);
  s.specular = 0.03;
  // The sea blackens the rock that it reaches.
  s.albedo *= mix(1.0, 0.55, smoothstep(0.0, 0.5, at.wet + 0.2 * patches.x * step(0.01, at.wet)));
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.09 * at.relief * at.relief * relief_slope.w);
  return s;
}

Surface rock(Spot at) {
  const float kDarkest = 0.16;  // rock darker than this is basalt
  if (max(at.colour.r, max(at.colour.g, at.colour.b)) < kDarkest) return basaltic(at);
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.11 + 5.0);
  vec4 patches = noise(p * 0.43 + 40.0);
  vec4 mottle = noise(p * 1.7 + 9.0);
  float grain = fineNoise(p * 11.0, 0.09, footprint) + 0.7 * fineNoise(p * 37.0, 0.027, footprint) +
                0.6 * fineNoise(p * 131.0, 0.0076, footprint);

  // Beds (layers of the rock) are nearly level and gently folded; some are pale, some contain iron.
  float height = p.y + 1.6 * broad.x + 0.30 * patches.x + 0.05 * mottle.x;
  float bed = noise(vec3(height * 0.55, 3.0, broad.y)).x;
  float wall = 1.0 - smoothstep(0.55, 0.9, abs(n.y));
  float lamina = wall > 0.0 ? fineNoise(vec3(0.5, height * 3.4, patches.y * 0.3), 0.3, footprint) : 0.0;

  vec3 pale = mix(at.colour, vec3(dot(at.colour, vec3(0.33))), 0.25) * 1.22;
  vec3 iron = at.colour * vec3(0.92, 0.70, 0.50);
  vec3 albedo = mix(at.colour, pale, smoothstep(-0.05, 0.55, bed));
  albedo = mix(albedo, iron, 0.55 * smoothstep(0.05, 0.65, -bed + 0.35 * patches.x));
  albedo *= 1.0 + 0.13 * lamina * wall + 0.16 * grain + 0.12 * mottle.x;

  // Water runs down walls: it leaves thin dark films, and pale deposits of minerals where it has dried.
  vec3 run = vec3(p.x * 1.1, p.y * 0.11, p.z * 1.1) + 0.5 * vec3(patches.y, 0.0, mottle.x);
  float streak = 0.0;
  if (wall > 0.0) streak = noise(run + 70.0).x + 0.5 * noise(run * vec3(2.7, 1.7, 2.7) + 31.0).x;
  float film = wall * smoothstep(0.35, 0.85, streak);
  float sinter = wall * smoothstep(0.35, 0.85, -streak + 0.35 * broad.x);
  albedo = mix(albedo, albedo * vec3(0.60, 0.57, 0.55), 0.7 * film);
  albedo = mix(albedo, vec3(0.60, 0.54, 0.45) * (1.0 + 0.10 * grain), 0.35 * sinter);

  float split = cracks(p + 0.25 * patches.yzw + 0.10 * mottle.yzw, n, 1.9, 0.03, footprint);
  split *= smoothstep(0.0, 0.5, patches.x + 0.5 * mottle.y);
  albedo *= 1.0 - 0.45 * split;

  // Former seeps have left iron and manganese along their paths, in patches; between them the stone is clean.
  float seep = smoothstep(0.10, 0.55, noise(run * vec3(0.8, 1.4, 0.8) + 11.0).x + 0.45 * patches.z);
  albedo = mix(albedo, at.colour * vec3(0.95, 0.60, 0.34) * (1.0 + 0.25 * grain), 0.50 * seep * (0.4 + 0.6 * wall));
  float soot = smoothstep(0.30, 0.62, noise(p * 0.71 + 55.0).x + 0.35 * mottle.x);
  albedo = mix(albedo, at.colour * vec3(0.34, 0.31, 0.29), 0.45 * soot);

  // Silt, clay and small stones cover surfaces that are flat enough.
  float floor_cover = smoothstep(0.70, 0.92, n.y + 0.18 * patches.x + 0.08 * mottle.x);
  vec3 silt = mix(vec3(0.27, 0.20, 0.135), at.colour * 0.7, 0.45) * (1.0 + 0.22 * grain + 0.2 * mottle.x);
  float settled = at.sheltered ? 1.0 : 0.4;  // share of silt that stays; outdoors, rain washes most of it away
  albedo = mix(albedo, silt, 0.7 * settled * floor_cover);
  float mud = 0.0;
  if (floor_cover > 0.0 && at.sheltered) {
    mud = floor_cover * smoothstep(0.0, 0.35, noise(p * vec3(0.31, 0.2, 0.31) + 21.0).x + 0.3 * mottle.x);
  }
  albedo = mix(albedo, silt * vec3(0.62, 0.56, 0.50), 0.8 * mud);
  vec3 strewn = vec3(0.0);
  if (floor_cover > 0.05 && footprint < 0.07 && at.sheltered) {
    vec4 uneven = noise(p * 13.0);
    vec2 on = p.xz + 0.020 * noise(p * 5.0).yz + 0.009 * uneven.yz;
    const float kLarge = 0.23, kSmall = 0.065;
    float much = floor_cover * (0.62 + 0.40 * patches.y + 0.25 * mottle.z - 0.25 * mud);
    float many = much - 0.22 - 0.5 * (1.0 - floor_cover);
    float seen = visible(0.6 * kLarge, footprint), fine = visible(0.8 * kSmall, footprint);
    vec3 way = -vec3(at.to_eye.x, dot(at.to_eye, n), at.to_eye.z), to_light = vec3(at.light.x, dot(at.light, n), at.light.z);
    Strewn large = strewnAt(on, way, kLarge, many, 71), small = large;
    vec2 open = mix(vec2(1.0), lightAmong(large, to_light, kLarge, many, 71), seen);
    if (large.there == 0.0 && fine > 0.0) {
      small = strewnAt(on, way, kSmall, much, 73);
      open *= mix(vec2(1.0), lightAmong(small, to_light, kSmall, much, 73), fine);
    }
    float shown = small.there * (large.there > 0.0 ? seen : fine);
    albedo = mix(albedo, at.colour * mix(0.42, 0.88, small.lot.y) * (1.0 + 0.30 * grain + 0.1 * mottle.x), shown);
    albedo *= mix(open.y, open.x, 0.6 * length(at.light));
    // Stones are broken, not rounded: their faces meet at blunt edges.
    vec3 facing = small.normal + 0.16 * uneven.yzw;
    strewn = -vec3(facing.x, 0.0, facing.z) / max(facing.y, 0.4) * shown;
    mud *= 1.0 - shown;
  }

  // The mesh itself shows larger forms of the rock, so the longest wavelength of the relief is 0.36 m.
  vec4 relief_slope = relief(p, 0.36, 7, 2, footprint);
  vec3 slope = relief_slope.xyz;
  slope.y += wall * 0.4 * lamina;
  // Faces of the rock that broke along a joint are smooth, others are rough.
  slope *= mix(0.55, 1.10, smoothstep(-0.35, 0.45, patches.z + 0.6 * broad.z));
  slope *= mix(1.0, mix(0.55, 0.30, mud), floor_cover);
  slope += strewn / (0.34 * max(at.relief, 0.3));

  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.29 * at.relief);
  // Wet stone is shiny where water runs, in drops and thin films; elsewhere it is damp, dull and paler.
  float base = at.roughness, gleam = max(max(0.9 * film, 0.5 * sinter), 0.9 * mud);
  if (base < 0.4) {
    float beads = smoothstep(0.10, 0.60, fineNoise(p * 19.0 + 7.0, 0.05, footprint) +
                                         0.5 * fineNoise(p * 53.0, 0.02, footprint));
    float runs = smoothstep(0.0, 0.5, streak + 0.5 * patches.y) * wall;
    float shine = max(runs * (0.35 + 0.65 * beads), 0.5 * beads * smoothstep(0.0, 0.5, patches.y));
    base = mix(0.72, base, shine);
    gleam *= 0.4 + 0.6 * beads;
    s.albedo *= 1.0 + 0.30 * (1.0 - shine);
  }
  s.roughness = clamp(mix(base, max(0.24, base * 0.5), gleam), 0.10, 1.0);
  s.specular = mix(0.025, 0.04, gleam);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.085 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Granite: grains of several colours.
Surface speckled(Spot at) {
  Surface s = surfaceOf(at);
  float seen = visible(0.012, at.footprint);
  float dark = smoothstep(0.25, 0.45, noise(at.p * 90.0).x), pink = smoothstep(0.1, 0.5, noise(at.p * 70.0 + 31.0).x);
  vec3 grains = mix(mix(at.colour * 1.2, at.colour * vec3(1.25, 1.0, 0.9), pink), at.colour * 0.25, dark);
  float broad = noise(at.p * 0.35).x;
  s.albedo = mix(at.colour, grains, seen) * (1.0 + 0.15 * broad);
  vec4 relief_slope = relief(at.p, 0.5, 6, 2, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.25 * at.relief);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.0625 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Marble: polished stone with veins.
Surface veined(Spot at) {
  Surface s = surfaceOf(at);
  vec4 broad = noise(at.p * 0.9 + 3.0), fine = noise(at.p * 3.1 + 11.0);
  float vein = 1.0 - smoothstep(0.0, 0.09, abs(noise(at.p * 1.1 + 0.9 * broad.yzw + 0.3 * fine.yzw).x));
  s.albedo = at.colour * (1.0 - 0.35 * vein) * (1.0 + 0.08 * broad.x);
  vec4 relief_slope = relief(at.p, 0.15, 3, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.06 * at.relief);
  return s;
}

// Flowstone: calcite that water has deposited in thin films; also used for ice.
Surface flowstone(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.5 + 12.0), patches = noise(p * 1.9 + 4.0);
  // Each run of water has a colour of its own, from white over honey to rust; it meanders downwards.
  vec3 run = vec3(p.x * 6.0, p.y * 0.40, p.z * 6.0) + 0.9 * broad.yzw + 0.25 * patches.yzw;
  float wall = 1.0 - smoothstep(0.6, 0.95, abs(n.y));
  float fluted = visible(0.14, footprint) * wall;
  vec4 flute = fluted > 0.0 ? noise(run) * fluted : vec4(0.0);
  float stripe = noise(run * vec3(0.45, 0.8, 0.45) + 33.0).x;
  // Films that have dried leave bands of unequal width. They are interrupted where the water has changed its path.
  float band = 0.0;
  if (wall > 0.0) {
    vec3 bands = vec3(p.x * 0.7, p.y * 11.0 + 2.5 * broad.x + 0.8 * patches.x, p.z * 0.7);
    band = wall * fineNoise(bands, 0.09, footprint);
  }
  float grain = fineNoise(p * 29.0, 0.035, footprint) + 0.8 * fineNoise(p * 97.0, 0.01, footprint);
  vec3 honey = at.colour * vec3(0.90, 0.68, 0.44), rust = at.colour * vec3(0.62, 0.38, 0.22);
  Surface s = surfaceOf(at);
  float age = broad.x + 0.55 * stripe + 0.25 * patches.x;
  s.albedo = mix(at.colour, honey, smoothstep(-0.20, 0.45, age));
  s.albedo = mix(s.albedo, rust, 0.75 * smoothstep(0.28, 0.75, age + 0.15 * band));
  s.albedo *= 1.0 + 0.14 * flute.x + 0.10 * band + 0.10 * grain;
  // Clay lies on surfaces that face up, and sticks to old, dry calcite.
  float dirt = smoothstep(0.45, 0.95, n.y + 0.35 * patches.x) * smoothstep(-0.25, 0.25, patches.y + 0.5 * broad.z) +
               0.6 * smoothstep(0.25, 0.6, noise(p * 0.9 + 61.0).x + 0.3 * patches.z);
  dirt = min(dirt, 1.0);
  s.albedo = mix(s.albedo, vec3(0.235, 0.175, 0.115) * (1.0 + 0.3 * grain), 0.55 * dirt);
  vec3 slope = flute.yzw * vec3(1.0, 0.1, 1.0) + vec3(0.0, 0.45 * band, 0.0);
  vec4 relief_slope = relief(p, 0.24, 5, 2, footprint);
  slope += mix(0.45, 0.8, smoothstep(0.0, 0.5, patches.z)) * relief_slope.xyz;
  s.normal = bend(n, slope, 0.30 * at.relief);
  float flutes = visible(0.14, footprint), lost = 0.25 * relief_slope.w + 0.5 * (1.0 - flutes * flutes);
  // Water still runs in some places; elsewhere the calcite has dried to a dull crust.
  float runs = smoothstep(0.05, 0.45, noise(run * vec3(0.6, 0.5, 0.6) + 80.0).x + 0.3 * broad.y);
  s.roughness = clamp(mix(1.9, 0.85, runs) * at.roughness * (1.0 + 0.35 * dirt), 0.08, 1.0);
  s.albedo *= mix(1.0, 0.80, runs);
  s.specular = 0.045;
  wetten(s, 0.6 * at.wet);
  s.roughness = roughened(s.roughness, 0.30 * 0.30 * at.relief * at.relief * lost);
  s.translucency = 0.20;
  return s;
}

// Solidified lava: dark, matt and full of small bubbles, with level lines where the flow has stood for a while. In
// patches, hot gas has rusted it, a glaze has dripped, or seeping water has deposited pale salts. Floors are a crust
// that has cracked while it shrank.
Surface lava(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.19 + 5.0), patches = noise(p * 0.7 + 40.0), mottle = noise(p * 2.7 + 9.0);
  float fine = fineNoise(p * 11.0, 0.09, footprint);
  float grain = fineNoise(p * 37.0, 0.027, footprint) + 0.8 * fineNoise(p * 110.0, 0.009, footprint);
  float floor_share = smoothstep(0.62, 0.88, n.y + 0.10 * mottle.x), wall = 1.0 - smoothstep(0.45, 0.80, abs(n.y));
  vec3 albedo = at.colour * (1.0 + 0.20 * broad.x + 0.14 * patches.x + 0.15 * mottle.x + 0.16 * fine + 0.24 * grain);
  albedo *= mix(vec3(0.94, 1.0, 1.06), vec3(1.06, 1.01, 0.96), smoothstep(-0.4, 0.5, patches.z + 0.6 * broad.y));

  float rust = smoothstep(0.15, 0.75, broad.z + 0.45 * patches.x + 0.3 * mottle.y + 0.2 * fine) * (1.0 - 0.7 * floor_share);
  albedo = mix(albedo, vec3(0.098, 0.062, 0.048) * (1.0 + 0.2 * fine + 0.3 * grain), 0.30 * rust);
  float glaze = smoothstep(0.20, 0.50, patches.y + 0.4 * broad.y + 0.30 * mottle.z) * (1.0 - floor_share);
  albedo *= mix(vec3(1.0), vec3(0.72, 0.72, 0.76), glaze);
  // Salts cover bubbles and ledges, in specks that grow together.
  float salt = smoothstep(0.30, 0.75, noise(p * 0.9 + 71.0).x + 0.30 * patches.w + 0.28 * mottle.w + 0.22 * fine + 0.22 * grain);
  albedo = mix(albedo, vec3(0.22, 0.212, 0.195) * (1.0 + 0.2 * grain), 0.30 * salt * (1.0 - 0.6 * floor_share));
  // Level lines where the flow stood: thin, paler above and darker below, interrupted in places.
  float height = p.y + 0.10 * broad.x + 0.025 * mottle.x;
  float line = fineNoise(vec3(0.5, height * 7.0, 0.5 + 0.4 * broad.y), 0.12, footprint) +
               0.6 * fineNoise(vec3(0.5, height * 19.0, 2.5), 0.045, footprint);
  albedo *= 1.0 + 0.22 * wall * line * smoothstep(-0.4, 0.3, patches.y - broad.z);

  float bubbles = smoothstep(0.26, 0.48, fineNoise(p * 36.0, 0.028, footprint)) * (1.0 - 0.7 * glaze);
  albedo *= 1.0 - 0.40 * bubbles;
  vec3 bent = p + 0.16 * patches.yzw + 0.05 * mottle.yzw;
  float split = floor_share > 0.0 ? cracks(bent, n, 0.9, 0.022, footprint) * smoothstep(-0.15, 0.25, patches.z) : 0.0;
  albedo *= 1.0 - 0.7 * split * floor_share;
  // Grit and dust lie on flat surfaces.
  float dust = floor_share * smoothstep(-0.2, 0.5, patches.w + 0.4 * mottle.z + 0.3 * fine);
  albedo = mix(albedo, vec3(0.085, 0.077, 0.069) * (1.0 + 0.2 * fine + 0.25 * grain), 0.4 * dust);

  vec4 relief_slope = relief(p, 0.26, 6, 1, footprint);
  vec3 slope = relief_slope.xyz * mix(1.0, 0.6, max(glaze, 0.6 * dust));
  slope.y += 0.35 * wall * line;
  slope -= noise(p * 36.0).yzw * (0.5 * bubbles);
  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.27 * at.relief);
  s.roughness = clamp(at.roughness * mix(1.45, 0.95, glaze) * (1.0 + 0.08 * grain), 0.12, 1.0);
  s.specular = mix(0.02, 0.04, glaze);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.075 * at.relief * at.relief * relief_slope.w);
  return s;
}
