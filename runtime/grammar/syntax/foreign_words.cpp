#include "grammar/syntax/foreign_words.h"

#include <algorithm>
#include <array>

#include "grammar/syntax/keywords.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

struct Foreign {
  std::string_view theirs;  ///< the other language's word, in lower case
  std::string_view ours;
};

constexpr std::array<Foreign, 36> kWords = {
    {{"add", "union"},       {"ball", "sphere"},       {"ceiling", "ceil"},      {"cellular", "cellnoise"},
     {"cone", "truncone"},   {"cube", "box"},          {"cuboid", "box"},        {"difference", "cut"},
     {"donut", "torus"},     {"ellipse", "ellipsoid"}, {"float3", "vec"},        {"frac", "fract"},
     {"include", "import"},  {"intersect", "meet"},    {"intersection", "meet"}, {"lerp", "mix"},
     {"material", "mat"},    {"minus", "cut"},         {"move", "at"},           {"noise", "fractal"},
     {"perlin", "fractal"},  {"plane", "halfspace"},   {"random", "rand"},       {"rotate", "rot"},
     {"simplex", "fractal"}, {"smoothunion", "union"}, {"snoise", "fractal"},    {"subtract", "cut"},
     {"translate", "at"},    {"trunc", "floor"},       {"tunnel", "tube"},       {"uniform", "rand"},
     {"vec3", "vec"},        {"vector3", "vec"},       {"voronoi", "cellnoise"}, {"worley", "cellnoise"}}};

constexpr std::string_view kRemainder = "write `a - b*floor(a/b)`";
constexpr std::string_view kUnitVector = "write `v/length(v)`";
constexpr std::string_view kNoLogarithm = "there is no logarithm: write the value that it would give";
constexpr std::string_view kHeights =
    "displace a half-space by a field: `displace 8m*fractal(60m) { halfspace(below 0m); }`; pictures are not read";
constexpr std::string_view kBillow =
    "write `import \"std/noise.sgm\" as noise;` at the top and `noise.billow(period 8m, amp 1m)` here";
constexpr std::string_view kLarger = "write `displace -0.1m { ... }` to make a shape larger on all sides";

/// Hints for words without a single equivalent in this language.
constexpr std::array<Foreign, 61> kHints = {
    {{"acos", "write `atan2(sqrt(1 - x*x), x)`"},
     {"asin", "write `atan2(x, sqrt(1 - x*x))`"},
     {"atan", "write `atan2(x, 1)`"},
     {"billow", kBillow},
     {"cbrt", "write `pow(x, 1/3)`"},
     {"clamp01", "write `clamp(x, 0, 1)`"},
     {"cross", "write `(a.y*b.z - a.z*b.y, a.z*b.x - a.x*b.z, a.x*b.y - a.y*b.x)`"},
     {"degrees", "write `x/1deg`"},
     {"dist", "write `length(a - b)`"},
     {"distance", "write `length(a - b)`"},
     {"dot", "write `a.x*b.x + a.y*b.y + a.z*b.z`"},
     {"elevation", kHeights},
     {"exp", "write `pow(2.718281828, x)`"},
     {"exp2", "write `pow(2, x)`"},
     {"fbm", "write `import \"std/noise.sgm\" as noise;` at the top and `noise.fbm(period 8m, amp 1m)` here"},
     {"float2", "write `(x, y)`"},
     {"fmod", kRemainder},
     {"group", "write `{ ... }`"},
     {"heightfield", kHeights},
     {"heightmap", kHeights},
     {"hull", "there is no convex hull: write a `prism`, or a `union smooth` of the shapes"},
     {"hypot", "write `sqrt(a*a + b*b)`"},
     {"inversesqrt", "write `1/sqrt(x)`"},
     {"linear_extrude", "write `prism(h, (x, z), ...)`, or `extrude` over a footprint"},
     {"ln", kNoLogarithm},
     {"log", kNoLogarithm},
     {"log2", kNoLogarithm},
     {"magnitude", "write `length(v)`"},
     {"minkowski", kLarger},
     {"mod", kRemainder},
     {"modulo", kRemainder},
     {"norm", "write `length(v)`"},
     {"normalise", kUnitVector},
     {"normalize", kUnitVector},
     {"normalized", kUnitVector},
     {"offset", kLarger},
     {"pi", "write `180deg` for an angle, `3.14159265` for a number"},
     {"polygon", "write `prism(h, (x, z), (x, z), (x, z))`"},
     {"polyhedron", "import it as an asset: `import \"bay.glb\" as bay;` and `fit bay;`"},
     {"position", "write `p`, the point in the world, or `q`, the point in the scope"},
     {"radians", "write `x*1deg`"},
     {"ridged", "write `import \"std/noise.sgm\" as noise;` at the top and `noise.ridged(period 8m, amp 1m)` here"},
     {"rotatex", "write `rot(x, 30deg)` in front of the shape"},
     {"rotatey", "write `rot(y, 30deg)` in front of the shape"},
     {"rotatez", "write `rot(z, 30deg)` in front of the shape"},
     {"round", "write `floor(x + 0.5)`"},
     {"rsqrt", "write `1/sqrt(x)`"},
     {"saturate", "write `clamp(x, 0, 1)`"},
     {"sign", "write `if x < 0 then -1 else 1`"},
     {"smax", "write `meet smooth 0.5m { ... }` around the shapes"},
     {"smin", "write `union smooth 0.5m { ... }` around the shapes"},
     {"smoothmin", "write `union smooth 0.5m { ... }` around the shapes"},
     {"sqr", "write `x*x`"},
     {"step", "write `if x < edge then 0 else 1`"},
     {"tan", "write `sin(a)/cos(a)`"},
     {"tau", "write `360deg` for an angle, `6.2831853` for a number"},
     {"terrain", kHeights},
     {"time", "there is no time: write an animated parameter, `param t = 0 in 0..1 animated;`"},
     {"turbulence", kBillow},
     {"vec2", "write `(x, y)`"},
     {"vector", "write `(x, y, z)`"}}};

constexpr bool byTheirs(const Foreign& a, const Foreign& b) { return a.theirs < b.theirs; }
static_assert(std::is_sorted(kWords.begin(), kWords.end(), byTheirs));
static_assert(std::is_sorted(kHints.begin(), kHints.end(), byTheirs));

template <class Table>
std::string_view wordIn(const Table& table, std::string_view foreign) {
  std::string word(foreign);
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto found = std::lower_bound(table.begin(), table.end(), Foreign{word, {}}, byTheirs);
  return found == table.end() || found->theirs != word ? std::string_view() : found->ours;
}

}  // namespace

std::string_view wordFor(std::string_view foreign) { return wordIn(kWords, foreign); }

std::string hintFor(std::string_view foreign) {
  if (const std::string_view ours = wordFor(foreign); !ours.empty()) return join({"write `", ours, "`"});
  return std::string(wordIn(kHints, foreign));
}

}  // namespace sgm
