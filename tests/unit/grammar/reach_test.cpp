#include <cmath>

#include "catch.h"
#include "compile_text.h"
#include "grammar/range/interval.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// The proven bound, in metres, of a rule in a grammar cell of 8 m.
struct Bound {
  bool compiled = false, proven = false;
  double lo[3] = {}, hi[3] = {};
  std::string brief, messages;
};

Bound boundOf(const std::string& body, const std::string& more = "", const std::string& reach = "30m") {
  const CompileResult result =
      compileText("sgm 1; import \"std/noise.sgm\" as noise; domain infinite;\nlayer l cell 8m reach " + reach +
                  " { start A; }\n" + more + "\nrule A { " + body + " }");
  Bound out;
  out.brief = brief(result.diagnostics);
  out.messages = renderDiagnostics(result);
  if (!result.program) return out;
  out.compiled = true;
  out.proven = result.program->layers[0].proven;
  for (int axis = 0; axis < 3; ++axis) {
    out.lo[axis] = result.program->layers[0].bound.lo[axis] / 1024.0;
    out.hi[axis] = result.program->layers[0].bound.hi[axis] / 1024.0;
  }
  return out;
}

void checkBound(const std::string& body, std::array<double, 3> lo, std::array<double, 3> hi,
                const std::string& more = "") {
  const Bound bound = boundOf(body, more);
  INFO(body << "\n" << bound.messages);
  REQUIRE(bound.compiled);
  CHECK(bound.proven);
  for (size_t axis = 0; axis < 3; ++axis) {
    INFO("axis " << axis);
    CHECK(bound.lo[axis] == Approx(lo[axis]).margin(0.003));
    CHECK(bound.hi[axis] == Approx(hi[axis]).margin(0.003));
  }
}

}  // namespace

TEST_CASE("bounds of shapes and transforms are tight where they can be", "[grammar][reach]") {
  checkBound("sphere(2m);", {-2, -2, -2}, {2, 2, 2});
  checkBound("box(2m, 4m, 6m);", {-1, -2, -3}, {1, 2, 3});
  checkBound("at(1m, 2m, 3m) sphere(1m);", {0, 1, 2}, {2, 3, 4});
  checkBound("rot(y, 90deg) at(4m, 0m, 0m) sphere(1m);", {-1, -1, -5}, {1, 1, -3});
  checkBound("mirror(x) at(4m, 0m, 0m) sphere(1m);", {-5, -1, -1}, {-3, 1, 1});
  checkBound("scale(2) at(1m, 0m, 0m) sphere(1m);", {0, -2, -2}, {4, 2, 2});
  checkBound("repeat 3 at(2m, 0m, 0m) sphere(1m);", {-1, -1, -1}, {5, 1, 1});
  checkBound("for i in 0..4 { at(1m*i, 0m, 0m) sphere(1m); }", {-1, -1, -1}, {4, 1, 1});
  checkBound("at(cell.center) sphere(1m);", {3, 3, 3}, {5, 5, 5});
  checkBound("at(cell.point(jitter 0.5)) sphere(1m);", {1, 1, 1}, {7, 7, 7});
  checkBound("sphere(rand(1m, 3m));", {-3, -3, -3}, {3, 3, 3});
  checkBound("truncone(4m, top 1m, bottom 2m);", {-2, -2, -2}, {2, 2, 2});
  checkBound("capsule((0m, 0m, 0m), (3m, 0m, 0m), 1m);", {-1, -1, -1}, {4, 1, 1});
  checkBound("tube((0m, 0m, 0m), (3m, 0m, 0m), 1m, bend 2m);", {-3, -3, -3}, {6, 3, 3});
  checkBound("prism(2m, (-1m, -2m), (3m, -2m), (0m, 4m));", {-1, -1, -2}, {3, 1, 4});
  checkBound("meet { sphere(2m); halfspace(below 1m); }", {-2, -2, -2}, {2, 1, 2});
  checkBound("union { sphere(2m); cut { halfspace(below 0m); } }", {-2, -2, -2}, {2, 2, 2});
  checkBound("size(2m, 4m, 6m) B;", {-1, -2, -3}, {1, 2, 3}, "rule B { box(scope); }");
  checkBound("scatter 9 on disc(3m) sphere(1m);", {-4, -1, -4}, {4, 1, 4});
  checkBound("scatter poisson(1m) sphere(1m);", {-1, -1, -1}, {9, 9, 9});
}

TEST_CASE("smoothing, displacement and sums enter the reach", "[grammar][reach]") {
  checkBound("union smooth 0.5m { sphere(2m); box(1m); }", {-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5});
  checkBound("displace noise.fbm(period 1m, amp 0.25m) { sphere(2m); }", {-2.25, -2.25, -2.25}, {2.25, 2.25, 2.25});
  checkBound("displace clamp(p.y, -1m, 0.5m) { sphere(2m); }", {-3, -3, -3}, {3, 3, 3});
  checkBound("displace p.y amp 1m { sphere(2m); }", {-3, -3, -3}, {3, 3, 3});
  checkBound("warp noise.swirl(period 1m, amp 0.5m) { sphere(2m); }", {-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5});
  checkBound("sum { blob(2m); }", {-3.2, -3.2, -3.2}, {3.2, 3.2, 3.2});
  checkBound("morph(sphere(1m), box(4m), p.y/1m);", {-2, -2, -2}, {2, 2, 2});
}

TEST_CASE("guards narrow what a parameter may be", "[grammar][reach]") {
  checkBound("B(rand(1m, 9m));", {-3, -3, -3}, {3, 3, 3},
             "rule B(r) when r < 3m { sphere(r); } rule B(r) else { box(1m); }");
  checkBound("B(rand(1m, 9m));", {-3, -3, -3}, {3, 3, 3},
             "rule B(r) when r > 3m { box(1m); } rule B(r) else { sphere(r); }");
  checkBound("B(3, 1m);", {-4, -4, -4}, {4, 4, 4},
             "rule B(n, r) when n > 0 { B(n - 1, r + 1m); } rule B(n, r) else { sphere(r); }");
  checkBound("B;", {-1, -1, -1}, {5, 1, 1}, "rule B depth 4 -> sphere(1m) { sphere(1m); at(1m, 0m, 0m) B; }");
}

TEST_CASE("a reach that cannot hold is an error, one that may not a warning", "[grammar][reach]") {
  CHECK(boundOf("sphere(4m);", "", "4m").brief.empty());
  CHECK(boundOf("sphere(5m);", "", "4m").brief == "4:10 reach");
  CHECK(boundOf("sphere(rand(3m, 5m));", "", "4m").brief == "4:10 reach-maybe");
  CHECK(boundOf("at(0m, 15m, 0m) sphere(rand(1m, 2m));", "", "4m").brief == "4:26 reach");
  CHECK(boundOf("displace p.y { sphere(1m); }").brief == "4:19 reach");
  CHECK(boundOf("halfspace(below 0m);").brief == "4:10 reach");
  CHECK(boundOf("sphere(1m/rand(0, 1));").brief == "4:20 reach");
  CHECK(boundOf("B(3m);", "rule B(r) { sphere(r); at(0m, 20m, 0m) C(r); } rule C(r) { sphere(r); }", "4m").brief ==
        "4:10 reach");
  const Bound bound = boundOf("B(14m);", "rule B(r) { sphere(r); }", "4m");
  CHECK(bound.messages.find("cannot prove reach: `B` may extend 14 m from its cell, layer `l` declares reach 4 m") !=
        std::string::npos);
}

TEST_CASE("a turned shape grows by its displacement and not by its corners", "[grammar][reach]") {
  const double half = 2 * std::sqrt(2.0) + 5;
  checkBound("displace 5m*fractal(20m) { rot(y, 45deg) box(4m); }", {-half, -7, -half}, {half, 7, half});
  checkBound("rot(y, 45deg) displace 5m*fractal(20m) { box(4m); }", {-half, -7, -half}, {half, 7, half});
  // A warp displaces points along the scope's axes, so a rotation of the scope rotates the displacement.
  const double turned = (1 + 2) * std::sqrt(0.5) + 2 * std::sqrt(0.5);
  checkBound("rot(y, 45deg) warp (1m*fractal(2m), 0m, 0m) { box(4m); }", {-turned, -2, -turned}, {turned, 2, turned});
  checkBound("scale(2) displace 1m*fractal(3m) { sphere(1m); }", {-4, -4, -4}, {4, 4, 4});
}

TEST_CASE("what is no distance grows faster when it is displaced", "[grammar][reach]") {
  checkBound("displace 1m*fractal(3m) { ellipsoid(10m, 1m, 1m); }", {-20, -11, -11}, {20, 11, 11});
  checkBound("B(10m);", {-15, -11, -15}, {15, 11, 15},
             "rule B(r) { displace 3m*fractal(9m) { ellipsoid(r, 0.6*r, r); } }");
  CHECK(boundOf("displace 1m*fractal(3m) { ellipsoid(rand(0m, 4m), 2m, 2m); }").brief == "4:19 reach");
  // Far from the leaves of a sum, the gradient of the sum's field is only 0.26 of its maximum.
  checkBound("displace 0.5m*fractal(3m) { sum { blob(2m); } }", {-3.2, -3.2, -3.2}, {3.2, 3.2, 3.2});
  const Bound bound = boundOf("displace 0.6m*fractal(3m) { sum { blob(2m); } }");
  CHECK(bound.brief == "4:19 reach");
  // The amplitude that the hint suggests is accepted.
  CHECK(boundOf("displace 0.5099m*fractal(3m) { sum { blob(2m); } }").proven);
  CHECK(bound.messages.find("than 0.51 m") != std::string::npos);
  // The bound uses the largest leaf if this leaf is always present.
  CHECK(boundOf("displace 0.5m*fractal(3m) { sum { blob(2m); blob(0.1m); } }").proven);
  CHECK(boundOf("displace 0.5m*fractal(3m) { sum { blob(0.1m); scatter 3 on disc(1m) when chance(50%) blob(2m); } }")
            .brief == "4:19 reach");
}

TEST_CASE("displaced operands of a meet that lie apart come together", "[grammar][reach]") {
  checkBound("displace 1m*fractal(3m) { meet { sphere(1m); at(3m, 0m, 0m) sphere(1m); } }", {0, -2, -2}, {3, 2, 2});
}

TEST_CASE("a parameter without a range may be anything", "[grammar][reach]") {
  CHECK(boundOf("sphere(2m*w);", "param w = 1;").brief == "4:10 reach");
  CHECK(boundOf("sphere(2m*clamp(w, 0, 1));", "param w = 1;").proven);
  CHECK(boundOf("sphere(2m*w);", "param w = 1 in 0..2;").proven);
}

TEST_CASE("counts are rounded as derivation rounds them", "[grammar][reach]") {
  checkBound("repeat 2.5 at(2m, 0m, 0m) sphere(1m);", {-1, -1, -1}, {5, 1, 1});
  checkBound("for i in 0..3.5 { at(1m*i, 0m, 0m) sphere(1m); }", {-1, -1, -1}, {4, 1, 1});
  checkBound("repeat 3 size(2*scope) B;", {-16, -16, -16}, {16, 16, 16},
             "rule B { box((min(scope.x, 32m), 32m, 32m)); }");
}

TEST_CASE("copies have sizes of which each follows from the one before", "[grammar][reach]") {
  checkBound("repeat 3 size(2*scope) box(scope);", {-16, -16, -16}, {16, 16, 16});
  checkBound("repeat 3 size(0.5*scope) box(scope);", {-4, -4, -4}, {4, 4, 4});
  checkBound("repeat 900 size(0.9*scope) box(scope);", {-4, -4, -4}, {4, 4, 4});
  checkBound("repeat 3 size(scope.x + 2m, 1m, 2*scope.z) box(scope);", {-6, -4, -16}, {6, 4, 16});
  checkBound("repeat 900 size(2m, 1m, 3m) box(scope);", {-4, -4, -4}, {4, 4, 4});
  CHECK_FALSE(boundOf("repeat 900 size(2*scope) box(scope);").compiled);
}

TEST_CASE("splits in splits are followed as deep as blocks may stand", "[grammar][reach]") {
  for (const int deep : {4, 8, 12, 16}) {
    CAPTURE(deep);
    std::string body = "box(scope);";
    for (int i = 0; i < deep; ++i)
      body = std::string("split ") + "xyz"[i % 3] + " { ~1m: box(scope); ~1m: { " + body + " } ~1m: box(scope); }";
    const Bound bound = boundOf(body);
    INFO(bound.messages);
    CHECK(bound.proven);
    CHECK(bound.hi[0] >= 4);
    CHECK(bound.hi[0] <= 30);
  }
}

TEST_CASE("sizes are those that come out, and scopes those of the moment", "[grammar][reach]") {
  checkBound("B(4m);", {-4, -4, -4}, {4, 4, 4}, "rule B(r) minsize 1m -> box(r) { sphere(r); scale(0.5) B(r); }");
  checkBound("size(2m, 2m, 2m) at(scope.x, 0m, 0m) sphere(1m);", {1, -1, -1}, {3, 1, 1});
  checkBound("at(1m, 0m, 0m) B;", {3, 3, 3}, {5, 5, 5}, "rule B { at(cell.center) sphere(1m); }");
  checkBound("scale(-1) sphere(1m);", {-1, -1, -1}, {1, 1, 1});
  checkBound("scale(rand(-1, 0.5)) sphere(2m);", {-2, -2, -2}, {2, 2, 2});
  checkBound("scatter 3 on shell(-2m, up 20%) sphere(1m);", {-3, -3, -3}, {3, -0.2, 3});
}

TEST_CASE("faces are counted from the cell they belong to", "[grammar][reach]") {
  checkBound("for f in cell.faces { at(f.other.center) sphere(1m); }", {3, 3, 3}, {13, 13, 13});
  checkBound("for f in cell.faces { for g in f.other.faces { at(g.other.center) sphere(1m); } }", {3, 3, 3},
             {21, 21, 21});
}

TEST_CASE("a branch reaches as far as all its steps in a line", "[grammar][reach]") {
  const std::string tree = "for s in branch(4, step 2m, turn 30deg, fork 50%) ";
  checkBound(tree + "{ at(s.to) sphere(1m); }", {-9, -9, -9}, {9, 9, 9});
  checkBound(tree + "{ capsule(s.from, s.to, 1m - 0.5m*s.along); }", {-9, -9, -9}, {9, 9, 9});
  checkBound(tree + "{ sphere(1m + 1m*s.depth); }", {-4, -4, -4}, {4, 4, 4});
  checkBound("for s in branch(2.4, step rand(1m, 3m), turn 0deg) { Limb(s); }", {-7, -7, -7}, {7, 7, 7},
             "rule Limb(s) { at(s.from) sphere(1m); }");
  checkBound("at(cell.center) rot(z, 90deg) " + tree + "{ at(s.to) sphere(1m); }", {-5, -5, -5}, {13, 13, 13});
  checkBound("for s in branch(0, step 2m, turn 30deg) { at(s.to) sphere(1m); }", {-1, -1, -1}, {1, 1, 1});
  // A count of branches without a range is bounded by the largest number of segments that a branch may have.
  const std::string any = "for s in branch(n, step 5mm, turn 0deg) { at(s.to) sphere(1m); }";
  CHECK(boundOf(any, "param n = 3;", "22m").proven);
  CHECK(boundOf(any, "param n = 3;", "21m").brief == "4:61 reach-maybe");
}

TEST_CASE("the corners of a beam's ends count", "[grammar][reach]") {
  const double r = std::sqrt(3.0);
  checkBound("beam((0m, 0m, 0m), (3m, 0m, 0m), 1m);", {-r, -r, -r}, {3 + r, r, r});
}

TEST_CASE("probes count", "[grammar][reach]") {
  const char* text =
      "sgm 1; domain infinite solid;\nlayer net cell 8m reach 4m { start A; }\nlayer drip cell 8m reach %s uses net { "
      "start D; }\n"
      "rule A { cut { at(cell.center) sphere(2m); } }\nrule D { scatter poisson(1m) probe up 4m of net { sphere(1m); } "
      "}";
  auto with = [&](const std::string& reach) {
    std::string out = text;
    return brief(compileText(out.replace(out.find("%s"), 2, reach)).diagnostics);
  };
  CHECK(with("5m").empty());
  CHECK(with("4m") == "5:51 reach-maybe");
}

TEST_CASE("a gap counts with the most that it may be", "[grammar][reach]") {
  const char* text =
      "sgm 1; domain infinite solid;\nlayer net cell 8m reach 4m { start A; }\nlayer drip cell 8m reach %s uses net { "
      "start D; }\nrule A { cut { at(cell.center) sphere(2m); } }\n"
      "rule D { scatter poisson(1m) probe up 1m of net gap h within 3m { at(0m, -h, 0m) sphere(h/2); } }";
  auto with = [&](const std::string& reach) {
    std::string out = text;
    return brief(compileText(out.replace(out.find("%s"), 2, reach)).diagnostics);
  };
  CHECK(with("5m").empty());
  CHECK(with("4m") == "5:82 reach-maybe");
}

TEST_CASE("a cellular automaton reaches one voxel beyond its cell", "[grammar][reach]") {
  const auto with = [](const std::string& reach, const std::string& rule) {
    return brief(compileText("sgm 1; param v = 1m in 0.5m..2m; domain infinite; layer a cell 8m reach " + reach +
                             " { start A; }\nrule A { " + rule + " }")
                     .diagnostics);
  };
  CHECK(with("1m", "ca(1m);").empty());
  CHECK(with("0.75m", "ca(1m);") == "2:10 reach");
  CHECK(with("2m", "ca(v);").empty());
  CHECK(with("1.75m", "ca(v);") == "2:10 reach-maybe");
  CHECK(with("1.5m", "displace 0.5m*fractal(4m) amp 0.5m { ca(1m); }").empty());
  CHECK(with("1.25m", "displace 0.5m*fractal(4m) amp 0.5m { ca(1m); }") == "2:47 reach-maybe");
  CHECK(with("1m", "meet { ca(v); at(4m, 4m, 4m) box(9m); }").empty());
}

TEST_CASE("a layer of voxels shows where cells are no larger than eight of them", "[grammar][reach]") {
  const auto coarsest = [](const std::string& rule) {
    const CompileResult result =
        compileText("sgm 1; domain infinite; layer a cell 8m reach 4m { start A; }\nrule A { " + rule + " }");
    REQUIRE(result.program);
    return result.program->layers[0].coarsest_cell;
  };
  const CompileResult threshold =
      compileText("sgm 1; domain infinite; layer a cell 8m reach 4m detail 0.3m { start A; }\nrule A { sphere(1m); }");
  REQUIRE(threshold.program);
  CHECK(threshold.program->layers[0].coarsest_cell == 307);
  CHECK(std::abs(coarsest("ca(1m);") - 4 * 1024) <= 8);
  CHECK(std::abs(coarsest("detail 2m { ca(1m); }") - 2 * 1024) <= 8);
  CHECK(coarsest("ca(1m); at(4m, 4m, 4m) sphere(1m);") == std::numeric_limits<int32_t>::max());
}

TEST_CASE("what a query looks at counts, wherever it stands", "[grammar][reach]") {
  auto with = [&](const std::string& reach, const std::string& rule) {
    return brief(compileText("sgm 1; domain infinite solid;\nlayer net cell 8m reach 4m { start A; }\n"
                             "layer drip cell 8m reach " +
                             reach +
                             " uses net { start D; }\nrule A { cut { at(cell.center) sphere(2m); } }\n"
                             "param r = 1m in 0m..3m;\n" +
                             rule)
                     .diagnostics);
  };
  const auto takes = [&](const std::string& enough, const std::string& little, const std::string& rule) {
    INFO(rule);
    CHECK(with(enough, rule).empty());
    CHECK(with(little, rule).find(" reach") != std::string::npos);
  };
  takes("3m", "2.75m", "rule D when query clear r of net { anchor spawn; }");
  takes("7m", "6.75m",
        "rule D { at(-1m, 0m, 0m) scale(2) Ask; } rule Ask when not query inside r of net { anchor spawn; }");
  takes("5m", "4.75m",
        "rule D { at(10m, 0m, 0m) rot(z, 45deg) Ask; } rule Ask when query clear r of net { anchor spawn; }");
  takes("0.5m", "0.25m", "rule D { at(8.5m, 0m, 0m) Ask; } rule Ask when query clear of net { anchor spawn; }");
  takes("6m", "5.75m", "rule D { Ask; at(11m, 0m, 0m) Ask; } rule Ask when query clear r of net { anchor spawn; }");
  takes("9m", "8.75m", "rule D { Ask; scale(3) Ask; } rule Ask when query clear r of net { anchor spawn; }");
  takes("8m", "7.75m", "rule D { scatter 3 on disc(5m) when query clear r of net { anchor spawn; } }");
  takes("3m", "2.75m", "rule D { scatter poisson(1m) when query clear r of net { anchor spawn; } }");
  takes(
      "5m", "4.75m",
      "rule D { scatter poisson(1m) probe down 2m of net Ask; } rule Ask when query clear r of net { anchor spawn; }");
  takes("4m", "3.75m",
        "rule D { for i in 0..4 { at(-i*1m/3, 0m, 0m) Ask; } } rule Ask when query clear r of net { anchor spawn; }");
  takes("3m", "2.75m", "rule D { let open = query clear r of net; sphere(if open then 0.1m else 0.2m); }");
  takes("3m", "2.75m", "rule D { Ask(query clear r of net); } rule Ask(open) when open { anchor spawn; }");
  takes("3m", "2.75m", "rule D { detail if query clear r of net then 1m else 2m { sphere(1m); } }");
}

TEST_CASE("a finite grammar without a box gets the bound of its shapes", "[grammar][reach]") {
  const CompileResult result = compileText("sgm 1; start A; rule A { at(3m, 0m, 0m) sphere(2m); }");
  REQUIRE(result.program);
  CHECK(result.program->domain.box == IntBox{{-6 * 1024, -3 * 1024, -3 * 1024}, {6 * 1024, 3 * 1024, 3 * 1024}});
  CHECK(brief(compileText("sgm 1; start A; rule A { halfspace(below 0m); }").diagnostics) == "1:26 reach");
  CHECK(brief(compileText("sgm 1; domain finite box(4m); start A; rule A { sphere(3m); }").diagnostics) ==
        "1:49 reach");
  CHECK(compileText("sgm 1; domain finite box(4m); start A; rule A { meet { halfspace(below 0m); sphere(2m); } }")
            .program);
}

TEST_CASE("interval arithmetic holds its values", "[grammar][reach]") {
  const Interval a{-2, 3}, b{1, 4};
  CHECK((a + b).lo <= -1);
  CHECK((a * b).hi >= 12);
  CHECK((a / b).lo <= -2);
  CHECK_FALSE((b / a).bounded());
  CHECK(absolute(a) == Interval{0, 3});
  CHECK(cosine({-0.1, 0.1}).hi == 1);
  CHECK(cosine({3.0, 3.3}).lo == -1);
  CHECK(sine({0, 7}) == Interval{-1, 1});
  CHECK(smoothStep({0, 0}, {1, 1}, {0.5, 2}).hi == Approx(1));
  CHECK(power({2, 3}, {2, 2}).hi >= 9);
}
