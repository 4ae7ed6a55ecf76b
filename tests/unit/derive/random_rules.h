#pragma once
// Random grammars that put shapes into every statement that moves, rotates, scales, grows or mixes them.

#include <initializer_list>
#include <string>

#include "base/hash.h"

namespace sgm {

class RandomRules {
 public:
  explicit RandomRules(uint64_t seed) : key_{seed} {}

  /// A random grammar. finite: with a finite domain whose box is not stated, so that the compiler computes it from the
  /// extent of the shapes; otherwise with an infinite layer of cells of 256 m. In nearly all of these grammars, shapes
  /// extend less than 150 m; if they extended farther, hundreds of cells would be derived for every box.
  std::string program(bool finite) {
    out_ =
        "sgm 1;\nparam size_ = 2m in 1m..3m;\nparam share = 0.5 in 0..1;\nparam free = 3;\nparam count = 2 in 0..3;\n";
    first_ = pick({"R0", "R0", "Fine"});
    const std::string start = "start " + first_ + "(2m);";
    out_ += finite ? start + "\n" : "domain infinite;\nlayer l cell 256m reach 150m { " + start + " }\n";
    out_ += "rule Fine(r) { detail " + pick({"30cm", "0.5*size_", "0.2*r"}) + " { R0(r); anchor here; } }\n";
    levels_ = !finite;
    out_ += "let spot(c) = c.point(jitter 0.4);\n";
    for (level_ = 0; level_ < 3; ++level_) rule();
    out_ += "rule R3(r) minsize 0.8m -> sphere(r) { " + leaf() + " scale(0.7) R3(r); }\n";
    out_ += "rule Deep(r) depth 3 -> sphere(r) { box(r); at(" + length() + ", 1m, 0m) rot(z, 40deg) Deep(0.8*r); }\n";
    out_ += "rule Stand(plan) { extrude rand(1m, 3m) of plan; at(0m, 2m, 0m) roof hip(40deg) of plan; }\n";
    out_ += "rule Swollen(r) { displace 0.12*r*fractal(3m) { sum { blob(r); at(0.5*r, 0m, 0m) blob(0.4*r); } } }\n";
    out_ += "rule Share(r) { at(0m, 6m - r, 0m) sphere(0.5m*(r/(r - 0.5*r))); let s = r/(0.4*r); box(0.3m*s); }\n";
    out_ += "morphic Body(r) : blob(r) -> superq((r, 0.6*r, r), 0.7) by share;\n";
    return out_;
  }

  /// Override statements, by path and by tag, to be appended to the grammar that the last call of program() returned.
  std::string edits() {
    std::string out = "override tag \"edited\" " + edit("") + "\n";
    const std::string path = first_ == "R0" ? "R0" : "Fine/R0";
    level_ = 2;
    for (const char* below : {"", "/R1", "/R1/R2", "/R1/R2/R3", "/R1/R2/R3/R3[0]", "/R1/R2/Deep/Deep", "/R1/R2/Body[0]",
                              "/R1[1]/R2", "/R1/R2[0]"})
      if (chance(40))
        out += "override \"" + std::string(chance(30) && levels_ ? "l(0, 0, 1)/" : "") + path + below + "\" " +
               edit("tag \"edited\"; ") + "\n";
    return out + "override \"" + path + "\" { tag \"edited\"; inner; }\n";
  }

 private:
  std::string edit(const std::string& tag) {
    // An override by tag cannot use the parameters of the rule, so the override declares r itself.
    const std::string let = tag.empty() ? "{ let r = 1.5m; " : "{ " + tag;
    switch (draw(4)) {
      case 0:
        return let + "}";
      case 1:
        return let + xforms() + "{ inner; " + leaf() + " } }";
      case 2:
        return let + "displace " + sampled() + " { inner; } " + statement(2) + " }";
      default:
        return let + "inner; " + statement(2) + " }";
    }
  }

  uint64_t draw(uint64_t below) { return hashCombine(key_.value, ++drawn_) % below; }
  bool chance(uint64_t percent) { return draw(100) < percent; }
  std::string pick(std::initializer_list<const char*> list) { return list.begin()[draw(list.size())]; }

  void rule() {
    const std::string head = "rule R" + std::to_string(level_) + "(r) ";
    const uint64_t kind = draw(5);
    out_ += head +
            (kind == 0   ? "when r > 1.5m "
             : kind == 1 ? "weight 2 "
             : kind == 2 ? "lod 1m "
                         : "") +
            whole() + "\n";
    if (kind < 3) out_ += head + (kind == 0 ? "else " : kind == 1 ? "weight count " : "") + block(0) + "\n";
  }

  /// A block of statements that also calls the next rule, so that every rule is used.
  std::string whole() {
    std::string out = block(0);
    out.pop_back();
    if (level_ == 2) return out + "Body(1m); R3(1m); Deep(1m); " + correlated() + "}";
    return out + "R" + std::to_string(level_ + 1) + "(" + length() + "); }";
  }

  /// Calls of rules that use their parameter r more than once. Interval arithmetic alone, which takes each use for an
  /// independent value, gives no finite bound for their shapes.
  std::string correlated() {
    return pick({"", "Swollen(rand(1m, 4m)); ", "Swollen(size_); ", "Share(rand(0.5m, 5m)); ", "Share(2*size_); "});
  }

  std::string length() {
    return pick({"r", "1m", "size_", "0.5*r", "2.5m", "rand(0.5m, 2m)", "(r + 1m)", "min(r, 2m)", "mix(r, 2m, share)",
                 "(if share < 0.5 then r else 1m)", "abs(-1.5m)", "max(0.3m, r - 1m)"});
  }
  std::string signedLength() { return pick({"", "-", "-0.5*"}) + length(); }
  std::string angle() { return pick({"45deg", "90deg", "-30deg", "rand(0deg, 90deg)", "200deg", "10deg*count"}); }
  std::string sampled() {
    return pick({"1m*fractal(3m)", "r*fractal(5m, octaves 3)", "clamp(p.y, -0.5m, 1m)", "1m*fract(q.x/1m)",
                 "mix(-1m, 0.5m, smoothstep(0m, 5m, p.z))", "(if p.x > 0m then 0.5m else -0.25m)",
                 "0.5m*floor(2*fractal(4m))", "abs(1m*fractal(2m)) - 0.7m", "0.3m*u",
                 "sqrt(1m*1m*abs(fractal(2m))) - 1m", "mix(-0.6m, 0m, share)", "p.y amp 0.5m", "q.x amp size_",
                 "-0.4m"});
  }
  std::string field() {
    return pick({"share", "p.x/4m", "smoothstep(-2m, 2m, q.y)", "0.5 + 0.5*fractal(2m)", "0.3", "fract(p.z/3m)"});
  }
  std::string point() { return "(" + signedLength() + ", " + signedLength() + ", " + signedLength() + ")"; }

  std::string leaf() {
    switch (draw(14)) {
      case 0:
        return "sphere(" + length() + ");";
      case 1:
        return "box(" + length() + ", " + length() + ", " + length() + ");";
      case 2:
        return "cylinder(" + length() + ", " + length() + ");";
      case 3:
        return "truncone(" + length() + ", top 0.2*r, bottom = " + length() + ");";
      case 4:
        return "capsule(" + point() + ", " + point() + ", " + length() + ");";
      case 5:
        return "tube(" + point() + ", " + point() + ", 0.5m, bend " + pick({"0m", "2m"}) + ");";
      case 6:
        return "beam(" + point() + ", " + point() + ", " + length() + pick({"", ", bend 1m"}) + ");";
      case 7:
        return "torus(" + length() + ", 0.4m);";
      case 8:
        return "ellipsoid(" + length() + ", " + length() + ", " + length() + ");";
      case 9:
        return "superq((" + length() + ", " + length() + ", 0.7m), share);";
      case 10:
        return "prism(" + length() + ", (-1m, -2m), (" + length() + ", -1m), (0m, 3m));";
      case 11:
        return "box(scope);";
      case 12:
        return "Body(" + length() + ");";
      default:
        return "blob(" + length() + ");";
    }
  }

  std::string xforms() {
    std::string out;
    const uint64_t count = 1 + draw(3);
    for (uint64_t i = 0; i < count; ++i) {
      switch (draw(8)) {
        case 0:
          out += "rot(" + pick({"x", "y", "z", "(1m, 2m, 0m)"}) + ", " + angle() + ") ";
          break;
        case 1:
          out += "scale(" + pick({"0.5", "2", "rand(0.7, 1.5)", "share", "1 - 2*share"}) + ") ";
          break;
        case 2:
          out += "mirror(" + pick({"x", "y", "z"}) + ") ";
          break;
        case 3:
          out += "size(" + pick({"2m, 1m, 3m", "0.5*scope", "x 1m", "(1m, r, 2m)", "y size_"}) + ") ";
          break;
        case 4:
          out += "at(" + pick({"spot(cell)", "cell.center", "cell.point()"}) + ") ";
          if (!levels_) out = "";
          break;
        case 5:
          out += "at(min(scope.x, 3m), clamp(1m*free, -1m, 1m), 0m) ";
          break;
        default:
          out += "at(" + signedLength() + ", " + signedLength() + ", 0m) ";
          break;
      }
    }
    return out.empty() ? "rot(z, " + angle() + ") " : out;
  }

  std::string block(int depth) {
    std::string out = "{ ";
    const uint64_t count = 1 + draw(2);
    for (uint64_t i = 0; i < count; ++i) out += statement(depth + 1) + " ";
    return out + "}";
  }

  std::string statement(int depth) {
    if (depth > 3) return leaf();
    switch (draw(29)) {
      case 0:
        return level_ < 2 ? "R" + std::to_string(level_ + 1) + "(" + length() + ");" : "R3(min(r, 3m));";
      case 1:
        return "union smooth " + length() + " " + block(depth);
      case 2:
        return "cut " + pick({"", "smooth 0.5m "}) + block(depth);
      case 3:
        return "meet " + pick({"", "smooth 0.3m "}) + "{ " + statement(depth + 1) + " " + statement(depth + 1) + " }";
      case 4:
        return "meet { halfspace(" + pick({"below", "above"}) + " " + signedLength() + "); " + leaf() + " }";
      case 5:
        return pick({"", "displace 0.1m*fractal(2m) "}) + "sum " + sumBody(depth);
      case 6:
        return "morph(" + block(depth) + ", " + block(depth) + ", " + field() + ");";
      case 7:
        return "morph(sphere(" + length() + "), box(" + length() + "), " + field() + ") power;";
      case 8:
      case 9:
        return "displace " + sampled() + " " + block(depth);
      case 10:
        return "warp (" + pick({"1m*fractal(2m)", "clamp(p.x, -1m, 2m)"}) + ", 0.3m, -0.5m*fractal(1m)) " +
               block(depth);
      case 11:
        return "repeat " + pick({"2.5", "count", "3", "1.4"}) + " " + xforms() + block(depth);
      case 12:
        return "for i" + std::to_string(depth) + " in " + pick({"0..3.5", "0.6..count", "1..3"}) + " { at(2m*i" +
               std::to_string(depth) + ", 0m, 0m) " + statement(depth + 1) + " }";
      case 13:
        return "scatter 3 on " +
               pick({"disc(r)", "shell(2m, up 60%)", "shell(-1m, up 20%)", "box(4m, 2m, r)", "shell(r)"}) + " " +
               block(depth);
      case 14:
        return "detail " + pick({"5cm ", "1m "}) + block(depth);
      case 15:
        return "Deep(" + length() + ");";
      case 16:
        return "for s" + std::to_string(depth) + " in branch(" + pick({"3", "count", "1.6*count"}) + ", step " +
               pick({"1m", "0.5*r", "free*1m"}) + ", turn " + pick({"0deg", "30deg", "90deg", "share*90deg"}) +
               pick({"", ", fork 40%", ", fork share"}) + ") " + segmentBody("s" + std::to_string(depth), depth);
      case 17:
      case 18:
      case 19:
        return xforms() + block(depth);
      case 20:
      case 21:
        return sized() + pick({"", "", "snap x 0.7m ", "snap y 1m from 0.3*r "}) + "split " + pick({"x", "y", "z"}) +
               pick({"", "", " snap 0.4m", " snap 0.3*size_"}) + " { " +
               pick({"", "0.5m: { }", "rand(0.1m, 1m): { }", "20%: box(scope);", "share: box(scope);"}) + " " +
               pick({"~1m", "1m", "~size_", "~(0.2*r)", "30%"}) + ": " + statement(depth + 1) +
               pick({"", " { ~0.7m: box(scope); }*", " { 0.2m: { } ~size_: box(scope); }*", " { 0.4m: box(scope); }*",
                     " { ~0.1m: sphere(3*scope.y); 1m: { } }*",
                     " { ~0.3m: box(scope); 0.5m: sphere(0.5*scope.x); }*"}) +
               pick({"", " ~0.5m: box(scope);", " 0.3m: box(scope);"}) + " }";
      case 22:
        return sized() + "comp { " + pick({"side", "front", "left", "top", "bottom", "edges", "inside"}) + ": " +
               statement(depth + 1) +
               pick({"", " back: size(z 0.3m) box(scope);", " right: at(z 0.5m) size(z 1m) box(scope);"}) + " }";
      case 23:
        return "roof " + roof() + ";";
      case 24:
        return sized() + "treemap" + rooms(depth);
      case 25:
        // The sizes give only a few places for tiles, so that each tile may have many contents.
        return pick({"size(2m, 1m, 3m) ", "size(min(r, 3m), 2m, rand(0.5m, 2m)) "}) + "wfc " +
               pick({"1m", "(2m, 1m, 1.5m)", "rand(1m, 3m)", "(r, 2m, max(size_, 1m))"}) + tiles(depth);
      case 26:
      case 27:
        return profile("plan" + std::to_string(depth), depth);
      default:
        return leaf();
    }
  }

  std::string sized() {
    return pick({"", "size(2m, 1m, 3m) ", "size(size_, r, 2m) ", "size(2*size_, 4m*share, rand(1m, 3m)) ",
                 "size(y 3m*count) "});
  }

  std::string segmentBody(const std::string& s, int depth) {
    switch (draw(4)) {
      case 0:
        return "{ at(" + s + pick({".from", ".to", ".to + (0m, r, 0m)"}) + ") " + statement(depth + 1) + " }";
      case 1:
        return "{ sphere(1m*" + s + pick({".along", ".depth", ".to.y/4m"}) + "); }";
      default:
        return "{ " + pick({"capsule", "tube", "beam"}) + "(" + s + ".from, " + s + ".to, rand(" + s + ", 0.2m, 0.6m)" +
               pick({"*(1 - 0.5*", "*(0.5 + 0.1*"}) + s + pick({".along", ".depth"}) + ")); }";
    }
  }

  std::string roof() {
    const std::string overhang = pick({"", ", overhang 0.4m", ", 0.2*size_"}) + ")";
    if (chance(30)) return "flat(" + length() + overhang;
    return pick({"gable(", "hip("}) + pick({"30deg", "rand(5deg, 80deg)", "60deg*share", "80deg"}) + overhang;
  }

  std::string rooms(int depth) {
    std::string out = pick({"", "(wall 0.1m)", "(0.3m, door rand(0.4m, 1m), corridor 0.8m)"}) + " { a " +
                      pick({"4", "rand(1, 6)", "count"}) + ": " + statement(depth + 1) + " b 3: { " + leaf() + " cut " +
                      leaf() + " } c 0.5*count: " + leaf();
    out += pick({"", " link a b by door;", " link b c by door(0.6m, 1m);"});
    if (chance(50)) out += " facade: " + statement(depth + 1);
    if (chance(50)) out += " corridor: " + leaf();
    return out + " }";
  }

  std::string tiles(int depth) {
    std::string out = pick({" { ", " { border side in_; ", " { border top out, left out or in_; "});
    out += "a " + pick({"2", "count", "rand(0, 2)"}) + pick({"", " turn"}) +
           ", side in_ or out: " + statement(depth + 1) + " ";
    if (chance(60)) out += "b 1 turn, front in_, back out, bottom out: { " + leaf() + " box(scope); } ";
    if (chance(60)) out += "c 3 turn, front out, right in_, top out: at(0.5*scope.x, 0m, 0m) " + statement(depth + 1);
    return out + " }";
  }

  std::string profile(const std::string& plan, int depth) {
    const std::string outline = pick({"merge 3 rect(", "rect(", "merge count regular(5, ", "regular(3 + count, "});
    std::string out = "{ footprint " + outline + length() + (outline.ends_with("rect(") ? ", " + length() : "");
    if (chance(20)) out = "{ footprint polygon((0m, 0m), (" + length() + ", 0.3m), (1m, " + length() + ")";
    out += ") as " + plan + "; extrude " + length() + " of " + plan +
           (chance(50) ? "; " : " { tag \"edited\"; " + statement(depth + 1) + " } ");
    if (chance(30)) return out + xforms() + "Stand(" + plan + "); }";
    return out + (chance(50) ? "at(0m, 1m, 0m) roof " + roof() + " of " + plan + "; }" : "}");
  }

  std::string sumBody(int depth) {
    std::string out = "{ ";
    const uint64_t count = 1 + draw(3);
    for (uint64_t i = 0; i < count; ++i) out += (chance(50) ? xforms() : "") + (chance(20) ? "R3(1m);" : leaf()) + " ";
    if (depth < 3 && chance(30)) out += "scatter 4 on shell(r) { " + leaf() + " } ";
    return out + "}";
  }

  PathKey key_;
  uint64_t drawn_ = 0;
  int level_ = 0;
  bool levels_ = false;
  std::string out_, first_;
};

}  // namespace sgm
