// Tests the contents of a checked program.

#include <limits>
#include <thread>

#include "catch.h"
#include "compile_text.h"

using namespace sgm;
using namespace sgm::test;

TEST_CASE("parameters have dimension, range and doc", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; param r = 50cm in 0m..2m \"radius\"; param n = 3 in 1..9; param f = 0.5 in 0..1; param w = 50% in "
      "0%..100%; "
      "param bare = 30deg; start A; rule A { sphere(r); }");
  REQUIRE(result.program);
  const Program& p = *result.program;
  REQUIRE(p.params.size() == 5);
  CHECK(p.params[0].dim == kLength);
  CHECK(p.params[0].value == 0.5);
  CHECK(p.params[0].high == 2);
  CHECK(p.text(p.params[0].doc) == "radius");
  CHECK_FALSE(p.params[0].whole);
  CHECK(p.params[1].whole);
  CHECK_FALSE(p.params[2].whole);
  CHECK(p.params[3].value == 0.5);
  CHECK_FALSE(p.params[4].has_range);
  CHECK(p.params[4].low == p.params[4].value);
  CHECK(p.findParam("n") == 1);
  CHECK(p.findParam("x") == kNoId);
}

TEST_CASE("a call keeps its name while its arguments bring many new ones", "[grammar][program]") {
  // The parser cannot know that `above -2m` is a named argument and not a subtraction. Only the checker knows the
  // callee, and thus the names of its arguments.
  std::string sum = "1m";
  for (int i = 100; i < 160; ++i) {
    const CompileResult result = compileText("sgm 1; start A; rule A {\nhalfspace(below " + sum + ", above -2m);\n}");
    INFO(sum);
    CHECK(brief(result.diagnostics) == "2:1 argument-count");
    sum += " + 0.0" + std::to_string(i) + "m";
  }
}

TEST_CASE("layers are sorted so that each uses lower ones", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; domain infinite;\nlayer c cell 8m reach 4m uses b, a { start A; }\nlayer b cell 16m reach 4m uses a { "
      "start A; }\n"
      "layer a cell 32m reach 4m { start A; }\nrule A { sphere(1m); }");
  REQUIRE(result.program);
  const Program& p = *result.program;
  REQUIRE(p.layers.size() == 3);
  CHECK(p.text(p.layers[0].name) == "a");
  CHECK(p.text(p.layers[1].name) == "b");
  CHECK(p.text(p.layers[2].name) == "c");
  CHECK(std::vector<uint32_t>(p.layers[2].uses.begin(), p.layers[2].uses.end()) == std::vector<uint32_t>{0, 1});
  CHECK(p.layers[0].cell == Int3{32768, 32768, 32768});
  CHECK(p.layers[0].reach == 4096);
}

TEST_CASE("a layer shows where cells are not larger than every detail around its shapes", "[grammar][program]") {
  constexpr int32_t kEvery = std::numeric_limits<int32_t>::max();
  const auto contents = [](const std::string& rules) {
    const CompileResult result = compileText(
        "sgm 1; param fine = 20cm in 10cm..50cm; param open = 20cm; domain infinite;\n"
        "layer l cell 8m reach 20m { start A; }\n" +
        rules);
    INFO(brief(result.diagnostics));
    REQUIRE(result.program);
    return result.program->layers[0];
  };
  // 257 is one unit more than 25 cm, because the interval arithmetic rounds outwards.
  CHECK(contents("rule A { detail 25cm { sphere(1m); } }").coarsest_cell == 257);
  CHECK(contents("rule A { detail 25cm { B(); } } rule B { sphere(1m); }").coarsest_cell == 257);
  CHECK(contents("rule A { detail 25cm { B(); } B(); } rule B { sphere(1m); }").coarsest_cell == kEvery);
  CHECK(contents("rule A { detail 25cm sphere(1m); detail 1m { detail 50cm cut { box(1m); } } }").coarsest_cell == 513);
  CHECK(contents("rule A { B(); } rule B depth 3 -> C() { B(); } rule C { detail 25cm box(1m); }").coarsest_cell ==
        257);
  CHECK(contents("rule A { B(); } rule B depth 3 -> box(1m) { B(); }").coarsest_cell == kEvery);
  CHECK(contents("rule A { detail fine box(1m); }").coarsest_cell == 513);
  CHECK(contents("rule A { detail open box(1m); }").coarsest_cell == kEvery);
  CHECK(contents("rule A { B(30cm); } rule B(r) { detail r box(1m); }").coarsest_cell == kEvery);
  CHECK(contents("rule A { detail 0.01*scope.x box(1m); }").coarsest_cell == kEvery);
  CHECK(contents("rule A { morph(B(), B(), 0.5); } rule B { detail 25cm box(1m); }").coarsest_cell == 257);
  CHECK(contents("rule A { detail -2*2000000m box(1m); }").coarsest_cell == 1);
  const auto declared = [](const std::string& clause) {
    const CompileResult result = compileText("sgm 1; domain infinite; layer l cell 8m reach 20m " + clause +
                                             " { start A; } rule A { detail 25cm sphere(1m); }");
    INFO(brief(result.diagnostics));
    REQUIRE(result.program);
    return result.program->layers[0].coarsest_cell;
  };
  CHECK(declared("detail 12.5cm") == 128);
  CHECK(declared("detail 1m") == 257);
  CHECK(compileText("sgm 1; domain infinite; layer l cell 8m reach 20m detail 0m { start A; } rule A { }").program ==
        nullptr);
  const Layer marks = contents("rule A { anchor spawn; }");
  CHECK(marks.coarsest_cell == 0);
  CHECK(marks.anchors);
  CHECK(contents("rule A { detail 1m { B(); } } rule B { anchor spawn; sphere(1m); }").anchors);
  CHECK_FALSE(contents("rule A { sphere(1m); }").anchors);
}

TEST_CASE("axes without cells have no cell edge", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; domain infinite axes xz solid earth output density; layer a cell 8m reach 4m { start A; } rule A { "
      "at(0m, 900m, 0m) sphere(1m); }");
  REQUIRE(result.program);
  CHECK(result.program->layers[0].cell == Int3{8192, 0, 8192});
  CHECK(result.program->domain.solid);
  CHECK(result.program->domain.density);
  CHECK(result.program->domain.density_edge == 10 * 1024);
  CHECK(result.program->materials[result.program->domain.material] == "earth");
}

TEST_CASE("a density's edge is a constant length, and another meaning", "[grammar][program]") {
  const auto compiled = [](const std::string& clause) {
    return compileText("sgm 1; let wide = 4m; domain finite box(8m) output density" + clause +
                       "; start A; rule A { sphere(1m); }");
  };
  const CompileResult plain = compiled(""), wide = compiled(" edge 3*wide"), twelve = compiled(" edge 12m solid rock");
  REQUIRE(plain.program);
  REQUIRE(wide.program);
  REQUIRE(twelve.program);
  CHECK(wide.program->domain.density_edge == 12 * 1024);
  CHECK(twelve.program->domain.density_edge == 12 * 1024);
  CHECK(twelve.program->domain.solid);
  CHECK(wide.program->hash != plain.program->hash);
  CHECK(wide.program->canonical.find("domain finite box(8m) output density edge 3*wide;") != std::string::npos);
}

TEST_CASE("materials and tags hold for their whole block", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; start A; rule A { sphere(1m); mat gold; tag \"a.b\"; { mat tin; box(1m); } anchor spawn \"x\"; }");
  REQUIRE(result.program);
  const Program& p = *result.program;
  CHECK(p.materials.size() == 3);
  CHECK(p.materials[0].empty());
  const StmtNode& body = p.stmt(p.rules[0].alternatives[0].body);
  CHECK(p.materials[body.material] == "gold");
  CHECK(p.tags[body.tag] == "a.b");
  const StmtNode& inner = p.stmt(p.idAt(body.children, 3));
  CHECK(p.materials[inner.material] == "tin");
  CHECK(inner.tag == 0);
  const StmtNode& anchor = p.stmt(p.idAt(body.children, 4));
  CHECK(p.names[anchor.extra] == "spawn");
  CHECK(p.names[anchor.extra2] == "x");
}

TEST_CASE("arguments are bound by position, name and default", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; start A; let f(a, b = 2, c = 3) = a + b + c; rule A { truncone(3m, bottom 1m, top 2m); sphere(f(1, c "
      "5)*1m); }");
  REQUIRE(result.program);
  const Program& p = *result.program;
  const StmtNode& body = p.stmt(p.rules[0].alternatives[0].body);
  const ExprNode& cone = p.expr(p.stmt(p.idAt(body.children, 0)).expr);
  CHECK(cone.ref == Ref::primitive);
  CHECK(cone.id == static_cast<uint32_t>(Primitive::truncone));
  REQUIRE(cone.bound.count == 3);
  CHECK(p.expr(p.idAt(cone.bound, 1)).value == 2);
  CHECK(p.expr(p.idAt(cone.bound, 2)).value == 1);
  const ExprNode& product = p.expr(p.idAt(p.expr(p.stmt(p.idAt(body.children, 1)).expr).bound, 0));
  const ExprNode& call = p.expr(p.idAt(product.children, 0));
  CHECK(call.ref == Ref::let);
  REQUIRE(call.bound.count == 3);
  CHECK(p.expr(p.idAt(call.bound, 1)).value == 2);
  CHECK(p.expr(p.idAt(call.bound, 2)).value == 5);
}

TEST_CASE("draws and statements are numbered within their rule", "[grammar][program]") {
  const char* rule = "rule B { at(rand(0m, 1m), rand(0m, 1m), 0m) sphere(rand(1m, 2m)); }";
  auto ordinals = [&](const std::string& before) {
    const CompileResult result = compileText("sgm 1; start A; " + before + " rule A { B; } " + rule);
    REQUIRE(result.program);
    std::vector<uint32_t> out;
    for (const ExprNode& n : result.program->ast.exprs)
      if (n.ref == Ref::builtin && n.id == static_cast<uint32_t>(Builtin::rand) && n.span.begin > before.size() + 20)
        out.push_back(n.ordinal);
    std::sort(out.begin(), out.end());
    return out;
  };
  CHECK(ordinals("") == std::vector<uint32_t>{0, 1, 2});
  CHECK(ordinals("rule C { sphere(1m); }") == ordinals(""));
}

TEST_CASE("the hash is of the meaning, not of the layout", "[grammar][program]") {
  auto hashOf = [](const char* text) {
    const CompileResult result = compileText(text);
    INFO(renderDiagnostics(result));
    REQUIRE(result.program);
    return result.program->hash;
  };
  const uint64_t hash = hashOf("sgm 1; start A; rule A { sphere(0.25m + 1m*2); }");
  CHECK(hash == hashOf("sgm 1;\n// a comment\nstart A;\n\nrule A {\n  sphere((25cm) + (1m*2));  // another\n}\n"));
  CHECK(hash != hashOf("sgm 1; start A; rule A { sphere((0.25m + 1m)*2); }"));
  // The hash omits everything on which the world does not depend, such as `animated`, because edits are stored with
  // this hash.
  const uint64_t of_param = hashOf("sgm 1; param r = 1m in 1m..2m; start A; rule A { sphere(r); }");
  CHECK(of_param == hashOf("sgm 1; param r = 1m in 1m..2m animated; start A; rule A { sphere(r); }"));
  CHECK(of_param == hashOf("sgm 1; param r = 1m in 1m..2m \"wide\"; start A; rule A { sphere(r); }"));
  CHECK(of_param == hashOf("sgm 1; param r = 1m in 1m..2m; start A; rule A { sphere(r); } expect components == 1;"));
  CHECK(of_param != hashOf("sgm 1; param r = 1m in 1m..3m; start A; rule A { sphere(r); }"));
  CHECK(hash != hashOf("sgm 1; start A; rule A { sphere(0.26m + 1m*2); }"));
  CHECK(hash != hashOf("sgm 1; start B; rule B { sphere(0.25m + 1m*2); }"));

  MapResolver resolver;
  auto imported = [&](const char* text) {
    resolver.files["a.sgm"] = text;
    return compileText("sgm 1; import \"a.sgm\" as a; start A; rule A { a.B; }", &resolver).program->hash;
  };
  const uint64_t with = imported("sgm 1; rule B { sphere(1m); }");
  CHECK(with == imported("sgm 1;\nrule B {\n sphere(100cm);\n}"));
  CHECK(with != imported("sgm 1; rule B { sphere(2m); }"));
}

TEST_CASE("compiling is a pure function, on any thread", "[grammar][program]") {
  const char* text =
      "sgm 1; import \"std/rock.sgm\" as rock; start A; rule A { displace rock.fbm(2m, 0.1m) { sphere(2m); } }";
  const uint64_t hash = compileText(text).program->hash;
  std::vector<std::thread> threads;
  std::array<uint64_t, 4> hashes{};
  for (uint64_t& h : hashes) threads.emplace_back([&h, text] { h = compileText(text).program->hash; });
  for (std::thread& thread : threads) thread.join();
  for (uint64_t h : hashes) CHECK(h == hash);
}

TEST_CASE("expectations are kept", "[grammar][program]") {
  const CompileResult result = compileText(
      "sgm 1; start A; rule A { sphere(1m); } expect watertight; expect components(air) == 1 in block(8); report "
      "volume; "
      "expect volume in 1m3..5m3 per A;");
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  const auto& e = result.program->expectations;
  REQUIRE(e.size() == 4);
  CHECK(e[0].measure == Measure::watertight);
  CHECK(e[1].block == 8);
  CHECK(e[1].value_number == 1);
  CHECK_FALSE(e[2].expect);
  CHECK(e[3].high_number == 5);
  CHECK(e[3].per == 0);
}
