// Tests messages about divisions by 0, weights below 0 and values without a bound. Each message reports the cause at a
// line that the author can change, with a hint; the hint's text removes the error.

#include <cmath>
#include <string>

#include "grammar/range/interval.h"
#include "grammar/range/reach_values.h"
#include "messages.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

const MessageCase kZero[] = {
    {"4:20 divide-by-zero: division by zero | divide by a number other than 0", "rule A { sphere(1m/0); }"},
    {"4:20 divide-by-zero: division by zero: `z` is 0 here | divide by a number other than 0",
     "rule A { sphere(1m/z); }"},
    {"4:21 divide-by-zero: division by zero: `2*z` is 0 here | divide by a number other than 0",
     "rule A { sphere(1m/(2*z)); }"},
    {"4:40 divide-by-zero: division by zero: `w` is 0 here | divide by a number other than 0",
     "rule A { let w = rand(0, 0); sphere(1m/w); }"},
    {"4:46 divide-by-zero: division by zero: `n` is 0 here | divide by a number other than 0",
     "rule A { Post(0); } rule Post(n) { sphere(1m/n); }"},
    {"4:24 divide-by-zero: division by zero: `swing` divides by a value that is 0 with these arguments | give it "
     "arguments other than 0 | note: the division is at std/rock.sgm:89:48",
     "rule A { displace 0.1m*rock.swing(0m) { sphere(2m); } }"},
};

const MessageCase kWeights[] = {
    {"4:15 value-range: a weight is 0 or more, and this is -1 | write how often this head is drawn relative to the "
     "others, such as weight 2",
     "rule A weight -1 { sphere(1m); } rule A weight 2 { box(1m); }"},
    {"4:15 value-range: a weight is 0 or more, and this is -3 | write how often this head is drawn relative to the "
     "others, such as weight 2",
     "rule A weight low { sphere(1m); } rule A { box(1m); }\nlet low = -3 + 0;"},
    {"4:36 value-range: a weight is 0 or more, and this is at most -2 | write how often this head is drawn relative to "
     "the others, such as weight 2",
     "rule A { B(-2); } rule B(w) weight w { sphere(1m); } rule B(w) { box(1m); }"},
    {"4:37 warning value-range: this weight may be as low as -1 | below 0 it counts as 0: bound what it depends on, or "
     "write max(..., 0)",
     "param w = 1 in -1..2; rule A weight w { sphere(1m); } rule A { box(1m); }"},
    {"4:15 value-range: all heads of `A` have weight 0, so none is ever drawn | give one of them a weight above 0",
     "rule A weight 0 { sphere(1m); } rule A weight z { box(1m); }\nlet z = 0;"},
};

CompileResult grammar(const std::string& text) {
  return compileText("sgm 1; import \"std/rock.sgm\" as rock; import \"std/cloud.sgm\" as cloud;\n" + text);
}

/// The text with `from` replaced by the text of a hint.
std::string mended(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string between(const std::string& text, char mark) {
  const size_t open = text.find(mark), close = text.find(mark, open + 1);
  return close == std::string::npos ? "" : text.substr(open + 1, close - open - 1);
}

}  // namespace

TEST_CASE("messages: divisions by what is 0", "[grammar][messages]") {
  checkMessages(kZero,
                {"sgm 1; start A; import \"std/rock.sgm\" as rock;\nlet z = 0;\nfield f = z*rock.fbm(1m, 1m);\n", ""});
}

TEST_CASE("messages: weights below 0", "[grammar][messages]") {
  checkMessages(kWeights, {"sgm 1; start A;\n\n\n", ""});
}

TEST_CASE("what may be 0 or has no range is named, and the hint helps", "[grammar][reach]") {
  const auto told = [](const std::string& text) { return inWords(grammar(text)); };
  const std::string quotient = "start A;\nrule A { B(rand(0, 1)); }\nrule B(w) { sphere(1m/w); }";
  CHECK(told(quotient) ==
        "4:23 reach: cannot prove reach: `sphere` may extend without bound: `w`, the divisor, may be 0 | keep it away "
        "from "
        "0: `max(w, 0.1)`");
  CHECK(grammar(mended(quotient, "/w", "/" + between(grammar(quotient).diagnostics[0].hint, '`'))).program);

  const std::string length = "start A;\nrule A { B(rand(-1m, 1m)); }\nrule B(w) { sphere(1m*(1m/w)); }";
  CHECK(grammar(mended(length, "/w", "/" + between(grammar(length).diagnostics[0].hint, '`'))).program);

  // If a unit is missing from a value, the hint explains how to add it.
  CHECK(told("start A;\nrule A { B(rand(-1m, 1m)); }\nrule B(w) { sphere(1m2*1m2*1m/(w*w*w*w)); }") ==
        "4:32 reach: cannot prove reach: `sphere` may extend without bound: `w*w*w*w`, the divisor, may be 0 | keep it "
        "away from 0: a parameter's range, or max()");

  const std::string free = "start A;\nparam size_ = 3m;\nrule A { sphere(2*size_); }";
  CHECK(told(free) ==
        "4:10 reach: cannot prove reach: `sphere` may extend without bound: the parameter `size_` has no range | give "
        "it one: `param size_ = 3m in 0m..6m`");
  CHECK(grammar(mended(free, "param size_ = 3m", between(grammar(free).diagnostics[0].hint, '`'))).program);
  CHECK(told("start A;\nparam a = -3m;\nrule A { sphere(a); }") ==
        "4:10 reach: cannot prove reach: `sphere` may extend without bound: the parameter `a` has no range | give it "
        "one: `param a = -3m in LOW..HIGH`");

  // A quotient may be part of any value: a position, a scale, a copy's step, an amplitude, or a blend.
  for (const char* rule :
       {"rule A { at(y 2m/(n - 1)) sphere(1m); }", "rule A { at(2m/(n - 1), 0m, 0m) { sphere(1m); } }",
        "rule A { let gap = 2m/(n - 1); at(gap, 0m, 0m) sphere(1m); }", "rule A { scale(1/(n - 1)) sphere(1m); }",
        "rule A { repeat 3 at(x 2m/(n - 1)) { sphere(1m); } }",
        "rule A { displace noise.fbm(period 1m, amp 1m/(n - 1)) { sphere(1m); } }",
        "rule A { union smooth 1m/(n - 1) { sphere(1m); } }"}) {
    const CompileResult placed =
        grammar("import \"std/noise.sgm\" as noise;\nstart A;\nparam n = 1 in 1..5;\n" + std::string(rule));
    INFO(inWords(placed));
    REQUIRE(placed.diagnostics.size() == 1);
    CHECK(placed.diagnostics[0].message.ends_with("may extend without bound: `n - 1`, the divisor, may be 0"));
    CHECK(placed.diagnostics[0].hint == "keep it away from 0: `max(n - 1, 0.1)`");
  }

  // For an error in a library's rule, the message names the line of the call.
  const CompileResult cloudy = grammar("start A;\nrule A { cloud.Cumulus(rand(0m, 500m)); }");
  CHECK(
      inWords(cloudy) ==
      "3:10 reach: cannot prove reach: `Cumulus` may extend without bound | give it a size that cannot come near to "
      "0, such as `max(r, 1m)` for r | note: the bound is lost at std/cloud.sgm:31:12\n"
      "3:24 warning argument-range: `cloud.Cumulus` may be given `r` = 0m..500m, not all of which is within 1m..20km | "
      "bound what it depends on, or write clamp(..., 1m, 20km)");
  CHECK(grammar("start A;\nrule A { cloud.Cumulus(max(rand(0m, 500m), 1m)); }").program);
}

TEST_CASE("all shapes that pass the reach are told at once, and one declaration has room for them",
          "[grammar][reach]") {
  const auto layer = [](int cell, int reach) {
    return "domain infinite; layer l cell " + std::to_string(cell) + "m reach " + std::to_string(reach) +
           "m { start A; }\n";
  };
  const std::string rules =
      "rule A { sphere(5m);\n  at(9m, 0m, 0m) sphere(2m);\n  at(cell.center) sphere(1m);\n  B; }\nrule B { box(30m); }";
  const CompileResult result = grammar(layer(8, 4) + rules);
  INFO(renderDiagnostics(result));
  CHECK(brief(result.diagnostics) == "3:10 reach; 6:3 reach");
  for (const Diagnostic& d : result.diagnostics) CHECK(d.hint == "raise reach to 15 m or make the shape smaller");
  CHECK(grammar(layer(8, 15) + rules).program);

  // If the required reach would span too many cells, the cell must grow as well, and with it everything that depends on
  // cell.size.
  const std::string far = "rule A { sphere(100m);\n at(3*cell.size) sphere(1m); }";
  const CompileResult wide = grammar(layer(8, 4) + far);
  INFO(renderDiagnostics(wide));
  REQUIRE(wide.diagnostics.size() == 2);
  CHECK(wide.diagnostics[0].hint == "raise cell to 25 m and reach to 100 m, or make the shape smaller");
  CHECK(grammar(layer(25, 100) + far).program);

  // A shape whose position grows with the cell size fits no cell, so the hint suggests a smaller shape.
  const CompileResult endless = grammar(layer(8, 4) + "rule A { at(9*cell.size) sphere(1m); }");
  REQUIRE(endless.diagnostics.size() == 1);
  CHECK(endless.diagnostics[0].hint == "make the shape smaller");

  const std::string box = "domain finite box(4m); start A;\nrule A { sphere(9m);\n  at(0m, 12m, 0m) box(1m); }";
  const CompileResult boxed = grammar(box);
  INFO(renderDiagnostics(boxed));
  REQUIRE(boxed.diagnostics.size() == 2);
  CHECK(boxed.diagnostics[1].hint == "write `box(18m, 26m, 18m)`, or make the shape smaller");
  CHECK(grammar(mended(box, "box(4m)", between(boxed.diagnostics[0].hint, '`'))).program);

  const std::string scope = "start A;\nrule A { box(scope); }";
  const CompileResult boxless = grammar(scope);
  REQUIRE(boxless.diagnostics.size() == 1);
  CHECK(boxless.diagnostics[0].hint == "give the domain a box: `domain finite box(20m, 20m, 20m);`");
  CHECK(grammar(between(boxless.diagnostics[0].hint, '`') + scope).program);

  CHECK(inWords(grammar("start A;\nrule A { at(1100km, 0m, 0m) sphere(1m); }")) ==
        "3:29 reach: cannot prove reach: `sphere` may extend 1100001 m from its origin | make the shape smaller");
}

TEST_CASE("a value that is used twice is the same both times", "[grammar][reach]") {
  const auto proven = [](const std::string& text) {
    const CompileResult result = grammar("domain infinite; layer l cell 400m reach 1600m { start A; }\n" + text);
    INFO(text << "\n" << renderDiagnostics(result));
    const bool good = result.program && result.program->layers[0].proven;
    CHECK(good);
    return good ? result.program->layers[0].bound.hi[0] / 1024.0 : 0.0;
  };
  // The bound follows values through arguments, lets, parameters, functions and loops.
  CHECK(proven("rule A { cloud.Cumulus(rand(250m, 500m)); }") < 1600);
  CHECK(proven("rule A { cloud.Cumulus(rand(1m, 500m)); }") < 1600);
  CHECK(proven("rule A { let r = rand(50m, 500m); displace 0.1*r*fractal(9m) { sum { blob(r); } } }") < 900);
  CHECK(proven("param r = 90m in 50m..500m;\nrule A { displace 0.1*r*fractal(9m) { sum { blob(r); } } }") < 900);
  CHECK(proven("rule A { for i in 1..40 { displace 0.1m*i*fractal(9m) { sum { blob(1m*i); } } } }") < 80);
  CHECK(proven("let part(r) = r/(r - 0.5*r);\nrule A { sphere(1m*part(rand(1, 9))); }") < 20);
  CHECK(proven("rule A { B(rand(0m, 1599m)); } rule B(r) { at(r, 0m, 0m) sphere(max(1599m - r, 1m)); }") <= 2000);
  CHECK(proven("rule A { B(rand(1, 2)); } rule B(w) { sphere(1m*w/(w - 0.5*w)); }") < 9);
}

TEST_CASE("what is proven in pieces holds for every value", "[grammar][reach]") {
  // Random quotients of one value, which occurs in both numerator and denominator: compares the proven bound with the
  // actual values.
  uint64_t state = 7;
  const auto draw = [&](uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % below;
  };
  unsigned bounded = 0;
  for (unsigned round = 0; round < rounds(200); ++round) {
    const double low = 0.25 * static_cast<double>(1 + draw(8)), high = low + 0.25 * static_cast<double>(draw(24));
    const double a = 0.25 * static_cast<double>(1 + draw(6)), b = 0.125 * static_cast<double>(draw(8)),
                 c = 0.25 * static_cast<double>(draw(8));
    const auto number = [](double v) { return std::to_string(v); };
    const std::string value =
        "(" + number(a) + "*r - " + number(b) + "*r + " + number(c) + ")/(r*" + number(a) + " - " + number(b) + "*r)";
    const CompileResult result =
        grammar("domain infinite; layer l cell 500m reach 2000m { start A; }\nrule A { B(rand(" + number(low) + ", " +
                number(high) + ")); }\nrule B(r) { sphere(1m*max(0, " + value + ")); }");
    if (!result.program || !result.program->layers[0].proven) continue;
    ++bounded;
    const double bound = result.program->layers[0].bound.hi[0] / 1024.0;
    double most = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double r = low + (high - low) * i / 1000;
      const double v = (a * r - b * r + c) / (r * a - b * r);
      if (std::isfinite(v)) most = std::max(most, v);
    }
    INFO("round " << round << ": " << value << " of " << low << ".." << high);
    CHECK(most <= bound + 0.002);
  }
  CHECK(2 * bounded > rounds(200));
}
