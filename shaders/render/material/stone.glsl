// Stone as it grew and broke: beds, stains, cracks, flowstone.

Surface rock(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.11 + 5.0);
  vec4 patches = noise(p * 0.43 + 40.0);
  vec4 mottle = noise(p * 1.7 + 9.0);
  float grain = fineNoise(p * 11.0, 0.09, footprint) + 0.7 * fineNoise(p * 37.0, 0.027, footprint) +
                0.6 * fineNoise(p * 131.0, 0.0076, footprint);

  // Beds lie nearly level and are bent gently; some are pale, some carry iron.
  float height = p.y + 1.6 * broad.x + 0.30 * patches.x + 0.05 * mottle.x;
  float bed = noise(vec3(height * 0.55, 3.0, broad.y)).x;
  float wall = 1.0 - smoothstep(0.55, 0.9, abs(n.y));
  float lamina = wall > 0.0 ? fineNoise(vec3(0.5, height * 3.4, patches.y * 0.3), 0.3, footprint) : 0.0;

  vec3 pale = mix(at.colour, vec3(dot(at.colour, vec3(0.33))), 0.25) * 1.22;
  vec3 iron = at.colour * vec3(0.92, 0.70, 0.50);
  vec3 albedo = mix(at.colour, pale, smoothstep(-0.05, 0.55, bed));
  albedo = mix(albedo, iron, 0.55 * smoothstep(0.05, 0.65, -bed + 0.35 * patches.x));
  albedo *= 1.0 + 0.13 * lamina * wall + 0.16 * grain + 0.12 * mottle.x;

  // Water runs down walls: thin dark films, and pale sinter where it has dried.
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

  // Old seeps have left iron and manganese along their ways, in patches; between them the stone is fresh.
  float seep = smoothstep(0.10, 0.55, noise(run * vec3(0.8, 1.4, 0.8) + 11.0).x + 0.45 * patches.z);
  albedo = mix(albedo, at.colour * vec3(0.95, 0.60, 0.34) * (1.0 + 0.25 * grain), 0.50 * seep * (0.4 + 0.6 * wall));
  float soot = smoothstep(0.30, 0.62, noise(p * 0.71 + 55.0).x + 0.35 * mottle.x);
  albedo = mix(albedo, at.colour * vec3(0.34, 0.31, 0.29), 0.45 * soot);

  // Silt, clay and small stones settle on whatever is flat enough.
  float floor_cover = smoothstep(0.70, 0.92, n.y + 0.18 * patches.x + 0.08 * mottle.x);
  vec3 silt = mix(vec3(0.27, 0.20, 0.135), at.colour * 0.7, 0.45) * (1.0 + 0.22 * grain + 0.2 * mottle.x);
  albedo = mix(albedo, silt, 0.7 * floor_cover);
  float mud = 0.0;
  if (floor_cover > 0.0) {
    mud = floor_cover * smoothstep(0.0, 0.35, noise(p * vec3(0.31, 0.2, 0.31) + 21.0).x + 0.3 * mottle.x);
  }
  albedo = mix(albedo, silt * vec3(0.62, 0.56, 0.50), 0.8 * mud);
  vec3 strewn = vec3(0.0);
  if (floor_cover > 0.05 && footprint < 0.07) {
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
    // Broken, not rolled: faces meet at blunt edges.
    vec3 facing = small.normal + 0.16 * uneven.yzw;
    strewn = -vec3(facing.x, 0.0, facing.z) / max(facing.y, 0.4) * shown;
    mud *= 1.0 - shown;
  }

  // Geometry has what is larger than a step; relief begins where that ends.
  vec4 relief_slope = relief(p, 0.62, 7, 3, footprint);
  vec3 slope = relief_slope.xyz;
  slope.y += wall * 0.4 * lamina;
  // Faces that broke along a joint are smooth, others rough.
  slope *= mix(0.42, 1.15, smoothstep(-0.35, 0.45, patches.z + 0.6 * broad.z));
  slope *= mix(1.0, mix(0.55, 0.30, mud), floor_cover);
  slope += strewn / (0.34 * max(at.relief, 0.3));

  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.34 * at.relief);
  // Wet stone gleams where water runs or stands in hollows; between, it is damp and dull, and paler.
  float base = at.roughness;
  if (base < 0.4) {
    float damp = smoothstep(-0.35, 0.25, -patches.y - 0.35 * mottle.z - 0.25 * grain) * (1.0 - film);
    base = mix(base, 0.60, 0.85 * damp);
    s.albedo *= 1.0 + 0.30 * damp;
  }
  s.roughness = clamp(mix(base, base * 0.45, max(max(0.9 * film, 0.5 * sinter), 0.9 * mud)), 0.10, 1.0);
  s.specular = mix(0.03, 0.045, max(film, mud));
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.12 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Grains of several colours: granite.
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

// Marble: veins through polished stone.
Surface veined(Spot at) {
  Surface s = surfaceOf(at);
  vec4 broad = noise(at.p * 0.9 + 3.0), fine = noise(at.p * 3.1 + 11.0);
  float vein = 1.0 - smoothstep(0.0, 0.09, abs(noise(at.p * 1.1 + 0.9 * broad.yzw + 0.3 * fine.yzw).x));
  s.albedo = at.colour * (1.0 - 0.35 * vein) * (1.0 + 0.08 * broad.x);
  vec4 relief_slope = relief(at.p, 0.15, 3, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.06 * at.relief);
  return s;
}

// Calcite, which water has laid down film by film; ice, which it froze to.
Surface flowstone(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.5 + 12.0), patches = noise(p * 1.9 + 4.0);
  // Each run of water has its own colour, from white over honey to rust; it wanders on its way down.
  vec3 run = vec3(p.x * 6.0, p.y * 0.40, p.z * 6.0) + 0.9 * broad.yzw + 0.25 * patches.yzw;
  float wall = 1.0 - smoothstep(0.6, 0.95, abs(n.y));
  float fluted = visible(0.14, footprint) * wall;
  vec4 flute = fluted > 0.0 ? noise(run) * fluted : vec4(0.0);
  float stripe = noise(run * vec3(0.45, 0.8, 0.45) + 33.0).x;
  // Films that dry leave bands of unequal width, which are broken where the water has found another way.
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
  // Clay lies on what faces up and sticks to old, dry calcite.
  float dirt = smoothstep(0.45, 0.95, n.y + 0.35 * patches.x) * smoothstep(-0.25, 0.25, patches.y + 0.5 * broad.z) +
               0.6 * smoothstep(0.25, 0.6, noise(p * 0.9 + 61.0).x + 0.3 * patches.z);
  dirt = min(dirt, 1.0);
  s.albedo = mix(s.albedo, vec3(0.235, 0.175, 0.115) * (1.0 + 0.3 * grain), 0.55 * dirt);
  vec3 slope = flute.yzw * vec3(1.0, 0.1, 1.0) + vec3(0.0, 0.45 * band, 0.0);
  vec4 relief_slope = relief(p, 0.24, 5, 2, footprint);
  slope += mix(0.45, 0.8, smoothstep(0.0, 0.5, patches.z)) * relief_slope.xyz;
  s.normal = bend(n, slope, 0.30 * at.relief);
  float flutes = visible(0.14, footprint), lost = 0.25 * relief_slope.w + 0.5 * (1.0 - flutes * flutes);
  // Water still runs here and there; elsewhere the calcite has dried to a dull crust.
  float runs = smoothstep(0.05, 0.45, noise(run * vec3(0.6, 0.5, 0.6) + 80.0).x + 0.3 * broad.y);
  s.roughness = clamp(mix(1.75, 0.65, runs) * at.roughness * (1.0 + 0.35 * dirt), 0.08, 1.0);
  s.albedo *= mix(1.0, 0.80, runs);
  s.specular = 0.045;
  wetten(s, 0.6 * at.wet);
  s.roughness = roughened(s.roughness, 0.30 * 0.30 * at.relief * at.relief * lost);
  s.translucency = 0.20;
  return s;
}

// Lava as it ran and froze. Walls have a glaze that has dripped, which hot gas has rusted in patches; where it has come off,
// the stone is full of bubbles. Floors are a crust in wrinkles, which has cracked as it shrank.
Surface lava(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.16 + 5.0), patches = noise(p * 0.55 + 40.0), mottle = noise(p * 2.1 + 9.0);
  float grain = fineNoise(p * 14.0, 0.07, footprint) + 0.8 * fineNoise(p * 47.0, 0.021, footprint) +
                0.6 * fineNoise(p * 150.0, 0.0066, footprint);
  float floor_share = smoothstep(0.62, 0.88, n.y + 0.10 * mottle.x);
  vec3 albedo = at.colour * (1.0 + 0.22 * grain + 0.25 * mottle.x + 0.3 * broad.x);

  float rust = smoothstep(0.10, 0.60, broad.z + 0.55 * patches.x + 0.25 * mottle.y + 0.10 * grain) * (1.0 - 0.7 * floor_share);
  albedo = mix(albedo, vec3(0.130, 0.062, 0.041) * (1.0 + 0.35 * grain), 0.52 * rust);
  float glaze = smoothstep(-0.10, 0.30, patches.y + 0.5 * broad.y + 0.25 * mottle.z) * (1.0 - 0.85 * floor_share);
  albedo = mix(albedo, albedo * vec3(0.60, 0.60, 0.64), glaze);
  // Salts that seeping water has left: a thin bloom along cracks and ledges.
  float salt = smoothstep(0.42, 0.75, noise(p * vec3(1.3, 0.6, 1.3) + 71.0).x + 0.35 * patches.z + 0.12 * grain);
  albedo = mix(albedo, vec3(0.30, 0.285, 0.26), 0.30 * salt * (1.0 - glaze));

  float bubbles = smoothstep(0.28, 0.50, noise(p * 33.0).x) * visible(0.03, footprint) * (1.0 - glaze);
  albedo *= 1.0 - 0.4 * bubbles;
  vec3 bent = p + 0.16 * patches.yzw + 0.05 * mottle.yzw;
  float split = floor_share > 0.0 ? cracks(bent, n, 1.1, 0.035, footprint) * smoothstep(-0.35, 0.1, patches.z) : 0.0;
  split *= floor_share;
  albedo *= (1.0 - 0.8 * split) * (1.0 - 0.25 * floor_share);

  // Drips run down walls; wrinkles lie over the glaze.
  vec3 run = vec3(p.x * 7.0, p.y * 1.1, p.z * 7.0) + 0.5 * mottle.yzw;
  vec4 drips = noise(run) * (visible(0.14, footprint) * (1.0 - floor_share));
  vec4 relief_slope = relief(p, 0.40, 7, 1, footprint);
  vec3 slope = relief_slope.xyz * mix(1.0, 0.55, glaze) + drips.yzw * vec3(0.5, 0.1, 0.5);
  slope -= noise(p * 33.0).yzw * (0.6 * bubbles);
  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.34 * at.relief);
  s.roughness = clamp(at.roughness * mix(1.25, 0.50, glaze) * (1.0 + 0.15 * grain), 0.12, 1.0);
  s.specular = mix(0.03, 0.07, glaze);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.10 * at.relief * at.relief * relief_slope.w);
  return s;
}
