#pragma once
// What must be meshed again when another field takes the place of a world's own: other parameters, or a grammar that
// was edited.
//
// Cells of both fields are derived and compared, group by group, but those that have read no parameter which differs.
// So a chunk that no differing group reaches keeps its mesh, and one that a group's bounds reach is meshed again.

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

/// Thread-safe: a pure function of the two fields, which keeps what it has found.
class FieldChange {
 public:
  /// Of two fields with one finest cell. `to` takes over what `from` has derived (WorldField::adopt). sharp: chunks
  /// have sharp features.
  FieldChange(std::shared_ptr<const WorldField> from_in, std::shared_ptr<const WorldField> to_in, bool sharp = false);

  const std::shared_ptr<const WorldField>& to() const { return to_; }

  /// Whether the chunk's mesh, its seams or its anchors may differ. Derives the cells around it, where that has not
  /// been done: as long as that takes. A cell that cannot be derived counts as changed.
  bool touches(const ChunkKey& chunk) const;

 private:
  using Changes = std::vector<ChangedShape>;
  /// A layer of each field with the same name and cells; or one that the other field does not have.
  struct LayerPair {
    std::optional<uint32_t> before, after;
  };

  void pairLayers();
  bool shows(const LayerPair& pair, int32_t cell_edge) const;
  /// One of the two is left out at a level that matters to chunks with cells of this edge: by its own `detail`.
  bool showsOtherwise(const LayerPair& pair, int32_t cell_edge) const;
  std::shared_ptr<const Changes> changesIn(uint32_t pair, Int3 cell) const;
  Changes compare(const LayerPair& pair, Int3 cell) const;

  const std::shared_ptr<const WorldField> from_;
  const std::shared_ptr<const WorldField> to_;
  const bool sharp_;
  bool everything_ = false;  ///< the domain itself differs, or layers that have changed places
  std::vector<LayerPair> layers_;
  std::vector<HostField> hosts_;  ///< of either, that the other does not have
  mutable std::mutex mutex_;      ///< guards what follows
  mutable std::map<std::pair<uint32_t, Int3>, std::shared_ptr<const Changes>> known_;
};

}  // namespace sgm
