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
  /// For tests: all derived content is moved by this many units before it is meshed.
  Int3 shift;
  /// Called when a derived cell has left something out, each time it is derived (again after its eviction). Any thread,
  /// several concurrently; must not call back.
  std::function<void(const GrammarChunk&)> on_notes;
  Profiler profiler;
  /// Laid above all derived content, in this order, and below edits; derivation does not see them.
  std::vector<HostField> hosts;
};

/// A field whose labels name the shapes that make its surface.
struct ShapeField {
  std::shared_ptr<const FieldProgram> program;
  std::vector<std::shared_ptr<const DerivedCell>> cells;  ///< in the order of ShapeLabels::Source
  ShapeLabels labels;
};

/// Thread-safe. Its answers are a pure function of its settings; only its cache has state.
class WorldField {
 public:
  /// memory must outlive the field and everything it returns.
  WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory);
  /// An empty world that holds only `alone`, in place of the program's content and domain.
  WorldField(WorldFieldSettings settings, std::shared_ptr<const DerivedCell> alone, std::pmr::memory_resource* memory);

  const WorldFieldSettings& settings() const { return settings_; }
  const Profiler& profiler() const { return settings_.profiler; }
  std::pmr::memory_resource* memory() const { return memory_; }
  int32_t cellAt(int level) const { return settings_.finest_cell << level; }

  /// Whether it holds `alone`.
  bool isAlone() const { return alone_ != nullptr; }
  /// Whether the world is solid where there is no shape.
  bool isSolidDomain() const { return !isAlone() && settings_.program->domain.solid; }

  /// Bytes that identify the field: they change with everything that changes an answer, but not with layout and
  /// comments of the grammar. nullopt if the field holds `alone`, whose content has no name.
  std::optional<std::vector<std::byte>> identity() const;

  /// Takes over the derived cells of another field that this one would derive alike, that is, cells that read no
  /// parameter that differs. Takes none if the program, seed or shift differ.
  void adopt(const WorldField& other) const;

  /// Whether both fields derive the same cell, if the cell has read these parameters (GrammarChunk::parameters).
  bool derivesAlike(const WorldField& other, uint64_t parameters) const;

  /// The cell of a layer, derived or from the cache.
  Result<std::shared_ptr<const DerivedCell>> cell(uint32_t layer, Int3 cell) const;

  /// The cell's content for levels whose cells have this edge, units. Cells that only coarse levels need are cached
  /// with that content only.
  Result<std::shared_ptr<const DerivedCell>> cellFor(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  /// Derives the cell anew and records the origin of its shapes.
  Result<TracedCell> trace(uint32_t layer, Int3 cell) const;

  /// Visits the cells of a layer whose declared reach meets the box, in order z, y, x, to the first error.
  /// limit: more than 2^24 cells.
  Result<void> cellsAround(uint32_t layer, const IntBox& box,
                           const std::function<Result<void>(Int3 cell)>& visit) const;

  /// Compiles all groups that matter in the closed box at a level, with the host's fields above them and the edits on
  /// top; derivation sees neither. limit: more than 2^20 cells of a layer reach into the box, or the box is too large
  /// to sample a host's field; errors of derivation and of these fields. at_hand: cells of this field, searched first;
  /// all cells used are added.
  Result<std::shared_ptr<const FieldProgram>> compile(const IntBox& box, int level, const EditSnapshot* edits = nullptr,
                                                      CellsAtHand* at_hand = nullptr) const;

  /// As compile(), but with labels of shapes in place of materials and tags.
  Result<ShapeField> compileShapes(const IntBox& box, int level, const EditSnapshot* edits = nullptr) const;

  /// The edits that compile() lays on top, in order.
  std::pmr::vector<Brush> brushes(const IntBox& box, int level, const EditSnapshot* edits) const;

  /// The program of the domain's own state, the same everywhere: the field beyond the drawn world.
  Result<std::shared_ptr<const FieldProgram>> compileOutside(int level) const;

  /// Anchors in the box lo <= p < hi, by layer, cell and key.
  /// limit: the box holds points of more than 2^24 cells of a layer; errors of derivation. at_hand: cells, searched
  /// first.
  Result<std::vector<Anchor>> anchors(const IntBox& box, const CellsAtHand* at_hand = nullptr) const;

  /// What derivation had to leave out in cells whose reach meets the box, of layers that are visible at cells of this
  /// edge or may have anchors. Each cell's notes come once. limit: more than 2^24 cells of a layer; errors of
  /// derivation.
  Result<std::vector<DeriveNote>> notes(const IntBox& box, int32_t cell_edge) const;

  /// The uses of a rule whose frames stand in the box lo <= p < hi, by layer and cell, in order of derivation. Searches
  /// only cells whose reach meets the box.
  /// limit: more than `most` of them, or more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<RuleInstance>> instances(uint32_t rule, const IntBox& box, size_t most) const;

  CellCacheStats cacheStats() const { return cache_.stats(); }

  /// The program of the layers up to and including `layer`, in full detail, for derivations of the layers above.
  /// parameters: the parameters read are added.
  Result<std::shared_ptr<const FieldProgram>> compileBelow(uint32_t layer, const IntBox& box,
                                                           uint64_t* parameters = nullptr) const;

 private:
  /// The key under which the cache keeps a cell for levels whose cells have this edge.
  CellKey keyFor(uint32_t layer, Int3 at, int32_t cell_edge) const;
  /// Selects the cells that matter in a box: by the proven extent of their shapes, by their declared reach, or by the
  /// points they own.
  enum class CellsBy { shapes, reach, ownership };
  /// Visits the cells of a layer that matter in the box, in order z, y, x, to the first error.
  Result<void> walkCells(uint32_t layer, const IntBox& box, CellsBy by,
                         const std::function<Result<void>(const CellKey&)>& visit) const;
  /// The inputs of a compiled program.
  struct GatheredCells {
    uint64_t parameters = 0;  ///< the parameters that the cells have read
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
  /// Adds the missing cells of the keys to at_hand, from the cache or by derivation.
  Result<void> bring(std::span<const CellKey> keys, CellsAtHand& at_hand) const;
  FieldSettings fieldSettings(int32_t finest_cell, int32_t cell) const;
  /// Runs `derive` with the layers below the cell.
  template <class T, class Derive>
  Result<T> overLayersBelow(uint32_t layer, Int3 cell, const Derive& derive) const;

  /// Bypasses the cache. cell_edge: as in CellKey.
  Result<GrammarChunk> derive(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  WorldFieldSettings settings_;
  std::shared_ptr<const DerivedCell> alone_;
  std::pmr::memory_resource* memory_;
  mutable CellCache cache_;
};

}  // namespace sgm
