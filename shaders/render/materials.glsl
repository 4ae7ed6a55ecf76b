// What each pattern looks like at a point: colour, roughness, the normal after relief.

struct Surface {
  vec3 albedo;
  vec3 normal;
  float roughness;
  float specular;      // reflectance at normal incidence
  float translucency;  // how far light wraps around, 0..1
};

// Weight of detail of a size where one sample covers `footprint` metres: gone before it would flicker.
float visible(float size, float footprint) { return clamp(size / (2.0 * footprint) - 1.0, 0.0, 1.0); }

// Slope of a relief made of octaves from `period` metres down; ridged octaves have sharp crests, as broken rock has.
// w: the variance of the slopes that are too fine to be seen.
vec4 relief(vec3 p, float period, int octaves, int ridged, float footprint) {
  const float kVariance = 0.5;  // of the slopes of one octave, along the surface
  vec4 slope = vec4(0.0);
  float strength = 1.0;
  for (int i = 0; i < octaves; ++i) {
    float w = visible(period, footprint);
    if (w > 0.0) {
      vec4 n = noise(p / period + float(i) * 17.3);
      slope.xyz += n.yzw * (w * strength * (i < ridged ? -n.x * inversesqrt(n.x * n.x + 0.012) : 1.0));
    }
    slope.w += kVariance * strength * strength * (1.0 - w * w);
    period *= 0.47;
    strength *= 0.84;
  }
  return slope;
}

// Roughness with relief that is too fine to be seen (after Olano and Baker, "LEAN mapping"): it spreads a highlight as
// roughness does. Without it whatever lies far away would be a mirror.
float roughened(float roughness, float variance) {
  float a = roughness * roughness;
  return sqrt(sqrt(min(1.0, a * a + 2.0 * variance)));
}

// A relief's normal at a place that is seen: what faces away from the eye is hidden behind what does not.
vec3 turnedTo(vec3 to_eye, vec3 normal, vec3 n) {
  float least = 0.3 * max(dot(n, to_eye), 0.0), facing = dot(normal, to_eye);
  return facing >= least ? normal : normalize(normal + to_eye * (least - facing));
}

vec3 bend(vec3 normal, vec3 slope, float strength) {
  vec3 along = slope - normal * dot(normal, slope);
  // A slope beyond about 60 degrees would turn its back to every lamp and read as a black speck.
  along *= strength;
  return normalize(normal - along * inversesqrt(1.0 + 0.35 * dot(along, along)));
}

vec3 planeWeights(vec3 n) {
  vec3 w = pow(abs(n), vec3(4.0));
  return w / (w.x + w.y + w.z);
}

// Depth of cracks, 0..1, mapped along the three axes and blended by the normal.
float cracks(vec3 p, vec3 n, float size, float width, float footprint) {
  float w = visible(width * 3.0, footprint);
  if (w <= 0.0) return 0.0;
  vec3 weights = planeWeights(n);
  vec3 q = p / size;
  float depth = 0.0;
  if (weights.x > 0.1) depth += weights.x * (1.0 - smoothstep(0.0, width / size, borderDistance(q.zy, 11)));
  if (weights.y > 0.1) depth += weights.y * (1.0 - smoothstep(0.0, width / size, borderDistance(q.xz, 23)));
  if (weights.z > 0.1) depth += weights.z * (1.0 - smoothstep(0.0, width / size, borderDistance(q.xy, 37)));
  return depth * w;
}

Surface rock(vec3 p, vec3 n, vec3 colour, float roughness, float strength, float footprint) {
  vec4 broad = noise(p * 0.11 + 5.0);
  vec4 patches = noise(p * 0.43 + 40.0);
  vec4 mottle = noise(p * 1.7 + 9.0);
  vec3 warped = p + 0.55 * vec3(patches.y, mottle.x, patches.z);

  // Beds lie nearly level and are bent gently; some are pale, some carry iron.
  float height = p.y + 1.6 * broad.x + 0.30 * patches.x + 0.05 * mottle.x;
  float bed = noise(vec3(height * 0.55, 3.0, broad.y)).x;
  float lamina = noise(vec3(0.5, height * 3.4, patches.y * 0.3)).x * visible(0.3, footprint);
  float grain = noise(p * 11.0).x * visible(0.09, footprint) + 0.7 * noise(p * 37.0).x * visible(0.027, footprint);

  vec3 pale = mix(colour, vec3(dot(colour, vec3(0.33))), 0.25) * 1.28;
  vec3 iron = colour * vec3(0.86, 0.58, 0.38);
  vec3 albedo = mix(colour, pale, smoothstep(-0.05, 0.45, bed));
  albedo = mix(albedo, iron, 0.75 * smoothstep(0.05, 0.55, -bed + 0.35 * patches.x));
  albedo *= 1.0 + 0.16 * lamina + 0.20 * grain + 0.16 * mottle.x;

  float wall = 1.0 - smoothstep(0.55, 0.9, abs(n.y));
  // Water runs down walls: dark manganese films, and pale sinter where it has dried.
  vec3 run = vec3(warped.x * 1.5, warped.y * 0.16, warped.z * 1.5);
  float streak = noise(run + 70.0).x + 0.5 * noise(run * vec3(2.7, 1.7, 2.7) + 31.0).x;
  float film = wall * smoothstep(0.30, 0.75, streak);
  float sinter = wall * smoothstep(0.25, 0.70, -streak + 0.35 * broad.x);
  albedo = mix(albedo, albedo * vec3(0.42, 0.40, 0.40), 0.8 * film);
  albedo = mix(albedo, vec3(0.62, 0.55, 0.44) * (1.0 + 0.10 * grain), 0.55 * sinter);

  float split = cracks(p + 0.25 * patches.yzw, n, 1.9, 0.035, footprint) * smoothstep(-0.1, 0.35, patches.x + 0.2);
  albedo *= 1.0 - 0.55 * split;

  // Silt and clay settle on whatever is flat enough.
  float floor_cover = smoothstep(0.62, 0.86, n.y + 0.22 * patches.x + 0.08 * mottle.x);
  vec3 silt = mix(vec3(0.26, 0.185, 0.12), colour * 0.7, 0.35) * (1.0 + 0.22 * grain + 0.25 * mottle.x);
  albedo = mix(albedo, silt, 0.85 * floor_cover);

  vec4 relief_slope = relief(p, 1.35, 6, 2, footprint);
  vec3 slope = relief_slope.xyz;
  // Beds stand out as ledges along walls.
  slope.y += wall * 0.55 * lamina;
  slope *= mix(1.0, 0.55, floor_cover);

  float damp = smoothstep(0.05, 0.5, broad.x * 0.7 + 0.4 * film + 0.25 * floor_cover - 0.1);
  Surface s;
  s.albedo = albedo * mix(1.0, 0.80, damp);
  s.normal = bend(n, slope, 0.40 * strength);
  s.roughness = clamp(mix(roughness, roughness * 0.48, max(damp, 0.6 * sinter)), 0.08, 1.0);
  s.roughness = roughened(s.roughness, 0.16 * strength * strength * relief_slope.w);
  s.specular = mix(0.03, 0.045, damp);
  s.translucency = 0.0;
  return s;
}

Surface flowstone(vec3 p, vec3 n, vec3 colour, float roughness, float strength, float footprint) {
  vec4 broad = noise(p * 0.5 + 12.0);
  // Flutes run with the water; rims cross them where each film has dried.
  vec3 run = vec3(p.x * 7.0, p.y * 0.45, p.z * 7.0) + 0.6 * broad.yzw;
  vec4 flute = noise(run) * visible(0.14, footprint);
  float rim_height = p.y * 9.0 + 1.5 * broad.x + 0.4 * flute.x;
  float rim = sin(rim_height) * visible(0.35, footprint);
  float grain = noise(p * 29.0).x * visible(0.035, footprint);
  vec3 honey = colour * vec3(0.92, 0.70, 0.46);
  Surface s;
  s.albedo = mix(colour, honey, smoothstep(-0.15, 0.6, broad.x + 0.12 * rim));
  s.albedo *= 1.0 + 0.10 * flute.x + 0.05 * rim + 0.06 * grain;
  vec3 slope = flute.yzw * vec3(1.0, 0.1, 1.0) + vec3(0.0, 0.35 * cos(rim_height) * visible(0.35, footprint), 0.0);
  vec4 relief_slope = relief(p, 0.21, 3, 0, footprint);
  slope += 0.4 * relief_slope.xyz;
  s.normal = bend(n, slope, 0.34 * strength);
  s.roughness = clamp(roughness * (1.0 + 0.35 * broad.x), 0.08, 1.0);
  float flutes = visible(0.14, footprint), lost = 0.16 * relief_slope.w + 0.5 * (1.0 - flutes * flutes);
  s.roughness = roughened(s.roughness, 0.34 * 0.34 * strength * strength * lost);
  s.specular = 0.05;
  s.translucency = 0.35;
  return s;
}

Surface brickwork(vec3 p, vec3 n, vec3 colour, float roughness, float strength, float footprint) {
  const vec2 kBrick = vec2(0.25, 0.083);
  vec3 a = abs(n);
  vec2 uv = a.y > max(a.x, a.z) ? p.xz : (a.x > a.z ? p.zy : p.xy);
  vec2 q = uv / kBrick;
  float course = floor(q.y);
  q.x += 0.5 * mod(course, 2.0);
  vec2 cell = floor(q), f = q - cell;
  vec2 edge = min(f, 1.0 - f) * kBrick;
  float joint = 1.0 - smoothstep(0.004, 0.009, min(edge.x, edge.y));
  float w = visible(0.06, footprint);
  vec3 tint = random3(ivec3(ivec2(cell), 5));
  float grain = noise(p * 23.0).x * visible(0.04, footprint);
  vec3 fired = colour * (0.75 + 0.5 * tint.x) * (1.0 + 0.15 * grain);
  Surface s;
  s.albedo = mix(mix(fired, vec3(0.50, 0.47, 0.42) * (1.0 + 0.1 * grain), joint), mix(colour, vec3(0.45), 0.15), 1.0 - w);
  s.albedo *= 1.0 + 0.12 * noise(p * 0.7).x;
  vec4 relief_slope = relief(p, 0.05, 2, 0, footprint);
  s.normal = bend(n, relief_slope.xyz * (1.0 + joint), 0.25 * strength);
  s.roughness = roughened(roughness, 0.0625 * strength * strength * relief_slope.w);
  s.specular = 0.03;
  s.translucency = 0.0;
  return s;
}

Surface plain(vec3 p, vec3 n, vec3 colour, float roughness, float strength, float footprint) {
  float broad = noise(p * 0.8).x, grain = noise(p * 19.0).x * visible(0.05, footprint);
  Surface s;
  s.albedo = colour * (1.0 + strength * (0.10 * broad + 0.10 * grain));
  vec4 relief_slope = relief(p, 0.6, 4, 0, footprint);
  s.normal = bend(n, relief_slope.xyz, 0.16 * strength);
  s.roughness = roughened(roughness, 0.0256 * strength * strength * relief_slope.w);
  s.specular = 0.04;
  s.translucency = 0.0;
  return s;
}

Surface vapour(vec3 p, vec3 n, vec3 colour, float strength, float footprint) {
  // Sizes follow the picture: a cloud's billows repeat at every scale that is seen.
  float size = max(footprint * 90.0, 0.5);
  float level = exp2(floor(log2(size)));
  Surface s;
  s.albedo = colour;
  vec3 slope = mix(relief(p, level, 4, 0, footprint).xyz, relief(p, 2.0 * level, 4, 0, footprint).xyz, size / level - 1.0);
  s.normal = bend(n, slope, 0.30 * strength);
  s.roughness = 1.0;
  s.specular = 0.0;
  s.translucency = 1.0;
  return s;
}
