#pragma once
// The field of one world, at every position and level. It is defined by a grammar with its parameters, seed and finest
// cell.

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
#include "world/cell_walk.h"
#include "world/edit_snapshot.h"

namespace sgm {

struct WorldFieldSettings {
  std::shared_ptr<const Program> program;
  ParameterValues parameters;
  uint64_t seed = 0;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell in units
  size_t cache_bytes = size_t{64} << 20;
  /// Moves all derived content by this vector, in units, before it is meshed. Used by tests.
  Int3 shift;
  /// Called each time after the derivation of a cell has left out shapes, also if an evicted cell is derived again.
  /// Called from any thread, also concurrently; must not call the field.
  std::function<void(const GrammarChunk&)> on_notes;
  Profiler profiler;
  /// Fields that the host program adds: in this order, they lie above all derived content and below the edits.
  /// Derivation cannot query them.
  std::vector<HostField> hosts;
};

/// A field program whose labels identify shapes instead of materials: the label of a surface point names its shape.
struct ShapeField {
  std::shared_ptr<const FieldProgram> program;
  std::vector<std::shared_ptr<const DerivedCell>> cells;  ///< the cells, in the order of ShapeLabels::Source::cell
  ShapeLabels labels;
};

/// The class is thread-safe. Results are a pure function of the settings; only the cache has state.
class WorldField {
 public:
  /// memory must outlive the field and everything that it returns.
  WorldField(WorldFieldSettings settings, std::pmr::memory_resource* memory);
  /// Makes a field whose only content is one derived cell, `alone`, in an empty domain, instead of the program's
  /// content and domain.
  WorldField(WorldFieldSettings settings, std::shared_ptr<const DerivedCell> alone, std::pmr::memory_resource* memory);

  const WorldFieldSettings& settings() const { return settings_; }
  const Profiler& profiler() const { return settings_.profiler; }
  std::pmr::memory_resource* memory() const { return memory_; }
  int32_t cellAt(int level) const { return settings_.finest_cell << level; }

  /// True if the field was made of a single cell (`alone`).
  bool isAlone() const { return alone_ != nullptr; }
  /// True if the world is solid where there is no shape.
  bool isSolidDomain() const { return !isAlone() && settings_.program->domain.solid; }

  /// Returns bytes that identify the field: they change with everything that changes a result, but not with the layout
  /// and comments of the grammar. nullopt if the field was made of a single cell, since this content has no identifier.
  std::optional<std::vector<std::byte>> identity() const;
  /// Returns the bytes that identify the field in files of version 0.2. The first call for a program parses it again
  /// (formerHash).
  std::optional<std::vector<std::byte>> formerIdentity() const;

  /// Copies those derived cells of another field that this field would derive identically, because the parameters that
  /// they have read have equal values in both fields. Copies none if the program, seed or shift differ.
  void adopt(const WorldField& other) const;

  /// True if this field and `other` derive the same content for a cell. parameters: mask of the parameters that the
  /// cell has read (GrammarChunk::parameters).
  bool derivesAlike(const WorldField& other, uint64_t parameters) const;

  /// Returns a cell of a layer with all detail: from the cache, or derived now.
  Result<std::shared_ptr<const DerivedCell>> cell(uint32_t layer, Int3 cell) const;

  /// Returns the grammar cell's content for levels whose grid cells have the edge cell_edge, in units. A cell that only
  /// coarse levels request is cached without its finer content.
  Result<std::shared_ptr<const DerivedCell>> cellFor(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  /// Derives the cell without the cache, and records the origin of its shapes.
  Result<TracedCell> trace(uint32_t layer, Int3 cell) const;

  /// Calls visit for each cell of a layer whose declared reach (the maximum extent of its shapes) meets the box, in
  /// order z, y, x, until the first error. Error: limit if there are more than 2^24 cells.
  Result<void> cellsAround(uint32_t layer, const IntBox& box,
                           const std::function<Result<void>(Int3 cell)>& visit) const;

  /// Compiles all groups of shapes that matter in the closed box at a level; the host fields and the edits become
  /// layers above these groups. cached_cells: cached cells of this field, which are searched first; all cells used are
  /// added. Errors: limit if more than 2^20 cells of a layer reach into the box, or the box is too large to sample a
  /// host field; errors of derivation and of the host fields.
  Result<std::shared_ptr<const FieldProgram>> compile(const IntBox& box, int level, const EditSnapshot* edits = nullptr,
                                                      CachedCells* cached_cells = nullptr) const;

  /// Same as compile(), but with labels that identify shapes instead of materials and tags.
  Result<ShapeField> compileShapes(const IntBox& box, int level, const EditSnapshot* edits = nullptr) const;

  /// Returns the brushes of `edits` that compile() adds above all other content, in the order of EditOrder.
  std::pmr::vector<Brush> brushes(const IntBox& box, int level, const EditSnapshot* edits) const;

  /// Returns a program for the field beyond the meshed world: solid or void everywhere, like the domain.
  Result<std::shared_ptr<const FieldProgram>> compileOutside(int level) const;

  /// Returns the anchors in the box lo <= p < hi, sorted by layer, cell and key. cached_cells: cached cells, which are
  /// searched first. Errors: limit if the box holds points of more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<Anchor>> anchors(const IntBox& box, const CachedCells* cached_cells = nullptr) const;

  /// Returns notes on content that derivation has left out. Considers the cells whose reach meets the box, of all
  /// layers that are visible at levels whose grid cells have the edge cell_edge, or that may have anchors. The notes of
  /// each cell occur once. Errors: limit if there are more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<DeriveNote>> notes(const IntBox& box, int32_t cell_edge) const;

  /// Returns the uses of a rule whose origins lie in the box lo <= p < hi, sorted by layer and cell; within a cell, in
  /// the order of derivation. Searches only cells whose reach meets the box. Errors: limit if there are more than
  /// `most` uses, or more than 2^24 cells of a layer; errors of derivation.
  Result<std::vector<RuleInstance>> instances(uint32_t rule, const IntBox& box, size_t most) const;

  CellCacheStats cacheStats() const { return cache_.stats(); }

  /// Compiles the layers up to and including `layer` in full detail, for derivations of the layers above. parameters:
  /// if not null, the parameters that these layers have read are added to this mask.
  Result<std::shared_ptr<const FieldProgram>> compileBelow(uint32_t layer, const IntBox& box,
                                                           uint64_t* parameters = nullptr) const;

 private:
  /// The cells from which a program was compiled.
  struct GatheredCells {
    uint64_t parameters = 0;  ///< mask of the parameters that the cells have read
    std::vector<std::shared_ptr<const DerivedCell>> cells;
  };
  Result<std::shared_ptr<const FieldProgram>> compileLayers(uint32_t layers, const IntBox& box,
                                                            const FieldSettings& field,
                                                            std::span<const HostField> hosts,
                                                            std::span<const Brush> brushes, CachedCells& cached_cells,
                                                            GatheredCells* gathered = nullptr) const;
  /// For each layer that `wanted` accepts, in order: calls visit for the content of each cell whose region (CellsBy)
  /// intersects the box.
  Result<void> forEachCell(const IntBox& box, CellsBy by, const std::function<bool(const Layer&)>& wanted,
                           const std::function<void(const GrammarChunk&)>& visit,
                           const CachedCells* cached_cells = nullptr) const;
  /// Makes cached_cells contain the cells of all keys: takes the missing cells from the cache, or derives them.
  Result<void> load(std::span<const CellKey> keys, CachedCells& cached_cells) const;
  FieldSettings fieldSettings(int32_t finest_cell, int32_t cell) const;
  /// Calls `derive` with access to the layers below the cell. Returns the result of `derive`; if access to the lower
  /// layers has failed, returns that error instead.
  template <class T, class Derive>
  Result<T> overLayersBelow(uint32_t layer, Int3 cell, const Derive& derive) const;

  /// Derives a cell without the cache. cell_edge: CellKey::cell_edge.
  Result<GrammarChunk> derive(uint32_t layer, Int3 cell, int32_t cell_edge) const;

  /// Returns the bytes that identify the field, with this hash of the grammar.
  std::vector<std::byte> identityWith(uint64_t grammar) const;

  WorldFieldSettings settings_;
  std::shared_ptr<const DerivedCell> alone_;
  std::pmr::memory_resource* memory_;
  mutable CellCache cache_;
};

}  // namespace sgm
