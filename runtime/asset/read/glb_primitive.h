#pragma once
// Primitives of a glTF file's meshes: reads, transforms and morphs their points, and reads their triangles.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asset/read/glb_accessor.h"
#include "asset/read/glb_material.h"
#include "asset/read/glb_skin.h"
#include "asset/read/glb_transform.h"
#include "asset/read/mesh_limits.h"
#include "asset/read/mesh_notes.h"
#include "asset/triangle_mesh.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// One instance of a mesh in the scene, from a node.
struct GlbShown {
  size_t mesh = 0;
  GlbTransform place;  ///< the node's transform; ignored if the mesh has a skin
  std::optional<size_t> skin;
  std::vector<double> weights;  ///< weight of each morph target; missing weights are 0
};

class GlbMeshes {
 public:
  GlbMeshes(const JsonValue& root, const GlbAccessors& accessors, std::vector<GlbMaterial> materials,
            const MeshLimits& limits);

  size_t size() const { return meshes_.size(); }
  /// Returns the default weights of a mesh's morph targets.
  const std::vector<double>& weightsOf(size_t mesh) const { return meshes_[mesh].weights; }
  /// Adds the triangles of a mesh instance. Errors: bad_input, whose message gives the JSON pointer or the byte offset
  /// of the fault; limit.
  Result<void> show(const GlbShown& shown);
  /// Returns all triangles that show() has added. Call only once. Error: bad_input if there is no triangle.
  Result<TriangleMesh> finish();

  TriangleMesh& mesh() { return mesh_; }

 private:
  /// The attributes of a primitive, as indices of accessors in the file.
  struct Attributes {
    size_t position, normal, coordinates;
  };
  struct Primitive {
    size_t mode, material, indices;
    Attributes own;
    std::vector<Attributes> targets;
    GlbBinding binding;
    size_t coordinates_set = 0;
    bool compressed = false;
  };
  struct Mesh {
    std::vector<Primitive> primitives;
    std::vector<double> weights;
  };
  /// The primitive that is being read; named in error messages.
  struct Here {
    size_t mesh, number;
    const Primitive& primitive;
  };

  static Attributes attributesIn(const JsonValue* of, size_t set);
  Primitive primitiveIn(const JsonValue& value) const;
  void makeRoom();
  Error wrong(const Here& here, std::string_view what, std::string_view member) const;
  std::string pointerOf(const Here& here) const;
  Result<void> areThere(const Here& here) const;
  Result<void> primitive(const Here& here, const GlbShown& shown);
  Result<void> addPoints(const Here& here, const GlbShown& shown, std::vector<GlbTransform>& pose);
  Result<void> morph(const Here& here, const GlbShown& shown, size_t first);
  void moveNormals(size_t first, const GlbShown& shown, const std::vector<GlbTransform>& pose);
  Result<void> addTriangles(const Here& here, const GlbCorners& corners);
  Result<void> addStripOrFan(const Here& here, const GlbCorners& corners);

  const GlbAccessors& accessors_;
  std::vector<GlbMaterial> materials_;
  const MeshLimits& limits_;
  GlbSkins skins_;
  std::vector<Mesh> meshes_;
  TriangleMesh mesh_;
  NotedPlaces lines_, placeless_, unruly_, zero_, uncharted_, unbound_;
};

}  // namespace sgm::asset
