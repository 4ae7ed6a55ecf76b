#pragma once
// Checks names, arguments, dimensions and stages: turns the parser's result into a resolved Program.
//
// A parameter of a rule has one type, found from the first call. Lets and fields are checked anew for each tuple of
// argument types (with cached results), so that one `fbm` works for both lengths and ratios.
//
// The parts, each of which uses only those before it: Symbols, Types, declared constants and layers, Statements with
// RuleTypes, Overrides with OverridePaths, LayerLevel. check.cpp runs them in order.

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
  /// Whether a used name may be declared in a part of the text that was not parsed.
  bool uses_lost = false;
};

/// Runs all checks except recursion and reach. Errors go to the sink, which already has those of loading and parsing.
/// syntax: of all files, [0] is the root. library: the root is a file for import, and derives nothing.
CheckFindings checkProgram(Program& program, NameTable& names, const std::vector<ModuleSyntax>& syntax,
                           const CompileLimits& limits, DiagnosticSink& sink, bool library);

}  // namespace sgm
