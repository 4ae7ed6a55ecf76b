#pragma once
// The state of the derivation of one cell. Code outside of this folder only uses derive.h.
//
// Each kind of statement is a function of the context and an Env (statements.h). It evaluates numbers with the
// Evaluator, adds shapes and anchors to the ShapeSink, and calls rules through the RuleRunner; each of these counts its
// work in the Budget.

#include <cstdint>
#include <memory_resource>

#include "derive/draft.h"
#include "derive/interpret/activations.h"
#include "derive/interpret/asset_cache.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/interpret/env.h"
#include "derive/interpret/evaluator.h"
#include "derive/interpret/floor_plan_cache.h"
#include "derive/interpret/path_overrides.h"
#include "derive/interpret/rule_runner.h"
#include "derive/interpret/rule_watch.h"
#include "derive/interpret/shape_sink.h"

namespace sgm::interpret {

struct CellOptions {
  /// derive only the content that is visible at levels with this cell edge (units) or a larger one; 0: derive
  /// everything
  int32_t coarse_edge = 0;
  RuleWatch* watch = nullptr;  ///< records the calls of one rule; may be null; must outlive the context
};

/// The state shared by all statements of one cell. Not movable, since its members refer to each other.
struct CellContext {
  CellContext(const CellInputs& inputs, const CellOptions& options, std::pmr::memory_resource* memory);
  CellContext(const CellContext&) = delete;
  CellContext& operator=(const CellContext&) = delete;

  /// True if shapes with this `detail` (units; 0: none) can be left out: the derivation serves only levels that do not
  /// show such shapes, and no other shape depends on them.
  bool skips(int32_t detail, const Env& env) const { return !env.whole && detail > 0 && coarse_edge > detail; }

  const CellInputs in;
  const Program& program;  ///< reference to in.program
  Activations activations;
  PathOverrides path_overrides;
  /// CellOptions::coarse_edge; 0 if overrides by path may apply in the cell, which is then derived completely
  const int32_t coarse_edge;
  Draft draft;
  Budget budget;
  ShapeSink sink;
  Evaluator evaluator;
  AssetCache assets;
  FloorPlanCache floor_plans;
  RuleRunner rules;
};

}  // namespace sgm::interpret
