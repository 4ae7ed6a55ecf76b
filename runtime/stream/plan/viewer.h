#pragma once
// A camera, or another centre of streaming, and its priorities for chunks.

#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "stream/plan/lod_target.h"

namespace sgm {

struct Viewer {
  std::array<double, 3> position{};   ///< units
  std::array<double, 3> direction{};  ///< view direction, of any length; all 0: all directions
  std::array<double, 3> velocity{};   ///< units a second
  double fov = 0;                     ///< vertical field of view, radians, below pi; 0: kUsualFov
  double weight = 1;                  ///< above 0: factor on the distances for detail
  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// The vertical field of view, radians, for which LodSettings' distances hold: a narrower one sees the same detail from
/// farther away.
inline constexpr double kUsualFov = 1.2217304763960306;  // 70 degrees

/// Detail is wanted where a moving viewer will be after this many seconds, before it arrives.
inline constexpr double kLookAhead = 0.5;

/// Errors: invalid_argument for values that are not finite, a weight outside of 0.01..100 or a field of view outside of
/// 0..3 radians; range for a position outside of the world or a velocity above 10,000 m/s.
Result<void> checkViewer(const Viewer& viewer);

/// The places that want detail: each viewer, and where it will be soon. Positions are rounded to an eighth of a level-0
/// chunk, so that small movements change nothing.
std::vector<LodViewer> lodViewers(std::span<const Viewer> viewers, const LodSettings& settings);

/// A viewer with precomputed values.
struct SeenBy {
  explicit SeenBy(const Viewer& viewer);

  Viewer viewer;
  std::array<double, 3> soon;  ///< its position after kLookAhead
  double reach;                ///< as LodViewer::reach
};

/// Smaller is more urgent: the chunk's distance from the viewer's path during kLookAhead, divided by the distance
/// within which the chunk's level is wanted, so that the largest on screen comes first. Chunks behind a viewer wait
/// longer, unless they are nearer than `all_around` (units), where bodies may fall. At least 0.
double urgencyFor(const ChunkKey& key, const SeenBy& seen, const LodSettings& settings, double all_around = 0);

}  // namespace sgm
