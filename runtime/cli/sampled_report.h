#pragma once
// What `sgm measure` says where it is asked for more than the mesh by itself tells.

#include <string>

#include "asset/triangle_mesh.h"
#include "cli/json.h"
#include "cli/region.h"
#include "measure/texel_density.h"
#include "metrics/field_agreement.h"
#include "metrics/level_distance.h"

namespace sgm::cli {

/// For --json, and in lines for people.
struct Section {
  Json json;
  std::string text;
};

/// cell: the mesh's, units. origin: where its positions count from.
Section fieldSection(const FieldAgreement& found, int32_t cell, Int3 origin);

/// Whether the region's surface is watertight but for the border, where the world is cut.
Section borderSection(const Region& region);

/// One pair of levels: fine and fine + 1. coarse_cell: units.
Section levelSection(const LevelDistance& found, int fine, int32_t coarse_cell);

/// with: the name of the other mesh. triangles: how many that has.
Section distanceSection(const measure::Hausdorff& found, const std::string& with, size_t triangles);

/// Of a file. resolution: texels on the edge of its texture.
Section texelSection(const asset::TriangleMesh& mesh, double resolution);
/// Of a region that has been textured, in tiles of kTile.
Section texelSection(const Region& region, double resolution);

}  // namespace sgm::cli
