#pragma once
// What `sgm measure` says where it is asked for more than the mesh by itself tells.

#include <string>

#include "asset/triangle_mesh.h"
#include "base/json.h"
#include "measure/texel_density.h"
#include "region/field_agreement.h"
#include "region/level_distance.h"
#include "tools/cli/measure/drawing_cost.h"
#include "tools/support/region.h"

namespace sgm::cli {

/// For --json, and in lines for people.
struct Section {
  Json json;
  std::string text;
};

/// cell: the mesh's, units. origin: where its positions count from.
Section fieldSection(const FieldAgreement& found, int32_t cell, Int3 origin);

/// One pair of levels: fine and fine + 1. coarse_cell: units. origin: where the fine one's positions count from.
Section levelSection(const LevelDistance& found, int fine, int32_t coarse_cell, Int3 origin);

/// with: the name of the other mesh. triangles: how many that has. origin: where both count from.
Section distanceSection(const measure::Hausdorff& found, const std::string& with, size_t triangles,
                        measure::Point origin);

/// What drawing it costs.
Section drawingSection(const DrawingCost& found);

/// Of a file. resolution: texels on the edge of its texture.
Section texelSection(const asset::TriangleMesh& mesh, double resolution);
/// Of a region that has been textured, in tiles of kTile.
Section texelSection(const Region& region, double resolution);

}  // namespace sgm::cli
