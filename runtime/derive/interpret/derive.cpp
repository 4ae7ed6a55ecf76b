#include "derive/interpret/derive.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "base/math.h"
#include "base/plain_text.h"
#include "derive/bounds.h"
#include "derive/coarse_chunk.h"
#include "derive/interpret/group_parts.h"
#include "derive/interpret/interpreter.h"

namespace sgm {
namespace {

std::string metresText(int64_t units) { return fixedText(static_cast<double>(units) / kUnitsPerMetre, 2); }

/// The amount by which `box` exceeds `limit`, in units.
int64_t excess(const IntBox& box, const IntBox& limit) {
  int64_t most = 0;
  for (int a = 0; a < 3; ++a) {
    most = std::max({most, int64_t{limit.lo[a]} - box.lo[a], int64_t{box.hi[a]} - limit.hi[a]});
  }
  return most;
}

/// The amount by which the bounds of shapes of this size may exceed their proven bounds: ShapeBounds::level() includes
/// a margin for the rounding of floats.
int64_t roundingOf(const IntBox& bound) {
  const IntBox all = IntBox::everything();
  int64_t longest = 0;
  for (int a = 0; a < 3; ++a) {
    if (bound.lo[a] > all.lo[a] && bound.hi[a] < all.hi[a]) {
      longest = std::max(longest, int64_t{bound.hi[a]} - bound.lo[a]);
    }
  }
  return longest >> 16;
}

}  // namespace

bool isWhole(const Layer& layer) { return layer.cell_expr == kNoId; }

IntBox cellBox(const Layer& layer, Int3 cell) {
  IntBox box = IntBox::everything();
  for (int a = 0; a < 3; ++a) {
    if (isWhole(layer) || layer.cell[a] <= 0) continue;
    box.lo[a] = saturate(int64_t{cell[a]} * layer.cell[a]);
    box.hi[a] = saturate((int64_t{cell[a]} + 1) * layer.cell[a] - 1);
  }
  return box;
}

IntBox cellLimit(const Program& program, uint32_t layer_index, Int3 cell) {
  const Layer& layer = program.layers[layer_index];
  if (isWhole(layer)) return program.domain.box.grown(kReachSlack);
  IntBox box = cellBox(layer, cell);
  for (int a = 0; a < 3; ++a) {
    if (layer.cell[a] <= 0) continue;
    box.lo[a] = saturate(int64_t{box.lo[a]} - layer.reach - kReachSlack);
    box.hi[a] = saturate(int64_t{box.hi[a]} + 1 + layer.reach + kReachSlack);
  }
  return box;
}

ShapeSpan reachSpan(const Program& program, const Layer& layer, int axis) {
  const IntBox all = IntBox::everything();
  if (isWhole(layer)) {
    return {int64_t{program.domain.box.lo[axis]} - kReachSlack, int64_t{program.domain.box.hi[axis]} + kReachSlack};
  }
  if (layer.cell[axis] <= 0) return {all.lo[axis], all.hi[axis]};
  const int64_t reach = int64_t{layer.reach} + kReachSlack;
  return {-reach, layer.cell[axis] + reach};
}

ShapeSpan shapeSpan(const Program& program, const Layer& layer, int axis) {
  const ShapeSpan reach = reachSpan(program, layer, axis);
  if (!layer.proven) return reach;
  const int64_t room = kReachSlack + roundingOf(layer.bound);
  return {std::max(reach.lo, layer.bound.lo[axis] - room), std::min(reach.hi, layer.bound.hi[axis] + room)};
}

IntBox shapeLimit(const Program& program, uint32_t layer_index, Int3 cell) {
  const Layer& layer = program.layers[layer_index];
  IntBox box;
  for (int a = 0; a < 3; ++a) {
    const ShapeSpan span = shapeSpan(program, layer, a);
    const int64_t corner = isWhole(layer) ? 0 : int64_t{cell[a]} * layer.cell[a];
    box.lo[a] = saturate(corner + span.lo);
    box.hi[a] = saturate(corner + span.hi);
  }
  return box;
}

namespace {

/// True if a box is unbounded only because the cell is at the end of the world, without space beyond.
bool endsWithWorld(const Layer& layer, const IntBox& limit, IntBox box) {
  const IntBox all = IntBox::everything();
  for (int a = 0; a < 3; ++a) {
    if (layer.cell[a] <= 0) continue;
    if (limit.lo[a] == all.lo[a]) box.lo[a] = std::max(box.lo[a], all.lo[a] + 1);
    if (limit.hi[a] == all.hi[a]) box.hi[a] = std::min(box.hi[a], all.hi[a] - 1);
  }
  return isBounded(box);
}

}  // namespace

Interpreter::Interpreter(const Program& program, const ParameterValues& parameters, uint64_t world_seed, uint32_t layer,
                         Int3 cell, const LowerLayers& lower, const DeriveLimits& limits,
                         std::pmr::memory_resource* memory)
    : program_(program),
      parameters_(parameters),
      layer_(program.layers[layer]),
      lower_(lower),
      limits_(limits),
      layer_index_(layer),
      seed_(hashCombine(program.seed, world_seed)),
      cell_(cell),
      draft_(memory),
      active_(program.rules.size()) {
  lattice_.seed = hashCombine(seed_, hashText(program.text(layer_.name)));
  lattice_.size = layer_.cell;
  for (int a = 0; a < 3; ++a) base_[a] = !isWhole(layer_) && lattice_.hasAxis(a) ? cellBox(layer_, cell).lo[a] : 0;
  findOverrides();
}

bool Interpreter::step(uint64_t count, const Span& span, uint32_t activation) {
  if (failed()) return false;
  steps_ += std::min(count, limits_.steps + 1);
  if (steps_ <= limits_.steps) return true;
  fail("deriving one cell takes more than " + std::to_string(limits_.steps) +
           " steps (derive less, or make the cells smaller)",
       span, activation);
  return false;
}

bool Interpreter::withinNesting(const Span& span, uint32_t activation) {
  if (nesting_ <= limits_.nesting) return true;
  fail("expressions and statements are nested too deep (let fewer rules call each other)", span, activation);
  return false;
}

void Interpreter::fail(const std::string& what, const Span& span, uint32_t activation) {
  if (failed()) return;
  const std::string path = pathText(activation);
  Error error{Code::limit, what, span.line, span.column};
  if (!path.empty()) error.message.append(", in ").append(path);
  if (span.file != 0 && span.file < program_.modules.size()) {
    error.message.append(" (").append(program_.modules[span.file].path).append(")");
  }
  error_ = std::move(error);
}

void Interpreter::note(const std::string& message, const Span& span, uint32_t activation) {
  if (notes_.size() >= limits_.notes) {
    ++dropped_notes_;
    return;
  }
  DeriveNote note{message, pathText(activation), span.line, span.column};
  if (span.file != 0 && span.file < program_.modules.size()) {
    note.message.append(" (").append(program_.modules[span.file].path).append(")");
  }
  notes_.push_back(std::move(note));
}

std::string Interpreter::pathText(uint32_t activation) const {
  std::vector<uint32_t> path;
  for (uint32_t i = activation; i != kNone; i = activations_[i].parent) path.push_back(i);
  if (path.empty()) return {};
  std::string text;
  if (!isWhole(layer_)) {
    text.append(program_.text(layer_.name)).append("(").append(std::to_string(cell_.x));
    text.append(", ").append(std::to_string(cell_.y)).append(", ").append(std::to_string(cell_.z)).append(")");
  }
  for (size_t i = path.size(); i-- > 0;) {
    const Activation& a = activations_[path[i]];
    if (!text.empty()) text += '/';
    if (a.edit != kNone) {
      text += "override";
      continue;
    }
    if (a.qualifier != kNoId) text.append(program_.text(a.qualifier)).append(".");
    text += program_.text(program_.rules[a.rule].name);
    if (a.parent == kNone) continue;
    text += '[';
    text += std::to_string(a.index);
    text += ']';
  }
  return text;
}

void Interpreter::noteBeyond(uint32_t shape, const IntBox& box) {
  const IntBox limit = cellLimit(program_, layer_index_, cell_);
  const Origin& origin = draft_.origin(shape);
  const std::string by = isBounded(box) ? metresText(excess(box, limit) + kReachSlack) + " m" : std::string();
  note(!isBounded(box) && endsWithWorld(layer_, limit, box)
           ? "this shape may pass the end of the world, about 2,097 km from the origin; it is left out whole"
       : !isBounded(box)
           ? "this shape has no bound, so no cell can own it; meet it with a box, or give the displacement an amplitude"
       : !isWhole(layer_) ? "this shape may pass the reach of its cell by " + by +
                                "; it is left out whole: raise `reach` or make it smaller"
                          : "this shape may pass the domain's box by " + by +
                                "; it is left out whole: enlarge the box or make it smaller",
       origin.span, origin.activation);
}

void Interpreter::addGroup(Group group, GrammarChunk& out) {
  const IntBox proven = shapeLimit(program_, layer_index_, cell_);
  if (!proven.contains(group.bounds)) {
    // Each warp rounds positions to units; its bounds include a margin for that.
    const std::pmr::vector<Shape>& shapes = draft_.chunk().shapes;
    const auto warps =
        std::count_if(shapes.begin(), shapes.end(), [](const Shape& s) { return s.kind == ShapeKind::warp; });
    const int64_t over = excess(group.bounds, proven);
    assert(over <= warps);
    if (over > warps) {
      const Origin& origin = draft_.origin(group.root);
      note("this shape passes the proven bound of its layer by " + metresText(over) +
               " m and ends there: a bug in the library, please report it",
           origin.span, origin.activation);
    }
    // Gathering the cells of a chunk relies on the proven bound: parts beyond it would show in only some chunks.
    group.bounds = group.bounds.clipped(proven);
  }
  if (!group.bounds.empty()) out.groups.push_back(group);
}

void Interpreter::collectGroups(const ShapeList& list, bool cut, GrammarChunk& out) {
  const ShapeBounds bounds(draft_.chunk());
  const IntBox limit = cellLimit(program_, layer_index_, cell_);
  std::optional<DraftCopier> copier;
  std::vector<std::pair<uint32_t, std::vector<uint32_t>>> parted;
  for (uint32_t root : list) {
    const IntBox box = bounds.level(root, 0);
    if (box.empty()) continue;
    Group group{root, cut, box, draft_.origin(root).key};
    if (isWithin(box, limit)) {
      addGroup(group, out);
      continue;
    }
    if (!copier) copier.emplace(draft_.chunk());
    GrammarChunk alone;
    copier->copy({&group, 1}, alone);
    const std::vector<uint32_t> from(copier->copied().begin(), copier->copied().end());
    const Origin& origin = draft_.origin(root);
    const auto parts =
        partsWithin(alone, limit, [&](uint64_t work) { return step(work, origin.span, origin.activation); });
    if (!parts) return;
    if (!parts->any) {
      noteBeyond(root, box);
      continue;
    }
    std::vector<bool> gone(from.size(), false);
    for (const LeftOutPart& part : parts->left_out) {
      noteBeyond(from[part.shape], part.bounds);
      gone[part.shape] = true;
    }
    for (uint32_t i = 0; i < from.size(); ++i) {
      const Shape& s = alone.shapes[i];
      std::vector<uint32_t> kept;
      for (uint32_t k = 0; k < s.child_count; ++k)
        if (const uint32_t child = alone.children[s.first_child + k]; !gone[child]) kept.push_back(from[child]);
      if (kept.size() < s.child_count) parted.emplace_back(from[i], std::move(kept));
    }
    group.bounds = parts->bounds;
    if (!group.bounds.empty()) addGroup(group, out);
  }
  for (const auto& [shape, kept] : parted) draft_.keepChildren(shape, kept);
}

ShapeList Interpreter::start() {
  Env env;
  env.place.base = base_;
  const IntBox& domain = program_.domain.box;
  for (int a = 0; a < 3; ++a) {
    const int64_t edge = isWhole(layer_) ? int64_t{domain.hi[a]} - domain.lo[a] : layer_.cell[a];
    env.scope[a] = static_cast<double>(std::max<int64_t>(edge, 0)) / kUnitsPerMetre;
  }
  env.key = lattice_.cellKey(cell_);
  env.activation = kNone;
  ShapeList adds;
  call(layer_.start, 0, env, adds);
  return adds;
}

Result<GrammarChunk> Interpreter::derived(std::vector<uint32_t>* from, std::pmr::memory_resource* memory) {
  const ShapeList adds = start();
  if (failed()) return *error_;
  noteMissed();
  GrammarChunk roots(memory), out(memory);
  collectGroups(adds, false, roots);
  collectGroups(layer_cuts_, true, roots);
  if (failed()) return *error_;
  out.layer = layer_index_;
  out.cell = cell_;
  out.parameters = parameters_read_;
  DraftCopier copier(draft_.chunk());
  copier.copy(roots.groups, out);
  if (from != nullptr) from->assign(copier.copied().begin(), copier.copied().end());
  out.anchors.assign(anchors_.begin(), anchors_.end());
  if (dropped_notes_ > 0) {
    // It has no place of its own: the start of the layer is the nearest.
    const Span& span = program_.expr(layer_.start).span;
    const std::string_view what =
        dropped_notes_ == 1 ? " more note on this cell is left out" : " more notes on this cell are left out";
    notes_.push_back({std::to_string(dropped_notes_).append(what), pathText(0), span.line, span.column});
  }
  for (DeriveNote& n : notes_) out.notes.push_back(std::move(n));
  return out;
}

Result<GrammarChunk> Interpreter::run(std::pmr::memory_resource* memory) { return derived(nullptr, memory); }

/// The activation of a rule that a path can name: activations within the blocks of overrides cannot be overridden.
uint32_t Interpreter::outsideOfEdits(uint32_t activation) const {
  uint32_t outside = activation;
  for (uint32_t i = activation; i != kNone; i = activations_[i].parent)
    if (activations_[i].edit != kNone) outside = activations_[i].parent;
  return outside;
}

Result<TracedCell> Interpreter::runTraced(std::pmr::memory_resource* memory) {
  std::vector<uint32_t> from;
  Result<GrammarChunk> chunk = derived(&from, memory);
  if (!chunk) return chunk.error();
  TracedCell traced{std::move(*chunk), {}, {}};
  std::map<uint32_t, uint32_t> use_of;  // activations, to uses in the trace
  for (const uint32_t shape : from) {
    const Origin& origin = draft_.origin(shape);
    const uint32_t activation = outsideOfEdits(origin.activation);
    const auto [use, fresh] = use_of.try_emplace(activation, static_cast<uint32_t>(traced.uses.size()));
    if (fresh) traced.uses.push_back(pathText(activation));
    traced.origins.push_back({use->second, origin.span});
  }
  return traced;
}

Result<GrammarChunk> Interpreter::runCoarse(int32_t cell_edge, std::pmr::memory_resource* memory) {
  // An override's path counts all activations of a rule, including those in shapes that would be left out.
  if (path_overrides_.empty()) coarse_edge_ = cell_edge;
  const Result<GrammarChunk> chunk = run(std::pmr::get_default_resource());
  if (!chunk) return chunk.error();
  GrammarChunk coarse = coarseChunk(*chunk, cell_edge, memory);
  coarse.notes.assign(chunk->notes.begin(), chunk->notes.end());
  return coarse;
}

namespace {

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

}  // namespace

Result<GrammarChunk> deriveCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits,
                                std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  return Interpreter(program, parameters, world_seed, layer, cell, lower, limits, memory).run(memory);
}

Result<TracedCell> traceCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                             uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits,
                             std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  return Interpreter(program, parameters, world_seed, layer, cell, lower, limits, memory).runTraced(memory);
}

Result<GrammarChunk> deriveCoarseCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                      uint32_t layer, Int3 cell, int32_t cell_edge, const LowerLayers& lower,
                                      const DeriveLimits& limits, std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  return Interpreter(program, parameters, world_seed, layer, cell, lower, limits, memory).runCoarse(cell_edge, memory);
}

Result<std::vector<RuleInstance>> deriveInstances(const Program& program, const ParameterValues& parameters,
                                                  uint64_t world_seed, uint32_t layer, Int3 cell, uint32_t rule,
                                                  const LowerLayers& lower, const DeriveLimits& limits,
                                                  std::pmr::memory_resource* memory) {
  if (Result<void> ok = checkArguments(program, parameters, layer, cell); !ok) return ok.error();
  if (rule >= program.rules.size())
    return Error{Code::invalid_argument, "the grammar has no rule " + std::to_string(rule) + "; it has " +
                                             std::to_string(program.rules.size())};
  return Interpreter(program, parameters, world_seed, layer, cell, lower, limits, memory).runInstances(rule, memory);
}

}  // namespace sgm
