#pragma once
// Warns of valid but probably unintended code: unused names, overlapping heads of a rule.

#include <span>

#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Warns of unused parameters, lets, fields and imports of the root. Precondition: a checked program without errors. A
/// root without layers or start is meant for import, and not warned of.
void warnOfUnused(const Program& program, std::span<const ModuleSyntax> syntax, DiagnosticSink& sink);

/// Warns of heads of a rule without `weight` whose guards test the same value and can hold together, so that one of
/// them is drawn by chance. Understands only simple guards. Precondition: a checked program without errors.
void warnOfOverlaps(const Program& program, DiagnosticSink& sink);

/// Warns of materials of the root whose names are almost equal to another one, which is used as often or more often.
/// Materials have no declaration: the host interprets their names. Precondition: a checked program without errors.
void warnOfMaterials(const Program& program, DiagnosticSink& sink);

}  // namespace sgm
