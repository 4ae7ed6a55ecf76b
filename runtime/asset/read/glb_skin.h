#pragma once
// Skins of a glTF file: where the bones of its nodes hold the points of a mesh, at rest.

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

/// The numbers of a primitive's accessors that bind its points: JOINTS_n and WEIGHTS_n, as many of each.
struct GlbBinding {
  std::vector<size_t> joints, weights;
};

class GlbSkins {
 public:
  GlbSkins(const JsonValue& root, const GlbAccessors& accessors);

  size_t size() const { return skins_.size(); }

  /// How each of a primitive's points is moved from its mesh to the world: by its joints, weighted. The node that shows
  /// the mesh plays no part (glTF 2.0, section 3.7.3.3). Errors: bad_input; limit.
  Result<std::vector<GlbTransform>> pose(size_t skin, const GlbBinding& binding, size_t points);

  /// About weights that do not sum to one.
  void addNotes(std::vector<std::string>& notes) const;

 private:
  Result<void> readJoints(size_t skin);
  Result<GlbTransform> nodeInWorld(size_t node);

  std::span<const JsonValue> nodes_, skins_;
  const GlbAccessors& accessors_;
  std::vector<size_t> parents_;
  std::vector<std::optional<GlbTransform>> in_world_;  ///< of nodes
  std::vector<std::vector<GlbTransform>> joints_;      ///< of skins that have been read: of the mesh to the world
  NotedPlaces unbalanced_;
};

}  // namespace sgm::asset
