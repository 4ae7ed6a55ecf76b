#include "stream/edits/field_change.h"

#include <algorithm>
#include <new>

#include "chunk/mesh_chunks.h"
#include "world/edits.h"

namespace sgm {
namespace {

/// The maximum number of changed shape groups that are stored per cell. A cell with more changes stores only one box
/// that encloses all of them.
constexpr size_t kMaxChangesOfCell = 64;

bool sameDomain(const Program& a, const Program& b) {
  return a.domain.solid == b.domain.solid && a.domain.material == b.domain.material &&
         a.materials[a.domain.material] == b.materials[b.domain.material];
}

bool sameCells(const Program& of_a, const Layer& a, const Program& of_b, const Layer& b) {
  return of_a.text(a.name) == of_b.text(b.name) && a.cell == b.cell && (a.cell_expr == kNoId) == (b.cell_expr == kNoId);
}

/// True if two host fields are equal. A host field without an identity never equals another.
bool sameHost(const HostField& a, const HostField& b) {
  return a.identity != 0 && a.identity == b.identity && a.bounds == b.bounds && a.cut == b.cut && a.label == b.label &&
         a.smooth == b.smooth && a.steepness == b.steepness;
}

ChangedShape joined(const std::vector<ChangedShape>& changes) {
  ChangedShape all = changes.front();
  for (const ChangedShape& change : changes) {
    all.box = all.box.joined(change.box);
    all.finest_cell = std::min(all.finest_cell, change.finest_cell);
    all.coarsest_cell = std::max(all.coarsest_cell, change.coarsest_cell);
    all.anchor = all.anchor && change.anchor;
  }
  return all;
}

/// True if a change can affect the body or the seams of a chunk. Seams also sample the next coarser level.
bool touchesChunk(const ChangedShape& change, const ChunkGrid& grid, const IntBox& box) {
  if (change.anchor) return grid.level == 0 && change.box.meets(box);
  return grid.cell <= change.coarsest_cell && int64_t{2} * grid.cell >= change.finest_cell &&
         editReach(change.box, grid.cell).meets(box);
}

}  // namespace

FieldChange::FieldChange(std::shared_ptr<const WorldField> from_in, std::shared_ptr<const WorldField> to_in, bool sharp)
    : from_(std::move(from_in)), to_(std::move(to_in)), sharp_(sharp) {
  to_->adopt(*from_);
  pairLayers();
  const auto keepOthers = [this](std::span<const HostField> of, std::span<const HostField> other) {
    for (size_t i = 0; i < of.size(); ++i) {
      // Host fields are compared index by index, because their order matters: a later field lies on top of the earlier
      // ones.
      if (i >= other.size() || !sameHost(of[i], other[i])) hosts_.push_back(of[i]);
    }
  };
  keepOthers(from_->settings().hosts, to_->settings().hosts);
  keepOthers(to_->settings().hosts, from_->settings().hosts);
}

void FieldChange::pairLayers() {
  const Program &before = *from_->settings().program, &after = *to_->settings().program;
  everything_ = !sameDomain(before, after);
  // Paired layers must have the same order in both fields: this is the index of the first layer of `after` that can
  // still be paired.
  uint32_t next = 0;
  for (uint32_t i = 0; i < before.layers.size(); ++i) {
    const auto same = [&](const Layer& layer) { return sameCells(before, before.layers[i], after, layer); };
    const auto found = std::find_if(after.layers.begin(), after.layers.end(), same);
    if (found == after.layers.end()) {
      layers_.push_back({i, std::nullopt});
      continue;
    }
    const auto partner = static_cast<uint32_t>(found - after.layers.begin());
    if (partner < next) everything_ = true;
    for (; next < partner; ++next) layers_.push_back({std::nullopt, next});
    layers_.push_back({i, partner});
    next = partner + 1;
  }
  for (; next < after.layers.size(); ++next) layers_.push_back({std::nullopt, next});
}

bool FieldChange::shows(const LayerPair& pair, int32_t cell_edge) const {
  const auto shown = [&](const WorldField& field, const std::optional<uint32_t>& layer) {
    if (!layer) return false;
    const Layer& info = field.settings().program->layers[*layer];
    return info.shows(cell_edge) || (cell_edge == field.cellAt(0) && info.anchors);
  };
  return shown(*from_, pair.before) || shown(*to_, pair.after);
}

bool FieldChange::showsOtherwise(const LayerPair& pair, int32_t cell_edge) const {
  if (!pair.before || !pair.after) return false;
  const Layer& before = from_->settings().program->layers[*pair.before];
  const Layer& after = to_->settings().program->layers[*pair.after];
  // The next coarser level is compared too, because the seams of the chunk sample it.
  return before.shows(cell_edge) != after.shows(cell_edge) || before.shows(2 * cell_edge) != after.shows(2 * cell_edge);
}

bool FieldChange::touches(const ChunkKey& key) const {
  const Result<ChunkGrid> grid = chunkGrid(*to_, key);
  if (everything_ || !grid) return true;
  const IntBox box = sampledBox(*grid, grid->level + 1, sharp_);
  for (const HostField& host : hosts_) {
    const IntBox reached = host.bounds.grown(saturate(int64_t{host.smooth} + influenceMargin(grid->cell)));
    if (editReach(reached, grid->cell).meets(box)) return true;
  }
  const IntBox around = editReach(box, grid->cell);
  for (uint32_t i = 0; i < layers_.size(); ++i) {
    const LayerPair& pair = layers_[i];
    if (!shows(pair, grid->cell)) continue;
    if (showsOtherwise(pair, grid->cell)) return true;
    bool touched = false;
    const auto look = [&](Int3 cell) -> Result<void> {
      const std::shared_ptr<const Changes> changes = changesIn(i, cell);
      touched = touched || std::any_of(changes->begin(), changes->end(),
                                       [&](const ChangedShape& change) { return touchesChunk(change, *grid, box); });
      // Not a failure: after a change is found, this error code only ends the iteration over cells.
      if (touched) return Error{Code::cancelled, ""};
      return {};
    };
    // The cells of each field are searched separately, because a layer's reach (how far its shapes may extend beyond
    // their cell) may differ between the fields if the grammar was edited.
    if (pair.before && !from_->cellsAround(*pair.before, around, look)) return true;
    if (pair.after && !to_->cellsAround(*pair.after, around, look)) return true;
  }
  return false;
}

std::shared_ptr<const FieldChange::Changes> FieldChange::changesIn(uint32_t pair, Int3 cell) const {
  const std::pair at{pair, cell};
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(at); found != known_.end()) return found->second;
  }
  // Two threads may compare the same cell concurrently; both get the same result.
  Changes changes = compare(layers_[pair], cell);
  if (changes.size() > kMaxChangesOfCell) changes.assign(1, joined(changes));
  auto found = std::make_shared<const Changes>(std::move(changes));
  const std::lock_guard lock(mutex_);
  return known_.try_emplace(at, std::move(found)).first->second;
}

FieldChange::Changes FieldChange::compare(const LayerPair& pair, Int3 cell) const {
  CellContent before{*from_->settings().program}, after{*to_->settings().program};
  std::shared_ptr<const DerivedCell> old, now;
  const auto derive = [cell](const WorldField& field, const std::optional<uint32_t>& layer, CellContent& content,
                             std::shared_ptr<const DerivedCell>& held) {
    if (!layer) return true;
    Result<std::shared_ptr<const DerivedCell>> derived = field.cell(*layer, cell);
    // Out of memory is not counted as a change but thrown, because the result must not depend on the available memory.
    if (!derived && derived.error().code == Code::out_of_memory) throw std::bad_alloc();
    if (!derived) return false;
    held = std::move(*derived);
    content.chunk = &held->chunk;
    return true;
  };
  // If a cell cannot be derived, meshing fails for every chunk within its reach. So all of these chunks count as
  // changed.
  const Changes all{{IntBox::everything()}};
  if (!derive(*to_, pair.after, after, now)) return all;
  // If the new cell was derived without reading a parameter that differs, the old cell is equal and need not be
  // derived.
  if (pair.before && now != nullptr && to_->derivesAlike(*from_, now->chunk.parameters)) return {};
  if (!derive(*from_, pair.before, before, old)) return all;
  return changedShapes(before, after);
}

}  // namespace sgm
