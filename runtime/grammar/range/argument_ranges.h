#pragma once
// Reports arguments outside of the ranges of their parameters.

#include <span>

#include "grammar/range/reach_values.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reports certain misfits as errors, others as warnings: at the argument, or at the library's caller.
void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink);

}  // namespace sgm
