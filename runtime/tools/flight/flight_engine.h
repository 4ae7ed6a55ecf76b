#pragma once
// An engine's side of a streamed world: draws and collides with what the events deliver.

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

/// Converts an error of the public interface.
Error errorOf(const sgm_error& error);

/// A chunk that is currently drawn.
struct DrawnMesh {
  std::shared_ptr<sgm_mesh> mesh;
  uint32_t seams = 0, coarser = 0;
};
using DrawnKey = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, x, y, z
using DrawnMeshes = std::map<DrawnKey, DrawnMesh>;

/// The worst values of all checked frames.
struct CheckedFrames {
  FrameReport worst;  ///< the largest counts of any frame
  uint64_t whole_checks = 0, whole_failures = 0;
  uint64_t between_parts = 0;  ///< the largest of all complete checks
};

struct ColliderReport {
  uint64_t colliders = 0;  ///< held by the engine
  uint64_t missing = 0;    ///< nearby drawn chunks without one
  uint64_t unlike = 0;     ///< differ from the drawn triangles
  uint64_t stray = 0;      ///< belong to chunks that are not drawn

  bool fit() const { return missing + unlike + stray == 0; }
};

/// One thread at a time.
class FlightEngine {
 public:
  /// check: enables checkFrame().
  explicit FlightEngine(bool check);

  /// Processes all events; returns the bytes of the delivered meshes. Checks are left to checkFrame().
  Result<uint64_t> poll(sgm_world* world);
  /// Checks the changes in what is drawn, or all of it; does nothing if the engine does not check.
  Result<void> checkFrame(bool whole, CheckedFrames& checked);

  /// Whether a place of the surface, in units, is drawn at level 0: a chunk of that level with triangles contains it or
  /// lies within a cell of it.
  bool finestAt(const int32_t (&place)[3], int32_t cell) const;
  /// Whether every drawn chunk that may have triangles within `distance` metres has a collider, even an outdated one.
  bool collidesNear(const Metres3& place, double distance) const;
  /// The same with exact comparison of triangles: for an idle world.
  ColliderReport checkColliders(const Metres3& place, double distance) const;

  const DrawnMeshes& drawn() const { return drawn_; }

 private:
  uint64_t take(const sgm_world_event& event);

  std::array<sgm_world_event, 256> events_;
  DrawnMeshes drawn_;
  std::map<DrawnKey, std::shared_ptr<sgm_mesh>> ready_;
  std::map<DrawnKey, std::shared_ptr<sgm_collider>> colliders_;
  std::vector<DrawnKey> changed_;  ///< since the last checkFrame(), if there is a checker
  std::optional<FrameChecker> checker_;
};

}  // namespace sgm::cli
