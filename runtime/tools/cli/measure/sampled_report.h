#pragma once
// The optional sections of the report of `sgm measure`. These sections need more input than the mesh itself.

#include <string>

#include "asset/triangle_mesh.h"
#include "base/json.h"
#include "measure/texel_density.h"
#include "region/field_agreement.h"
#include "region/level_distance.h"
#include "tools/cli/measure/drawing_cost.h"
#include "tools/support/region.h"

namespace sgm::cli {

/// One section of the report, as JSON and as lines of text.
struct Section {
  Json json;
  std::string text;
};

/// Reports the differences between a mesh and the field from which it was made. cell: edge of the mesh's grid cells,
/// units. origin: world position of the mesh's origin.
Section fieldSection(const FieldAgreement& found, int32_t cell, Int3 origin);

/// Reports the Hausdorff distance between the meshes of two levels of detail, fine and fine + 1. coarse_cell: edge of
/// the coarser level's grid cells, units. origin: world position of the finer mesh's origin.
Section levelSection(const LevelDistance& found, int fine, int32_t coarse_cell, Int3 origin);

/// Reports the Hausdorff distance between two meshes. with: name of the other mesh. triangles: number of triangles of
/// the other mesh. origin: world position of the origin of both meshes.
Section distanceSection(const measure::Hausdorff& found, const std::string& with, size_t triangles,
                        measure::Point origin);

/// Reports the estimated cost of drawing the mesh.
Section drawingSection(const DrawingCost& found);

/// Reports the texel density of a mesh file. resolution: number of texels along the edge of its texture.
Section texelSection(const asset::TriangleMesh& mesh, double resolution);
/// Reports the texel density of a textured region, whose texture repeats in tiles of kTile.
Section texelSection(const Region& region, double resolution);

}  // namespace sgm::cli
