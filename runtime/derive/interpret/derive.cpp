#include "derive/interpret/derive.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "derive/bounds.h"
#include "derive/coarse_chunk.h"
#include "derive/interpret/cell_context.h"
#include "derive/interpret/cell_groups.h"
#include "derive/interpret/statements.h"

namespace sgm {
namespace {

using interpret::CellContext;
using interpret::RuleWatch;
using interpret::ShapeList;
using interpret::WatchedCall;

Result<void> checkArguments(const Program& program, const ParameterValues& parameters, uint32_t layer, Int3 cell) {
  if (layer >= program.layers.size())
    return Error{Code::invalid_argument, "the grammar has no layer " + std::to_string(layer) + "; it has " +
                                             std::to_string(program.layers.size())};
  if (parameters.values.size() != program.params.size()) {
    return Error{Code::invalid_argument,
                 "the parameter values belong to another grammar; use the defaults of this one"};
  }
  const Layer& info = program.layers[layer];
  if (isWhole(info) && cell != Int3{}) {
    return Error{Code::invalid_argument, "a grammar without layers has only the cell 0 0 0"};
  }
  for (int a = 0; a < 3; ++a) {
    const int64_t low = int64_t{cell[a]} * info.cell[a], high = low + info.cell[a];
    if (low < std::numeric_limits<int32_t>::min() || high > std::numeric_limits<int32_t>::max()) {
      return Error{Code::invalid_argument, "the cell lies beyond the end of the world"};
    }
  }
  return {};
}

/// Derives the layer's call of its start rule; returns the shapes that the call adds.
ShapeList runStart(CellContext& c) {
  interpret::Env env;
  env.place.base = c.in.base;
  const IntBox& domain = c.program.domain.box;
  for (int a = 0; a < 3; ++a) {
    const int64_t edge = isWhole(c.in.layer) ? int64_t{domain.hi[a]} - domain.lo[a] : c.in.layer.cell[a];
    env.scope[a] = static_cast<double>(std::max<int64_t>(edge, 0)) / kUnitsPerMetre;
  }
  env.key = c.in.lattice.cellKey(c.in.cell);
  env.activation = kNone;
  ShapeList adds;
  runCall(c.in.layer.start, 0, c, env, adds);
  return adds;
}

/// Derives the whole cell. from: if not null, receives for each shape of the result its index in the draft.
Result<GrammarChunk> runCell(CellContext& c, std::vector<uint32_t>* from, std::pmr::memory_resource* memory) {
  const ShapeList adds = runStart(c);
  if (c.budget.failed()) return c.budget.error();
  c.path_overrides.noteMissed(c.budget);
  GrammarChunk roots(memory), out(memory);
  collectGroups(adds, false, c, roots);
  collectGroups(c.sink.layerCuts(), true, c, roots);
  if (c.budget.failed()) return c.budget.error();
  out.layer = c.in.layer_index;
  out.cell = c.in.cell;
  out.parameters = c.evaluator.parametersRead();
  DraftCopier copier(c.draft.chunk());
  copier.copy(roots.groups, out);
  if (from != nullptr) from->assign(copier.copied().begin(), copier.copied().end());
  out.anchors.assign(c.sink.anchors().begin(), c.sink.anchors().end());
  c.budget.moveNotes(out.notes);
  return out;
}

/// Returns each activation of the rule separately. `watch` must have recorded them during the derivation of the cell.
Result<std::vector<RuleInstance>> instancesOf(uint32_t rule, const RuleWatch& watch, const CellContext& c,
                                              std::pmr::memory_resource* memory) {
  const ShapeBounds bounds(c.draft.chunk());
  DraftCopier copier(c.draft.chunk());
  std::vector<RuleInstance> instances;
  size_t shapes = 0;
  for (const WatchedCall& call : watch.calls()) {
    RuleInstance instance{c.activations[call.activation].start.snap({}), c.activations.pathText(call.activation), true,
                          GrammarChunk(memory)};
    instance.chunk.layer = c.in.layer_index;
    instance.chunk.cell = c.in.cell;
    std::vector<Group> groups;
    const bool cuts_only = call.shapes.empty();
    instance.bounded = collectAlone(call.shapes, false, bounds, c, groups) &&
                       collectAlone(call.layer_cuts, !cuts_only, bounds, c, groups);
    if (instance.bounded) copier.copy(groups, instance.chunk);
    instance.chunk.anchors.assign(c.sink.anchors().begin() + static_cast<std::ptrdiff_t>(call.first_anchor),
                                  c.sink.anchors().begin() + static_cast<std::ptrdiff_t>(call.end_anchor));
    // Shapes of nested activations are part of several copies, so the total number of copied shapes must be limited.
    shapes += instance.chunk.shapes.size();
    if (shapes > c.in.limits.shapes) {
      return Error{Code::limit, "the uses of `" + std::string(c.program.text(c.program.rules[rule].name)) +
                                    "` in one cell have more than " + std::to_string(c.in.limits.shapes) +
                                    " shapes together; ask for a smaller rule"};
    }
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace

Result<GrammarChunk> deriveCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits,
                                std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  CellContext c({program, parameters, world_seed, layer, cell, lower, limits}, {}, memory);
  return runCell(c, nullptr, memory);
}

Result<TracedCell> traceCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                             uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits,
                             std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  CellContext c({program, parameters, world_seed, layer, cell, lower, limits}, {}, memory);
  std::vector<uint32_t> from;
  Result<GrammarChunk> chunk = runCell(c, &from, memory);
  if (!chunk) return chunk.error();
  TracedCell traced{std::move(*chunk), {}, {}};
  std::map<uint32_t, uint32_t> use_of;  // maps an activation to its index in TracedCell::uses
  for (const uint32_t shape : from) {
    const Origin& origin = c.draft.origin(shape);
    const uint32_t activation = c.activations.outsideOfEdits(origin.activation);
    const auto [use, fresh] = use_of.try_emplace(activation, static_cast<uint32_t>(traced.uses.size()));
    if (fresh) traced.uses.push_back(c.activations.pathText(activation));
    traced.origins.push_back({use->second, origin.span});
  }
  return traced;
}

Result<GrammarChunk> deriveCoarseCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                      uint32_t layer, Int3 cell, int32_t cell_edge, const LowerLayers& lower,
                                      const DeriveLimits& limits, std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  CellContext c({program, parameters, world_seed, layer, cell, lower, limits}, {.coarse_edge = cell_edge}, memory);
  const Result<GrammarChunk> chunk = runCell(c, nullptr, std::pmr::get_default_resource());
  if (!chunk) return chunk.error();
  GrammarChunk coarse = coarseChunk(*chunk, cell_edge, memory);
  coarse.notes.assign(chunk->notes.begin(), chunk->notes.end());
  return coarse;
}

Result<std::vector<RuleInstance>> deriveInstances(const Program& program, const ParameterValues& parameters,
                                                  uint64_t world_seed, uint32_t layer, Int3 cell, uint32_t rule,
                                                  const LowerLayers& lower, const DeriveLimits& limits,
                                                  std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  if (rule >= program.rules.size())
    return Error{Code::invalid_argument, "the grammar has no rule " + std::to_string(rule) + "; it has " +
                                             std::to_string(program.rules.size())};
  RuleWatch watch(rule);
  CellContext c({program, parameters, world_seed, layer, cell, lower, limits}, {.watch = &watch}, memory);
  runStart(c);
  if (c.budget.failed()) return c.budget.error();
  return instancesOf(rule, watch, c, memory);
}

}  // namespace sgm
