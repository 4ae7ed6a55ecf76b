#pragma once
// The engine's side of a streamed world: keeps the meshes and colliders that the world's events deliver.

#include <sgm/sgm.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "tools/flight/flight_curve.h"
#include "tools/flight/frame_checker.h"

namespace sgm::cli {

/// Converts an error of the public C interface.
Error errorOf(const sgm_error& error);

/// A chunk that is currently drawn.
struct DrawnMesh {
  std::shared_ptr<sgm_mesh> mesh;
  uint32_t seams = 0, coarser = 0;
};
using DrawnKey = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, x, y, z
using DrawnMeshes = std::map<DrawnKey, DrawnMesh>;

/// The combined results of checkFrame() over all frames so far.
struct CheckedFrames {
  FrameReport worst;  ///< the largest value of each count over all frames
  uint64_t whole_checks = 0, whole_failures = 0;
  uint64_t between_parts = 0;  ///< the largest WholeReport::between_parts over all complete checks
};

struct ColliderReport {
  uint64_t colliders = 0;  ///< number of colliders that the engine holds
  uint64_t missing = 0;    ///< number of nearby drawn chunks that have triangles but no collider
  uint64_t unlike = 0;     ///< number of colliders that have another number of triangles than the drawn chunk
  uint64_t stray = 0;      ///< number of colliders whose chunk is not drawn

  bool fit() const { return missing + unlike + stray == 0; }
};

/// Processes the events of a streamed world as an engine does. Not thread-safe.
class FlightEngine {
 public:
  /// check: enables checkFrame().
  explicit FlightEngine(bool check);

  /// Processes all pending events; returns the number of bytes of the received meshes. Does not check the surface: see
  /// checkFrame().
  Result<uint64_t> poll(sgm_world* world);
  /// Checks those parts of the drawn surface that the latest changes affect; if `whole`, also checks the whole surface
  /// from scratch. Merges the result into `checked`. Does nothing if checks are not enabled.
  Result<void> checkFrame(bool whole, CheckedFrames& checked);

  /// Whether a place on the surface, in units, is drawn at level 0: a drawn level-0 chunk contains the place or a point
  /// within one grid cell (`cell` units) of it.
  bool finestAt(const int32_t (&place)[3], int32_t cell) const;
  /// Whether every drawn chunk that may have triangles within `distance` metres has a collider; a collider of an
  /// earlier mesh of the chunk suffices.
  bool collidesNear(const Metres3& place, double distance) const;
  /// Compares the number of triangles of each collider with that of its drawn chunk, and counts drawn chunks within
  /// `distance` metres without a collider. Call it only when the world is idle.
  ColliderReport checkColliders(const Metres3& place, double distance) const;

  const DrawnMeshes& drawn() const { return drawn_; }

 private:
  uint64_t take(const sgm_world_event& event);

  std::array<sgm_world_event, 256> events_;
  DrawnMeshes drawn_;
  std::map<DrawnKey, std::shared_ptr<sgm_mesh>> ready_;
  std::map<DrawnKey, std::shared_ptr<sgm_collider>> colliders_;
  std::vector<DrawnKey> changed_;  ///< chunks changed since the last checkFrame(); empty if checks are not enabled
  std::optional<FrameChecker> checker_;
};

}  // namespace sgm::cli
