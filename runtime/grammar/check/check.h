#pragma once
// Checks names, arguments, dimensions and stages: turns the parser's result into a resolved Program.
//
// A parameter of a rule has one type, inferred from the rule's first call. A let or a field is checked once for each
// distinct tuple of argument types, with cached results, so that one `fbm` works for both lengths and ratios.
//
// The classes and files of this check, in order of dependence: Symbols, Types, declared_constants and layers,
// Statements with RuleTypes, Overrides with OverridePaths, LayerLevel. check.cpp runs them in this order.

#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

struct CheckFindings {
  std::vector<RuleCall> calls;
  /// true: the program uses an unknown name that may be declared in a part of the text that failed to parse
  bool uses_lost = false;
};

/// Runs all checks except those for recursion and reach. Reports errors to the sink, which already contains the errors
/// of loading and parsing. syntax: the syntax trees of all files; syntax[0] is the root file's. library: true: the root
/// is meant to be imported, so it needs no start.
CheckFindings checkProgram(Program& program, NameTable& names, const std::vector<ModuleSyntax>& syntax,
                           const CompileLimits& limits, DiagnosticSink& sink, bool library);

}  // namespace sgm
