#pragma once
// Skins of a glTF file: the rest pose of a mesh's points by the joints of the skeleton.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asset/read/glb_accessor.h"
#include "asset/read/glb_transform.h"
#include "asset/read/mesh_notes.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// The indices of the accessors that bind a primitive's points: equally many of JOINTS_n and WEIGHTS_n.
struct GlbBinding {
  std::vector<size_t> joints, weights;
};

class GlbSkins {
 public:
  GlbSkins(const JsonValue& root, const GlbAccessors& accessors);

  size_t size() const { return skins_.size(); }

  /// The transform of each point of a primitive from its mesh to the world, by its weighted joints. The node that shows
  /// the mesh has no effect (glTF 2.0, section 3.7.3.3). Errors: bad_input; limit.
  Result<std::vector<GlbTransform>> pose(size_t skin, const GlbBinding& binding, size_t points);

  /// Adds notes about weights that do not sum to one.
  void addNotes(std::vector<std::string>& notes) const;

 private:
  Result<void> readJoints(size_t skin);
  Result<GlbTransform> nodeInWorld(size_t node);

  std::span<const JsonValue> nodes_, skins_;
  const GlbAccessors& accessors_;
  std::vector<size_t> parents_;
  std::vector<std::optional<GlbTransform>> in_world_;  ///< of nodes
  std::vector<std::vector<GlbTransform>> joints_;      ///< of skins already read: from the mesh to the world
  NotedPlaces unbalanced_;
};

}  // namespace sgm::asset
