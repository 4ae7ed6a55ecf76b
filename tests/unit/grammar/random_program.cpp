#include "random_program.h"

#include <array>

#include "base/hash.h"

namespace sgm::test {

namespace {

class Writer {
 public:
  explicit Writer(uint64_t seed) : key_{seed} {}

  std::string program() {
    out_ = "sgm 1;\n";
    if (chance(30)) comment();
    out_ += "import \"std/noise.sgm\" as noise;\n";
    out_ += "param size_ = 2m in 1m..3m \"a \\\"doc\\\"\";\nparam count = 3 in 1..5;\n";
    out_ += "let twice(x) = 2*x;\nfield wave(amp, period = 2m" + range() + ") = amp*fractal(period);\n";
    out_ += "domain finite box(4000m, 4000m, 4000m);\nlayer under cell 4000m reach 4000m { start R4(2m); }\n";
    out_ += "layer main cell 4000m reach 4000m uses under { start R0(1m); }\n";
    for (int r = 0; r < 4; ++r) rule(r);
    out_ += "rule R4(r" + range() + ") { sphere(r); }\nmorphic M(r" + range() +
            ") : sphere(r) -> box(r, r, 2*r) by 0.5" + std::string(pick({"", " power", " lerp"})) + ";\n";
    for (int i = 0; i < 3; ++i) edit();
    if (chance(50)) out_ += "expect volume in 1m3..2m3 per R0;\nreport area;\n";
    return out_;
  }

 private:
  uint64_t draw(uint64_t below) { return hashCombine(key_.value, ++count_) % below; }
  bool chance(uint64_t percent) { return draw(100) < percent; }
  const char* pick(std::initializer_list<const char*> list) { return list.begin()[draw(list.size())]; }
  /// The range of a formal parameter: none, or one so wide that it contains all lengths.
  std::string range() { return pick({"", " in -900km..900km", " in -(900km)..2 *  450km"}); }
  void comment() { out_ += std::string("// note ") + std::to_string(draw(100)) + (chance(30) ? "  \n\n\n" : "\n"); }
  void blank() {
    const uint64_t kind = draw(12);
    if (kind == 0) comment();
    out_ += kind == 1 ? "\n\n" : kind < 5 ? "\n" : " ";
  }

  void rule(int r) {
    level_ = r;
    if (chance(30)) comment();
    const std::string head = "rule R" + std::to_string(r) + "(r)";
    const uint64_t kind = draw(4);
    const char* guards[] = {"", " when r > 0.5m and not (r >= 90m)", " weight 2", " depth 3 -> R4(r) lod 1m"};
    out_ += head + guards[kind];
    block(0);
    out_ += "\n";
    if (kind == 1) out_ += head + " else { }\n";
    if (kind == 2) out_ += head + " weight count { M(r); }\n";
  }

  void edit() {
    if (chance(30)) comment();
    out_ += std::string("override ") + pick({"\"R0\"", "tag \"t\"", "\"R0/M[0]\"", "\"main( 0,0, 0)/R0\""});
    if (chance(30)) {
      out_ += "{inner;mat ice;{at(1m,0,0)inner;}}\n";
      return;
    }
    block(2);
    out_ += "\n";
  }

  void block(int depth) {
    blank();
    out_ += '{';
    const uint64_t count = draw(4);
    for (uint64_t i = 0; i < count; ++i) {
      blank();
      statement(depth + 1);
    }
    blank();
    out_ += '}';
  }

  void body(int depth) {
    if (chance(60) || depth > 5)
      block(depth);
    else
      statement(depth);
  }

  void statement(int depth) {
    if (depth > 5) {
      out_ += "sphere(r);";
      return;
    }
    switch (draw(23)) {
      case 0:
        out_ += "sphere(" + length(0) + ");";
        return;
      case 1:
        out_ += "box(" + length(0) + ", " + length(0) + "," + length(0) + ");";
        return;
      case 2:
        out_ += "truncone(" + length(1) + ", bottom " + "0.5*r" + ", top r);";
        return;
      case 3:
        out_ += "R" + std::to_string(level_ + 1) + "(" + length(2) + ");";
        return;
      case 4:
        out_ += "union" + std::string(pick({" ", " smooth 0.2m "}));
        return body(depth + 1);
      case 5:
        out_ += "cut ";
        return block(depth + 1);
      case 6:
        out_ += "morph(sphere(r), { box(r); }, " + ratio(0) + ")" + pick({"", " lerp"}) + ";";
        return;
      case 7:
        out_ += "displace wave(amp 0.1m" + std::string(pick({"", ", period = 3m", ", period r"})) + ") ";
        return body(depth + 1);
      case 8:
        out_ += chance(30) ? "at(cell.point()) " : "at(" + length(0) + ", 0, -1m) ";
        out_ += pick({"", "rot(y, 30deg) ", "mirror(x) scale(0.5) "});
        return body(depth + 1);
      case 9:
        out_ += "repeat count rot(z, -90deg) ";
        return body(depth + 1);
      case 10:
        out_ += "for i" + std::to_string(depth) + " in 0..count ";
        return block(depth + 1);
      case 11:
        out_ += "scatter 3 on " + std::string(pick({"disc(r)", "shell(r, up 60%)", "box(r, r, r)"})) +
                pick({" ", " when chance(50%) "});
        return body(depth + 1);
      case 12:
        out_ += "{ let v" + std::to_string(depth) + " = " + length(0) + "; tag \"t\"; mat stone; } ";
        return;
      case 13:
        out_ += "anchor spawn" + std::string(pick({"", " \"n\""})) + ";";
        return;
      case 14:
        out_ += "detail 5cm ";
        return body(depth + 1);
      case 15:
        out_ += "for s" + std::to_string(depth) + " in branch(" + pick({"count", "3"}) + ", step r, turn 20deg" +
                pick({"", ", fork 0.1", ", fork = 30%"}) + ") { capsule(s" + std::to_string(depth) + ".from, s" +
                std::to_string(depth) + ".to, rand(s" + std::to_string(depth) + ", 0.1m, " + length(2) + ")); }";
        return;
      case 16:
        out_ += std::string(pick({"", "", "snap x  2m ", "snap y 3m from(r) "})) + "split " + pick({"x", "y", "z"}) +
                pick({"", "", " snap 0.5*r "}) + "{ ";
        if (chance(50)) out_ += "0.5*r: ", body(depth + 1), blank();
        if (chance(60))
          out_ += "{ ~2m: ", body(depth + 1), out_ += pick({"}*", " 1m: sphere(r); }*;", "; } * "}), blank();
        out_ += pick({"25%: ", "~size_:", "~(r): "});
        body(depth + 1);
        blank();
        out_ += "}";
        return;
      case 17:
        out_ += "comp { " + std::string(pick({"front: ", "side :", "edges:", "inside: "}));
        body(depth + 1);
        blank();
        out_ += pick({"", "top: { }", "bottom: sphere(r);"});
        out_ += " }";
        return;
      case 18:
        out_ += std::string("treemap") + pick({"", "(wall = 0.2m, door 1m)", "( 0.1m)"}) + "{ ";
        out_ += pick({"hall 2*3: ", "hall (1+2) : "});
        body(depth + 1);
        blank();
        out_ += "bath 4: sphere(r); " +
                std::string(pick({"", "link hall  bath by door ;", "link bath hall by door(0.9m);"}));
        if (chance(50)) out_ += "corridor: ", body(depth + 1), blank();
        out_ += pick({"", "facade :{ box(1m); }"});
        out_ += " }";
        return;
      case 19:
        out_ += std::string("wfc ") + pick({"2m", "( r,2m, size_ )", "(0.5*r)"}) + "{ ";
        out_ += pick({"", "border side sky , top air or sky;", "border bottom ground ;"});
        out_ += pick(
            {"wall 2*3 turn,left brick ,right brick: ",
             "wall 1 , left plug  meets hole or brick, right hole meets plug: ", "wall (1+2), side sky or  brick : "});
        body(depth + 1);
        blank();
        out_ +=
            pick({"", "grass count: { } ", "gate 1, side brick or sky, bottom ground, top air or ground:{ box(1m); }"});
        out_ += " }";
        return;
      case 21:
        out_ += "fit bay" + std::string(pick({"", " stretch x 0m..1m", " repeat  y (r)..2*r"})) +
                pick({"", " stretch z size_..if r > 1m then 2m else 3m"}) + ";";
        return;
      case 20:
        out_ += "{ footprint " +
                std::string(pick({"merge 3 rect(2m, r)", "merge count regular(5, r)", "rect(1m, z r)",
                                  "polygon((0, 0m), (r, 0m), (1m, 2m))"})) +
                " as plan; extrude " + length(0) + " of plan" + pick({";", " { sphere(r); mat stone; }"}) + " roof " +
                pick({"hip(30deg)", "gable(pitch = 40deg, overhang 10cm)", "flat("});
        out_ += out_.ends_with("flat(") ? length(1) + ")" : "";
        out_ += std::string(pick({"", " of plan"})) + "; }";
        return;
      default:
        out_ += "meet { sphere(r); halfspace(below " + length(1) + "); }";
        return;
    }
  }

  std::string length(int depth) {
    if (depth > 3) return pick({"r", "2m", "50cm", "size_", "1.5m"});
    switch (draw(9)) {
      case 0:
        return length(depth + 1) + pick({" + ", "-", " - "}) + "(" + length(depth + 1) + ")";
      case 1:
        return "(" + length(depth + 1) + " + r)*" + ratio(depth + 1);
      case 2:
        return "twice(" + length(depth + 1) + ")/2";
      case 3:
        return "min(" + length(depth + 1) + ", " + length(depth + 1) + ")";
      case 4:
        return "(if " + condition(depth + 1) + " then r else " + length(depth + 1) + ")";
      case 5:
        return "rand(0.5m, 1m)";
      case 6:
        return "(1m, r, size_).y";
      default:
        return pick({"r", "2m", "50cm", "size_", "(0.5*r)"});
    }
  }

  std::string ratio(int depth) {
    if (depth > 3) return pick({"0.5", "30%", "1"});
    switch (draw(5)) {
      case 0:
        return "(" + ratio(depth + 1) + "*" + ratio(depth + 1) + ")";
      case 1:
        return "clamp(" + length(depth + 1) + "/1m, 0, 1)";
      case 2:
        return "-(-" + ratio(depth + 1) + ")";
      default:
        return pick({"0.5", "30%", "0.25"});
    }
  }

  std::string condition(int depth) {
    switch (draw(3)) {
      case 0:
        return std::string(pick({"", "not "})) + "query" + pick({" clear ", "  inside "}) +
               (chance(50) ? length(depth + 1) + " " : "") + "of under" + pick({"", " and r > 1m"});
      default:
        return ratio(depth + 1) + " < 0.5";
    }
  }

  PathKey key_;
  uint64_t count_ = 0;
  int level_ = 0;
  std::string out_;
};

}  // namespace

std::string randomProgram(uint64_t seed) { return Writer(seed).program(); }

}  // namespace sgm::test
