#pragma once
// The settings of a streamed world.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "store/cache/baked_parts.h"
#include "stream/edits/edit_journal.h"
#include "stream/plan/lod_target.h"
#include "world/edits.h"

namespace sgm {

struct WorldSettings {
  LodSettings lod;
  size_t mesh_bytes = size_t{256} << 20;  ///< limit for all surfaces, including the engine's and those in work
  bool by_reach = true;                   ///< as PlannerSettings::by_reach
  double collider_distance = 0;           ///< units from a viewer within which chunks have a collider; 0: none
  size_t max_colliders = 4;               ///< new colliders per update, at least 1
  bool resident = false;                  ///< surfaces are on the backend's device, too (ChunkSurface::on_device)
  bool morph = false;                     ///< surfaces have morph offsets (geomorph.h)
  bool sharp = false;                     ///< surfaces have sharp features (sharpen_chunk.h)
  bool measure = false;                   ///< chunks are measured (world_measures.h)
  bool texture = false;                   ///< surfaces have texture coordinates, in tiles of kTile (surface_shapes.h)
  EditSettings edits{0};                  ///< author 0: drawn at random
  std::filesystem::path journal;          ///< of the edits; empty: edits are not saved
  std::filesystem::path cache;            ///< folder of the disk cache of meshed chunks; empty: none
  uint64_t cache_bytes = uint64_t{1} << 30;  ///< limit for the cache's files
  std::shared_ptr<BakedParts> baked;         ///< baked chunks; null: none
  /// Receives warnings about extra work or lost detail; low memory is reported once until the world is at rest. Called
  /// from any thread; must not call back.
  std::function<void(const std::string&)> on_warning;
};

}  // namespace sgm
