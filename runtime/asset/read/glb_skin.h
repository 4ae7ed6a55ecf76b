#pragma once
// Applies the skins of a glTF file: transforms a mesh's points by the joints of a skeleton in its rest pose.

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

/// The accessors that bind a primitive's points to joints: the same number of JOINTS_n and WEIGHTS_n attributes.
struct GlbBinding {
  std::vector<size_t> joints, weights;
};

class GlbSkins {
 public:
  GlbSkins(const JsonValue& root, const GlbAccessors& accessors);

  size_t size() const { return skins_.size(); }

  /// Returns, for each point of a primitive, the transform from mesh space to world space: the weighted mean of its
  /// joints' transforms. The transform of the node that uses the mesh has no effect (glTF 2.0, section 3.7.3.3).
  /// Errors: bad_input; limit.
  Result<std::vector<GlbTransform>> pose(size_t skin, const GlbBinding& binding, size_t points);

  /// Adds notes about skin weights that do not sum to one.
  void addNotes(std::vector<std::string>& notes) const;

 private:
  Result<void> readJoints(size_t skin);
  Result<GlbTransform> nodeInWorld(size_t node);

  std::span<const JsonValue> nodes_, skins_;
  const GlbAccessors& accessors_;
  std::vector<size_t> parents_;
  std::vector<std::optional<GlbTransform>> in_world_;  ///< for each node: its transform to world space, if already
                                                       ///< computed
  /// for each skin that was read and each of its joints: the transform from mesh space to world space
  std::vector<std::vector<GlbTransform>> joints_;
  NotedPlaces unbalanced_;
};

}  // namespace sgm::asset
