// The land around the world. Beyond the border of the drawn region, the ground continues as a plane at the border's
// height. The plane is bare, or it has meadows and fields; woods and hills stand in front of the horizon. frame.land
// contains the parameters.

// Applies aerial perspective to the colour of an object t metres away: air absorbs red light last, and adds blue light.
// Haze is near the ground, so that visibility is better from high above.
vec3 throughAir(vec3 colour, vec3 haze, float t) {
  float low = 1.0 / (1.0 + max(frame.eye.y - frame.land.x, 0.0) / 700.0);
  return mix(haze, colour, exp(-t * low / vec3(9200.0, 7400.0, 5600.0)));
}

vec3 landLight(vec3 n, float open) {
  return sunLight() * (open * max(dot(n, frame.sun.xyz), 0.0)) + 0.8 * skyLight(vec3(0.0, 1.0, 0.0), frame.sun.xyz);
}

// Returns the colour of the land: fields, hedges between them, and woods; bare land has only broad stains. Near the
// world it has the colour of the world's ground (`own`).
vec3 landAlbedo(vec2 at, float away, float footprint, vec3 own) {
  // Wavelengths of the noises in metres. They are evaluated in a loop, so that the function is compiled only once.
  const float kWide[8] = float[8](210.0, 37.0, 4.1, 6.0, 330.0, 41.0, 1500.0, 110.0);
  float n[8];
  for (int i = 0; i < 8; ++i) n[i] = plainNoise(vec3(at.x, 5.0 * float(i), at.y) / kWide[i]);
  float middle = n[1] * visible(20.0, footprint), fine = n[2] * visible(3.0, footprint);
  vec3 near = own * (1.0 + 0.22 * n[0] + 0.14 * middle);
  if (isBare()) return near;
  // The land is divided into parishes, irregular areas whose fields are in rows of different directions.
  Block parish = cellAt(at + 60.0 * vec2(n[4], n[0]), 900.0, 1.0, 407);
  float turn = 3.1 * parish.lot.x;
  vec2 rows = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * (at + 9.0 * vec2(n[1], n[5]));
  // Some parishes have small fields between hedges, others wide ones with a bank or a track here and there.
  float open = smoothstep(0.35, 0.65, parish.lot.y);
  vec2 wide = mix(vec2(130.0, 95.0), vec2(340.0, 170.0), open) * (0.8 + 0.5 * parish.lot.z);
  Block field = blockAt(rows, wide, 0.37, 0.5, 1.0);
  field.edge = min(field.edge, parish.edge);
  // Neighbouring fields often have the same crop.
  float sown = fract(0.55 * field.lot.y + 0.45 * random3(ivec3(floor(rows / (2.3 * wide.yx)), 5)).x + parish.lot.z);
  vec3 meadow = mix(vec3(0.098, 0.132, 0.046), vec3(0.158, 0.162, 0.076), field.lot.x);
  vec3 grain = mix(vec3(0.235, 0.200, 0.100), vec3(0.180, 0.168, 0.080), field.lot.x);
  vec3 soil = mix(vec3(0.172, 0.142, 0.085), vec3(0.140, 0.128, 0.070), field.lot.z);
  float seen = visible(60.0, footprint);
  vec3 c = mix(vec3(0.132, 0.142, 0.066), sown < 0.62 ? meadow : sown < 0.86 ? grain : soil, 0.75 * seen);
  c *= 1.0 + 0.16 * n[0] + 0.12 * middle + 0.10 * fine + 0.18 * n[6] + 0.14 * n[7];
  c = mix(near * (1.0 + 0.1 * fine), c, smoothstep(60.0, 420.0, away));
  float kept = smoothstep(-0.25, 0.15, n[7] + 0.5 * n[5] - 0.55 * open);
  float hedge = (1.0 - smoothstep(1.5, 4.0, field.edge + 1.8 * n[3])) * kept * seen * smoothstep(90.0, 160.0, away);
  // Woods form groups, with ragged borders and small copses around them.
  float wood = smoothstep(0.24, 0.30, 0.62 * n[4] + 0.85 * n[6] + 0.30 * n[7] + 0.16 * n[5]) * smoothstep(150.0, 300.0, away);
  float crowns = 1.0 + 0.3 * fine + 0.25 * n[3] * visible(6.0, footprint) + 0.2 * n[5];
  return mix(c, vec3(0.042, 0.058, 0.026) * crowns, max(0.8 * hedge, 0.92 * wood));
}

// Returns the height above the plane of a row of woods or hills, at a distance of `away` metres in a direction. tall:
// minimum and maximum height; wave: distance between rises in metres; crowns: how far single trees rise above the
// others.
float skyline(vec2 way, float away, vec2 tall, float wave, float crowns, float seed) {
  float h = 0.5, size = 0.75, top = 0.0, every = wave;
  for (int i = 0; i < 5; ++i) {
    if (i == 3) every = 11.0;
    float n = plainNoise(vec3(way * (away / every), seed + float(i)));
    if (i < 3) h += size * n;
    else top += crowns * (i == 3 ? 1.0 : 0.5) * (0.6 - abs(n));
    size *= 0.5;
    every *= 0.42;
  }
  return mix(tall.x, tall.y, clamp(h, 0.0, 1.0)) + top;
}

// Returns what is visible in a direction below or just above the horizon; returns `above` where only sky is visible.
vec3 land(vec3 d, vec3 above, vec3 own) {
  if (d.y > 0.2 || frame.land.y < 0.0) return above;
  float eye = max(frame.eye.y - frame.land.x, 0.3);
  vec2 way = normalize(d.xz + vec2(1e-6, 0.0));
  float slope = d.y / max(length(d.xz), 1e-4);
  vec3 haze = hazeIn(vec3(d.x, 0.0, d.z)) * vec3(0.88, 0.94, 1.0);
  vec3 wood = isBare() ? 0.75 * own : vec3(0.050, 0.066, 0.032);
  // The rows of woods and hills, from near to far; a row hides everything behind it.
  const float kAway[4] = float[4](420.0, 1300.0, 4800.0, 13000.0), kWave[4] = float[4](150.0, 700.0, 2100.0, 4700.0);
  const vec2 kTall[4] = vec2[4](vec2(-20.0, 15.0), vec2(6.0, 36.0), vec2(10.0, 230.0), vec2(60.0, 620.0));
  const float kCrowns[4] = float[4](5.0, 6.0, 0.0, 0.0);
  for (int row = isBare() ? 1 : 0; row < 4; ++row) {
    float away = kAway[row];
    // If the eye is high above the hills, they are drawn as a part of the plane.
    if (eye > 1.5 * (kTall[row].y + kCrowns[row])) continue;
    if (slope < -eye / away || slope > (kTall[row].y + kCrowns[row] - eye) / away) continue;
    float high = skyline(way, away, kTall[row], kWave[row], isBare() ? 0.0 : kCrowns[row], float(10 * row + 1));
    float over = slope * away + eye;
    if (high <= 0.5 || over > high) continue;
    // Crowns of trees are lit above and dark below; hills have woods and meadows in turn.
    bool hill = row >= 2;
    vec2 wide = hill ? vec2(420.0, 60.0) : vec2(5.0, 4.0);
    float grain = plainNoise(vec3(way * (away / wide.x), over / wide.y + 3.0));
    vec3 c = wood * (1.0 + 0.45 * grain) * (hill ? 0.9 : mix(0.45, 1.0, smoothstep(0.0, 1.0, over / high)));
    if (hill && !isBare()) c = mix(c, vec3(0.125, 0.140, 0.062), smoothstep(0.05, 0.35, grain));
    // The foot of a hill blends gently into the plain.
    if (hill && !isBare()) c = mix(vec3(0.120, 0.132, 0.058), c, smoothstep(0.0, 0.5, over / high));
    return throughAir(c * landLight(normalize(vec3(-way.x, 0.9, -way.y)), sunOnLand(way * away)), haze, away);
  }
  if (d.y >= -1e-4) return above;
  float t = eye / -d.y;
  vec2 at = frame.eye.xz + frame.pattern_offset.xz + d.xz * t;
  vec3 c = landAlbedo(at, t, t * frame.eye.w / max(0.05, sqrt(-d.y)), own) * landLight(vec3(0.0, 1.0, 0.0), sunOnLand(d.xz * t));
  return throughAir(c, haze, t);
}
