#pragma once
// Warns of valid but probably unintended code: unused names, rule heads whose guards overlap.

#include <span>

#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of unused parameters, lets, fields and imports of the root. Gives no warnings for a root without layers and
/// start, which is meant for import. Precondition: the program is checked and has no errors.
void warnOfUnused(const Program& program, std::span<const ModuleSyntax> syntax, DiagnosticSink& sink);

/// Warns of heads of one rule, without `weight`, whose guards compare the same value and can hold together, since one
/// of the heads is then chosen at random. Only analyses simple guards. Precondition: the program is checked and has no
/// errors.
void warnOfOverlaps(const Program& program, DiagnosticSink& sink);

/// Warns of a material name in the root that differs only slightly from another one which is used at least as often.
/// Materials are not declared, since the host interprets their names, so that a misspelling is no error. Precondition:
/// the program is checked and has no errors.
void warnOfMaterials(const Program& program, DiagnosticSink& sink);

}  // namespace sgm
