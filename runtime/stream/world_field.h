#pragma once
// A grammar with its parameters, seed and finest cell: the field of one world, at every place and level.

#include <memory>
#include <vector>

#include "backend/backend.h"
#include "derive/derive.h"
#include "field/evaluate.h"
#include "stream/cell_cache.h"

namespace sgm {

struct WorldFieldSettings {
  std::shared_ptr<const Program> program;
  ParameterValues parameters;
  uint64_t seed = 0;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell in units
  size_t cache_bytes = size_t{64} << 20;
  /// For tests: everything that is derived is moved by this many units before it is meshed.
  Int3 shift;
};

/// Thread-safe: what it answers is a pure function of its settings; only its cache has a state.
class WorldField {
 public:
  /// memory must outlive the field and all that it hands out.
  WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory);

  const WorldFieldSettings& settings() const { return settings_; }
  std::pmr::memory_resource* memory() const { return memory_; }
  int32_t cellAt(int level) const { return settings_.finest_cell << level; }

  /// The cell of a layer, derived or from the cache.
  Result<std::shared_ptr<const DerivedCell>> cell(uint32_t layer, Int3 cell) const;

  /// The program of all groups that matter in the closed box at a level.
  Result<std::shared_ptr<const FieldProgram>> compile(const IntBox& box, int level) const;

  /// Anchors in the box lo <= p < hi, by layer, cell and key.
  Result<std::vector<Anchor>> anchors(const IntBox& box) const;

  /// What derivation had to leave out in the cells that reach into the box; each cell's notes once.
  Result<std::vector<DeriveNote>> notes(const IntBox& box) const;

  CellCacheStats cacheStats() const { return cache_.stats(); }

  /// Cells of a layer whose shapes can reach into the box.
  /// limit: more than 2^20 of them.
  Result<std::vector<CellKey>> cellsReaching(uint32_t layer, const IntBox& box) const;

  /// The program of the layers up to and including `layer`, in full detail: what a derivation above may ask about.
  Result<std::shared_ptr<const FieldProgram>> compileBelow(uint32_t layer, const IntBox& box) const;

 private:
  Result<std::shared_ptr<const FieldProgram>> compileLayers(uint32_t layers, const IntBox& box,
                                                            const FieldSettings& field) const;
  /// Visits the cells of all layers that can reach into the box, in order.
  Result<void> forEachCell(const IntBox& box, const std::function<void(const GrammarChunk&)>& visit) const;
  FieldSettings fieldSettings(int32_t finest_cell, int32_t cell) const;

  WorldFieldSettings settings_;
  std::pmr::memory_resource* memory_;
  mutable CellCache cache_;
};

}  // namespace sgm
