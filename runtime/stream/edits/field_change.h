#pragma once
// Finds the chunks that must be meshed again when another field (other parameters, or an edited grammar) replaces a
// world's own.
//
// Cells of both fields are derived and compared group by group, except cells that have read no differing parameter. A
// chunk within the bounds of a differing group is meshed again; other chunks keep their meshes.

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

/// The difference between two fields. Thread-safe: a pure function of the fields, with cached results.
class FieldChange {
 public:
  /// Compares two fields with the same finest cell. `to` copies those derived cells of `from` that do not differ
  /// (WorldField::adopt). sharp: true if chunks have sharp features.
  FieldChange(std::shared_ptr<const WorldField> from_in, std::shared_ptr<const WorldField> to_in, bool sharp = false);

  const std::shared_ptr<const WorldField>& to() const { return to_; }

  /// Returns true if the chunk's mesh, seams or anchors may differ. Derives the cells around the chunk that are not
  /// cached, which takes time. A cell that cannot be derived counts as changed.
  bool touches(const ChunkKey& chunk) const;

 private:
  using Changes = std::vector<ChangedShape>;
  /// A pair of layers with the same name and cells, one of each field; or a layer that only one field has.
  struct LayerPair {
    std::optional<uint32_t> before, after;
  };

  void pairLayers();
  bool shows(const LayerPair& pair, int32_t cell_edge) const;
  /// True if only one layer of the pair is visible, by its `detail`, at a level that affects chunks with cells of this
  /// edge (in units).
  bool showsOtherwise(const LayerPair& pair, int32_t cell_edge) const;
  std::shared_ptr<const Changes> changesIn(uint32_t pair, Int3 cell) const;
  Changes compare(const LayerPair& pair, Int3 cell) const;

  const std::shared_ptr<const WorldField> from_;
  const std::shared_ptr<const WorldField> to_;
  const bool sharp_;
  bool everything_ = false;  ///< true if every chunk changes, because the domain or the order of layers differs
  std::vector<LayerPair> layers_;
  std::vector<HostField> hosts_;  ///< host fields that only one of the two fields has
  mutable std::mutex mutex_;      ///< guards the following members
  mutable std::map<std::pair<uint32_t, Int3>, std::shared_ptr<const Changes>> known_;
};

}  // namespace sgm
