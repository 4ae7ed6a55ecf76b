#pragma once
// The derivation of one cell. Everything outside of this folder calls derive.h.
//
// A statement is a function over the context and an Env (statements.h). It gets numbers from the Evaluator, adds shapes
// and anchors to the ShapeSink, and calls rules through the RuleRunner; each of these counts its work in the Budget.

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
  int32_t coarse_edge = 0;     ///< derive only for levels with this cell edge (units) or a larger one; 0: for all
  RuleWatch* watch = nullptr;  ///< must outlive the context
};

/// The state that all statements of one cell share. Its parts refer to each other, so it stays in its place.
struct CellContext {
  CellContext(const CellInputs& inputs, const CellOptions& options, std::pmr::memory_resource* memory);
  CellContext(const CellContext&) = delete;
  CellContext& operator=(const CellContext&) = delete;

  /// True if this derivation is for levels that do not show shapes with this `detail`, and nothing else depends on
  /// them.
  bool skips(int32_t detail, const Env& env) const { return !env.whole && detail > 0 && coarse_edge > detail; }

  const CellInputs in;
  const Program& program;  ///< that of `in`
  Activations activations;
  PathOverrides path_overrides;
  const int32_t coarse_edge;  ///< as in CellOptions; 0 if overrides by path may apply
  Draft draft;
  Budget budget;
  ShapeSink sink;
  Evaluator evaluator;
  AssetCache assets;
  FloorPlanCache floor_plans;
  RuleRunner rules;
};

}  // namespace sgm::interpret
