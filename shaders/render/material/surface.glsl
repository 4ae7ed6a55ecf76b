// The appearance of a surface at a point, and functions that all surface patterns use.

struct Surface {
  vec3 albedo;
  vec3 normal;
  float roughness;
  float specular;      // reflectance at normal incidence
  float translucency;  // how far light wraps around the surface, 0..1
  vec3 within;         // light that is transmitted through the surface from behind it
  vec3 clear;          // transmittance: share of the light from behind the surface that is visible, 0..1
};

// The input of a pattern: a point on a surface, in metres from the patterns' origin.
struct Spot {
  vec3 p;
  vec3 n;
  vec3 to_eye;
  vec3 colour;
  float roughness;
  float relief;
  float footprint;  // width in metres that a sample covers
  float wet;        // 1 at the border of standing water, 0 away from it
  float depth;      // depth under water in metres
  vec3 light;       // direction from which most light comes; its length, 0..1, is the share of light from this
                    // direction
  bool sheltered;   // true if no rain reaches the point
};

Surface surfaceOf(Spot at) {
  Surface s;
  s.albedo = at.colour;
  s.normal = at.n;
  s.roughness = at.roughness;
  s.specular = 0.04;
  s.translucency = 0.0;
  s.within = vec3(0.0);
  s.clear = vec3(0.0);
  return s;
}

// Returns the weight of detail of this size, 0..1. Detail smaller than two footprints of a sample would flicker, so its
// weight is 0; from four footprints on, it is 1. `size` and `footprint` are in metres.
float visible(float size, float footprint) { return clamp(size / (2.0 * footprint) - 1.0, 0.0, 1.0); }

// Returns noise with details of this size in metres; 0 if they are too small to be visible.
float fineNoise(vec3 p, float size, float footprint) {
  float seen = visible(size, footprint);
  return seen > 0.0 ? seen * plainNoise(p) : 0.0;
}

// Returns the slope of a relief with octaves of noise, the largest with wavelength `period` in metres. The first
// `ridged` octaves have sharp crests, like broken rock. Component w of the result: variance of the slopes that are too
// fine to be visible.
vec4 relief(vec3 p, float period, int octaves, int ridged, float footprint) {
  const float kVariance = 0.5;  // variance of the slope of one octave along the surface
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

// Returns the roughness including relief that is too fine to be visible, which widens a highlight like roughness (after
// Olano and Baker, "LEAN mapping"). Otherwise distant surfaces would look like mirrors.
float roughened(float roughness, float variance) {
  float a = roughness * roughness;
  return sqrt(sqrt(min(1.0, a * a + 2.0 * variance)));
}

// Returns the normal of a relief at a visible point, limited to directions that face the eye, because parts that face
// away would be hidden.
vec3 turnedTo(vec3 to_eye, vec3 normal, vec3 n) {
  float least = 0.3 * max(dot(n, to_eye), 0.0), facing = dot(normal, to_eye);
  return facing >= least ? normal : normalize(normal + to_eye * (least - facing));
}

vec3 bend(vec3 normal, vec3 slope, float strength) {
  vec3 along = slope - normal * dot(normal, slope);
  // Slopes are limited to about 60 degrees: steeper ones would face away from every lamp and look like black specks.
  along *= strength;
  return normalize(normal - along * inversesqrt(1.0 + 0.35 * dot(along, along)));
}

vec3 planeWeights(vec3 n) {
  vec3 w = pow(abs(n), vec3(4.0));
  return w / (w.x + w.y + w.z);
}

// Returns the depth of cracks, 0..1, by triplanar projection: along the three axes, blended by the normal.
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

// Coordinates on a wall: metres along its level direction, and up its slope. The height of courses of stones depends on
// world height alone, so that they meet at corners and are continuous on curved walls, ribs and vaults. The level
// direction changes in steps, so that round columns and towers show whole faces of stones. On leaning surfaces, the
// height of courses also changes in steps.
struct Chart {
  vec2 at;
  vec3 along;
  vec3 up;
};

Chart chartOf(vec3 p, vec3 n) {
  Chart c;
  float level = length(n.xz);
  if (level < 0.28) {
    c.along = vec3(1.0, 0.0, 0.0);
    c.up = vec3(0.0, 0.0, 1.0);
    c.at = p.xz;
    return c;
  }
  // Round the wall's direction to a multiple of kStep (45 degrees). The offset is 0.56 instead of 0.5. With 0.5, the
  // faces of an octagonal column that is turned by 22.5 degrees would lie exactly between two multiples, so that
  // rounding errors would choose between them from point to point.
  const float kStep = 6.2831853 / 8.0;
  float turn = floor(atan(n.z, n.x) / kStep + 0.56) * kStep;
  vec3 out_of = vec3(cos(turn), 0.0, sin(turn));
  c.along = vec3(-out_of.z, 0.0, out_of.x);
  c.up = normalize(vec3(-out_of.x * n.y, level, -out_of.z * n.y));
  float steep = exp2(0.5 * floor(2.0 * log2(level) + 0.5));
  c.at = vec2(dot(p, c.along), p.y / steep);
  return c;
}

// The block of masonry at a point, and the place of the point in this block.
struct Block {
  vec3 lot;     // random numbers of the block
  vec2 within;  // position of the point, in metres from the block's middle
  float edge;   // distance in metres from the point to the block's nearest edge
  vec2 tilt;    // slope of the block's rounded edges: its components along the wall and upwards
};

// Returns the block of masonry at a point. The blocks of `size` metres are in courses, each shifted by `shift` blocks.
// vary: relative variation of lengths within a course, 0..0.5.
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

// Returns the cell at a point of an irregular (Voronoi) pattern, with cells about `size` metres wide: rubble, leaves,
// pebbles.
Block cellAt(vec2 at, float size, float round_edge, int seed) {
  vec2 q = at / size, cell = floor(q), f = q - cell;
  ivec2 i = ivec2(cell), chosen = i;
  vec2 nearest = vec2(0.0);
  float best = 8.0;
  [[dont_unroll]] for (int k = 0; k < 9; ++k) {
    ivec2 aside = ivec2(k % 3 - 1, k / 3 - 1);
    vec2 d = vec2(aside) + 0.1 + 0.8 * random3(ivec3(i + aside, seed)).xy - f;
    float l = dot(d, d);
    if (l < best) { best = l; nearest = d; chosen = i + aside; }
  }
  float border = 8.0;
  vec2 towards = vec2(0.0);
  [[dont_unroll]] for (int k = 0; k < 9; ++k) {
    ivec2 aside = ivec2(k % 3 - 1, k / 3 - 1);
    vec2 d = vec2(aside) + 0.1 + 0.8 * random3(ivec3(i + aside, seed)).xy - f;
    vec2 across = d - nearest;
    if (dot(across, across) < 1e-4) continue;
    vec2 away = normalize(across);
    float distance_to = dot(0.5 * (nearest + d), away);
    if (distance_to < border) { border = distance_to; towards = away; }
  }
  Block b;
  b.lot = random3(ivec3(chosen, seed + 1));
  b.within = -nearest * size;
  b.edge = border * size;
  b.tilt = towards * (1.0 - smoothstep(0.0, round_edge, b.edge));
  return b;
}

// Returns the paving stone at a point; stones are about `size` metres wide, and laid in uneven rows. Sizes differ,
// corners are rounded, and rows waver. loose: maximum deviation of a stone from its regular position, 0..0.5.
Block settAt(vec2 at, vec2 size, float loose, float round_edge, int seed) {
  vec2 q = at / size;
  int row = int(floor(q.y));
  vec2 mids[9];
  ivec2 cells[9];
  int chosen = 0;
  float best = 64.0, scale = min(size.x, size.y);
  [[dont_unroll]] for (int i = 0; i < 9; ++i) {
    int r = row + i / 3 - 1;
    float shift = random3(ivec3(r, 7, seed)).x;
    int column = int(floor(q.x - shift)) + i % 3 - 1;
    cells[i] = ivec2(column, r);
    vec2 off = loose * vec2(1.0, 0.6) * (2.0 * random3(ivec3(column, r, seed)).xy - 1.0);
    // vertical distances are enlarged, so that the nearest stones are those of the same row
    mids[i] = (vec2(float(column) + shift, float(r)) + 0.5 + off - q) * size * vec2(1.0, 1.5);
    float l = dot(mids[i], mids[i]);
    if (l < best) { best = l; chosen = i; }
  }
  // The smooth minimum of the distances to all borders makes rounded corners.
  float sum = 0.0, sharp = 14.0 / scale;
  vec2 towards = vec2(0.0);
  [[dont_unroll]] for (int i = 0; i < 9; ++i) {
    if (i == chosen) continue;
    vec2 away = normalize(mids[i] - mids[chosen]);
    float w = exp(-sharp * dot(0.5 * (mids[i] + mids[chosen]), away));
    sum += w;
    towards += w * away;
  }
  Block b;
  b.lot = random3(ivec3(cells[chosen], seed + 1));
  b.within = -mids[chosen];
  b.edge = max(0.0, -log(max(sum, 1e-6)) / sharp);
  b.tilt = towards / max(sum, 1e-6) * (1.0 - smoothstep(0.0, round_edge, b.edge));
  return b;
}

// A stone in a layer of stones strewn over a plane: a rotated ellipsoid in its own grid cell. The layer's axes are x
// and z along the plane, and y out of it.
struct Stone {
  vec3 middle;  // position in metres
  vec3 radii;   // radii in metres; 0 in a cell without a stone
  vec2 turn;    // cosine and sine of the stone's rotation
  vec3 lot;     // random numbers of the stone
};

Stone stoneIn(ivec2 cell, float size, float many, int seed) {
  Stone s;
  vec3 place = random3(ivec3(cell, seed));
  s.lot = random3(ivec3(cell, seed + 1));
  float wide = size * (0.28 + 0.30 * s.lot.x) * smoothstep(0.0, 0.2, s.lot.z + many - 1.0);
  s.radii = wide * vec3(1.0, 0.52 + 0.34 * place.z, 0.58 + 0.36 * s.lot.y);
  vec2 on = (vec2(cell) + 0.2 + 0.6 * place.xy) * size;
  s.middle = vec3(on.x, 0.3 * s.radii.y, on.y);
  s.turn = vec2(cos(40.0 * place.z), sin(40.0 * place.z));
  return s;
}

// Converts a vector to axes in which the stone is a unit ball.
vec3 inStone(Stone s, vec3 v) {
  return vec3(s.turn.x * v.x + s.turn.y * v.z, v.y, s.turn.x * v.z - s.turn.y * v.x) / s.radii;
}

// The visible stone of a layer of stones, if any.
struct Strewn {
  float there;  // 1 if a stone is visible, otherwise 0
  vec3 at;      // visible point in metres, in the layer's axes
  vec3 normal;  // unit normal at the visible point, in the layer's axes
  vec3 lot;     // random numbers of the stone
  ivec2 cell;
};

// Returns the stone that a ray from the eye hits first. at: point where the ray would hit the plane; way: direction of
// the ray in the layer's axes; size: distance between stones in metres; many: share of grid cells that have a stone.
Strewn strewnAt(vec2 at, vec3 way, float size, float many, int seed) {
  vec3 base = vec3(at.x, 0.0, at.y);
  // The ray is made steeper: along a flat ray, long rows of stones would hide each other, but only a few cells are
  // searched.
  vec3 ray = normalize(vec3(way.x, min(way.y, -0.4), way.z));
  Strewn found = Strewn(0.0, base, vec3(0.0, 1.0, 0.0), vec3(0.5), ivec2(1 << 20));
  ivec2 middle = ivec2(floor((at - ray.xz / -ray.y * (0.16 * size)) / size));
  float first = 0.0;
  [[dont_unroll]] for (int i = 0; i < 9; ++i) {
    ivec2 cell = middle + ivec2(i % 3 - 1, i / 3 - 1);
    Stone s = stoneIn(cell, size, many, seed);
    if (s.radii.x < 0.05 * size) continue;
    vec3 o = inStone(s, base - s.middle), d = inStone(s, ray);
    float a = dot(d, d), b = dot(o, d), c = dot(o, o) - 1.0, root = b * b - a * c;
    if (root <= 0.0) continue;
    float t = (-b - sqrt(root)) / a;
    if (t >= first) continue;
    first = t;
    vec3 ball = (o + t * d) / s.radii;
    vec3 normal = normalize(vec3(s.turn.x * ball.x - s.turn.y * ball.z, ball.y, s.turn.y * ball.x + s.turn.x * ball.z));
    found = Strewn(1.0, base + t * ray, normal, s.lot, cell);
  }
  return found;
}

// Returns, for a point among the stones, how much light from a direction reaches it (x), and its ambient openness (y).
vec2 lightAmong(Strewn seen, vec3 to_light, float size, float many, int seed) {
  vec3 l = normalize(vec3(to_light.x, max(to_light.y, 0.25), to_light.z));
  ivec2 middle = ivec2(floor((seen.at.xz + 0.25 * size * l.xz / l.y) / size));
  vec2 open = vec2(1.0);
  [[dont_unroll]] for (int i = 0; i < 9; ++i) {
    ivec2 cell = middle + ivec2(i % 3 - 1, i / 3 - 1);
    if (seen.there > 0.0 && cell == seen.cell) continue;
    Stone s = stoneIn(cell, size, many, seed);
    if (s.radii.x < 0.05 * size) continue;
    vec3 o = inStone(s, seen.at - s.middle), d = inStone(s, l);
    float away = dot(o, o), b = dot(o, d), across = away - b * b / dot(d, d);
    open.y *= 1.0 - 0.55 * exp(-2.5 * max(sqrt(away) - 1.0, 0.0));
    if (b < 0.0) open.x = min(open.x, smoothstep(0.55, 1.1, across));
  }
  return open;
}

// Makes a surface darker and smoother where standing water has wetted it.
void wetten(inout Surface s, float wet) {
  s.albedo *= mix(1.0, 0.55, wet);
  s.roughness = mix(s.roughness, 0.14, 0.85 * wet);
  s.specular = mix(s.specular, 0.035, wet);
}
