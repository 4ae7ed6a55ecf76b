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
  /// limit in bytes for all surfaces, including those that the engine owns or that are being meshed
  size_t mesh_bytes = size_t{256} << 20;
  bool by_reach = true;  ///< true: level 0 is drawn only around chunks that can be reached from a viewer through the
                         ///< void (PlannerSettings::by_reach)
  /// distance from a viewer, in units, within which chunks have a collider; 0: no colliders
  double collider_distance = 0;
  size_t max_colliders = 4;  ///< maximum number of new colliders per update, at least 1
  bool resident = false;     ///< true: surfaces are also stored on the backend's device (ChunkSurface::on_device)
  bool morph = false;        ///< true: surfaces have morph offsets (geomorph.h)
  bool sharp = false;        ///< true: surfaces have sharp features (sharpen_chunk.h)
  bool measure = false;      ///< true: chunks are measured (world_measures.h)
  /// true: surfaces have texture coordinates, in units of kTile (surface_shapes.h)
  bool texture = false;
  EditSettings edits{0};                     ///< settings of edits; author 0: a random author is chosen
  std::filesystem::path journal;             ///< file of the edit journal; empty: edits are not saved
  std::filesystem::path cache;               ///< folder of the disk cache of meshed chunks; empty: no cache
  uint64_t cache_bytes = uint64_t{1} << 30;  ///< limit for the total size of the cache's files, in bytes
  std::shared_ptr<BakedParts> baked;         ///< stores of baked chunks; null: none
  /// Receives warnings about extra work or lost detail. Low memory is reported only once until the world is idle again.
  /// Called from any thread; must not call the world.
  std::function<void(const std::string&)> on_warning;
};

}  // namespace sgm
