// Fluids: water and vapour.

// Still water. Its reflections are ray-traced. Through it, a bed of silt and stones is visible along the refracted ray;
// the shallower the water, the paler the bed. at.depth: depth of the water in metres.
Surface water(Spot at) {
  Surface s = surfaceOf(at);
  vec3 ripple = noise(at.p * vec3(1.3, 0.0, 1.3)).yzw * visible(0.8, at.footprint) +
                0.6 * noise(at.p * vec3(4.1, 0.0, 4.1) + 9.0).yzw * visible(0.25, at.footprint);
  s.normal = bend(at.n, vec3(ripple.x, 0.0, ripple.z), (at.sheltered ? 0.022 : 0.05) * at.relief);
  vec3 down = refract(-at.to_eye, vec3(0.0, 1.0, 0.0), 0.75);
  float way = at.depth / max(-down.y, 0.6);
  // The depth that the ray tracer finds is too coarse for refraction, so the place on the bed is computed as if the
  // water were 60 cm deep.
  vec2 bed_at = at.p.xz + down.xz * 0.8;
  // Absorption along the way down to the bed and up to the eye: clear water over limestone in caves; in open water,
  // algae absorb more.
  vec3 through = exp(-(at.depth + way) * (at.sheltered ? vec3(0.36, 0.085, 0.075) : vec3(0.46, 0.23, 0.27)));

  vec4 broad = noise(vec3(bed_at * 0.45, 3.0)), mottle = noise(vec3(bed_at * 2.3, 8.0));
  vec4 fine = noise(vec3(bed_at * 9.0, 1.0));
  float grain = fineNoise(vec3(bed_at * 37.0, 2.0), 0.03, at.footprint);
  vec3 silt = vec3(0.235, 0.212, 0.168) * (1.0 + 0.22 * broad.x + 0.16 * mottle.x + 0.10 * fine.x + 0.08 * grain);
  vec3 bed = silt;
  // The stones on the bed lie in patches. Large stones lie on top of small ones. All stones shade the ground around
  // them.
  vec2 bent = bed_at + 0.055 * mottle.yz + 0.016 * fine.yz + 0.003 * noise(vec3(bed_at * 27.0, 6.0)).yz;
  float many = 0.5 * broad.x + 0.2 * mottle.x, dark = 0.75 * length(at.light);
  vec3 to_light = at.light * vec3(0.75, 1.0, 0.75);
  const float kLarge = 0.36, kSmall = 0.10;
  float far = visible(0.8 * kSmall, at.footprint);
  Strewn large = strewnAt(bent, down, kLarge, 0.26 + many, 51), small = large;
  vec2 open = lightAmong(large, to_light, kLarge, 0.26 + many, 51), among = vec2(1.0);
  if (large.there == 0.0 && far > 0.0) {
    small = strewnAt(bent, down, kSmall, 0.62 + many, 53);
    among = mix(vec2(1.0), lightAmong(small, to_light, kSmall, 0.62 + many, 53), far);
  }
  if (small.there > 0.0) {
    vec3 lot = small.lot;
    vec3 stone = mix(vec3(0.150, 0.130, 0.102), vec3(0.29, 0.262, 0.210), lot.y) * (1.0 + 0.22 * fine.x);
    stone *= 1.0 + 0.30 * grain + 0.15 * mottle.x;
    // Silt covers the tops of stones, and the ground around them.
    float settled = smoothstep(0.55, 0.98, small.normal.y + 0.25 * fine.x) * (0.35 + 0.4 * lot.x);
    float sunk = 1.0 - smoothstep(0.0, 0.16, small.at.y / (large.there > 0.0 ? kLarge : kSmall) + 0.03 * fine.y);
    stone = mix(stone, silt, max(settled, 0.7 * sunk));
    bed = mix(bed, stone, large.there > 0.0 ? visible(0.5 * kLarge, at.footprint) : far);
  }
  // Shade the bed here, by the normals of its stones, because s.normal is the normal of the water's surface.
  vec3 facing = normalize(small.normal + 0.22 * vec3(fine.y, 0.0, fine.z) + 0.10 * vec3(mottle.y, 0.0, mottle.z));
  vec3 from = normalize(to_light + vec3(0.0, 1e-3, 0.0));
  float turned = dot(facing, from) / max(from.y, 0.35);
  vec2 all = open * among;
  bed *= mix(all.y * (0.72 + 0.28 * facing.y), all.x * clamp(turned, 0.0, 1.6), dark);
  s.albedo = bed * through + 0.6 * at.colour * (1.0 - through.g);
  s.roughness = 0.06;
  s.specular = 0.02;
  return s;
}

Surface vapour(Spot at) {
  // The size of the pattern depends on the footprint of a sample, because billows of vapour repeat at every scale.
  float size = max(at.footprint * 90.0, 0.5);
  float level = exp2(floor(log2(size)));
  Surface s = surfaceOf(at);
  s.albedo = at.colour;
  vec3 fine = relief(at.p, level, 4, 0, at.footprint).xyz, wide = relief(at.p, 2.0 * level, 4, 0, at.footprint).xyz;
  vec3 slope = mix(fine, wide, size / level - 1.0);
  s.normal = bend(at.n, slope, 0.15 * at.relief);
  s.roughness = 1.0;
  s.specular = 0.0;
  s.translucency = 1.0;
  return s;
}
