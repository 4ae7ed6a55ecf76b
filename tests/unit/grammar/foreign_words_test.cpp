// Tests messages about words of other languages: they must suggest the right words, and not the nearest spelling.

#include <set>
#include <string>

#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

const MessageCase kForeignCases[] = {
    {"2:17 unknown-name: unknown name `mod` | write `a - b*floor(a/b)`", "rule A { sphere(mod(3m, 2m)); }"},
    {"2:17 unknown-name: unknown name `dot` | write `a.x*b.x + a.y*b.y + a.z*b.z`",
     "rule A { sphere(dot((1, 0, 0), (1m, 0m, 0m))); }"},
    {"2:13 unknown-name: unknown name `normalize` | write `v/length(v)`",
     "rule A { at(normalize((1m, 2m, 0m))) box(1m); }"},
    {"2:10 unknown-name: unknown name `heightmap` | displace a half-space by a field: `displace 8m*fractal(60m) { "
     "halfspace(below 0m); }`; pictures are not read",
     "rule A { heightmap(\"hills.png\"); }"},
    {"2:10 wrong-use: `mix` gives a value and is not a shape | to blend two shapes, write `morph(A, B, 0.5);`",
     "rule A { mix(1, 2, 0.5); }"},
    {"2:10 wrong-use: `min` gives a value and is not a shape | to join two shapes, write `union { ... }`",
     "rule A { min(1, 2); }"},
    {"2:10 wrong-use: `max` gives a value and is not a shape | to keep what two shapes have in common, write `meet { "
     "... }`",
     "rule A { max(1, 2); }"},
    {"2:10 wrong-use: `abs` gives a value and is not a shape | write a shape such as sphere(2m), or a rule",
     "rule A { abs(1); }"},
    {"2:17 unknown-member: a point has no `length()` | write `length(...)` with the value within",
     "rule A { sphere((1m, 1m, 1m).length()); }"},
    {"2:19 bad-character: this character has no place here | write `a - b*floor(a/b)` for the remainder of a division",
     "rule A { sphere(a % b); }"},
    {"2:19 bad-character: this character has no place here | write `pow(a, b)`", "rule A { sphere(2 ^ 3*1m); }"},
    {"2:23 bad-character: this character has no place here | write `if a < b then c else d`",
     "rule A { sphere(1 < 2 ? 1m : 2m); }"},
    {"2:13 bad-character: this character has no place here | write a vector as `(x, y, z)`",
     "rule A { at([1, 2, 3) box(1m); }"},
};

/// A word of another language, and the text that the hint suggests in backquotes, or the whole hint if it suggests
/// none.
struct Word {
  const char *theirs, *ours;
};

const Word kValues[] = {
    {"lerp", "mix"},
    {"frac", "fract"},
    {"ceiling", "ceil"},
    {"perlin", "fractal"},
    {"Vec3", "vec"},
    {"saturate", "clamp(x, 0, 1)"},
    {"step", "write `if x < edge then 0 else 1`"},
    {"sign", "write `if x < 0 then -1 else 1`"},
    {"round", "floor(x + 0.5)"},
    {"tan", "sin(a)/cos(a)"},
    {"distance", "length(a - b)"},
    {"cross", "(a.y*b.z - a.z*b.y, a.z*b.x - a.x*b.z, a.x*b.y - a.y*b.x)"},
    {"exp", "pow(2.718281828, x)"},
    {"exp2", "pow(2, x)"},
    {"asin", "atan2(x, sqrt(1 - x*x))"},
    {"acos", "atan2(sqrt(1 - x*x), x)"},
    {"atan", "atan2(x, 1)"},
    {"inversesqrt", "1/sqrt(x)"},
    {"cbrt", "pow(x, 1/3)"},
    {"hypot", "sqrt(a*a + b*b)"},
    {"sqr", "x*x"},
    {"radians", "x*1deg"},
    {"degrees", "x/1deg"},
    {"vec2", "(x, y)"},
    {"vector", "(x, y, z)"},
    {"log", "there is no logarithm: write the value that it would give"},
    {"PI", "write `180deg` for an angle, `3.14159265` for a number"},
    {"tau", "write `360deg` for an angle, `6.2831853` for a number"},
    {"time", "there is no time: write an animated parameter, `param t = 0 in 0..1 animated;`"},
    {"position", "write `p`, the point in the world, or `q`, the point in the scope"},
    {"fbm", "write `import \"std/noise.sgm\" as noise;` at the top and `noise.fbm(period 8m, amp 1m)` here"},
    {"turbulence", "write `import \"std/noise.sgm\" as noise;` at the top and `noise.billow(period 8m, amp 1m)` here"},
    {"ridged", "write `import \"std/noise.sgm\" as noise;` at the top and `noise.ridged(period 8m, amp 1m)` here"},
};

const Word kShapes[] = {
    {"smin", "write `union smooth 0.5m { ... }` around the shapes"},
    {"smax", "write `meet smooth 0.5m { ... }` around the shapes"},
    {"group", "{ ... }"},
    {"hull", "there is no convex hull: write a `prism`, or a `union smooth` of the shapes"},
    {"offset", "write `displace -0.1m { ... }` to make a shape larger on all sides"},
    {"linear_extrude", "write `prism(h, (x, z), ...)`, or `extrude` over a footprint"},
    {"polyhedron", "import it as an asset: `import \"bay.glb\" as bay;` and `fit bay;`"},
    {"polygon", "prism(h, (x, z), (x, z), (x, z))"},
    {"rotateX", "write `rot(x, 30deg)` in front of the shape"},
    {"rotateY", "write `rot(y, 30deg)` in front of the shape"},
    {"rotateZ", "write `rot(z, 30deg)` in front of the shape"},
};

std::string hintOf(const std::string& rule) {
  const CompileResult result = compileText("sgm 1; start A;\nrule A { " + rule + " }");
  for (const Diagnostic& d : result.diagnostics)
    if (d.code == codes::kUnknownName) return d.hint;
  return renderDiagnostics(result);
}

}  // namespace

TEST_CASE("messages: words of other languages", "[grammar][messages]") {
  checkMessages(kForeignCases, {"sgm 1; start A;\n", ""});
}

TEST_CASE("words of shaders and modellers get what to write instead", "[grammar][messages]") {
  const auto wanted = [](const Word& word) {
    const std::string ours = word.ours;
    const bool whole = ours.starts_with("write ") || ours.starts_with("there ") || ours.starts_with("import ");
    return whole ? ours : "write `" + ours + "`";
  };
  for (const Word& word : kValues) {
    const std::string theirs = word.theirs;
    const bool name = theirs == "PI" || theirs == "tau" || theirs == "time" || theirs == "position";
    CHECK(hintOf("sphere(" + theirs + (name ? "" : "(1)") + ");") == wanted(word));
  }
  for (const Word& word : kShapes) CHECK(hintOf(word.theirs + std::string("(1);")) == wanted(word));
}

TEST_CASE("what hints say to write is right", "[grammar][messages]") {
  const char* values[] = {"a - b*floor(a/b)",     "a*1/length((1m, 1m, 0m))*1m",
                          "clamp(a/1m, 0, 1)*1m", "1m*(if a < 1m then 0.5 else 1)",
                          "1m*floor(a/1m + 0.5)", "1m*sin(30deg)/cos(30deg)",
                          "1m*pow(2, 2)",         "1m*(atan2(0.5, sqrt(1 - 0.5*0.5))/1deg)/90",
                          "1m*1/sqrt(4)",         "length((1m, 1m, 0m) - (0m, 1m, 0m))",
                          "1m*pow(8, 1/3)"};
  for (const char* value : values) {
    const CompileResult result = compileText(
        "sgm 1; start A; let a = 3m; let b = 2m; rule A { sphere(a + 0*b); sphere(" + std::string(value) + "); }");
    INFO(renderDiagnostics(result));
    CHECK(result.program);
  }
  CHECK(compileText("sgm 1; start A; rule A { meet { displace 8m*fractal(60m) { halfspace(below 0m); } box(9m); } }")
            .program);
}
