#include "grammar/syntax/program.h"

namespace sgm {

StmtId Program::innermost(StmtId id) const {
  for (;;) {
    const StmtNode& s = stmt(id);
    if (!placesBody(s.kind)) return id;
    id = s.body;
  }
}

uint32_t Program::findParam(std::string_view name) const {
  for (uint32_t i = 0; i < params.size(); ++i)
    if (text(params[i].name) == name) return i;
  return kNoId;
}

uint32_t Program::findRule(std::string_view name) const {
  for (uint32_t i = 0; i < rules.size(); ++i)
    if (text(rules[i].name) == name) return i;
  return kNoId;
}

uint32_t Program::findLayer(std::string_view name) const {
  for (uint32_t i = 0; i < layers.size(); ++i)
    if (text(layers[i].name) == name) return i;
  return kNoId;
}

}  // namespace sgm
