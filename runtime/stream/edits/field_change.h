#pragma once
// Finds the chunks that must be meshed again when another field (other parameters, or an edited grammar) replaces the
// field of a world. The cells of both fields are derived, and their shapes compared group by group; a cell whose
// derivation has read no differing parameter is skipped. A chunk within the bounds of a differing group is meshed
// again; other chunks keep their meshes.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "derive/changed_shapes.h"
#include "world/chunk_key.h"
#include "world/world_field.h"

namespace sgm {

/// The difference between two fields. Immutable, except for cached results. Thread-safe.
class FieldChange {
 public:
  /// Compares two fields that have the same finest cell size. `to` copies the derived cells of `from` that do not
  /// differ (WorldField::adopt). sharp: true if chunks have sharp features.
  FieldChange(std::shared_ptr<const WorldField> from_in, std::shared_ptr<const WorldField> to_in, bool sharp = false);

  const std::shared_ptr<const WorldField>& to() const { return to_; }

  /// Returns true if the chunk's mesh, seams or anchors may differ between the fields. Derives the grammar cells around
  /// the chunk unless they are cached; this takes time. A cell that cannot be derived counts as changed.
  bool touches(const ChunkKey& chunk) const;

 private:
  using Changes = std::vector<ChangedShape>;
  /// Two corresponding layers, one in each field, which have the same name and cell size: their indices. For a layer
  /// that only one field has, the index in the other field is nullopt.
  struct LayerPair {
    std::optional<uint32_t> before, after;
  };

  void pairLayers();
  bool shows(const LayerPair& pair, int32_t cell_edge) const;
  /// True if only one of the two layers is shown in chunks with this cell edge (in units), or in the next coarser
  /// chunks, because the layers have different `detail`.
  bool showsOtherwise(const LayerPair& pair, int32_t cell_edge) const;
  std::shared_ptr<const Changes> changesIn(uint32_t pair, Int3 cell) const;
  Changes compare(const LayerPair& pair, Int3 cell) const;

  const std::shared_ptr<const WorldField> from_;
  const std::shared_ptr<const WorldField> to_;
  const bool sharp_;
  bool everything_ = false;  ///< true if every chunk changes, because the domains or the orders of layers differ
  std::vector<LayerPair> layers_;
  std::vector<HostField> hosts_;  ///< host fields that only one of the two fields has
  mutable std::mutex mutex_;      ///< guards the members below
  mutable std::map<std::pair<uint32_t, Int3>, std::shared_ptr<const Changes>> known_;
};

}  // namespace sgm
