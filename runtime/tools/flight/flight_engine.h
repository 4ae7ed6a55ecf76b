#pragma once
// An engine's side of a streamed world: what it draws and collides with, told by events alone.

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

/// The public interface's error as one of ours.
Error errorOf(const sgm_error& error);

/// A chunk that is drawn at the moment.
struct DrawnMesh {
  std::shared_ptr<sgm_mesh> mesh;
  uint32_t seams = 0, coarser = 0;
};
using DrawnKey = std::tuple<int32_t, int32_t, int32_t, int32_t>;  ///< level, x, y, z
using DrawnMeshes = std::map<DrawnKey, DrawnMesh>;

/// The worst of all frames that were checked.
struct CheckedFrames {
  FrameReport worst;  ///< the largest counts of any frame
  uint64_t whole_checks = 0, whole_failures = 0;
  uint64_t between_parts = 0;  ///< the largest of any whole check
};

struct ColliderReport {
  uint64_t colliders = 0;  ///< that the engine has
  uint64_t missing = 0;    ///< drawn chunks nearby without one
  uint64_t unlike = 0;     ///< that do not have the triangles that are drawn
  uint64_t stray = 0;      ///< of chunks that are not drawn

  bool fit() const { return missing + unlike + stray == 0; }
};

/// One thread at a time.
class FlightEngine {
 public:
  /// check: the surface of every frame.
  explicit FlightEngine(bool check);

  /// Takes over all events; the bytes of the meshes that came with them. The checker's work waits for checkFrame().
  Result<uint64_t> poll(sgm_world* world);
  /// Checks what is drawn now, as far as it has changed, or all of it; nothing where the engine does not check.
  Result<void> checkFrame(bool whole, CheckedFrames& checked);

  /// Whether a place of the surface, in units, is drawn at level 0: a chunk of that level with triangles holds it, or
  /// all but touches it.
  bool finestAt(const int32_t (&place)[3], int32_t cell) const;
  /// Whether every drawn chunk that may have triangles within so many metres has a collider, of now or of before.
  bool collidesNear(const Metres3& place, double distance) const;
  /// The same to the triangle: for a world that is idle.
  ColliderReport checkColliders(const Metres3& place, double distance) const;

  const DrawnMeshes& drawn() const { return drawn_; }

 private:
  uint64_t take(const sgm_world_event& event);

  std::array<sgm_world_event, 256> events_;
  DrawnMeshes drawn_;
  std::map<DrawnKey, std::shared_ptr<sgm_mesh>> ready_;
  std::map<DrawnKey, std::shared_ptr<sgm_collider>> colliders_;
  std::vector<DrawnKey> changed_;  ///< since the last checkFrame(), where there is a checker
  std::optional<FrameChecker> checker_;
};

}  // namespace sgm::cli
