// What flows: water, and vapour.

// Still water: what it mirrors is traced; under it lies a bed of silt and stones, which is seen where the ray bends to,
// the paler the shallower it is. at.depth is how deep it lies.
Surface water(Spot at) {
  Surface s = surfaceOf(at);
  vec3 ripple = noise(at.p * vec3(1.3, 0.0, 1.3)).yzw * visible(0.8, at.footprint) +
                0.6 * noise(at.p * vec3(4.1, 0.0, 4.1) + 9.0).yzw * visible(0.25, at.footprint);
  s.normal = bend(at.n, vec3(ripple.x, 0.0, ripple.z), 0.022 * at.relief);
  vec3 down = refract(-at.to_eye, vec3(0.0, 1.0, 0.0), 0.75);
  float way = at.depth / max(-down.y, 0.6);
  // Beds are seen as if 60 cm deep: the depth that rays find is too rough to bend the view by.
  vec2 bed_at = at.p.xz + down.xz * 0.8;
  // Absorption of clear water over limestone: down to the bed, and up to the eye.
  vec3 through = exp(-(at.depth + way) * vec3(0.22, 0.078, 0.074));

  vec4 broad = noise(vec3(bed_at * 0.45, 3.0)), mottle = noise(vec3(bed_at * 2.3, 8.0));
  vec4 fine = noise(vec3(bed_at * 9.0, 1.0));
  vec2 bent = bed_at + 0.05 * mottle.yz + 0.012 * fine.yz;
  Block large = cellAt(bent, 0.55, 0.10, 51), small = cellAt(bent + 3.7, 0.15, 0.04, 53);
  vec3 silt = vec3(0.215, 0.180, 0.128) * (1.0 + 0.22 * broad.x + 0.16 * mottle.x + 0.10 * fine.x);
  // Stones lie here and not there; each is lit from one side, and dark where it meets the silt.
  float many = 0.5 * broad.x + 0.2 * mottle.x;
  float round_small = 1.0 - length(small.within) * (1.0 + 0.5 * fine.w) / (0.03 + 0.045 * small.lot.x);
  float strewn = step(0.42, small.lot.z + many) * smoothstep(0.0, 0.2, round_small) * visible(0.10, at.footprint);
  vec3 pebble = mix(vec3(0.13, 0.11, 0.085), vec3(0.31, 0.28, 0.225), small.lot.y * small.lot.y);
  pebble *= (0.72 + 0.4 * max(round_small, 0.0) + 2.5 * small.within.x) * (1.0 + 0.15 * fine.x);
  vec2 oval = large.within * vec2(1.0 + 0.4 * large.lot.x, 1.2 - 0.3 * large.lot.y);
  float uneven = 1.0 + 0.3 * mottle.w + 0.18 * fine.w;
  float round_large = 1.0 - length(oval) * uneven / (0.09 + 0.18 * large.lot.x);
  float here = step(0.60, large.lot.z + many) * visible(0.30, at.footprint);
  float lies = here * smoothstep(0.0, 0.12, round_large);
  vec3 stone = mix(vec3(0.12, 0.10, 0.08), vec3(0.29, 0.255, 0.20), large.lot.y);
  stone *= (0.68 + 0.45 * max(round_large, 0.0) + 0.8 * large.within.x) * (1.0 + 0.25 * mottle.x + 0.15 * fine.x);
  vec3 bed = mix(silt, pebble, strewn);
  bed *= 1.0 - 0.35 * here * smoothstep(-0.22, 0.0, round_large);
  bed = mix(bed, stone, lies);
  s.albedo = bed * through + 0.6 * at.colour * (1.0 - through.g);
  s.roughness = 0.06;
  s.specular = 0.02;
  return s;
}

Surface vapour(Spot at) {
  // Sizes follow the picture: a cloud's billows repeat at every scale that is seen.
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
