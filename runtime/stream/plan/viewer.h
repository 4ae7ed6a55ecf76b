#pragma once
// A camera (or another position around which the world is streamed), and the urgency of chunks for it.

#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "stream/plan/lod_target.h"

namespace sgm {

struct Viewer {
  std::array<double, 3> position{};   ///< units
  std::array<double, 3> direction{};  ///< view direction, of any length; all 0: the viewer looks in all directions
  std::array<double, 3> velocity{};   ///< units a second
  double fov = 0;                     ///< vertical field of view in radians, below pi; 0: kUsualFov
  double weight = 1;                  ///< factor on the distances of levels of detail, above 0
  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// The vertical field of view, in radians, for which the distances of LodSettings hold. With a narrower field of view,
/// the same detail is drawn from farther away.
inline constexpr double kUsualFov = 1.2217304763960306;  // 70 degrees

/// Detail is prepared at the position where a moving viewer will be after this time, in seconds.
inline constexpr double kLookAhead = 0.5;

/// Checks a viewer. Errors: invalid_argument if a value is not finite, the weight is outside of 0.01..100 or the field
/// of view outside of 0..3 radians; range if the position lies outside of the world or the velocity is above 10,000
/// m/s.
Result<void> checkViewer(const Viewer& viewer);

/// Returns the positions around which detail is needed: for each viewer its position now, and its position after
/// kLookAhead. Positions are rounded to an eighth of a level-0 chunk, so that small movements do not change the target
/// octree.
std::vector<LodViewer> lodViewers(std::span<const Viewer> viewers, const LodSettings& settings);

/// A viewer with precomputed values for urgencyFor().
struct SeenBy {
  explicit SeenBy(const Viewer& viewer);

  Viewer viewer;
  std::array<double, 3> soon;  ///< the viewer's position after kLookAhead
  double reach;                ///< factor on all distances (LodViewer::reach)
};

/// Returns how urgent a chunk is for a viewer: 0 or more, smaller is more urgent. The value is the distance of the
/// chunk from the viewer's path during kLookAhead, divided by the distance within which the chunk's level is needed; so
/// the chunk that is largest on screen comes first. Chunks behind a viewer are less urgent, unless they are nearer than
/// `all_around` units, where objects need colliders.
double urgencyFor(const ChunkKey& key, const SeenBy& seen, const LodSettings& settings, double all_around = 0);

}  // namespace sgm
