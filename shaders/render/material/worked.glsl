// What is spread, poured, sawn or rolled: even by nature, never rocky.

// Plaster, paint, clay: colour with a fine grain, broad stains, and streaks where rain runs.
Surface plain(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 0.45).x + 0.5 * noise(at.p * 1.9 + 7.0).x;
  float grain = fineNoise(at.p * 45.0, 0.022, at.footprint) + fineNoise(at.p * 160.0, 0.006, at.footprint);
  s.albedo = at.colour * (1.0 + at.relief * (0.07 * broad + 0.05 * grain));
  s.albedo *= 1.0 - 0.16 * at.relief * weathered(at.p, at.n);
  vec4 relief_slope = relief(at.p, 0.05, 4, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.05 * at.relief);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.0025 * at.relief * at.relief * relief_slope.w);
  return s;
}

// Concrete from forms: panels, holes of their ties, pores, stains.
Surface concrete(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  Block b = blockAt(chart.at, vec2(2.4, 1.2), 0.0, 0.0, 0.01);
  Surface s = plain(at);
  float seam = (1.0 - smoothstep(0.002, 0.006, b.edge)) * visible(0.02, at.footprint);
  vec2 tie = abs(b.within) - vec2(0.8, 0.3);
  float hole = (1.0 - smoothstep(0.010, 0.014, length(tie))) * visible(0.03, at.footprint);
  float pores = smoothstep(0.45, 0.6, noise(at.p * 60.0).x) * visible(0.016, at.footprint);
  s.albedo *= (1.0 + 0.08 * (b.lot.x - 0.5)) * (1.0 - 0.35 * seam - 0.6 * hole - 0.25 * pores);
  return s;
}

// Wood along an axis of length 1: bands of grain, checks where it has dried, knots, and dents of the tool that has shaped
// it. lot: random numbers of its own, so that one board differs from the next.
Surface grained(Spot at, vec3 axis, vec3 lot) {
  float along = dot(at.p, axis);
  vec3 across = at.p - along * axis;
  // Fibres bend around knots.
  vec4 knots = noise(across * 4.2 + axis * (along * 1.9 + 7.0 * lot.z) + 3.0);
  float knot = smoothstep(0.50, 0.66, knots.x) * visible(0.10, at.footprint);
  vec4 swing = noise(at.p * 1.3 + 5.0);
  vec3 fibre = across * 16.0 + axis * (along * 0.9 + 9.0 * lot.x) + 0.9 * swing.x + 1.6 * knot * knots.yzw;
  vec4 ring = noise(fibre) * visible(0.05, at.footprint), hair = noise(fibre * vec3(3.7)) * visible(0.016, at.footprint);
  float fine = fineNoise(fibre * 9.0 - axis * (along * 3.0), 0.008, at.footprint);
  // Checks run along the grain, open in the middle and closed at both ends.
  vec4 split = noise(across * 9.0 + axis * (along * 0.55 + 5.0 * lot.y) + 0.35 * swing.y + 21.0);
  float dry = smoothstep(0.0, 0.35, noise(across * 3.0 + axis * along * 1.3 + 50.0).x);
  float check = (1.0 - smoothstep(0.015, 0.07, abs(split.x))) * dry * visible(0.016, at.footprint);
  Surface s = surfaceOf(at);
  vec3 grey = vec3(dot(at.colour, vec3(0.4)));
  s.albedo = mix(at.colour, grey, 0.2 + 0.5 * smoothstep(-0.1, 0.6, noise(at.p * 0.8).x + 0.4 * noise(at.p * 3.7).x));
  s.albedo *= 1.0 - 0.30 * smoothstep(0.1, 0.7, noise(at.p * 1.9 + 4.0).x + 0.4 * noise(at.p * 11.0).x);
  s.albedo *= (1.0 + 0.30 * (lot.y - 0.5)) * (1.0 + 0.26 * ring.x + 0.16 * hair.x + 0.14 * fine);
  s.albedo *= (1.0 - 0.6 * check) * (1.0 - 0.55 * knot);
  vec3 slope = 0.5 * ring.yzw + 0.35 * hair.yzw - sign(split.x) * split.yzw * (1.2 * check);
  slope += 0.5 * noise(at.p * 7.0 + 17.0).yzw * visible(0.14, at.footprint) + 0.8 * knots.yzw * knot;
  s.normal = bend(at.n, slope, 0.22 * at.relief);
  s.roughness = clamp(at.roughness * (1.0 + 0.2 * ring.x), 0.05, 1.0);
  wetten(s, at.wet);
  return s;
}

// Posts, and all that is of one piece. The grain runs up walls and along floors.
Surface wooden(Spot at) {
  return grained(at, length(at.n.xz) < 0.28 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0), vec3(0.5));
}

// Beams, planks and logs that lie: across the way up their sides. In steps, or places far from the origin would waver.
Surface lying(Spot at) {
  const float kStep = 3.14159265 / 12.0;
  float turn = length(at.n.xz) < 0.06 ? 0.0 : floor(atan(at.n.x, -at.n.z) / kStep + 0.5) * kStep;
  return grained(at, vec3(cos(turn), 0.0, sin(turn)), vec3(0.5));
}

// Boards side by side.
Surface boarded(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  float board = chart.at.x / 0.14, edge = 0.14 * min(fract(board), 1.0 - fract(board));
  Surface s = grained(at, chart.up, random3(ivec3(int(floor(board)), 41, 2)));
  s.albedo *= 1.0 - 0.6 * (1.0 - smoothstep(0.002, 0.006, edge)) * visible(0.02, at.footprint);
  return s;
}

// Metal that is handled: dull, with rust where the relief says that it is neglected.
Surface metallic(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 1.1).x, fine = fineNoise(at.p * 23.0, 0.04, at.footprint);
  float stain = smoothstep(-0.05, 0.55, noise(at.p * 2.3 + 8.0).x + 0.45 * noise(at.p * 9.0).x + 0.25 * fine);
  stain = max(stain, 0.7 * weathered(at.p, at.n)) * at.relief;
  s.albedo = at.colour * (1.0 + 0.10 * broad + 0.06 * fine);
  s.albedo = mix(s.albedo, vec3(0.17, 0.085, 0.045) * (1.0 + 0.4 * fine), 0.75 * stain);
  vec4 relief_slope = relief(at.p, 0.12, 4, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.05 * at.relief);
  s.roughness = clamp(mix(at.roughness * (1.0 + 0.3 * broad), 0.9, stain), 0.15, 1.0);
  s.specular = mix(0.18, 0.03, stain);
  return s;
}

// Tar with chips of stone, which wheels have laid bare in places; it has sunk, cracked and been sealed again.
Surface asphalt(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 0.35).x + 0.4 * noise(at.p * 1.6).x;
  float mottle = fineNoise(at.p * 6.0, 0.16, at.footprint), clots = fineNoise(at.p * 25.0, 0.04, at.footprint);
  float chips = fineNoise(at.p * 120.0, 0.009, at.footprint), dust = fineNoise(at.p * 64.0, 0.016, at.footprint);
  // Chips stand pale out of the tar, the more the more it is worn.
  float bare = smoothstep(0.05, 0.40, chips + 0.35 * dust + 0.15 * clots + 0.12 * broad);
  s.albedo = at.colour * (1.0 + 0.16 * broad + 0.13 * mottle + 0.20 * clots + 0.22 * dust) * (1.0 - 0.2 * max(-chips, 0.0));
  s.albedo = mix(s.albedo, vec3(0.20, 0.195, 0.185) * (1.0 + 0.5 * dust), 0.55 * bare);
  vec3 bent = at.p + 0.3 * noise(at.p * 0.7).yzw + 0.03 * noise(at.p * 5.0).yzw;
  float old = smoothstep(0.0, 0.4, broad);
  float split = cracks(bent, at.n, 3.1, 0.012, at.footprint) * old;
  s.albedo *= 1.0 - 0.60 * split;
  // Most of the long cracks have been sealed with a band of fresh tar.
  float band = cracks(0.7 * at.p + 0.2 * noise(at.p * 0.45).yzw + 7.0, at.n, 4.7, 0.035, at.footprint);
  float sealed = smoothstep(0.25, 0.45, band) * smoothstep(-0.05, 0.15, noise(at.p * 0.21 + 9.0).x);
  s.albedo = mix(s.albedo, vec3(0.028, 0.028, 0.030), 0.75 * sealed);
  s.roughness = mix(s.roughness, 0.55, sealed);
  vec4 relief_slope = relief(at.p, 0.035, 4, 0, at.footprint);
  s.normal = bend(at.n, relief_slope.xyz, 0.13 * at.relief * (1.0 - 0.8 * sealed));
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.016 * relief_slope.w);
  return s;
}

// The colour of glass in the table of materials (runtime/materials/material.cpp).
const vec3 kClearGlass = vec3(0.22, 0.30, 0.33);

// A pane, and behind it a room: floor, ceiling, back wall, curtains, drawn without their shapes being there (van Dongen,
// "Interior mapping", 2008). What is tinted, as a car's panes are, hides what is behind it.
Surface glazed(Spot at) {
  Surface s = surfaceOf(at);
  s.roughness = 0.04;
  s.specular = 0.06;
  s.albedo = 0.4 * at.colour;
  if (distance(at.colour, kClearGlass) > 0.04) return s;
  s.albedo = vec3(0.0);
  const vec3 kRoom = vec3(2.3, 3.0, 4.0);
  Chart chart = chartOf(at.p, at.n);
  vec2 q = chart.at / kRoom.xy;
  ivec2 room = ivec2(floor(q));
  vec3 lot = random3(ivec3(room, 77));
  vec3 way = -vec3(dot(at.to_eye, chart.along), dot(at.to_eye, chart.up), dot(at.to_eye, at.n));
  way.z = max(-way.z, 0.05);
  vec2 from = (q - floor(q)) * kRoom.xy;
  vec3 walls = vec3(way.x > 0.0 ? kRoom.x - from.x : from.x, way.y > 0.0 ? kRoom.y - from.y : from.y, kRoom.z);
  vec3 t = walls / max(abs(vec3(way.xy, way.z)), vec3(1e-4));
  float depth = min(t.x, min(t.y, t.z));
  vec3 hit = vec3(from, 0.0) + depth * vec3(way.xy, way.z);
  vec3 paint = mix(vec3(0.34, 0.31, 0.27), vec3(0.22, 0.25, 0.28), lot.x);
  if (depth == t.y) paint = way.y > 0.0 ? vec3(0.42) : vec3(0.20, 0.14, 0.09);
  // Daylight comes in by the window alone: by day rooms are dark, some more than others.
  s.within = paint * (0.20 / (1.0 + 0.5 * hit.z * hit.z)) * (0.35 + lot.y);
  if (lot.z > 0.35) {
    float side = min(from.x, kRoom.x - from.x), fold = 0.5 + 0.5 * sin(from.x * 41.0 + 3.0 * sin(from.x * 7.0));
    float hung = 1.0 - smoothstep(0.0, 0.03, side - 0.15 - 0.9 * (lot.z - 0.35));
    vec3 cloth = mix(vec3(0.30, 0.29, 0.27), vec3(0.20, 0.15, 0.11), step(0.75, lot.x)) * (0.45 + 0.55 * fold);
    s.within = mix(s.within, 0.8 * cloth * mix(0.7, 1.1, from.y / kRoom.y), 0.8 * hung);
  } else if (lot.x > 0.6) {
    // A blind, let down some of the way.
    float below = 1.0 - smoothstep(0.0, 0.02, kRoom.y - from.y - kRoom.y * (0.25 + 0.45 * lot.y));
    s.within = mix(s.within, vec3(0.27, 0.26, 0.23) * (0.85 + 0.15 * step(0.5, fract(from.y * 22.0))), 0.85 * below);
  }
  return s;
}

// A window of stained glass: diamonds, pale as old glass is, each a little otherwise, in strips of lead on bars of iron, and
// in every other field a wheel of colours.
Surface leaded(Spot at) {
  const vec2 kField = vec2(0.90, 1.20), kDiamond = vec2(0.15, 0.20);
  Surface s = surfaceOf(at);
  vec2 p = chartOf(at.p, at.n).at;
  vec2 q = vec2(p.x / kDiamond.x + p.y / kDiamond.y, p.x / kDiamond.x - p.y / kDiamond.y);
  vec3 lot = random3(ivec3(ivec2(floor(q)), 311));
  vec3 tint = at.colour * (0.72 + 0.28 * lot.x) * mix(vec3(1.0), vec3(1.06, 0.98, 0.80), 0.7 * lot.y);
  float from_lead = 0.12 * min(min(fract(q.x), 1.0 - fract(q.x)), min(fract(q.y), 1.0 - fract(q.y)));
  ivec2 field = ivec2(floor(p / kField));
  vec2 from_middle = p - (vec2(field) + 0.5) * kField;
  float r = length(from_middle);
  if (((field.x + field.y) & 1) == 0 && r < 0.40) {
    float turn = atan(from_middle.y, from_middle.x) / 6.2831853 + 0.5;
    float ring = r < 0.13 ? 0.0 : r < 0.31 ? 1.0 : 2.0, parts = ring == 0.0 ? 4.0 : ring == 1.0 ? 8.0 : 24.0;
    float part = floor(turn * parts);
    vec3 own = random3(ivec3(field, int(part) + 32 * int(ring)));
    float even = mod(part, 2.0);
    vec3 ruby = vec3(0.46, 0.025, 0.03), cobalt = vec3(0.035, 0.09, 0.50), amber = vec3(0.75, 0.42, 0.06);
    vec3 green = vec3(0.06, 0.30, 0.10);
    tint = ring == 0.0 ? amber : ring == 1.0 ? mix(ruby, cobalt, even) : mix(cobalt, own.x < 0.3 ? green : ruby, even);
    tint *= 0.75 + 0.5 * own.y;
    float across = abs(fract(turn * parts + 0.5) - 0.5) / parts * 6.2831853 * r;
    from_lead = min(across, min(abs(r - 0.13), min(abs(r - 0.31), 0.40 - r)));
  } else if (r < 0.43 && ((field.x + field.y) & 1) == 0) {
    from_lead = min(from_lead, r - 0.40);
  }
  float soft = 0.5 * at.footprint + 0.001;
  float lead = 1.0 - smoothstep(0.004 - soft, 0.004 + soft, from_lead);
  float bar = abs(p.y / 0.6 - floor(p.y / 0.6) - 0.5) * 0.6;
  lead = max(lead, 1.0 - smoothstep(0.011 - soft, 0.011 + soft, bar));
  // Glass that was blown is streaked and has dirt at its edges.
  float streaks = fineNoise(vec3(p * vec2(14.0, 3.0), 0.0), 0.07, at.footprint);
  tint *= (1.0 + 0.16 * streaks) * mix(0.55, 1.0, smoothstep(0.004, 0.022, from_lead));
  s.clear = tint * (1.0 - lead);
  s.albedo = mix(0.03 * at.colour, vec3(0.045, 0.046, 0.050), lead);
  s.roughness = mix(0.12, 0.6, lead);
  return s;
}

// What shines by itself. A flame behind a pane is brightest in the middle; towards the rim the pane is seen, which is hot and
// coloured.
Surface glowing(Spot at) {
  Surface s = surfaceOf(at);
  float facing = max(dot(at.n, at.to_eye), 0.0);
  s.albedo = 0.1 * at.colour;
  s.within = at.colour * mix(0.9, 3.4, facing * facing) + vec3(0.9, 0.7, 0.4) * pow(facing, 6.0);
  s.within *= 1.0 + 0.15 * noise(at.p * 13.0).x;
  return s;
}
