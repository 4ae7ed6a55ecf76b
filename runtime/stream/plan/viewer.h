#pragma once
// A camera, or anything else that the world is streamed around, and how urgently it wants each chunk.

#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "stream/plan/lod_target.h"

namespace sgm {

struct Viewer {
  std::array<double, 3> position{};   ///< units
  std::array<double, 3> direction{};  ///< where it looks, of any length; all 0: everywhere
  std::array<double, 3> velocity{};   ///< units a second
  double fov = 0;                     ///< vertical field of view, radians, below pi; 0: that of kUsualFov
  double weight = 1;                  ///< above 0: factor on the distances at which it sees detail
  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// The vertical field of view, radians, that LodSettings' distances hold for: a narrower one sees as much detail from
/// farther away.
inline constexpr double kUsualFov = 1.2217304763960306;  // 70 degrees

/// How far ahead a moving viewer is thought, in seconds: detail is wanted there before it arrives.
inline constexpr double kLookAhead = 0.5;

/// Errors: invalid_argument for what is not finite, a weight not in 0.01..100, a field of view not in 0..3 radians;
/// range for a position outside the world or a velocity above 10,000 m/s.
Result<void> checkViewer(const Viewer& viewer);

/// What wants detail: each viewer, and where it will be soon. Positions come in steps of an eighth of a level-0 chunk,
/// so that a viewer who hardly moves wants the same.
std::vector<LodViewer> lodViewers(std::span<const Viewer> viewers, const LodSettings& settings);

/// A viewer, and what follows from it for every chunk.
struct SeenBy {
  explicit SeenBy(const Viewer& viewer);

  Viewer viewer;
  std::array<double, 3> soon;  ///< where it will be in kLookAhead
  double reach;                ///< as LodViewer::reach
};

/// Smaller is more urgent: the chunk's distance from where the viewer is or will be within kLookAhead, measured by what
/// the chunk's level is wanted within, so that what looks largest comes first; what is behind a viewer waits longer,
/// unless it is nearer than `all_around` (units), where bodies may fall. At least 0.
double urgencyFor(const ChunkKey& key, const SeenBy& seen, const LodSettings& settings, double all_around = 0);

}  // namespace sgm
