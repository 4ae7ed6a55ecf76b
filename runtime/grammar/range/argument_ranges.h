#pragma once
// What is said of arguments that do not lie in the range of what they are given to.

#include <span>

#include "grammar/range/reach_values.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Errors for what is certain, warnings for the rest: at the argument, or at the library's caller.
void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink);

}  // namespace sgm
