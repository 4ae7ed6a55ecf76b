#pragma once
// Converts a chunk's mesh to surfaces of the engine. Pure functions, which any thread may call.

#include <sgm/sgm.h>

#include "godot/variant.h"

namespace sgm_godot {

/// One surface: a dictionary for RenderingServer.mesh_add_surface, and the slot of the material that draws it.
struct PackedSurface {
  Variant surface;
  uint16_t slot;
  uint32_t triangles;
};

/// Selects the parts of a mesh to pack.
struct Part {
  bool body = true;
  uint32_t seams = 0;  // mask of the seams: the bit of a face's seam is 1 << sgm_face
};

/// Packs the triangles, one surface for each slot. `slots`: the slot of each material of the grammar. Slot 0, the
/// blended material, draws all materials for which the game has set no material of its own. A triangle is drawn by the
/// material with the largest share in it. Positions are metres from the chunk's corner, as exact as in the mesh;
/// attributes have the layout that addons/sgm/shaders/surface.gdshaderinc reads. Returns no surfaces if the part has no
/// triangles.
std::vector<PackedSurface> packSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots);

/// A surface as plain arrays for ArrayMesh: positions, normals, texture coordinates, colours (blended from `palette`)
/// and indices.
struct PlainSurface {
  std::vector<Vector3> positions, normals;
  std::vector<Vector2> coordinates;
  std::vector<Color> colors;
  std::vector<int32_t> indices;
  uint16_t slot;
};
std::vector<PlainSurface> plainSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots,
                                        const std::vector<Color>& palette);

/// The triangles of a collider, three corners each, divided into arrays of at most `most` triangles, so that each shape
/// is small enough to be made within a frame.
std::vector<Variant> packFaces(const sgm_collider_view& collider, size_t most);

}  // namespace sgm_godot
