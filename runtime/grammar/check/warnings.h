#pragma once
// What is right, and yet hardly meant: names that nothing uses, heads of a rule that come together.

#include <span>

#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Of a checked program without errors: parameters, lets, fields and imports of the root that nothing uses. A root
/// without layers or start is there to be imported: it is not warned of.
void warnOfUnused(const Program& program, std::span<const ModuleSyntax> syntax, DiagnosticSink& sink);

/// Of a checked program without errors: heads of a rule without `weight` whose guards ask about the same value, and
/// that can hold together, so that one of them is drawn by chance. Guards that ask for more are not understood.
void warnOfOverlaps(const Program& program, DiagnosticSink& sink);

/// Of a checked program without errors: materials of the root that are spelt almost as another one is, which is used as
/// often or more. Materials have no list: they are what the host makes of their names.
void warnOfMaterials(const Program& program, DiagnosticSink& sink);

}  // namespace sgm
