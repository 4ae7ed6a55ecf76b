// Weathering of rock and buildings: traces of rain, dirt and use, in patches and streaks. It depends on the
// surroundings of a point (Traced::lie).

// Masks of patterns that weather in the same way. Plants, metal and glass do not weather.
const uint kRoofs = 1u << kRoofTiles | 1u << kSlates;
const uint kStreets = 1u << kPaving | 1u << kCobbles | 1u << kConcrete | 1u << kAsphalt;
const uint kWeathering = 1u << kRock | kRoofs | kStreets | 1u << kBrick | 1u << kAshlar | 1u << kRubble | 1u << kPlain |
                         1u << kWooden | 1u << kLying | 1u << kBoards;
// True if the mask `patterns` contains a pattern. Constant false, so that code is removed, if the scene contains none
// of these patterns.
bool isOf(uint patterns, uint pattern) { return (kPatterns & patterns) != 0u && (patterns >> pattern & 1u) != 0u; }

// Returns noises with wavelengths of 4.3, 1.2 and 0.34 metres, for patches.
vec3 patches(vec3 p, float footprint) {
  vec3 n;
  for (int i = 0; i < 3; ++i) {
    float size = i == 0 ? 4.3 : i == 1 ? 1.2 : 0.34;
    n[i] = fineNoise(p / size + 13.0 * float(i), 0.5 * size, footprint);
  }
  return n;
}

// Returns streaks of running water, -1..1: some as wide as a hand, others finer, all long in the vertical direction.
float streaks(vec3 p, float footprint) {
  return fineNoise(vec3(p.x * 5.3, p.y * 0.33, p.z * 5.3), 0.15, footprint) +
         0.6 * fineNoise(vec3(p.x * 17.0, p.y * 0.6, p.z * 17.0) + 7.0, 0.05, footprint);
}

// Weathers a wall. flakes: true for plaster, which comes off in sheets.
void weatherWall(inout Surface s, Spot at, vec3 lie, vec3 patchy, float much, bool flakes) {
  float runs = streaks(at.p, at.footprint);
  float tone = 0.15 * patchy.x + 0.08 * patchy.y + 0.04 * patchy.z;
  s.albedo *= 1.0 + much * tone;
  s.albedo *= mix(vec3(1.0), vec3(1.02, 0.98, 0.90), much * smoothstep(-0.4, 0.6, patchy.y - patchy.x));
  // Below a ledge, rain does not wash the wall: soot stays, and is washed off only where water drips from the ledge.
  float dripped = lie.y * (0.10 + 0.90 * smoothstep(0.0, 0.80, runs + 0.15 * patchy.y));
  s.albedo *= mix(vec3(1.0), vec3(0.52, 0.51, 0.49), much * 0.62 * dripped);
  // Splashed soil and rising damp at the foot of the wall, and algae where it never dries.
  float foot = smoothstep(0.12, 0.95, lie.z + 0.22 * patchy.y + 0.16 * patchy.z + 0.10 * runs);
  s.albedo *= mix(vec3(1.0), vec3(0.56, 0.515, 0.455), 0.70 * foot);
  s.albedo = mix(s.albedo, vec3(0.105, 0.110, 0.062), 0.22 * foot * foot);
  if (flakes) {
    // Where damp rises, plaster comes off in sheets, and the grey, coarse coat below it is visible.
    float fine = fineNoise(at.p * 9.0, 0.11, at.footprint) + 0.5 * fineNoise(at.p * 27.0, 0.04, at.footprint);
    float off = smoothstep(0.50, 0.54 + 2.0 * at.footprint, lie.z + 0.50 * patchy.y + 0.32 * patchy.z + 0.14 * fine + 0.3 * patchy.x - 0.25);
    s.albedo = mix(s.albedo, vec3(0.30, 0.265, 0.22) * (1.0 + 0.25 * fine + 0.2 * patchy.z), 0.9 * off);
  }
  float corner = smoothstep(0.24, 0.85, lie.x + 0.12 * patchy.z + 0.08 * patchy.y);
  s.albedo *= mix(vec3(1.0), vec3(0.66, 0.645, 0.62), much * 0.45 * corner);
  s.roughness = clamp(s.roughness * (1.0 + much * (0.12 * patchy.y + 0.1 * dripped)), 0.05, 1.0);
}

void weatherRoof(inout Surface s, Spot at, vec3 lie, vec3 patchy) {
  Chart chart = chartOf(at.p, at.n);
  float run = fineNoise(vec3(chart.at.x * 2.6, chart.at.y * 0.3, 3.0), 0.2, at.footprint);
  s.albedo *= 1.0 + 0.20 * patchy.x + 0.12 * patchy.y + 0.14 * run;
  // Lichen makes bright tiles grey.
  float lichen = smoothstep(-0.2, 0.7, 0.6 * patchy.x + 0.5 * patchy.y + 0.6 * patchy.z);
  s.albedo = mix(s.albedo, vec3(0.21, 0.185, 0.15), 0.38 * lichen);
  float moss = smoothstep(0.25, 0.95, 0.9 * lie.x + 0.55 * patchy.y + 0.35 * patchy.z + 0.3 * patchy.x);
  s.albedo = mix(s.albedo, vec3(0.075, 0.085, 0.040), 0.55 * moss);
  float soot = smoothstep(0.2, 0.9, run - patchy.x + lie.x);
  s.albedo *= mix(vec3(1.0), vec3(0.66, 0.65, 0.64), 0.6 * soot);
}

void weatherStreet(inout Surface s, Spot at, uint pattern, vec3 lie, vec3 patchy) {
  vec2 q = at.p.xz;
  s.albedo *= 1.0 + 0.11 * patchy.x + 0.07 * patchy.y + 0.05 * patchy.z;
  float dirt = smoothstep(0.10, 0.7, lie.x + 0.18 * patchy.y + 0.12 * patchy.z);
  s.albedo = mix(s.albedo, vec3(0.105, 0.088, 0.066), 0.55 * dirt);
  // Stains of oil and other liquids; larger ones are rarer.
  Block spot = cellAt(q + 0.2 * patchy.yz, 2.6, 1.0, 501);
  float wide = 0.10 + 0.45 * spot.lot.y * spot.lot.y;
  float stain = step(spot.lot.x, 0.30) * (1.0 - smoothstep(0.4 * wide, wide, length(spot.within) + 0.12 * patchy.z));
  s.albedo *= 1.0 - 0.42 * stain * (0.6 + 0.4 * spot.lot.z);
  if (pattern != kAsphalt) return;
  // Where pipes lie under the street, the asphalt was replaced, in rectangles with a border of tar.
  Block cut = blockAt(q + 0.03 * patchy.zy, vec2(5.2, 3.4), 0.37, 0.3, 0.05);
  vec2 half_size = vec2(0.9 + 1.1 * cut.lot.y, 0.5 + 0.8 * cut.lot.z);
  vec2 outside = abs(cut.within + vec2(0.3, -0.2)) - half_size;
  float edge = max(outside.x, outside.y), there = step(cut.lot.x, 0.22);
  s.albedo *= 1.0 - 0.26 * there * (1.0 - smoothstep(-0.02, 0.02, edge));
  float seam = 1.0 - smoothstep(0.012, 0.03 + 0.5 * at.footprint, abs(edge));
  s.albedo *= 1.0 - 0.5 * there * seam * visible(0.06, at.footprint);
  // Wheels polish and bleach the asphalt in broad bands that look like lanes.
  s.albedo *= mix(vec3(1.0), vec3(1.22, 1.20, 1.16), smoothstep(-0.1, 0.6, patchy.x) * (1.0 - stain));
}

// Weathers rock in the open: rain washes it grey, algae run down in dark bands, and surfaces that an overhang keeps dry
// stay warm and bright. Soil collects on ledges and, if `green`, plants grow there.
void weatherRock(inout Surface s, Spot at, vec3 lie, vec3 patchy, bool green) {
  float wall = 1.0 - smoothstep(0.45, 0.80, abs(at.n.y)), tone = dot(at.colour, vec3(0.3, 0.5, 0.2));
  float broad = plainNoise(at.p / 17.0 + 5.0), fine = fineNoise(at.p * 7.0, 0.14, at.footprint);
  float dry = max(lie.y, 0.8 * smoothstep(0.05, 0.45, -at.n.y));
  float washed = smoothstep(-0.45, 0.35, broad + 0.45 * patchy.x + 0.25 * patchy.y + 0.10 * fine) * (1.0 - 0.85 * dry);
  s.albedo = mix(s.albedo, 0.62 * (vec3(tone) * vec3(1.0, 0.99, 0.96)) + 0.30 * s.albedo, 0.62 * washed);
  s.albedo *= mix(vec3(1.0), vec3(1.06, 0.96, 0.82), 0.6 * dry);
  // Dark bands begin where water comes over an edge, at different heights, and have ragged borders.
  vec3 q = vec3(at.p.x, 0.055 * at.p.y, at.p.z) + vec3(0.5 * patchy.y, 0.0, 0.5 * patchy.z);
  float run = plainNoise(q / 2.6 + 40.0) + 0.55 * fineNoise(q / 0.75, 0.4, at.footprint) +
              0.30 * fineNoise(q / 0.21, 0.11, at.footprint);
  float band = smoothstep(0.08, 0.50, run + 0.45 * broad - 0.5 * dry) * wall;
  s.albedo *= mix(vec3(1.0), vec3(0.34, 0.34, 0.35), 0.72 * band);
  if (!green) return;
  float ledge = smoothstep(0.55, 0.85, at.n.y + 0.20 * patchy.z + 0.10 * fine);
  float grown = ledge * smoothstep(-0.10, 0.30, 0.7 * patchy.x + 0.5 * patchy.y + 0.4 * patchy.z + 0.25 * fine + lie.x - 0.25);
  vec3 sward = mix(vec3(0.110, 0.125, 0.055), vec3(0.205, 0.180, 0.095), smoothstep(-0.3, 0.4, patchy.y - patchy.z));
  s.albedo = mix(s.albedo, sward * (1.0 + 0.35 * fine), 0.85 * grown);
}

// Weathers paint on which people walk or drive: it has worn off in flakes, and the rest is scuffed.
void weatherPaint(inout Surface s, Spot at, vec3 patchy) {
  float fine = fineNoise(at.p * 9.0, 0.11, at.footprint) + 0.7 * fineNoise(at.p * 34.0, 0.03, at.footprint);
  float off = smoothstep(0.12, 0.62, 0.55 * patchy.y + 0.65 * patchy.z + 0.65 * fine + 0.25 * patchy.x);
  s.albedo *= (1.0 + 0.08 * patchy.y + 0.07 * fine) * vec3(0.86, 0.855, 0.84);
  s.albedo = mix(s.albedo, vec3(0.125, 0.122, 0.118) * (1.0 + 0.3 * fine), 0.62 * off);
}

// Weathers a surface according to its pattern. lie: Traced::lie at the point; green: true if plants grow on the land
// around.
void weather(inout Surface s, Spot at, uint pattern, vec3 lie, bool green) {
  if (!isOf(kWeathering, pattern) || at.relief <= 0.0) return;
  if (isOf(1u << kRock, pattern)) {
    weatherRock(s, at, lie, patches(at.p, at.footprint), green);
    return;
  }
  float wall = 1.0 - smoothstep(0.45, 0.75, abs(at.n.y));
  bool roof = isOf(kRoofs, pattern), street = isOf(kStreets, pattern) && at.n.y > 0.75;
  bool paint = isOf(1u << kPlain, pattern) && at.n.y > 0.9 && at.relief < 0.5;
  if (!roof && !street && !paint && wall <= 0.0) return;
  vec3 patchy = patches(at.p, at.footprint);
  if (roof) {
    weatherRoof(s, at, lie, patchy);
  } else if (paint) {
    weatherPaint(s, at, patchy);
  } else if (street) {
    weatherStreet(s, at, pattern, lie, patchy);
  } else {
    // Painted surfaces have a small relief. They are washed more often than others, so they weather less.
    Surface worn = s;
    bool flakes = isOf(1u << kPlain, pattern) && at.relief >= 0.9 && at.relief <= 1.1;
    weatherWall(worn, at, lie, patchy, clamp(0.2 + 0.8 * at.relief, 0.0, 1.0), flakes);
    s.albedo = mix(s.albedo, worn.albedo, wall);
    s.roughness = mix(s.roughness, worn.roughness, wall);
  }
}
