#include "world/world_field.h"

#include <algorithm>

#include "base/bytes.h"
#include "derive/chunk_ops.h"
#include "derive/coarse_chunk.h"
#include "grammar/identity/former_hash.h"
#include "world/layers_below.h"

namespace sgm {

namespace {

/// True if lo <= p < hi on each axis.
bool holds(const IntBox& box, Int3 p) { return box.contains(p) && p.x < box.hi.x && p.y < box.hi.y && p.z < box.hi.z; }

/// Returns for each layer whether its cells may derive the rule.
std::vector<bool> layersDeriving(const Program& program, uint32_t rule) {
  std::vector<bool> found;
  for (const Layer& layer : program.layers) {
    std::vector<bool> reached(program.rules.size());
    std::vector<uint32_t> open;
    const auto reach = [&](uint32_t r) {
      if (!reached[r]) open.push_back(r);
      reached[r] = true;
    };
    if (const ExprNode& start = program.expr(layer.start); start.ref == Ref::rule) reach(start.id);
    while (!open.empty()) {
      const uint32_t from = open.back();
      open.pop_back();
      for (uint32_t to : program.rules[from].calls) reach(to);
    }
    found.push_back(reached[rule]);
  }
  return found;
}

}  // namespace

WorldField::WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory)
    : settings_(std::move(settings)), memory_(memory), cache_(settings_.cache_bytes, memory) {}

WorldField::WorldField(WorldFieldSettings settings, std::shared_ptr<const DerivedCell> alone,
                       std::pmr::memory_resource* memory)
    : settings_(std::move(settings)), alone_(std::move(alone)), memory_(memory), cache_(0, memory) {}

std::optional<std::vector<std::byte>> WorldField::identity() const {
  if (alone_) return std::nullopt;
  return identityWith(settings_.program->hash);
}

std::optional<std::vector<std::byte>> WorldField::formerIdentity() const {
  if (alone_) return std::nullopt;
  return identityWith(formerHash(*settings_.program));
}

std::vector<std::byte> WorldField::identityWith(uint64_t grammar) const {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  out.put(grammar);
  out.put(uint64_t{settings_.parameters.values.size()});
  for (double value : settings_.parameters.values) out.put(value);
  out.put(settings_.seed);
  out.put(settings_.finest_cell);
  for (int axis = 0; axis < 3; ++axis) out.put(settings_.shift[axis]);
  for (const HostField& host : settings_.hosts) {
    out.put(host.identity);
    for (const Int3 corner : {host.bounds.lo, host.bounds.hi}) {
      for (int axis = 0; axis < 3; ++axis) out.put(corner[axis]);
    }
    out.put(uint32_t{host.cut});
    out.put(host.label);
    out.put(host.smooth);
    out.put(host.steepness);
  }
  return bytes;
}

template <class T, class Derive>
Result<T> WorldField::overLayersBelow(uint32_t layer, Int3 at, const Derive& derive) const {
  const ProfileScope scope(profiler(), zone::kDerive);
  // The derivation of the cell queries lower layers at points within the cell's reach, and by probes (rays), which
  // start in the cell and end within its reach. So this box contains all queries.
  const IntBox around = movedBy(cellLimit(*settings_.program, layer, at), settings_.shift);
  LayersBelow below(*this, around);
  Result<T> derived = derive(below);
  if (below.error()) return *below.error();
  return derived;
}

void WorldField::adopt(const WorldField& other) const {
  cache_.adopt(other.cache_, [&](const DerivedCell& cell) { return derivesAlike(other, cell.chunk.parameters); });
}

bool WorldField::derivesAlike(const WorldField& other, uint64_t parameters) const {
  const WorldFieldSettings& theirs = other.settings_;
  return !alone_ && !other.alone_ && settings_.program->hash == theirs.program->hash && settings_.seed == theirs.seed &&
         settings_.shift == theirs.shift &&
         (parameters & changedParameters(settings_.parameters, theirs.parameters)) == 0;
}

Result<GrammarChunk> WorldField::derive(uint32_t layer, Int3 at, int32_t cell_edge) const {
  Result<GrammarChunk> chunk = overLayersBelow<GrammarChunk>(layer, at, [&](const LayersBelow& below) {
    const Program& program = *settings_.program;
    const ParameterValues& parameters = settings_.parameters;
    const uint64_t seed = settings_.seed;
    Result<GrammarChunk> derived =
        cell_edge == 0
            ? deriveCell(program, parameters, seed, layer, at, below, DeriveLimits{}, memory_)
            : deriveCoarseCell(program, parameters, seed, layer, at, cell_edge, below, DeriveLimits{}, memory_);
    if (derived) derived->parameters |= below.parameters();
    return derived;
  });
  if (chunk && settings_.shift != Int3{}) translate(*chunk, settings_.shift);
  // Derivations for coarse levels report no notes, since they would repeat the notes of the finest level.
  if (chunk && settings_.on_notes && !chunk->notes.empty() && cell_edge <= settings_.finest_cell)
    settings_.on_notes(*chunk);
  return chunk;
}

Result<TracedCell> WorldField::trace(uint32_t layer, Int3 at) const {
  Result<TracedCell> traced = overLayersBelow<TracedCell>(layer, at, [&](const LayersBelow& below) {
    return traceCell(*settings_.program, settings_.parameters, settings_.seed, layer, at, below, DeriveLimits{},
                     memory_);
  });
  if (traced && settings_.shift != Int3{}) translate(traced->chunk, settings_.shift);
  return traced;
}

Result<std::shared_ptr<const DerivedCell>> WorldField::cell(uint32_t layer, Int3 at) const {
  return cache_.get({layer, at, 0}, [&] { return derive(layer, at, 0); });
}

Result<std::shared_ptr<const DerivedCell>> WorldField::cellFor(uint32_t layer, Int3 at, int32_t cell_edge) const {
  const CellKey key = cellKey(*settings_.program, settings_.finest_cell, layer, at, cell_edge);
  return cache_.get(key, [&] { return derive(layer, at, key.cell_edge); });
}

Result<std::vector<RuleInstance>> WorldField::instances(uint32_t rule, const IntBox& box, size_t most) const {
  const std::vector<bool> deriving = layersDeriving(*settings_.program, rule);
  std::vector<RuleInstance> found;
  for (uint32_t layer = 0; layer < deriving.size(); ++layer) {
    if (!deriving[layer]) continue;
    const Result<void> walked = cellsAround(layer, box, [&](Int3 at) -> Result<void> {
      Result<std::vector<RuleInstance>> derived =
          overLayersBelow<std::vector<RuleInstance>>(layer, at, [&](const LowerLayers& below) {
            return deriveInstances(*settings_.program, settings_.parameters, settings_.seed, layer, at, rule, below,
                                   DeriveLimits{}, memory_);
          });
      if (!derived) return derived.error();
      for (RuleInstance& instance : *derived) {
        if (settings_.shift != Int3{}) {
          translate(instance.chunk, settings_.shift);
          instance.origin = saturatingAdd(instance.origin, settings_.shift);
        }
        if (holds(box, instance.origin)) found.push_back(std::move(instance));
      }
      if (found.size() > most) {
        return Error{Code::limit, "the region holds more than " + std::to_string(most) + " uses of `" +
                                      std::string(settings_.program->text(settings_.program->rules[rule].name)) +
                                      "`; choose a smaller region"};
      }
      return {};
    });
    if (!walked) return walked.error();
  }
  return found;
}

Result<void> WorldField::cellsAround(uint32_t layer, const IntBox& box,
                                     const std::function<Result<void>(Int3 cell)>& visit) const {
  return walkCells(*settings_.program, settings_.shift, layer, box, CellsBy::reach,
                   [&](const CellKey& key) { return visit(key.cell); });
}

FieldSettings WorldField::fieldSettings(int32_t finest_cell, int32_t cell) const {
  if (alone_) return {finest_cell, cell, false, 0};
  const Domain& domain = settings_.program->domain;
  return {finest_cell, cell, domain.solid, makeLabel(domain.material, 0)};
}

Result<void> WorldField::load(std::span<const CellKey> keys, CachedCells& cached_cells) const {
  std::pmr::vector<CellKey> missing(memory_);
  for (const CellKey& key : keys) {
    if (cached_cells.count(key) == 0) missing.push_back(key);
  }
  if (missing.empty()) return {};
  std::vector<std::shared_ptr<const DerivedCell>> found;
  cache_.find(missing, found);
  for (size_t i = 0; i < missing.size(); ++i) {
    const CellKey& key = missing[i];
    if (!found[i]) {
      Result<std::shared_ptr<const DerivedCell>> derived =
          cache_.get(key, [&] { return derive(key.layer, key.cell, key.cell_edge); });
      if (!derived) return derived.error();
      found[i] = std::move(*derived);
    }
    cached_cells.emplace(key, std::move(found[i]));
  }
  return {};
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compileLayers(
    uint32_t layers, const IntBox& box, const FieldSettings& field, std::span<const HostField> hosts,
    std::span<const Brush> brushes, CachedCells& cached_cells, GatheredCells* gathered) const {
  const ProfileScope scope(profiler(), zone::kCompile);
  const IntBox reached = box.grown(influenceMargin(field.cell));
  std::pmr::vector<IndexedCell> indexed(memory_);
  const auto use = [&](const std::shared_ptr<const DerivedCell>& cell) {
    indexed.push_back(cell->indexed());
    if (gathered == nullptr) return;
    gathered->parameters |= cell->chunk.parameters;
    gathered->cells.push_back(cell);
  };
  if (alone_) use(alone_);
  std::pmr::vector<CellKey> keys(memory_);
  for (uint32_t layer = 0; layer < layers && !alone_; ++layer) {
    if (!settings_.program->layers[layer].shows(field.cell)) continue;
    keys.clear();
    const Result<void> walked = walkCells(
        *settings_.program, settings_.shift, layer, reached, CellsBy::shapes, [&](const CellKey& key) -> Result<void> {
          keys.push_back(cellKey(*settings_.program, settings_.finest_cell, key.layer, key.cell, field.cell));
          return {};
        });
    if (!walked) return walked.error();
    if (const Result<void> brought = load(keys, cached_cells); !brought) return brought.error();
    for (const CellKey& key : keys) use(cached_cells.at(key));
  }
  Result<FieldProgram> program = compileField(indexed, box, field, memory_, hosts, brushes);
  if (!program) return program.error();
  return std::shared_ptr<const FieldProgram>(std::make_shared<FieldProgram>(std::move(*program)));
}

Result<ShapeField> WorldField::compileShapes(const IntBox& box, int level, const EditSnapshot* edits) const {
  ShapeField shapes;
  FieldSettings settings = fieldSettings(settings_.finest_cell, cellAt(level));
  settings.shapes = &shapes.labels;
  CachedCells cached_cells;
  GatheredCells gathered;
  Result<std::shared_ptr<const FieldProgram>> program =
      compileLayers(static_cast<uint32_t>(settings_.program->layers.size()), box, settings, settings_.hosts,
                    brushes(box, level, edits), cached_cells, &gathered);
  if (!program) return program.error();
  shapes.program = std::move(*program);
  shapes.cells = std::move(gathered.cells);
  return shapes;
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compile(const IntBox& box, int level, const EditSnapshot* edits,
                                                                CachedCells* cached_cells) const {
  CachedCells own;
  return compileLayers(static_cast<uint32_t>(settings_.program->layers.size()), box,
                       fieldSettings(settings_.finest_cell, cellAt(level)), settings_.hosts, brushes(box, level, edits),
                       cached_cells != nullptr ? *cached_cells : own);
}

std::pmr::vector<Brush> WorldField::brushes(const IntBox& box, int level, const EditSnapshot* edits) const {
  std::pmr::vector<Brush> found(memory_);
  if (edits) edits->query(box.grown(influenceMargin(cellAt(level))), cellAt(level), found);
  return found;
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compileOutside(int level) const {
  Result<FieldProgram> program =
      compileField({}, IntBox::everything(), fieldSettings(settings_.finest_cell, cellAt(level)), memory_);
  if (!program) return program.error();
  return std::shared_ptr<const FieldProgram>(std::make_shared<FieldProgram>(std::move(*program)));
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compileBelow(uint32_t layer, const IntBox& box,
                                                                     uint64_t* parameters) const {
  // A cell edge of one unit requests full detail, regardless of the cells with which the world is meshed.
  CachedCells cached_cells;
  GatheredCells gathered;
  Result<std::shared_ptr<const FieldProgram>> program =
      compileLayers(layer + 1, box, fieldSettings(1, 1), {}, {}, cached_cells, &gathered);
  if (parameters != nullptr) *parameters |= gathered.parameters;
  return program;
}

Result<void> WorldField::forEachCell(const IntBox& box, CellsBy by, const std::function<bool(const Layer&)>& wanted,
                                     const std::function<void(const GrammarChunk&)>& visit,
                                     const CachedCells* cached_cells) const {
  if (alone_) return visit(alone_->chunk), Result<void>{};
  for (uint32_t layer = 0; layer < settings_.program->layers.size(); ++layer) {
    if (!wanted(settings_.program->layers[layer])) continue;
    const Result<void> walked =
        walkCells(*settings_.program, settings_.shift, layer, box, by, [&](const CellKey& key) -> Result<void> {
          if (cached_cells != nullptr) {
            if (const auto found = cached_cells->find(key); found != cached_cells->end())
              return visit(found->second->chunk), Result<void>{};
          }
          Result<std::shared_ptr<const DerivedCell>> derived = cell(key.layer, key.cell);
          if (!derived) return derived.error();
          visit((*derived)->chunk);
          return {};
        });
    if (!walked) return walked.error();
  }
  return {};
}

Result<std::vector<Anchor>> WorldField::anchors(const IntBox& box, const CachedCells* cached_cells) const {
  std::vector<Anchor> found;
  const auto wanted = [](const Layer& layer) { return layer.anchors; };
  const auto visit = [&](const GrammarChunk& chunk) {
    for (const Anchor& a : chunk.anchors) {
      if (holds(box, a.frame.origin)) found.push_back(a);
    }
  };
  // Anchors always lie inside their own cell, so only cells that intersect the box are visited.
  const Result<void> visited = forEachCell(box, CellsBy::ownership, wanted, visit, cached_cells);
  if (!visited) return visited.error();
  return found;
}

Result<std::vector<DeriveNote>> WorldField::notes(const IntBox& box, int32_t cell_edge) const {
  std::vector<DeriveNote> found;
  const auto wanted = [&](const Layer& layer) { return layer.shows(cell_edge) || layer.anchors; };
  const Result<void> visited = forEachCell(box, CellsBy::reach, wanted, [&](const GrammarChunk& chunk) {
    found.insert(found.end(), chunk.notes.begin(), chunk.notes.end());
  });
  if (!visited) return visited.error();
  return found;
}

}  // namespace sgm
