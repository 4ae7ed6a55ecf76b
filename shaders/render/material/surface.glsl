// What a surface looks like at a point, and tools that all patterns share.

struct Surface {
  vec3 albedo;
  vec3 normal;
  float roughness;
  float specular;      // reflectance at normal incidence
  float translucency;  // how far light wraps around, 0..1
  vec3 within;         // light that comes through the surface from behind it
};

// What a pattern starts from: a place on the surface of a body, in the patterns' own metres.
struct Spot {
  vec3 p;
  vec3 n;
  vec3 to_eye;
  vec3 colour;
  float roughness;
  float relief;
  float footprint;  // metres that a sample covers
  float wet;        // 1 at the edge of standing water, 0 away from it
  float depth;      // of water, metres
};

Surface surfaceOf(Spot at) {
  Surface s;
  s.albedo = at.colour;
  s.normal = at.n;
  s.roughness = at.roughness;
  s.specular = 0.04;
  s.translucency = 0.0;
  s.within = vec3(0.0);
  return s;
}

// Weight of detail of a size where one sample covers `footprint` metres: gone before it would flicker.
float visible(float size, float footprint) { return clamp(size / (2.0 * footprint) - 1.0, 0.0, 1.0); }

// Noise with details of a size, which is found only where they would be seen.
float fineNoise(vec3 p, float size, float footprint) {
  float seen = visible(size, footprint);
  return seen > 0.0 ? seen * plainNoise(p) : 0.0;
}

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

// A surface unrolled: metres along its level direction and up its slope. Walls turn in steps, so that a tower's courses
// are as long as they would be on its stones' own faces.
struct Chart {
  vec2 at;
  vec3 along;
  vec3 up;
};

Chart chartOf(vec3 p, vec3 n) {
  Chart c;
  if (abs(n.y) > 0.96) {
    c.along = vec3(1.0, 0.0, 0.0);
    c.up = vec3(0.0, 0.0, 1.0);
  } else {
    const float kStep = 6.2831853 / 32.0;
    float turn = floor(atan(n.z, n.x) / kStep + 0.5) * kStep;
    vec3 out_of = vec3(cos(turn), 0.0, sin(turn));
    c.along = vec3(-out_of.z, 0.0, out_of.x);
    float level = length(n.xz);
    c.up = normalize(vec3(-out_of.x * n.y, level, -out_of.z * n.y));
  }
  c.at = vec2(dot(p, c.along), dot(p, c.up));
  return c;
}

// A block of masonry at a point of a chart.
struct Block {
  vec3 lot;     // random numbers of its own
  vec2 within;  // metres from its middle
  float edge;   // metres to its nearest edge
  vec2 tilt;    // slope of its rounded edges, along and up
};

// Courses of blocks, `size` metres, each course shifted by `shift` blocks, the lengths within one varying by `vary` 0..0.5.
Block blockAt(vec2 at, vec2 size, float shift, float vary, float round_edge) {
  float course = floor(at.y / size.y);
  vec3 course_lot = random3(ivec3(int(course), 17, 3));
  float x = at.x / size.x + shift * course + vary * 4.0 * course_lot.x;
  float column = floor(x);
  float left = vary * (random3(ivec3(int(column), int(course), 9)).x - 0.5);
  float right = vary * (random3(ivec3(int(column) + 1, int(course), 9)).x - 0.5);
  float f = x - column;
  if (f < left) { column -= 1.0; right = left; left = vary * (random3(ivec3(int(column), int(course), 9)).x - 0.5); f += 1.0; right += 1.0; }
  else if (f > 1.0 + right) { column += 1.0; left = right; right = 1.0 + vary * (random3(ivec3(int(column) + 1, int(course), 9)).x - 0.5); f -= 1.0; }
  else right += 1.0;
  Block b;
  b.lot = random3(ivec3(int(column), int(course), 5));
  float l = (f - left) * size.x, r = (right - f) * size.x, d = at.y - course * size.y, u = size.y - d;
  b.within = vec2(0.5 * (l - r), 0.5 * (d - u));
  b.edge = min(min(l, r), min(d, u));
  b.tilt = vec2(smoothstep(0.0, round_edge, l) - smoothstep(0.0, round_edge, r),
                smoothstep(0.0, round_edge, d) - smoothstep(0.0, round_edge, u));
  return b;
}

// Cells of no order, about `size` metres wide: rubble, leaves, pebbles.
Block cellAt(vec2 at, float size, float round_edge, int seed) {
  vec2 q = at / size, cell = floor(q), f = q - cell;
  ivec2 i = ivec2(cell), chosen = i;
  vec2 nearest = vec2(0.0);
  float best = 8.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      vec2 d = vec2(x, y) + 0.1 + 0.8 * random3(ivec3(i + ivec2(x, y), seed)).xy - f;
      float l = dot(d, d);
      if (l < best) { best = l; nearest = d; chosen = i + ivec2(x, y); }
    }
  }
  float border = 8.0;
  vec2 towards = vec2(0.0);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      vec2 d = vec2(x, y) + 0.1 + 0.8 * random3(ivec3(i + ivec2(x, y), seed)).xy - f;
      vec2 across = d - nearest;
      if (dot(across, across) < 1e-4) continue;
      vec2 away = normalize(across);
      float distance_to = dot(0.5 * (nearest + d), away);
      if (distance_to < border) { border = distance_to; towards = away; }
    }
  }
  Block b;
  b.lot = random3(ivec3(chosen, seed + 1));
  b.within = -nearest * size;
  b.edge = border * size;
  b.tilt = towards * (1.0 - smoothstep(0.0, round_edge, b.edge));
  return b;
}

// Darkens and smooths what standing water has wetted.
void wetten(inout Surface s, float wet) {
  s.albedo *= mix(1.0, 0.55, wet);
  s.roughness = mix(s.roughness, 0.14, 0.85 * wet);
  s.specular = mix(s.specular, 0.035, wet);
}
