#include "stream/world_field.h"

#include <algorithm>

#include "derive/chunk_ops.h"
#include "stream/layers_below.h"

namespace sgm {

namespace {

constexpr int64_t kMaxCells = int64_t{1} << 20;

// floor(a / b) for b > 0.
int64_t floorDiv(int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

IntBox moved(const IntBox& box, Int3 by) { return {saturatingAdd(box.lo, by), saturatingAdd(box.hi, by)}; }

}  // namespace

WorldField::WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory)
    : settings_(std::move(settings)), memory_(memory), cache_(settings_.cache_bytes, memory) {}

Result<std::shared_ptr<const DerivedCell>> WorldField::cell(uint32_t layer, Int3 at) const {
  return cache_.get({layer, at}, [&]() -> Result<GrammarChunk> {
    const Program& program = *settings_.program;
    // Probes start in the cell and end within its reach.
    const IntBox around = moved(cellLimit(program, layer, at), settings_.shift);
    LayersBelow below(*this, around);
    Result<GrammarChunk> chunk =
        deriveCell(program, settings_.parameters, settings_.seed, layer, at, below, DeriveLimits{}, memory_);
    if (below.error()) return *below.error();
    if (chunk && settings_.shift != Int3{}) translate(*chunk, settings_.shift);
    return chunk;
  });
}

Result<std::vector<CellKey>> WorldField::cellsReaching(uint32_t layer, const IntBox& box) const {
  const Layer& info = settings_.program->layers[layer];
  if (info.cell_expr == kNoId) return std::vector<CellKey>{{layer, {}}};  // a grammar without layers is one cell
  const IntBox home = moved(box, {saturate(-int64_t{settings_.shift.x}), saturate(-int64_t{settings_.shift.y}),
                                  saturate(-int64_t{settings_.shift.z})});
  if (isWhole(info)) return std::vector<CellKey>{{layer, {}}};
  std::array<int64_t, 3> first{}, last{};
  const int64_t reach = int64_t{info.reach} + kReachSlack;
  int64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const int64_t edge = info.cell[axis];
    if (edge == 0) continue;
    // Cells that would lie partly outside of the world derive nothing.
    const int64_t world_first = floorDiv(int64_t{INT32_MIN} + edge - 1, edge),
                  world_last = floorDiv(INT32_MAX, edge) - 1;
    first[a] = std::clamp(floorDiv(int64_t{home.lo[axis]} - reach, edge), world_first, world_last);
    last[a] = std::clamp(floorDiv(int64_t{home.hi[axis]} + reach, edge), world_first, world_last);
    count *= last[a] - first[a] + 1;
    if (count > kMaxCells) {
      return Error{Code::limit, "more than a million cells reach into one chunk; make the layer's cells larger"};
    }
  }
  std::vector<CellKey> cells;
  cells.reserve(static_cast<size_t>(count));
  for (int64_t z = first[2]; z <= last[2]; ++z) {
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      for (int64_t x = first[0]; x <= last[0]; ++x) cells.push_back({layer, {saturate(x), saturate(y), saturate(z)}});
    }
  }
  return cells;
}

FieldSettings WorldField::fieldSettings(int32_t finest_cell, int32_t cell) const {
  const Domain& domain = settings_.program->domain;
  return {finest_cell, cell, domain.solid, makeLabel(domain.material, 0)};
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compileLayers(uint32_t layers, const IntBox& box,
                                                                      const FieldSettings& field) const {
  const IntBox reached = box.grown(influenceMargin(field.cell));
  std::vector<std::shared_ptr<const DerivedCell>> held;
  std::vector<IndexedCell> indexed;
  for (uint32_t layer = 0; layer < layers; ++layer) {
    Result<std::vector<CellKey>> keys = cellsReaching(layer, reached);
    if (!keys) return keys.error();
    for (const CellKey& key : *keys) {
      Result<std::shared_ptr<const DerivedCell>> derived = cell(key.layer, key.cell);
      if (!derived) return derived.error();
      indexed.push_back((*derived)->indexed());
      held.push_back(std::move(*derived));
    }
  }
  Result<FieldProgram> program = compileField(indexed, box, field, memory_);
  if (!program) return program.error();
  return std::shared_ptr<const FieldProgram>(std::make_shared<FieldProgram>(std::move(*program)));
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compile(const IntBox& box, int level) const {
  return compileLayers(static_cast<uint32_t>(settings_.program->layers.size()), box,
                       fieldSettings(settings_.finest_cell, cellAt(level)));
}

Result<std::shared_ptr<const FieldProgram>> WorldField::compileBelow(uint32_t layer, const IntBox& box) const {
  // One unit as the cell: in full detail, and the same whatever cells the world is meshed with.
  return compileLayers(layer + 1, box, fieldSettings(1, 1));
}

Result<void> WorldField::forEachCell(const IntBox& box, const std::function<void(const GrammarChunk&)>& visit) const {
  for (uint32_t layer = 0; layer < settings_.program->layers.size(); ++layer) {
    Result<std::vector<CellKey>> keys = cellsReaching(layer, box);
    if (!keys) return keys.error();
    for (const CellKey& key : *keys) {
      Result<std::shared_ptr<const DerivedCell>> derived = cell(key.layer, key.cell);
      if (!derived) return derived.error();
      visit((*derived)->chunk);
    }
  }
  return {};
}

Result<std::vector<Anchor>> WorldField::anchors(const IntBox& box) const {
  std::vector<Anchor> found;
  const Result<void> visited = forEachCell(box, [&](const GrammarChunk& chunk) {
    for (const Anchor& a : chunk.anchors) {
      const Int3 p = a.frame.origin;
      const bool below_top = p.x < box.hi.x && p.y < box.hi.y && p.z < box.hi.z;
      if (box.contains(p) && below_top) found.push_back(a);
    }
  });
  if (!visited) return visited.error();
  return found;
}

Result<std::vector<DeriveNote>> WorldField::notes(const IntBox& box) const {
  std::vector<DeriveNote> found;
  const Result<void> visited = forEachCell(
      box, [&](const GrammarChunk& chunk) { found.insert(found.end(), chunk.notes.begin(), chunk.notes.end()); });
  if (!visited) return visited.error();
  return found;
}

}  // namespace sgm
