#pragma once
// Traverses the scene of a glTF file to find the meshes that its nodes use, and the transforms of these nodes.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asset/read/glb_accessor.h"
#include "asset/read/glb_primitive.h"
#include "asset/read/glb_transform.h"
#include "asset/read/mesh_limits.h"
#include "asset/read/mesh_notes.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// Traverses the nodes of the default scene, or of the first scene, or all nodes if the file has no scene, and passes
/// their meshes to GlbMeshes. Supports KHR_node_visibility and EXT_mesh_gpu_instancing.
class GlbScene {
 public:
  GlbScene(const JsonValue& root, const GlbAccessors& accessors, GlbMeshes& meshes, const MeshLimits& limits)
      : root_(root), nodes_(root.list("nodes")), accessors_(accessors), meshes_(meshes), limits_(limits) {}

  /// Traverses the scene. Call only once. Notes are added to the mesh. Errors: bad_input, with the JSON pointer or the
  /// byte in the message; limit.
  Result<void> show();

 private:
  struct Open {
    size_t node;
    GlbTransform place;
    size_t parent;  ///< index of the parent node; the number of nodes stands for the scene itself
  };

  Result<void> openRoots();
  Result<void> visit(const Open& at);
  Result<void> showMesh(size_t node, const GlbTransform& place);
  Result<std::vector<GlbTransform>> instances(const JsonValue& attributes, size_t node) const;

  const JsonValue& root_;
  std::span<const JsonValue> nodes_;
  const GlbAccessors& accessors_;
  GlbMeshes& meshes_;
  const MeshLimits& limits_;
  std::string scene_ = "/nodes";
  std::vector<bool> seen_;
  std::vector<Open> open_;
  NotedPlaces hidden_;
};

}  // namespace sgm::asset
