#include "grammar/compile.h"

#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/check/layer_contents.h"
#include "grammar/check/recursion.h"
#include "grammar/check/warnings.h"
#include "grammar/check_file.h"
#include "grammar/identity/hash_meaning.h"
#include "grammar/parse/imports.h"
#include "grammar/parse/parse_module.h"
#include "grammar/print/printer.h"
#include "grammar/range/argument_ranges.h"
#include "grammar/reach/reach.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Checks the length of the text. Returns false after reporting an error.
bool fits(std::string_view text, const CompileLimits& limits, DiagnosticSink& sink) {
  const size_t limit = std::min<size_t>(limits.text_bytes, 0x7FFFFFFFu);
  if (text.size() <= limit) return true;
  Span span;
  span.line = span.column = span.end_line = span.end_column = 1;
  sink.error(span, codes::kTooLarge, join({"the text is longer than ", std::to_string(limit), " bytes"}),
             "move rules into a file of their own and import it");
  return false;
}

/// True if a file contains only declarations that an imported file may have, and at least one that importing files can
/// use.
bool isLibrary(const ModuleSyntax& root) {
  bool gives = false;
  for (const Item& item : root.items) {
    switch (item.kind) {
      case ItemKind::version:
      case ItemKind::import:
      case ItemKind::units:
        break;
      case ItemKind::let:
      case ItemKind::field:
      case ItemKind::alternative:
        gives = true;
        break;
      default:
        return false;
    }
  }
  return gives;
}

std::shared_ptr<Program> newProgram(std::string_view text, std::string_view path, std::pmr::memory_resource* memory) {
  auto program = std::allocate_shared<Program>(std::pmr::polymorphic_allocator<Program>(memory), memory);
  program->modules.emplace_back(memory);
  program->modules[0].path = path;
  program->modules[0].text = text;
  for (auto* table : {&program->materials, &program->tags, &program->names}) table->emplace_back();
  return program;
}

CheckResult compile(std::string_view text, std::string_view path, const CompileOptions& options, bool libraries) {
  CheckResult check;
  CompileResult& result = check.compiled;
  DiagnosticSink sink(options.limits.diagnostics);
  sink.addFile(path);
  result.files.push_back({std::string(path), std::string(text)});
  if (!fits(text, options.limits, sink)) {
    result.diagnostics = sink.take();
    return check;
  }
  std::shared_ptr<Program> program = newProgram(text, path, options.memory);
  NameTable names(program->ast);
  std::vector<ModuleSyntax> syntax = loadModules(*program, names, options, sink, result.files);
  const uint32_t unread = sink.errorCount();
  check.library = libraries && isLibrary(syntax[0]);
  if (unread == 0) {
    // The canonical text and the hash are made before the checker runs, since the checker rewrites calls while it
    // resolves names.
    program->canonical = printModule(*program, syntax[0]);
    program->hash = hashMeaning(*program, syntax);
  }
  // The parsed part is checked even after errors, so that one run reports all problems.
  if (!sink.full()) {
    const CheckFindings found = checkProgram(*program, names, syntax, options.limits, sink, check.library);
    const bool understood = sink.errorCount() == unread && !found.uses_lost;
    const bool bounded = std::ranges::all_of(syntax, [](const ModuleSyntax& m) { return m.readable && m.bounded; });
    if (understood) checkRecursion(*program, found.calls, options.limits, sink);
    if (understood) checkRanges(*program, options.limits, sink);
    if (understood && bounded && sink.errorCount() == unread) checkReach(*program, options.limits, sink);
  }
  if (sink.errorCount() == 0) {
    findLayerContents(*program, options.limits);
    warnOfUnused(*program, syntax, sink);
    warnOfOverlaps(*program, sink);
    warnOfMaterials(*program, sink);
  }
  if (sink.errorCount() == 0) result.program = std::move(program);
  result.diagnostics = sink.take();
  return check;
}

}  // namespace

CompileResult compileGrammar(std::string_view text, std::string_view path, const CompileOptions& options) {
  return compile(text, path, options, false).compiled;
}

CheckResult checkFile(std::string_view text, std::string_view path, const CompileOptions& options) {
  return compile(text, path, options, true);
}

FormatResult formatGrammar(std::string_view text, std::string_view path, const CompileLimits& limits) {
  FormatResult result;
  DiagnosticSink sink(limits.diagnostics);
  sink.addFile(path);
  if (fits(text, limits, sink)) {
    const std::shared_ptr<Program> program = newProgram(text, path, std::pmr::get_default_resource());
    NameTable names(program->ast);
    const ModuleSyntax syntax = parseModule(*program, names, 0, limits, sink);
    if (sink.errorCount() == 0) result.text = printModule(*program, syntax);
  }
  result.diagnostics = sink.take();
  return result;
}

std::string renderDiagnostics(const CompileResult& result) {
  std::string out;
  for (const Diagnostic& diagnostic : result.diagnostics) {
    std::string_view source;
    for (const SourceFile& file : result.files)
      if (file.path == diagnostic.file) {
        source = file.text;
        break;
      }
    out += renderDiagnostic(diagnostic, source);
  }
  return out;
}

}  // namespace sgm
