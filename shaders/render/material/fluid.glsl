// What flows: water, and vapour.

// Still water: what it mirrors is traced; under it lies a bed, the paler the shallower it is. at.depth is how deep it lies.
Surface water(Spot at) {
  Surface s = surfaceOf(at);
  vec3 ripple = noise(at.p * vec3(1.3, 0.0, 1.3)).yzw * visible(0.8, at.footprint) +
                0.6 * noise(at.p * vec3(4.1, 0.0, 4.1) + 9.0).yzw * visible(0.25, at.footprint);
  s.normal = bend(at.n, vec3(ripple.x, 0.0, ripple.z), 0.035 * at.relief);
  // Absorption of clear water over limestone, twice the way: down and up.
  vec3 through = exp(-2.0 * at.depth * vec3(0.30, 0.115, 0.125));
  float bed_grain = noise(at.p * 2.7).x + 0.5 * noise(at.p * 9.0).x;
  vec3 bed = vec3(0.26, 0.225, 0.165) * (1.0 + 0.25 * bed_grain);
  s.albedo = bed * through + at.colour * (1.0 - through.g);
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
  vec3 slope = mix(relief(at.p, level, 4, 0, at.footprint).xyz, relief(at.p, 2.0 * level, 4, 0, at.footprint).xyz, size / level - 1.0);
  s.normal = bend(at.n, slope, 0.15 * at.relief);
  s.roughness = 1.0;
  s.specular = 0.0;
  s.translucency = 1.0;
  return s;
}
