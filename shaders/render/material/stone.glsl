// Stone as it grew and broke: beds, stains, cracks, flowstone.

Surface rock(Spot at) {
  vec3 p = at.p, n = at.n;
  float footprint = at.footprint;
  vec4 broad = noise(p * 0.11 + 5.0);
  vec4 patches = noise(p * 0.43 + 40.0);
  vec4 mottle = noise(p * 1.7 + 9.0);
  float grain = noise(p * 11.0).x * visible(0.09, footprint) + 0.7 * noise(p * 37.0).x * visible(0.027, footprint) +
                0.6 * noise(p * 131.0).x * visible(0.0076, footprint);

  // Beds lie nearly level and are bent gently; some are pale, some carry iron.
  float height = p.y + 1.6 * broad.x + 0.30 * patches.x + 0.05 * mottle.x;
  float bed = noise(vec3(height * 0.55, 3.0, broad.y)).x;
  float lamina = noise(vec3(0.5, height * 3.4, patches.y * 0.3)).x * visible(0.3, footprint);
  float wall = 1.0 - smoothstep(0.55, 0.9, abs(n.y));

  vec3 pale = mix(at.colour, vec3(dot(at.colour, vec3(0.33))), 0.25) * 1.22;
  vec3 iron = at.colour * vec3(0.92, 0.70, 0.50);
  vec3 albedo = mix(at.colour, pale, smoothstep(-0.05, 0.55, bed));
  albedo = mix(albedo, iron, 0.55 * smoothstep(0.05, 0.65, -bed + 0.35 * patches.x));
  albedo *= 1.0 + 0.13 * lamina * wall + 0.16 * grain + 0.12 * mottle.x;

  // Water runs down walls: thin dark films, and pale sinter where it has dried.
  vec3 run = vec3(p.x * 1.1, p.y * 0.11, p.z * 1.1) + 0.5 * vec3(patches.y, 0.0, mottle.x);
  float streak = noise(run + 70.0).x + 0.5 * noise(run * vec3(2.7, 1.7, 2.7) + 31.0).x;
  float film = wall * smoothstep(0.35, 0.85, streak);
  float sinter = wall * smoothstep(0.35, 0.85, -streak + 0.35 * broad.x);
  albedo = mix(albedo, albedo * vec3(0.60, 0.57, 0.55), 0.7 * film);
  albedo = mix(albedo, vec3(0.60, 0.54, 0.45) * (1.0 + 0.10 * grain), 0.35 * sinter);

  float split = cracks(p + 0.25 * patches.yzw, n, 1.9, 0.03, footprint) * smoothstep(-0.1, 0.35, patches.x + 0.2);
  albedo *= 1.0 - 0.5 * split;

  // Silt and clay settle on whatever is flat enough.
  float floor_cover = smoothstep(0.70, 0.92, n.y + 0.18 * patches.x + 0.08 * mottle.x);
  vec3 silt = mix(vec3(0.27, 0.20, 0.135), at.colour * 0.7, 0.45) * (1.0 + 0.22 * grain + 0.2 * mottle.x);
  albedo = mix(albedo, silt, 0.7 * floor_cover);

  // Geometry has what is larger than a step; relief begins where that ends.
  vec4 relief_slope = relief(p, 0.62, 7, 3, footprint);
  vec3 slope = relief_slope.xyz;
  slope.y += wall * 0.4 * lamina;
  slope *= mix(1.0, 0.55, floor_cover);

  Surface s = surfaceOf(at);
  s.albedo = albedo;
  s.normal = bend(n, slope, 0.34 * at.relief);
  s.roughness = clamp(mix(at.roughness, at.roughness * 0.55, max(0.8 * film, 0.5 * sinter)), 0.08, 1.0);
  s.specular = mix(0.03, 0.045, film);
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
  vec4 broad = noise(p * 0.5 + 12.0);
  // Flutes run with the water; rims cross them where each film has dried.
  vec3 run = vec3(p.x * 7.0, p.y * 0.45, p.z * 7.0) + 0.6 * broad.yzw;
  float wall = 1.0 - smoothstep(0.6, 0.95, abs(n.y));
  vec4 flute = noise(run) * visible(0.14, footprint) * wall;
  float rim_height = p.y * 9.0 + 1.5 * broad.x + 0.4 * flute.x;
  float rim = sin(rim_height) * visible(0.35, footprint) * wall;
  float grain = noise(p * 29.0).x * visible(0.035, footprint) + 0.7 * noise(p * 97.0).x * visible(0.01, footprint);
  vec3 honey = at.colour * vec3(0.92, 0.70, 0.46);
  Surface s = surfaceOf(at);
  s.albedo = mix(at.colour, honey, smoothstep(-0.15, 0.7, broad.x + 0.12 * rim));
  s.albedo *= 1.0 + 0.10 * flute.x + 0.05 * rim + 0.06 * grain;
  vec3 slope = flute.yzw * vec3(1.0, 0.1, 1.0) + vec3(0.0, 0.30 * cos(rim_height) * visible(0.35, footprint) * wall, 0.0);
  vec4 relief_slope = relief(p, 0.21, 5, 0, footprint);
  slope += 0.4 * relief_slope.xyz;
  s.normal = bend(n, slope, 0.30 * at.relief);
  float flutes = visible(0.14, footprint), lost = 0.16 * relief_slope.w + 0.5 * (1.0 - flutes * flutes);
  s.roughness = clamp(at.roughness * (1.0 + 0.35 * broad.x), 0.08, 1.0);
  s.specular = 0.05;
  wetten(s, 0.6 * at.wet);
  s.roughness = roughened(s.roughness, 0.30 * 0.30 * at.relief * at.relief * lost);
  s.translucency = 0.35;
  return s;
}
