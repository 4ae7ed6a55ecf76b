#pragma once
// The state of a proof of reach, shared by the functions that evaluate rules and statements.

#include "base/fixed.h"
#include "grammar/range/reach_values.h"
#include "grammar/reach/derived_heads.h"
#include "grammar/reach/override_extents.h"
#include "grammar/reach/range_pieces.h"
#include "grammar/reach/rule_extents.h"
#include "grammar/reach/start_calls.h"
#include "grammar/reach/step_budget.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm::reach {

inline constexpr double kUnit = 1.0 / kUnitsPerMetre;  ///< metres

/// The cell in which the current layer's start rule is derived.
struct StartCell {
  IntervalVector edges{};  ///< metres
  bool whole = false;      ///< the layer has no cells; its start is derived once for the whole world
  bool centred = false;    ///< the cell is centred on the origin, as for a finite domain
};

struct ReachContext {
  ReachContext(Program& checked, const CompileLimits& compile_limits, DiagnosticSink& diagnostics)
      : program(checked),
        limits(compile_limits),
        sink(diagnostics),
        lossy(diagnostics.errorCount() > 0),
        budget(compile_limits.bound_steps),
        values(checked, budget.left()),
        rules(checked),
        overrides(checked),
        heads(checked) {}
  ReachContext(const ReachContext&) = delete;
  ReachContext& operator=(const ReachContext&) = delete;

  Program& program;
  const CompileLimits limits;
  DiagnosticSink& sink;
  const bool lossy;  ///< errors were reported before, so a part of the text may be missing
  StepBudget budget;
  RangeEvaluator values;  ///< evaluates expressions; each step decrements `budget`
  StartCell cell;
  RangePieces pieces;
  RuleExtents rules;
  OverrideExtents overrides;
  StartCalls start_calls;
  DerivedHeads heads;
};

}  // namespace sgm::reach
