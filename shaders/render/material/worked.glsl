// Materials that people spread, pour, saw or roll: even, never rocky.

// Plaster, paint, clay: a colour with fine grain, broad stains, and streaks where rain runs. Plaster has mended patches
// and hairline cracks.
Surface plain(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 0.45).x + 0.5 * noise(at.p * 1.9 + 7.0).x;
  float grain = fineNoise(at.p * 45.0, 0.022, at.footprint) + fineNoise(at.p * 160.0, 0.006, at.footprint);
  s.albedo = at.colour * (1.0 + at.relief * (0.07 * broad + 0.05 * grain));
  s.albedo *= 1.0 - 0.16 * at.relief * weathered(at.p, at.n);
  if (at.relief >= 0.9 && at.relief <= 1.1 && abs(at.n.y) < 0.5) {
    Chart chart = chartOf(at.p, at.n);
    Block piece = cellAt(chart.at * vec2(0.8, 1.0) + 0.12 * noise(at.p * 2.7).yz, 2.7, 1.0, 113);
    float newer = step(piece.lot.x, 0.22) * smoothstep(0.01, 0.03 + at.footprint, piece.edge - 0.25);
    s.albedo *= mix(vec3(1.0), mix(vec3(0.90, 0.90, 0.91), vec3(1.06, 1.05, 1.03), piece.lot.y), 0.8 * newer);
    float hair = cracks(at.p + 0.10 * noise(at.p * 1.9).yzw + 0.02 * noise(at.p * 11.0).yzw, at.n, 2.3, 0.004, 0.3 * at.footprint);
    s.albedo *= 1.0 - 0.34 * hair * smoothstep(0.0, 0.4, noise(at.p * 0.5 + 70.0).x);
  }
  // A plasterer's float leaves broad, shallow strokes; sand makes the plaster grainy.
  vec4 strokes = relief(at.p * vec3(1.0, 1.6, 1.0), 0.30, 2, 0, at.footprint), fine = relief(at.p, 0.012, 2, 0, at.footprint);
  s.normal = bend(at.n, strokes.xyz + 0.9 * fine.xyz, 0.016 * at.relief);
  wetten(s, at.wet);
  s.roughness = roughened(s.roughness, 0.0006 * at.relief * at.relief * (strokes.w + fine.w));
  return s;
}

// Cast concrete: panels, holes of the formwork's tie rods, pores, stains.
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

// Wood with grain along an axis (a unit vector): bands, drying cracks, knots, and dents of the tool that shaped it.
// lot: random numbers of the piece, so that boards differ.
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
  // Cracks run along the grain, open in the middle and closed at both ends.
  vec4 split = noise(across * 9.0 + axis * (along * 0.55 + 5.0 * lot.y) + 0.35 * swing.y + 21.0);
  float dry = smoothstep(0.0, 0.35, noise(across * 3.0 + axis * along * 1.3 + 50.0).x);
  float check = (1.0 - smoothstep(0.015, 0.07, abs(split.x))) * dry * visible(0.016, at.footprint);
  Surface s = surfaceOf(at);
  vec3 grey = vec3(dot(at.colour, vec3(0.4)));
  // Weathering and stains follow the grain.
  vec3 drawn = across * 5.5 + axis * (along * 0.42 + 3.0 * lot.x);
  s.albedo = mix(at.colour, grey, 0.12 + 0.30 * smoothstep(-0.2, 0.6, noise(drawn).x + 0.3 * noise(at.p * 0.5).x));
  s.albedo *= 1.0 - 0.22 * smoothstep(0.1, 0.7, noise(drawn * 1.7 + 4.0).x + 0.3 * hair.x);
  s.albedo *= (1.0 + 0.30 * (lot.y - 0.5)) * (1.0 + 0.26 * ring.x + 0.16 * hair.x + 0.14 * fine);
  s.albedo *= (1.0 - 0.6 * check) * (1.0 - 0.55 * knot);
  vec3 slope = 0.5 * ring.yzw + 0.35 * hair.yzw - sign(split.x) * split.yzw * (1.2 * check);
  slope += 0.5 * noise(at.p * 7.0 + 17.0).yzw * visible(0.14, at.footprint) + 0.8 * knots.yzw * knot;
  s.normal = bend(at.n, slope, 0.22 * at.relief);
  s.roughness = clamp(at.roughness * (1.0 + 0.2 * ring.x), 0.05, 1.0);
  wetten(s, at.wet);
  return s;
}

// Wooden posts, and anything made of one piece of wood. The grain runs up walls and along floors.
Surface wooden(Spot at) {
  return grained(at, length(at.n.xz) < 0.28 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0), vec3(0.5));
}

// Horizontal wooden beams, planks and logs, with horizontal grain. The direction of the grain is quantised, because
// positions far from the origin are inexact.
Surface lying(Spot at) {
  const float kStep = 3.14159265 / 12.0;
  float turn = length(at.n.xz) < 0.06 ? 0.0 : floor(atan(at.n.x, -at.n.z) / kStep + 0.5) * kStep;
  return grained(at, vec3(cos(turn), 0.0, sin(turn)), vec3(0.5));
}

// Wooden boards side by side.
Surface boarded(Spot at) {
  Chart chart = chartOf(at.p, at.n);
  float board = chart.at.x / 0.14, edge = 0.14 * min(fract(board), 1.0 - fract(board));
  Surface s = grained(at, chart.up, random3(ivec3(int(floor(board)), 41, 2)));
  s.albedo *= 1.0 - 0.6 * (1.0 - smoothstep(0.002, 0.006, edge)) * visible(0.02, at.footprint);
  return s;
}

// Used metal: dull, with rust if the relief parameter says that the metal is neglected.
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

// Asphalt: tar with chips of stone, which wheels have exposed in places; with sunken areas, cracks and sealed cracks.
Surface asphalt(Spot at) {
  Surface s = surfaceOf(at);
  float broad = noise(at.p * 0.35).x + 0.4 * noise(at.p * 1.6).x;
  float mottle = fineNoise(at.p * 6.0, 0.16, at.footprint), clots = fineNoise(at.p * 25.0, 0.04, at.footprint);
  float chips = fineNoise(at.p * 120.0, 0.009, at.footprint), dust = fineNoise(at.p * 64.0, 0.016, at.footprint);
  // Chips are paler than tar, and the more the tar is worn, the more chips are exposed.
  float bare = smoothstep(0.05, 0.40, chips + 0.35 * dust + 0.15 * clots + 0.12 * broad);
  s.albedo = at.colour * (1.0 + 0.16 * broad + 0.13 * mottle + 0.20 * clots + 0.22 * dust) * (1.0 - 0.2 * max(-chips, 0.0));
  s.albedo = mix(s.albedo, vec3(0.20, 0.195, 0.185) * (1.0 + 0.5 * dust), 0.55 * bare);
  vec3 bent = at.p + 0.3 * noise(at.p * 0.7).yzw + 0.03 * noise(at.p * 5.0).yzw;
  float old = smoothstep(0.0, 0.4, broad);
  float split = cracks(bent, at.n, 3.1, 0.012, at.footprint) * old;
  s.albedo *= 1.0 - 0.60 * split;
  // Most of the long cracks are sealed with a band of fresh tar.
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

// The colour of clear glass, the same as in the table of materials (runtime/tools/materials/material.cpp).
const vec3 kClearGlass = vec3(0.22, 0.30, 0.33);

// The point that a ray hits in a room behind a window pane. The room is computed from the ray alone and has no geometry
// (van Dongen, "Interior mapping", 2008).
struct Room {
  vec2 from;   // point where the ray enters, in metres from the room's lower left corner
  vec3 way;    // direction of the ray: along the wall, up, and into the room
  vec3 hit;    // point where the ray ends, in metres from the room's lower left corner; z: distance from the pane
  float side;  // part of the room that the ray hits: 0 a side wall, 1 the floor, 2 the ceiling, 3 the back wall
  vec3 lot;    // random numbers of the room
};

Room roomBehind(Spot at, vec3 size, int seed) {
  Room r;
  Chart chart = chartOf(at.p, at.n);
  vec2 q = chart.at / size.xy;
  ivec2 room = ivec2(floor(q));
  r.lot = random3(ivec3(room, seed));
  r.way = -vec3(dot(at.to_eye, chart.along), dot(at.to_eye, chart.up), dot(at.to_eye, at.n));
  r.way.z = max(-r.way.z, 0.05);
  r.from = (q - floor(q)) * size.xy;
  vec3 walls = vec3(r.way.x > 0.0 ? size.x - r.from.x : r.from.x, r.way.y > 0.0 ? size.y - r.from.y : r.from.y, size.z);
  vec3 t = walls / max(abs(r.way), vec3(1e-4));
  float depth = min(t.x, min(t.y, t.z));
  r.hit = vec3(r.from, 0.0) + depth * r.way;
  r.side = depth == t.y ? (r.way.y > 0.0 ? 2.0 : 1.0) : depth == t.z ? 3.0 : 0.0;
  return r;
}

// Returns where a ray into a room crosses the vertical plane `deep` metres behind the pane.
vec2 atDepth(Room r, float deep) { return r.from + r.way.xy * (deep / r.way.z); }

// Returns 1 inside a rectangle around `middle`, 0 outside; the border is softened by the footprint of a sample.
float inBox(vec2 p, vec2 middle, vec2 half_size, float footprint) {
  vec2 out_of = abs(p - middle) - half_size;
  return 1.0 - smoothstep(-0.5 * footprint - 0.004, 0.5 * footprint + 0.004, max(out_of.x, out_of.y));
}

// A room of a home. Daylight comes only through the window: by day rooms are dark, some more than others, and in a few
// of them a lamp is on.
vec3 dwelling(Spot at) {
  Room r = roomBehind(at, vec3(3.6, 3.0, 4.2), 77);
  vec3 paint = mix(vec3(0.36, 0.32, 0.27), vec3(0.24, 0.26, 0.28), r.lot.x);
  if (r.side == 1.0) paint = vec3(0.19, 0.13, 0.085);
  if (r.side == 2.0) paint = vec3(0.44);
  if (r.side == 3.0) {
    // A cupboard or a picture on the back wall.
    float thing = inBox(r.hit.xy, vec2(0.8 + 2.0 * r.lot.z, 1.0), vec2(0.5, 1.0), at.footprint);
    paint = mix(paint, mix(vec3(0.13, 0.085, 0.055), vec3(0.30, 0.27, 0.22), step(0.6, r.lot.x)), thing);
    float picture = inBox(r.hit.xy, vec2(0.6 + 2.4 * fract(3.0 * r.lot.y), 1.75), vec2(0.28, 0.22), at.footprint);
    paint = mix(paint, vec3(0.32, 0.28, 0.20) * (0.4 + r.lot.z), picture);
  }
  vec3 seen = paint * (0.17 / (1.0 + 0.55 * r.hit.z * r.hit.z)) * (0.25 + 0.9 * r.lot.y);
  if (r.lot.z > 0.90) {
    vec3 lamp = vec3(1.0 + 2.0 * r.lot.x, 2.3, 2.4);
    vec3 away = r.hit - lamp;
    seen += paint * vec3(1.0, 0.72, 0.42) * (0.9 / (0.7 + dot(away, away)));
  }
  return seen;
}

// An office: a ceiling with rows of lights, some of them on; desks; and a blind that is partly lowered.
vec3 office(Spot at) {
  Room r = roomBehind(at, vec3(6.0, 3.4, 7.0), 79);
  bool lit = r.lot.x > 0.45;
  vec3 paint = r.side == 1.0 ? vec3(0.10, 0.105, 0.115) : r.side == 2.0 ? vec3(0.46) : vec3(0.33, 0.33, 0.32);
  vec3 seen = paint * (0.16 / (1.0 + 0.35 * r.hit.z * r.hit.z)) * (0.4 + 0.6 * r.lot.y);
  if (lit) seen += paint * vec3(0.115, 0.112, 0.10);
  if (r.side == 2.0) {
    vec2 lights = vec2(fract(r.hit.x / 1.5) * 1.5, fract(r.hit.z / 1.8) * 1.8);
    seen += vec3(0.95, 0.93, 0.85) * (lit ? 0.9 : 0.02) * inBox(lights, vec2(0.75, 0.9), vec2(0.15, 0.6), at.footprint);
  }
  // Desks with screens are near the window, pillars farther inside.
  vec2 desk = atDepth(r, 1.2);
  float place = fract(desk.x / 2.1) * 2.1;
  float there = step(desk.y, 0.78) + inBox(vec2(place, desk.y), vec2(1.0, 1.02), vec2(0.30, 0.17), at.footprint);
  if (1.2 < r.hit.z) seen = mix(seen, vec3(0.020, 0.020, 0.022) + (lit ? 0.02 : 0.0), clamp(there, 0.0, 1.0) * 0.85);
  // Each bay has its own blind.
  Chart chart = chartOf(at.p, at.n);
  vec3 own = random3(ivec3(int(floor(chart.at.x / 1.5)), int(floor(chart.at.y / 3.4)), 83));
  float low = 3.4 * (own.x < 0.45 ? 0.0 : own.x < 0.85 ? 0.28 * own.y : 0.85 * own.y);
  float drawn = smoothstep(-0.01, 0.01, r.from.y - (3.4 - low));
  float slat = visible(0.03, at.footprint) * 0.12 * step(0.5, fract(r.from.y * 28.0));
  return mix(seen, vec3(0.27, 0.265, 0.25) * (1.0 - slat), 0.9 * drawn);
}

// A shop: goods in the window, and on shelves along the back wall, under lights.
vec3 shop(Spot at) {
  Room r = roomBehind(at, vec3(4.4, 3.9, 5.0), 89);
  vec3 kept = mix(vec3(0.42, 0.36, 0.28), vec3(0.34, 0.36, 0.37), r.lot.x);
  vec3 paint = r.side == 1.0 ? vec3(0.17, 0.12, 0.08) : r.side == 2.0 ? vec3(0.5) : kept;
  vec2 wall = r.side == 3.0 ? r.hit.xy : vec2(r.hit.z, r.hit.y);
  if ((r.side == 3.0 || r.side == 0.0) && wall.y < 2.6) {
    // Shelves with goods of many colours, in groups of similar goods.
    vec2 q = vec2(wall.x / 0.11, wall.y / 0.42), lots = vec2(floor(wall.x / 0.66), floor(q.y));
    vec3 lot = random3(ivec3(ivec2(lots), 97)), own = random3(ivec3(int(floor(q.x)), int(lots.y), 101));
    vec3 goods = mix(mix(vec3(0.30, 0.25, 0.18), vec3(0.22, 0.10, 0.07), step(0.6, lot.x)),
                     mix(vec3(0.10, 0.14, 0.15), vec3(0.42, 0.40, 0.36), step(0.5, lot.z)), step(0.5, lot.y));
    float tall = 0.35 + 0.5 * lot.y + 0.08 * own.x, up = fract(q.y) / 0.92;
    float filled = step(up, tall) * step(0.12, fract(q.x)) * step(own.z, 0.9);
    vec3 shelf = mix(0.35 * kept, goods * (0.8 + 0.3 * own.y), filled);
    if (up > 1.0) shelf = 0.8 * kept;
    paint = mix(0.6 * kept, shelf, visible(0.25, at.footprint));
  }
  vec3 warm = vec3(1.0, 0.86, 0.66) * (0.20 + 0.22 * r.lot.y);
  vec3 seen = paint * (warm + 0.25 / (1.0 + 0.5 * r.hit.z * r.hit.z));
  if (r.side == 2.0) {
    vec2 spots = fract(vec2(r.hit.x, r.hit.z) / 1.1) - 0.5;
    seen += vec3(2.2, 1.9, 1.4) * (1.0 - smoothstep(0.05, 0.07, length(spots)));
  }
  // The goods on display are half a metre behind the pane, on a ledge: boxes, busts, bottles, each lit from one side.
  for (int i = 0; i < 2; ++i) {
    float deep = i == 0 ? 0.95 : 0.45;
    vec2 p = atDepth(r, deep);
    float wide = 0.34 + 0.16 * r.lot.z, n = floor(p.x / wide + 0.37 * float(i));
    vec3 own = random3(ivec3(int(n), int(floor(chartOf(at.p, at.n).at.x / 4.4)) + 7 * i, 103));
    float x = p.x / wide + 0.37 * float(i) - n - 0.5, top = 0.85 + 0.35 * own.x + 0.25 * float(1 - i), y = p.y - 0.55;
    // Boxes and cards, and round objects on a foot.
    float body = own.z < 0.7 ? max(abs(x) - 0.20 - 0.14 * own.y, y - (top - 0.55) * (0.5 + 0.5 * own.z))
                             : min(length(vec2(x, (y - 0.22) / 0.7)) - 0.26, max(abs(x) - 0.07, y - 0.2));
    float shown = step(deep, r.hit.z) * step(own.y, 0.6) * (1.0 - smoothstep(-0.02, 0.02, body));
    vec3 colour = own.x < 0.5 ? vec3(0.40, 0.36, 0.29) : mix(vec3(0.09, 0.10, 0.12), vec3(0.26, 0.13, 0.08), own.y);
    seen = mix(seen, colour * (0.55 + 0.35 * r.lot.y) * (0.75 + 0.8 * x), shown);
    if (y < 0.0) seen = mix(seen, kept * 0.34, step(deep, r.hit.z) * smoothstep(0.0, -0.03, y));
  }
  return 0.62 * seen;
}

// A pane of glass and the room behind it; kClearPane and the constants after it select the kind of room. Tinted glass
// hides the room.
Surface glazed(Spot at) {
  Surface s = surfaceOf(at);
  s.roughness = 0.04;
  s.specular = 0.06;
  s.albedo = vec3(0.0);
  uint behind = uint(at.relief + 0.5);
  if (behind == kClearPane) {
    s.clear = vec3(1.0);
  } else if (behind == kShopBehind) {
    s.within = shop(at);
  } else if (behind == kOfficeBehind) {
    s.within = office(at);
  } else if (behind == kCurtainBehind) {
    // Curtains hang in wide and narrow folds. The pane absorbs some of the light that passes in and out.
    Chart chart = chartOf(at.p, at.n);
    float x = chart.at.x + 0.02 * sin(1.7 * chart.at.y + 9.0 * chart.at.x);
    float fold = sin(47.0 * x + 2.0 * sin(11.0 * x)) + 0.5 * sin(113.0 * x + 1.0);
    s.albedo = 0.52 * at.colour * (0.86 + 0.16 * fold * visible(0.07, at.footprint));
    s.normal = normalize(at.n + chart.along * (0.35 * cos(47.0 * x + 2.0 * sin(11.0 * x)) * visible(0.07, at.footprint)));
  } else if (behind == kBlindBehind) {
    Chart chart = chartOf(at.p, at.n);
    float slat = fract(chart.at.y / 0.05);
    s.albedo = 0.55 * at.colour * (1.0 - 0.22 * smoothstep(0.75, 1.0, slat) * visible(0.05, at.footprint));
  } else if (distance(at.colour, kClearGlass) > 0.04) {
    s.albedo = 0.4 * at.colour;
  } else {
    s.within = dwelling(at);
  }
  return s;
}

// A window of stained glass: diamonds of pale old glass, each slightly different, in strips of lead on iron bars; every
// other field has a coloured wheel.
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
  // Each wheel has its own size, spokes and colours; some fields have a lozenge or nothing.
  vec3 kind = random3(ivec3(field, 317));
  bool figured = ((field.x + field.y) & 1) == 0 && kind.z < 0.9;
  float outer = 0.32 + 0.10 * kind.x;
  float r = kind.z > 0.62 ? 0.66 * (abs(from_middle.x) * 1.25 + abs(from_middle.y)) : length(from_middle);
  if (figured && r < outer) {
    float turn = atan(from_middle.y, from_middle.x) / 6.2831853 + 0.5, hub = outer * (0.22 + 0.2 * kind.y);
    float middle = outer * (0.70 + 0.12 * kind.x), spokes = 4.0 + 2.0 * floor(3.0 * kind.y);
    float ring = r < hub ? 0.0 : r < middle ? 1.0 : 2.0, parts = ring == 0.0 ? 4.0 : ring == 1.0 ? spokes : 3.0 * spokes;
    float part = floor(turn * parts);
    vec3 own = random3(ivec3(field, int(part) + 32 * int(ring)));
    float even = mod(part, 2.0);
    vec3 ruby = vec3(0.46, 0.025, 0.03), cobalt = vec3(0.035, 0.09, 0.50), amber = vec3(0.75, 0.42, 0.06);
    vec3 green = vec3(0.06, 0.30, 0.10), violet = vec3(0.24, 0.05, 0.30);
    vec3 first = kind.x < 0.4 ? ruby : kind.x < 0.7 ? green : violet, second = kind.y < 0.6 ? cobalt : amber;
    tint = ring == 0.0 ? mix(amber, vec3(0.72, 0.74, 0.66), step(0.6, kind.y)) : ring == 1.0 ? mix(first, second, even)
                                                                      : mix(cobalt, own.x < 0.3 ? green : ruby, even);
    tint *= 0.75 + 0.5 * own.y;
    float across = abs(fract(turn * parts + 0.5) - 0.5) / parts * 6.2831853 * r;
    from_lead = min(across, min(abs(r - hub), min(abs(r - middle), outer - r)));
  } else if (figured && r < outer + 0.03) {
    from_lead = min(from_lead, r - outer);
  }
  float soft = 0.5 * at.footprint + 0.001;
  float lead = 1.0 - smoothstep(0.004 - soft, 0.004 + soft, from_lead);
  float bar = abs(p.y / 0.6 - floor(p.y / 0.6) - 0.5) * 0.6;
  lead = max(lead, 1.0 - smoothstep(0.011 - soft, 0.011 + soft, bar));
  // Blown glass is streaked, and dirty at its edges.
  float streaks = fineNoise(vec3(p * vec2(14.0, 3.0), 0.0), 0.07, at.footprint);
  tint *= (1.0 + 0.16 * streaks) * mix(0.55, 1.0, smoothstep(0.004, 0.022, from_lead));
  s.clear = tint * (1.0 - lead);
  s.albedo = mix(0.03 * at.colour, vec3(0.045, 0.046, 0.050), lead);
  s.roughness = mix(0.12, 0.6, lead);
  return s;
}

// A glowing surface. A flame behind a pane is brightest in the middle; towards the border, the pane itself is visible:
// hot, coloured, and sooty in streaks.
Surface glowing(Spot at) {
  Surface s = surfaceOf(at);
  float facing = max(dot(at.n, at.to_eye), 0.0);
  float soot = smoothstep(-0.2, 0.6, noise(at.p * vec3(21.0, 7.0, 21.0)).x + 0.5 * noise(at.p * 47.0).x);
  s.albedo = 0.1 * at.colour;
  s.within = at.colour * mix(0.35, 1.15, facing * facing) + vec3(0.75, 0.60, 0.34) * pow(facing, 9.0);
  s.within *= mix(vec3(1.0), vec3(0.62, 0.54, 0.46), 0.8 * soot);
  return s;
}
