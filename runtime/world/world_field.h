#pragma once
// A grammar with its parameters, seed and finest cell: the field of one world, at every place and level.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "base/profile.h"
#include "derive/interpret/derive.h"
#include "field/evaluate.h"
#include "world/cell_cache.h"
#include "world/edit_snapshot.h"

namespace sgm {

struct WorldFieldSettings {
  std::shared_ptr<const Program> program;
  ParameterValues parameters;
  uint64_t seed = 0;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell in units
  size_t cache_bytes = size_t{64} << 20;
  /// For tests: everything that is derived is moved by this many units before it is meshed.
  Int3 shift;
  /// Told of a cell that has left something out, whenever it is derived (again, after the cache has lost it). On any
  /// thread, several at once; must not call back.
  std::function<void(const GrammarChunk&)> on_notes;
  Profiler profiler;
  /// Above all that the grammar derives, in this order, and below edits; derivation knows nothing of them.
  std::vector<HostField> hosts;
};

/// A field whose labels name the shapes that make its surface.
struct ShapeField {
  std::shared_ptr<const FieldProgram> program;
  std::vector<std::shared_ptr<const DerivedCell>> cells;  ///< as ShapeLabels::Source has them
  ShapeLabels labels;
};

/// Thread-safe: what it answers is a pure function of its settings; only its cache has a state.
class WorldField {
 public:
  /// memory must outlive the field and all that it hands out.
  WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory);
  /// An empty world that holds `alone` instead of what the program derives to, whatever the program's domain.
  WorldField(WorldFieldSettings settings, std::shared_ptr<const DerivedCell> alone, std::pmr::memory_resource* memory);

  const WorldFieldSettings& settings() const { return settings_; }
  const Profiler& profiler() const { return settings_.profiler; }
  std::pmr::memory_resource* memory() const { return memory_; }
  int32_t cellAt(int level) const { return settings_.finest_cell << level; }

  /// It holds `alone`.
  bool isAlone() const { return alone_ != nullptr; }
  /// The state of the world where no shape is.
  bool isSolidDomain() const { return !isAlone() && settings_.program->domain.solid; }

  /// Bytes that tell the field from every other: what changes any answer changes them, and layout and comments of the
  /// grammar do not. None of a world that holds `alone`, whose content has no name.
  std::optional<std::vector<std::byte>> identity() const;

  /// Takes over from another field what that one has derived and this one would derive alike: cells that have read no
  /// parameter which differs. None where program, seed or shift are others.
  void adopt(const WorldField& other) const;

  /// Whether this one derives a cell as the other does that has read these parameters (GrammarChunk::parameters).
  bool derivesAlike(const WorldField& other, uint64_t parameters) const;

  /// The cell of a layer, derived or from the cache.
  Result<std::shared_ptr<const DerivedCell>> cell(uint32_t layer, Int3 cell) const;

  /// What levels with cells of this edge, units, have of it: no more than that is kept of cells that only coarse levels
  /// ask for.
  Result<std::shared_ptr<const DerivedCell>> cellFor(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  /// The cell, derived anew, and whence its shapes come.
  Result<TracedCell> trace(uint32_t layer, Int3 cell) const;

  /// Visits the cells of a layer whose declared reach meets the box, in order z, y, x, to the first error.
  /// limit: more than 2^24 cells.
  Result<void> cellsAround(uint32_t layer, const IntBox& box,
                           const std::function<Result<void>(Int3 cell)>& visit) const;

  /// The program of all groups that matter in the closed box at a level, of the host's fields above them and the edits
  /// above these; derivation knows nothing of either. limit: more than 2^20 cells of a layer reach into the box, or the
  /// box is too large to sample a host's field; errors of derivation and of these fields. at_hand: cells are looked for
  /// there first, and all that are used are there afterwards; only of this field.
  Result<std::shared_ptr<const FieldProgram>> compile(const IntBox& box, int level, const EditSnapshot* edits = nullptr,
                                                      CellsAtHand* at_hand = nullptr) const;

  /// As compile(), but with shapes in the place of materials and tags.
  Result<ShapeField> compileShapes(const IntBox& box, int level, const EditSnapshot* edits = nullptr) const;

  /// The edits that compile() lays above all, in order.
  std::pmr::vector<Brush> brushes(const IntBox& box, int level, const EditSnapshot* edits) const;

  /// The program of the domain's own state, everywhere the same: what lies beyond the drawn world.
  Result<std::shared_ptr<const FieldProgram>> compileOutside(int level) const;

  /// Anchors in the box lo <= p < hi, by layer, cell and key.
  /// limit: the box holds points of more than 2^24 cells of a layer; errors of derivation. at_hand: cells are looked
  /// for there first.
  Result<std::vector<Anchor>> anchors(const IntBox& box, const CellsAtHand* at_hand = nullptr) const;

  /// What derivation had to leave out in the cells whose reach meets the box, of layers that show where cells have this
  /// edge or may have anchors; each cell's notes once. limit: more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<DeriveNote>> notes(const IntBox& box, int32_t cell_edge) const;

  /// The uses of a rule whose frames stand in the box lo <= p < hi, by layer and cell, in order of derivation. Only
  /// cells whose reach meets the box are looked at.
  /// limit: more than `most` of them, or more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<RuleInstance>> instances(uint32_t rule, const IntBox& box, size_t most) const;

  CellCacheStats cacheStats() const { return cache_.stats(); }

  /// The program of the layers up to and including `layer`, in full detail: what a derivation above may ask about.
  /// parameters: those that they have read are added.
  Result<std::shared_ptr<const FieldProgram>> compileBelow(uint32_t layer, const IntBox& box,
                                                           uint64_t* parameters = nullptr) const;

 private:
  /// What the cache keeps a cell as for levels with cells of this edge.
  CellKey keyFor(uint32_t layer, Int3 at, int32_t cell_edge) const;
  /// Which cells matter in a box: those whose shapes may lie in it as far as the proof of reach tells, those whose
  /// declared reach meets it, or those that own points of it.
  enum class CellsBy { shapes, reach, ownership };
  /// Visits the cells of a layer that matter in the box, in order z, y, x, to the first error.
  Result<void> walkCells(uint32_t layer, const IntBox& box, CellsBy by,
                         const std::function<Result<void>(const CellKey&)>& visit) const;
  /// What a program was compiled of.
  struct GatheredCells {
    uint64_t parameters = 0;  ///< that they have read
    std::vector<std::shared_ptr<const DerivedCell>> cells;
  };
  Result<std::shared_ptr<const FieldProgram>> compileLayers(uint32_t layers, const IntBox& box,
                                                            const FieldSettings& field,
                                                            std::span<const HostField> hosts,
                                                            std::span<const Brush> brushes, CellsAtHand& at_hand,
                                                            GatheredCells* gathered = nullptr) const;
  /// Visits the cells of all wanted layers that matter in the box, in order.
  Result<void> forEachCell(const IntBox& box, CellsBy by, const std::function<bool(const Layer&)>& wanted,
                           const std::function<void(const GrammarChunk&)>& visit,
                           const CellsAtHand* at_hand = nullptr) const;
  /// Takes those of the keys that are not at hand from the cache, or derives them.
  Result<void> bring(std::span<const CellKey> keys, CellsAtHand& at_hand) const;
  FieldSettings fieldSettings(int32_t finest_cell, int32_t cell) const;
  /// What `derive` makes of the layers below the cell.
  template <class T, class Derive>
  Result<T> overLayersBelow(uint32_t layer, Int3 cell, const Derive& derive) const;

  /// Not from the cache. cell_edge: as in CellKey.
  Result<GrammarChunk> derive(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  WorldFieldSettings settings_;
  std::shared_ptr<const DerivedCell> alone_;
  std::pmr::memory_resource* memory_;
  mutable CellCache cache_;
};

}  // namespace sgm
