#pragma once
// Meshes a region of a grammar's world at one level.

#include "chunk/mesh_chunks.h"
#include "metrics_fixture.h"

namespace sgm::test {

struct LevelMesh {
  WorldMesh mesh;
  IntBox extent;
};

/// A world of one grammar text with one finest cell size, meshed by the CPU.
class MeshedWorld {
 public:
  MeshedWorld(const World& world, double cell)
      : world_(world), field_(settingsOf(world, cell), std::pmr::get_default_resource()) {}

  const WorldField& field() const { return field_; }
  JobSystem& jobs() const { return world_.jobs(); }

  LevelMesh meshed(const IntBox& region, int level = 0, bool sharp = false) const {
    const auto keys = chunksOfRegion(field_, region, level, 65536);
    REQUIRE(keys);
    std::vector<ChunkRequest> requests;
    for (const ChunkKey& key : *keys) {
      requests.push_back({key, 0, {}});
      requests.back().sharp = sharp;
    }
    const auto chunks = meshChunks(field_, world_.backend(), world_.jobs(), requests);
    REQUIRE(chunks);
    std::pmr::vector<PlacedPart> parts;
    for (const PlacedChunk& chunk : *chunks) appendParts(chunk, parts);
    LevelMesh result;
    result.extent = {chunks->front().grid.origin, chunks->back().grid.origin};
    for (int axis = 0; axis < 3; ++axis) result.extent.hi[axis] += kChunkCells * chunks->back().grid.cell;
    Result<WorldMesh> mesh = weld(parts, result.extent.lo);
    REQUIRE(mesh);
    result.mesh = std::move(*mesh);
    return result;
  }
  LevelMesh meshed() const { return meshed(world_.program().domain.box); }

 private:
  static WorldFieldSettings settingsOf(const World& world, double cell) {
    const ExpectationSettings from = world.settings();
    WorldFieldSettings settings;
    settings.program = from.program;
    settings.parameters = from.parameters;
    settings.finest_cell = static_cast<int32_t>(cell * kUnitsPerMetre);
    return settings;
  }

  const World& world_;
  WorldField field_;
};

inline IntBox cube(double from, double to) {
  const auto low = static_cast<int32_t>(from * kUnitsPerMetre), high = static_cast<int32_t>(to * kUnitsPerMetre);
  return {{low, low, low}, {high, high, high}};
}

}  // namespace sgm::test
