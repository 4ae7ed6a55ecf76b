#pragma once
// Optional sections of `sgm measure`, which need more than the mesh itself.

#include <string>

#include "asset/triangle_mesh.h"
#include "base/json.h"
#include "measure/texel_density.h"
#include "region/field_agreement.h"
#include "region/level_distance.h"
#include "tools/cli/measure/drawing_cost.h"
#include "tools/support/region.h"

namespace sgm::cli {

/// For --json, and as lines of text.
struct Section {
  Json json;
  std::string text;
};

/// cell: the mesh's, units. origin: of its positions.
Section fieldSection(const FieldAgreement& found, int32_t cell, Int3 origin);

/// One pair of levels: fine and fine + 1. coarse_cell: units. origin: of the fine one's positions.
Section levelSection(const LevelDistance& found, int fine, int32_t coarse_cell, Int3 origin);

/// with: the name of the other mesh. triangles: its number of triangles. origin: of both meshes.
Section distanceSection(const measure::Hausdorff& found, const std::string& with, size_t triangles,
                        measure::Point origin);

/// The cost of drawing it.
Section drawingSection(const DrawingCost& found);

/// For a file. resolution: texels on the edge of its texture.
Section texelSection(const asset::TriangleMesh& mesh, double resolution);
/// For a textured region, in tiles of kTile.
Section texelSection(const Region& region, double resolution);

}  // namespace sgm::cli
