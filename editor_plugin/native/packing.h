#pragma once
// A chunk's mesh as surfaces of the engine's. Pure functions, for any thread.

#include <sgm/sgm.h>

#include "godot/variant.h"

namespace sgm_godot {

/// One surface: a dictionary for RenderingServer.mesh_add_surface, and the slot whose material draws it.
struct PackedSurface {
  Variant surface;
  uint16_t slot;
  uint32_t triangles;
};

/// Which parts of a mesh to pack.
struct Part {
  bool body = true;
  uint32_t seams = 0;  // mask of sgm_face
};

/// `slots`: by material of the grammar, the slot of its triangles: 0 is the blended material, which all share that have
/// none of their own. A triangle is of the material that it shows most of. Positions are metres from the chunk's
/// corner, exact as the mesh has them; attributes are laid out as addons/sgm/shaders/surface.gdshaderinc reads them.
/// Empty where the part has no triangles.
std::vector<PackedSurface> packSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots);

/// As above in plain arrays, for ArrayMesh: positions, normals, coordinates, colours (of `palette`, blended) and
/// indices.
struct PlainSurface {
  std::vector<Vector3> positions, normals;
  std::vector<Vector2> coordinates;
  std::vector<Color> colors;
  std::vector<int32_t> indices;
  uint16_t slot;
};
std::vector<PlainSurface> plainSurfaces(const sgm_mesh_view& mesh, Part part, const std::vector<uint16_t>& slots,
                                        const std::vector<Color>& palette);

/// A collider's triangles, three corners each, at most `most` triangles an array: shapes that are small enough to be
/// made within a frame.
std::vector<Variant> packFaces(const sgm_collider_view& collider, size_t most);

}  // namespace sgm_godot
