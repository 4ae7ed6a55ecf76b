// Compiles and derives grammars from arbitrary text: derivation must end within its limits without undefined behaviour,
// and no shape may exceed the bounds that the compiler has proven. The first two bytes of the input select the seed and
// the grammar cell; the rest is the text.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "derive/interpret/derive.h"
#include "grammar/compile.h"

namespace {

/// A lower layer that is solid above the height 0.
class Ceiling : public sgm::LowerLayers {
 public:
  bool solid(uint32_t, sgm::Int3 p) const override { return p.y >= 0; }
};

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "derive_fuzz: %s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 2, size - 2);
  sgm::CompileOptions options;
  options.limits.bound_steps = 1u << 14;
  const sgm::CompileResult result = sgm::compileGrammar(text, "fuzz.sgm", options);
  if (!result.program) return 0;
  const sgm::Program& program = *result.program;
  sgm::DeriveLimits limits;
  limits.steps = 50'000;
  limits.shapes = 2'000;
  limits.bytes = size_t{4} << 20;
  sgm::ParameterValues values = sgm::ParameterValues::defaults(program);
  for (size_t i = 0; i < program.params.size(); ++i) {
    const sgm::Param& param = program.params[i];
    if (param.has_range && data[0] % 3 != 0) values.values[i] = data[0] % 3 == 1 ? param.low : param.high;
  }
  for (uint32_t l = 0; l < program.layers.size() && l < 4; ++l) {
    const sgm::Layer& layer = program.layers[l];
    const int32_t at = data[1] % 5 - 2;
    const sgm::Int3 cell = sgm::isWhole(layer) ? sgm::Int3{} : sgm::Int3{at, 0, -at};
    const auto once = sgm::deriveCell(program, values, data[0], l, cell, Ceiling(), limits);
    const auto twice = sgm::deriveCell(program, values, data[0], l, cell, Ceiling(), limits);
    require(bool(once) == bool(twice), "one cell derived in two ways");
    if (!once) continue;
    require(once->groups.size() == twice->groups.size(), "one cell derived in two ways");
    const sgm::IntBox limit = sgm::shapeLimit(program, l, cell);
    for (const sgm::Group& group : once->groups) require(limit.contains(group.bounds), "a group beyond its bound");
    for (const sgm::DeriveNote& note : once->notes) {
      require(note.line >= 1 && note.column >= 1, "a note without a place");
      if (layer.proven) require(note.message.find("may pass") == std::string::npos, "left out though it is proven");
      require(note.message.find("proven bound") == std::string::npos, "ended where the proof ends");
    }
  }
  return 0;
}
