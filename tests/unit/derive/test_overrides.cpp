// Tests overrides: blocks replace the shapes that rules derive, nothing else changes, and the blocks keep their places.

#include <map>
#include <set>

#include "derive/changed_shapes.h"
#include "derive_fixture.h"
#include "random_rules.h"
#include "rounds.h"

using namespace sgm;

namespace {

constexpr uint64_t kEditSeed = 7;

std::vector<RuleInstance> usesOf(const Program& program, std::string_view rule, Int3 cell, uint32_t layer = 0) {
  auto uses = deriveInstances(program, ParameterValues::defaults(program), kEditSeed, layer, cell,
                              program.findRule(rule), Ceiling(1 << 30));
  REQUIRE(uses);
  return *std::move(uses);
}

std::string withEdit(const std::string& text, const std::string& path, const std::string& block) {
  return text + "override \"" + path + "\" " + block + "\n";
}

std::vector<ChangedShape> changes(const Program& before, const Program& after, Int3 cell) {
  const GrammarChunk a = derived(before, cell), b = derived(after, cell);
  return changedShapes({before, &a}, {after, &b});
}

std::string inLayer(const std::string& rules) {
  return "sgm 1; domain infinite;\nlayer net cell 64m reach 128m { start Main; }\n" + rules + "\n";
}

/// The kinds of the root shapes of a cell's groups, in the order of derivation.
std::vector<ShapeKind> kinds(const Program& program, Int3 cell = {}) {
  const GrammarChunk chunk = derived(program, cell);
  std::vector<ShapeKind> out;
  for (const Group& g : chunk.groups) out.push_back(chunk.shapes[g.root].kind);
  return out;
}

using Kinds = std::vector<ShapeKind>;

}  // namespace

TEST_CASE("an override that derives what was there changes no byte", "[override]") {
  const unsigned texts = rounds(60);
  size_t edits = 0, programs = 0;
  for (uint64_t seed = 1; seed <= texts; ++seed) {
    const std::string text = RandomRules(seed).program(false);
    const CompileResult plain = compileGrammar(text, "test.sgm");
    if (!plain.program) continue;
    const Program& before = *plain.program;
    std::string with = text;
    std::set<std::string> paths;
    for (const char* rule : {"R0", "R1", "R2", "R3", "Deep", "Body", "Fine"})
      for (const Int3 cell : {Int3{0, 0, 0}, Int3{-2, 1, 5}}) {
        const std::vector<RuleInstance> uses = usesOf(before, rule, cell);
        for (size_t i = 0; i < uses.size() && i < 3; ++i) paths.insert(uses[(i * 7) % uses.size()].path);
      }
    for (const std::string& path : paths) {
      with = withEdit(with, path, "{ inner; }");
      with = withEdit(with, path.substr(path.find('/') + 1), "{ { } inner; }");
    }
    INFO("seed " << seed << "\n" << with);
    const CompileResult after = compileGrammar(with, "test.sgm");
    INFO(renderDiagnostics(after));
    REQUIRE(after.program);
    for (const Int3 cell : {Int3{0, 0, 0}, Int3{-2, 1, 5}, Int3{3, 0, 0}}) {
      const GrammarChunk a = derived(before, cell), b = derived(*after.program, cell);
      CHECK(hashChunk(a) == hashChunk(b));
      CHECK(a.parameters == b.parameters);
      CHECK(a.notes.size() == b.notes.size());
    }
    edits += paths.size();
    ++programs;
  }
  CHECK(programs > texts / 3);
  CHECK(2 * edits > 5 * texts);
}

TEST_CASE("what is left out of one cell changes that cell alone", "[override]") {
  const unsigned texts = rounds(60);
  size_t changed = 0;
  for (uint64_t seed = 1; seed <= texts; ++seed) {
    const std::string text = RandomRules(seed).program(false);
    const CompileResult plain = compileGrammar(text, "test.sgm");
    if (!plain.program) continue;
    const Int3 at{1, -1, 0};
    for (const char* rule : {"R1", "R3", "Body"}) {
      const std::vector<RuleInstance> uses = usesOf(*plain.program, rule, at);
      if (uses.empty()) continue;
      const std::string with = withEdit(text, uses.back().path, "{ }");
      INFO("seed " << seed << "\n" << with);
      const CompileResult after = compileGrammar(with, "test.sgm");
      INFO(renderDiagnostics(after));
      // To bound a displaced sum, the compiler needs its largest shape. If the override has removed that shape, the
      // text does not compile.
      const bool unproven = text.find("fractal(2m) sum") != std::string::npos && !after.program;
      if (unproven) continue;
      REQUIRE(after.program);
      changed += !changes(*plain.program, *after.program, at).empty();
      for (const Int3 other : {Int3{0, 0, 0}, Int3{1, -1, 1}, Int3{-1, 1, 0}}) {
        CHECK(changes(*plain.program, *after.program, other).empty());
        CHECK(hashChunk(derived(*plain.program, other)) == hashChunk(derived(*after.program, other)));
      }
    }
  }
  CHECK(changed > texts / 2);
}

TEST_CASE("only the shapes of what is named change", "[override]") {
  const std::string text = inLayer(
      "rule Main { repeat 4 at(9m, 0m, 0m) Ball(rand(1m, 3m)); }\n"
      "rule Ball(r) { at(rand(0m, 2m), 0m, 0m) sphere(r); anchor here; }");
  const auto before = compiled(text);
  const auto after = compiled(withEdit(text, "net(0, 0, 0)/Main/Ball[2]", "{ at(0m, 5m, 0m) inner; box(r); }"));
  const GrammarChunk a = derived(*before), b = derived(*after);
  REQUIRE(a.groups.size() == 4);
  REQUIRE(b.groups.size() == 5);
  // The override derives the original ball 5 m higher, and adds a box whose size is r, the parameter of the replaced
  // call of Ball.
  CHECK(b.shapes[b.groups[2].root].size == a.shapes[a.groups[2].root].size);
  CHECK(b.shapes[b.groups[2].root].frame.origin ==
        saturatingAdd(a.shapes[a.groups[2].root].frame.origin, {0, 5 * kUnitsPerMetre, 0}));
  CHECK(b.groups[2].key == a.groups[2].key);
  CHECK(b.shapes[b.groups[3].root].size[0] * 2 == a.shapes[a.groups[2].root].size[0]);
  CHECK(changes(*before, *after, {}).size() == 3 + 2);
}

TEST_CASE("overrides hold on when rules are edited elsewhere", "[override]") {
  const std::string path = "net(0, 0, 0)/Main/Ball[1]";
  const auto box = [&](const std::string& main, const std::string& more) {
    const auto program = compiled(withEdit(inLayer("rule Main { " + main + " }\n" + more), path, "{ box(2m); }"));
    const GrammarChunk chunk = derived(*program);
    std::vector<Int3> boxes;
    for (const Shape& s : chunk.shapes)
      if (s.kind == ShapeKind::box) boxes.push_back(s.frame.origin);
    REQUIRE(boxes.size() == 1);
    return boxes[0];
  };
  const std::string balls = "at(3m, 0m, 0m) Ball; at(9m, 0m, 0m) Ball; at(15m, 0m, 0m) Ball;";
  const std::string rules = "rule Ball { sphere(1m); }";
  const Int3 place = box(balls, rules);
  CHECK(place == Int3{9 * kUnitsPerMetre, 0, 0});
  CHECK(box("let a = rand(0m, 1m); sphere(a); Pole; { mat stone; Pole; } " + balls,
            "rule Pole { cylinder(1m, 5m); }\n" + rules) == place);
  CHECK(box("for i in 0..3 { at(1m*i, 7m, 0m) Pole; } " + balls + " Pole;",
            rules + "\nrule Unused { }\nrule Pole when rand(0, 1) < 2 { cylinder(1m, 5m); }\nlet b = 3m;") == place);
}

TEST_CASE("what another override puts beside it moves no address", "[override]") {
  const std::string text = inLayer("rule Main { Two; }\nrule Two { Ball; Ball; }\nrule Ball { sphere(1m); }") +
                           "override \"Main/Two/Ball[1]\" { box(1m); }\n";
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box;
  CHECK(kinds(*compiled(text)) == Kinds{s, b});
  CHECK(kinds(*compiled(withEdit(text, "Main/Two", "{ Ball; Ball; inner; Two; }"))) == Kinds{s, s, s, b, s, s});
  CHECK(kinds(*compiled(withEdit(text, "Main", "{ Two; inner; }"))) == Kinds{s, s, s, b});
}

TEST_CASE("no path leads into the block of an override", "[override]") {
  const std::string text = inLayer(
      "rule Main { Tree(2); }\nrule Tree(n) when n > 0 { Ball; Tree(n - 1); }\nrule Tree(n) else { }\n"
      "rule Ball { sphere(1m); }");
  const std::string below = text + "override \"Main/Tree/Tree/Ball\" { box(1m); }\n";
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box;
  CHECK(kinds(*compiled(below)) == Kinds{s, b});
  CHECK(kinds(*compiled(withEdit(below, "Main/Tree", "{ Ball; }"))) == Kinds{s});
  CHECK(kinds(*compiled(withEdit(below, "Main/Tree", "{ Ball; inner; }"))) == Kinds{s, s, b});
}

TEST_CASE("`inner` stands where it is written, as a call there would", "[override]") {
  const std::string rules = "rule Ball { at(1m, 0m, 0m) sphere(1m); at(cell.center) box(1m); }";
  const auto frames = [](const Program& program) {
    std::vector<Frame> out;
    for (const Shape& s : derived(program, {1, 2, 3}).shapes) out.push_back(s.frame);
    return out;
  };
  const std::vector<Frame> moved =
      frames(*compiled(inLayer("rule Main { at(3m, 4m, 5m) rot(y, 90deg) Ball; }\n" + rules)));
  REQUIRE(moved.size() == 2);
  CHECK(frames(*compiled(withEdit(inLayer("rule Main { Ball; }\n" + rules), "Main/Ball",
                                  "{ at(3m, 4m, 5m) rot(y, 90deg) inner; }"))) == moved);
}

TEST_CASE("the path that a message prints is what an override names", "[override]") {
  class Files : public ImportResolver {
    Result<std::string> read(std::string_view, size_t) override {
      return std::string("sgm 1;\nrule Hall(r) { sphere(r); Deep(r); }\nrule Deep(r) { scale(-r/r) sphere(r); }\n");
    }
  } files;
  CompileOptions options;
  options.resolver = &files;
  const std::string text =
      "sgm 1; import \"lib.sgm\" as lib;\ndomain infinite;\nlayer net cell 64m reach 64m { start Main; }\n"
      "rule Main { Hall(1m); lib.Hall(2m); lib.Hall(3m); }\nrule Hall(r) { box(r); }\n";
  const auto program = compileGrammar(text, "test.sgm", options).program;
  REQUIRE(program);
  const GrammarChunk chunk = derived(*program, {0, -3, 0});
  REQUIRE(chunk.notes.size() == 2);
  CHECK(chunk.notes[1].path == "net(0, -3, 0)/Main/lib.Hall[1]/Deep[0]");
  for (const DeriveNote& note : chunk.notes) {
    const CompileResult with = compileGrammar(withEdit(text, note.path, "{ box(r); }"), "test.sgm", options);
    INFO(renderDiagnostics(with));
    REQUIRE(with.program);
    const GrammarChunk after = derived(*with.program, {0, -3, 0});
    REQUIRE(after.notes.size() == 1);
    CHECK(after.notes[0].path != note.path);
    CHECK(changes(*program, *with.program, {}).empty());
  }
}

TEST_CASE("what a path leaves out may be any", "[override]") {
  const std::string text = inLayer(
      "rule Main { Two; at(20m, 0m, 0m) Two; }\nrule Two { Ball; at(5m, 0m, 0m) Ball; }\n"
      "rule Ball { sphere(1m); }");
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box;
  const auto with = [&](const std::string& path, Int3 cell = {}) {
    return kinds(*compiled(withEdit(text, path, "{ box(1m); }")), cell);
  };
  CHECK(with("Main/Two[1]/Ball[0]") == Kinds{s, s, b, s});
  CHECK(with("Main/Two/Ball[0]") == Kinds{b, s, b, s});
  CHECK(with("Main/Two[0]/Ball") == Kinds{b, b, s, s});
  CHECK(with("Main/Two/Ball") == Kinds{b, b, b, b});
  CHECK(with("Main/Two[1]") == Kinds{s, s, b});
  CHECK(with("Main") == Kinds{b});
  CHECK(with("net(0, 0, 1)/Main/Two/Ball") == Kinds{s, s, s, s});
  CHECK(with("net(0,0, 1 )/Main/Two/Ball", {0, 0, 1}) == Kinds{b, b, b, b});
}

TEST_CASE("overrides stand on each other, the more special and then the later outside", "[override]") {
  const std::string text = inLayer("rule Main { Ball(2m); }\nrule Ball(r) { tag \"ball\"; sphere(r); }");
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box, t = ShapeKind::torus, c = ShapeKind::cylinder;
  const std::string by_tag = "override tag \"ball\" { inner; cylinder(1m, 1m); }\n";
  const std::string in_cell = "override \"net(0, 0, 0)/Main/Ball[0]\" { inner; box(1m); }\n";
  const std::string everywhere = "override \"Main/Ball\" { inner; torus(2m, 1m); }\n";
  for (const std::string& order : {by_tag + in_cell + everywhere, in_cell + everywhere + by_tag}) {
    CHECK(kinds(*compiled(text + order)) == Kinds{s, c, t, b});
    CHECK(kinds(*compiled(text + order), {1, 0, 0}) == Kinds{s, c, t});
  }
  CHECK(kinds(*compiled(text + in_cell + "override \"Main/Ball\" { box(3m); }\n")) == Kinds{b, b});
  CHECK(kinds(*compiled(text + by_tag + "override \"Main/Ball\" { box(3m); }\n")) == Kinds{b});
  CHECK(kinds(*compiled(text + everywhere + "override \"Main/Ball\" { inner; box(3m); }\n")) == Kinds{s, t, b});
}

TEST_CASE("an override by a room's name takes the place of what stands in the room, not of the room", "[override]") {
  const std::string rules =
      "rule Main { at(20m, 20m, 20m) size(12m, 3m, 9m) { box(scope); cut treemap { hall 8: { sphere(1m); cut box(2m); "
      "}\n"
      "  den 20: Den; bed 9: { tag \"quiet\"; torus(2m, 1m); } bath 7: anchor room; } } }\n"
      "rule Den { sphere(1m); anchor room; }";
  const auto shapesOf = [&](const std::string& edit) {
    const auto program = compiled(inLayer(rules) + edit);
    std::map<ShapeKind, int> count;
    const GrammarChunk chunk = derived(*program, {});
    for (const Shape& s : chunk.shapes) ++count[s.kind];
    return std::pair(count, chunk.anchors.size());
  };
  auto plain = shapesOf("");
  for (const char* name : {"hall", "den", "quiet", "bath"}) {
    INFO(name);
    const auto same = shapesOf(std::string("override tag \"") + name + "\" { inner; }\n");
    CHECK(same == plain);
    CHECK(hashChunk(derived(*compiled(inLayer(rules)), {})) ==
          hashChunk(derived(*compiled(inLayer(rules) + "override tag \"" + name + "\" { inner; }\n"), {})));
  }
  auto more = plain;
  ++more.first[ShapeKind::capsule];
  CHECK(shapesOf("override tag \"den\" { inner; capsule((0m, 0m, 0m), (1m, 0m, 0m), 1m); }") == more);
  // The room remains. In the room, the override replaces the original sphere and anchor: it cuts a capsule instead.
  auto other = plain;
  --other.first[ShapeKind::sphere];
  --other.second;
  ++other.first[ShapeKind::subtract];
  ++other.first[ShapeKind::capsule];
  CHECK(shapesOf("override tag \"den\" { cut capsule((0m, 0m, 0m), (1m, 0m, 0m), 1m); }") == other);
  auto bare = plain;
  --bare.second;
  CHECK(shapesOf("override tag \"bath\" { }") == bare);
  // The room's name is the tag of the room's block only if the block sets no tag of its own.
  CHECK(compileGrammar(inLayer(rules) + "override tag \"bed\" { }", "test.sgm").program == nullptr);
}

TEST_CASE("an override by tag takes the place of every block with the tag, wherever that stands", "[override]") {
  const std::string text = inLayer(
      "rule Main { A; B(1m); sum { tag \"x\"; blob(2m); at(1m, 0m, 0m) blob(2m); }\n"
      "  meet { tag \"x\"; sphere(3m); box(4m); } displace 1m*fractal(3m) { tag \"x\"; box(2m); } C; }\n"
      "rule A { detail 2m at(1m, 2m, 3m) { tag \"x\"; let r = rand(1m, 2m); sphere(r); } }\n"
      "rule B(r) weight 1 { tag \"x\"; box(r); }\nrule B(r) weight 1 { sphere(rand(1m, 9m)); }\n"
      "morphic Body(r) : { tag \"x\"; sphere(r); } -> box(r) by 0.5;\nrule C { Body(2m); tag \"y\"; }");
  const auto plain = compiled(text), same = compiled(text + "override tag \"x\" { inner; }\n"),
             ice = compiled(text + "override tag \"x\" { mat ice; inner; }\n"),
             none = compiled(text + "override tag \"x\" { }\n");
  for (int x = 0; x < 20; ++x) {
    const GrammarChunk a = derived(*plain, {x, 0, 0}), b = derived(*same, {x, 0, 0}), c = derived(*ice, {x, 0, 0}),
                       d = derived(*none, {x, 0, 0});
    CHECK(hashChunk(a) == hashChunk(b));
    REQUIRE(a.shapes.size() == c.shapes.size());
    for (size_t i = 0; i < a.shapes.size(); ++i) {
      const Shape& shape = c.shapes[i];
      CHECK((ice->materials[shape.material] == "ice") == (ice->tags[shape.tag] == "x"));
      CHECK(shape.size == a.shapes[i].size);
    }
    for (const Shape& shape : d.shapes) CHECK(none->tags[shape.tag] != "x");
  }
}

TEST_CASE("a material around `inner` holds over its own, and over those of other rules alone not", "[override]") {
  const std::string text = inLayer("rule Main { Ball; }\nrule Ball { mat stone; sphere(1m); { mat gold; box(1m); } }");
  const auto names = [&](const std::string& block) {
    const auto program = compiled(withEdit(text, "Main/Ball", block));
    const GrammarChunk chunk = derived(*program);
    std::string out;
    for (const Group& g : chunk.groups) out += std::string(program->materials[chunk.shapes[g.root].material]) + " ";
    return out;
  };
  CHECK(names("{ inner; }") == "stone gold ");
  CHECK(names("{ mat ice; inner; }") == "ice ice ");
  CHECK(names("{ { mat ice; inner; } sphere(2m); }") == "ice ice  ");
  CHECK(names("{ mat ice; Ball; sphere(2m); }") == "stone gold ice ");
}

TEST_CASE("overrides do not hold in their own blocks, so that none is without end", "[override]") {
  const std::string text = inLayer(
      "rule Main { Tree(3); }\nrule Tree(n) when n > 0 { tag \"t\"; sphere(1m*n); at(0m, 3m, 0m) Tree(n - 1); }\n"
      "rule Tree(n) else { box(1m); }");
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box, t = ShapeKind::torus;
  CHECK(kinds(*compiled(text)) == Kinds{s, s, s, b});
  // The override calls the same rule with another argument; uses of the rule below it have other paths, so the override
  // does not apply to them.
  CHECK(kinds(*compiled(withEdit(text, "Main/Tree", "{ Tree(n - 2); }"))) == Kinds{s, b});
  CHECK(kinds(*compiled(withEdit(text, "Main/Tree/Tree", "{ Tree(5); }"))) == Kinds{s, s, s, s, s, s, b});
  CHECK(kinds(*compiled(text + "override tag \"t\" { torus(3m, 1m); Tree(1); }\n")) == Kinds{t, s, b});
  // The original (`inner`) derives further trees, to which the override applies as well.
  CHECK(kinds(*compiled(text + "override tag \"t\" { torus(3m, 1m); inner; }\n")) == Kinds{t, s, t, s, t, s, b});
  // Two overrides whose blocks call each other's rules.
  const std::string two =
      inLayer("rule Main { A; }\nrule A { tag \"a\"; sphere(1m); }\nrule B { tag \"b\"; box(1m); }");
  CHECK(kinds(*compiled(two + "override tag \"a\" { B; }\noverride tag \"b\" { A; }\n")) == Kinds{s});
  CHECK(kinds(*compiled(two + "override tag \"a\" { B; inner; }\noverride tag \"b\" { inner; A; }\n")) ==
        Kinds{b, s, s});
}

TEST_CASE("overrides of rules with heads: guards, depth, size and levels hold in `inner`", "[override]") {
  const std::string text = inLayer(
      "rule Main { Deep(4m); Far; }\nrule Deep(r) depth 3 -> box(r) { sphere(r); at(5m, 0m, 0m) Deep(0.5*r); }\n"
      "rule Far lod 2m { box(9m); }\nrule Far weight 2 { sphere(9m); }\nrule Far weight 1 { sphere(8m); anchor far; }");
  const ShapeKind s = ShapeKind::sphere, b = ShapeKind::box;
  const auto plain = compiled(text);
  for (int x = 0; x < 10; ++x)
    CHECK(hashChunk(derived(*plain, {x, 0, 0})) ==
          hashChunk(derived(
              *compiled(text + "override \"Main/Far\" { inner; }\noverride \"Main/Deep/Deep\" { { inner; } }\n"),
              {x, 0, 0})));
  CHECK(kinds(*compiled(withEdit(text, "Main/Deep/Deep/Deep", "{ }"))) == Kinds{s, s, s, b});
  CHECK(kinds(*compiled(withEdit(text, "Main/Deep/Deep/Deep/Deep", "{ sphere(1m); }"))) == Kinds{s, s, s, s, s, b});
}

TEST_CASE("copies of `inner` differ as copies of a rule do, and the first stays", "[override]") {
  const std::string text = inLayer("rule Main { Ball; }\nrule Ball { sphere(rand(1m, 9m)); }");
  const auto sizes = [&](const std::string& block) {
    const GrammarChunk chunk = derived(*compiled(block.empty() ? text : withEdit(text, "Main/Ball", block)));
    std::vector<float> out;
    for (const Shape& s : chunk.shapes) out.push_back(s.size[0]);
    return out;
  };
  const float first = sizes("")[0];
  const std::vector<float> two = sizes("{ inner; at(3m, 0m, 0m) inner; repeat 3 at(1m, 0m, 0m) inner; }");
  CHECK(two[0] == first);
  CHECK(std::set<float>(two.begin(), two.end()).size() == 5);
  const std::vector<float> loop = sizes("{ repeat 3 at(1m, 0m, 0m) inner; }");
  CHECK(std::set<float>(loop.begin(), loop.end()).size() == 3);
  CHECK(sizes("{ at(3m, 0m, 0m) rot(y, 30deg) inner; }") == std::vector<float>{first});
  CHECK(sizes("{ scale(2) inner; }") == std::vector<float>{2 * first});
}

TEST_CASE("an override of a start cuts the domain as the start does", "[override]") {
  const std::string text = inLayer("rule Main { cut { Hall; } sphere(1m); }\nrule Hall { sphere(9m); }");
  const auto cuts = [&](const std::string& path, const std::string& block) {
    std::string out;
    for (const Group& g : derived(*compiled(withEdit(text, path, block))).groups) out += g.cut ? "cut " : "add ";
    return out;
  };
  CHECK(cuts("Main", "{ inner; }") == "add cut ");
  CHECK(cuts("Main", "{ inner; cut { box(5m); } }") == "add cut cut ");
  CHECK(cuts("Main", "{ at(1m, 0m, 0m) inner; box(5m); }") == "add add cut ");
  CHECK(cuts("Main/Hall", "{ inner; box(20m); }") == "add cut cut ");
  CHECK(cuts("Main/Hall", "{ }") == "add ");
}

TEST_CASE("a cell that is named and lacks the path says so, and no other", "[override]") {
  const std::string text = inLayer(
      "rule Main when rand(0, 1) < 0.5 { Ball; at(9m, 0m, 0m) Ball; }\nrule Main else { }\n"
      "rule Ball { sphere(1m); Fruit; }\nrule Fruit { sphere(2m); }");
  int with = 0, without = 0;
  for (int x = 0; x < 12; ++x) {
    const std::string cell = "net(" + std::to_string(x) + ", 0, 0)";
    const auto message = [&](const std::string& path, int at) -> std::string {
      const GrammarChunk chunk = derived(*compiled(withEdit(text, path, "{ }")), {at, 0, 0});
      if (chunk.notes.empty()) return "";
      REQUIRE(chunk.notes.size() == 1);
      CHECK(chunk.notes[0].line == 7);
      CHECK(chunk.notes[0].column == 10);
      return chunk.notes[0].message + " in " + chunk.notes[0].path;
    };
    const std::string none = "this override finds nothing: there is no `Ball` here in " + cell + "/Main";
    const bool balls = !derived(*compiled(text), {x, 0, 0}).groups.empty();
    (balls ? with : without)++;
    CHECK(message(cell + "/Main/Ball[1]", x) == (balls ? "" : none));
    CHECK(message(cell + "/Main/Ball[2]", x) ==
          (balls ? "this override finds nothing: there are only 2 `Ball` here in " + cell + "/Main" : none));
    CHECK(message(cell + "/Main/Ball[1]/Fruit[1]", x) ==
          (balls ? "this override finds nothing: there is only one `Fruit` here in " + cell + "/Main/Ball[1]" : none));
    // Each ball has exactly one Fruit, so Fruit[1], which would be the second one, does not exist.
    CHECK(message(cell + "/Main/Ball/Fruit[1]", x) ==
          (balls ? "this override finds nothing: there is only one `Fruit` here in " + cell + "/Main/Ball[0]" : none));
    CHECK(message(cell + "/Main/Ball[2]", x + 1).empty());
    CHECK(message("Main/Ball[2]", x).empty());
  }
  CHECK(with > 0);
  CHECK(without > 0);
}

TEST_CASE("a shape of an override that passes the reach is left out, with the path", "[override]") {
  const std::string text = inLayer("param far = 1m in 0m..900m;\nrule Main { Ball; }\nrule Ball { sphere(1m); }");
  const auto program = compiled(withEdit(text, "net(0, 0, 0)/Main/Ball[0]", "{ at(far, 0m, 0m) { inner; box(1m); } }"));
  ParameterValues values = ParameterValues::defaults(*program);
  REQUIRE(values.set(*program, "far", 300));
  const auto chunk = deriveCell(*program, values, kEditSeed, 0, {}, Ceiling(1 << 30));
  REQUIRE(chunk);
  CHECK(chunk->groups.empty());
  REQUIRE(chunk->notes.size() == 2);
  CHECK(chunk->notes[0].path == "net(0, 0, 0)/Main/Ball[0]");
  CHECK(chunk->notes[1].path == "net(0, 0, 0)/Main/Ball[0]/override");
  CHECK(chunk->parameters == parameterBit(0));
  CHECK(derived(*program, {1, 0, 0}).parameters == 0);
}
