#include "grammar/reach/derived_heads.h"

#include "grammar/text/codes.h"

namespace sgm::reach {

void DerivedHeads::warnOfIdle(const Program& program, DiagnosticSink& sink) const {
  for (uint32_t r = 0; r < program.rules.size(); ++r) {
    const Rule& rule = program.rules[r];
    if (rule.module != 0) continue;
    for (size_t h = 0; h < derived_[r].size(); ++h) {
      if (derived_[r][h]) continue;
      const Alternative& head = rule.alternatives[h];
      const bool otherwise = head.guard == Guard::otherwise;
      sink.warning(otherwise ? head.span : program.expr(head.when).span, codes::kIdleHead,
                   join({"this head of `", program.text(rule.name), "` never applies: ",
                         otherwise ? "another one's guard always holds" : "its guard never holds"}),
                   "this holds for all parameters within their ranges: correct the guard, or remove the head");
    }
  }
}

}  // namespace sgm::reach
