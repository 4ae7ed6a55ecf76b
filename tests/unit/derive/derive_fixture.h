#pragma once
// Functions for tests that compile and derive a grammar in one call.

#include <memory>
#include <string>
#include <string_view>

#include "catch.h"
#include "derive/chunk_ops.h"
#include "derive/interpret/derive.h"
#include "grammar/compile.h"

namespace sgm {

/// Stands for the lower layers: they are rock above a height, and air below it.
class Ceiling : public LowerLayers {
 public:
  explicit Ceiling(int32_t height) : height_(height) {}
  bool solid(uint32_t, Int3 p) const override { return p.y >= height_; }

 private:
  int32_t height_;
};

inline std::shared_ptr<const Program> compiled(std::string_view text) {
  const CompileResult result = compileGrammar(text, "test.sgm");
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  return result.program;
}

inline GrammarChunk derived(const Program& program, Int3 cell = {}, uint64_t seed = 7, uint32_t layer = 0,
                            const LowerLayers& lower = Ceiling(1 << 30)) {
  Result<GrammarChunk> chunk = deriveCell(program, ParameterValues::defaults(program), seed, layer, cell, lower);
  INFO((chunk ? std::string() : chunk.error().message));
  REQUIRE(chunk);
  return *std::move(chunk);
}

/// Derives a cell of a grammar with one infinite layer of 64 m cells. `rules` must define the rule Main.
inline GrammarChunk derivedRules(std::string_view rules, Int3 cell = {}, uint64_t seed = 7) {
  const std::string text =
      "sgm 1; units m; domain infinite; layer main cell 64m reach 64m { start Main; }\n" + std::string(rules);
  return derived(*compiled(text), cell, seed);
}

inline constexpr std::string_view kCave = R"(sgm 1;
import "std/rock.sgm" as rock;
units m;
param boxy = 0.3 in 0..1 "0 round, 1 square";
param wet  = 50% in 0%..100%;
domain infinite solid limestone;
layer net  cell 192m reach 176m        { start Node; }
layer drip cell 24m  reach 5m uses net { start Drips; }
let hub(c) = c.point(jitter 0.3);

rule Node {
  cut {
    at(hub(cell)) Chamber(rand(9m, 16m));
    for f in cell.links(tree 3, extra 25%)
      { Passage(hub(cell), hub(f.other), rand(f, 2m, 4m)); }
  }
}
rule Chamber(r) {
  displace rock.fbm(period 5m, amp 0.7m) { Hall(r); }
  anchor spawn "chamber";  tag "cave.hall";
}
rule Hall(r) weight 3 { morph(sphere(r), box(1.7*r), boxy); }
rule Hall(r) weight 1 {
  union smooth 2m { repeat 3 rot(y, 120deg) { at(0.6*r, 0m, 0m) sphere(0.7*r); } }
}
rule Passage(a, b, r) {
  field t = smoothstep(-60m, 20m, p.y);
  displace rock.fbm(period 3m, amp 0.4m)
    { morph(tube(a, b, r, bend 12m), beam(a, b, r, bend 12m), t); }
}
rule Drips {
  scatter poisson(2.2m) probe up 4m of net when chance(wet) { Drip(rand(0.3m, 2m)); }
}
rule Drip(l) { detail 0.3m { truncone(l, top 0.2*l, bottom 0.03*l); mat calcite; } }
)";

}  // namespace sgm
