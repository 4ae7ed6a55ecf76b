#pragma once
// What a streamed world is made with.

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
  size_t mesh_bytes = size_t{256} << 20;  ///< the most bytes of surfaces, the engine's own and those in work included
  bool by_reach = true;                   ///< as PlannerSettings::by_reach
  double collider_distance = 0;           ///< units from a viewer within which chunks have a collider; 0: none has
  size_t max_colliders = 4;               ///< new ones that an update hands over, at least 1
  bool resident = false;                  ///< surfaces are on the backend's device, too (ChunkSurface::on_device)
  bool morph = false;                     ///< surfaces have morph offsets (geomorph.h)
  bool sharp = false;                     ///< surfaces have sharp features (sharpen_chunk.h)
  bool measure = false;                   ///< chunks are measured (world_measures.h)
  bool texture = false;                   ///< surfaces have texture coordinates, in tiles of kTile (surface_shapes.h)
  EditSettings edits{0};                  ///< author 0: drawn at random
  std::filesystem::path journal;          ///< of the edits; empty: they are not kept
  std::filesystem::path cache;            ///< folder of meshed chunks that outlast the world; empty: none
  uint64_t cache_bytes = uint64_t{1} << 30;  ///< the most bytes of its files
  std::shared_ptr<BakedParts> baked;         ///< chunks that were made before; null: none were
  /// Told of what costs work or detail and is no error, of scarce memory once until the world is at rest. Any thread;
  /// must not call back.
  std::function<void(const std::string&)> on_warning;
};

}  // namespace sgm
