#include "grammar/identity/former_hash.h"

#include <limits>

#include "base/hash.h"
#include "grammar/parse/parse_module.h"
#include "grammar/print/printer.h"

namespace sgm {
namespace {

uint64_t hashOfText(const Program& program) {
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  Program again(memory);
  for (const Module& module : program.modules) {
    Module& copy = again.modules.emplace_back(memory);
    copy.path = module.path;
    copy.text = module.text;
  }
  // The text was within the limits when it was compiled, so parsing it again needs no limits.
  CompileLimits limits;
  limits.nesting = limits.nodes = std::numeric_limits<uint32_t>::max();
  DiagnosticSink sink(limits.diagnostics);
  NameTable names(again.ast);
  uint64_t hash = hashText("sgm 1");
  for (uint32_t module = 0; module < again.modules.size(); ++module) {
    const ModuleSyntax syntax = parseModule(again, names, module, limits, sink);
    hash = hashCombine(hash, hashText(printMeaning(again, syntax)));
  }
  for (const Asset& asset : program.assets) hash = hashCombine(hash, asset.hash);
  return hash;
}

}  // namespace

uint64_t formerHash(const Program& program) {
  return program.former_hash.get([&] { return hashOfText(program); });
}

}  // namespace sgm
