#pragma once
// What a layer may see of the layers below it. Implemented over finished cells by stream/; a pure function of the
// world.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/fixed.h"

namespace sgm {

inline constexpr int32_t kProbeStep = 256;  ///< units between the samples of a probe: thinner walls may be missed

/// What every position of a box holds, as far as that is proven.
enum class BoxContent : uint8_t { open, solid, unknown };

/// All positions (whole units) no farther than `radius` units from the centre.
struct Ball {
  Int3 centre;
  int32_t radius = 0;
};

inline constexpr int kBallHalvings = 6;            ///< of the ball's box along each axis: 64 pieces of it
inline constexpr uint32_t kMostBallPieces = 4096;  ///< looked at; a ball that takes more stays unproven

struct BallProof {
  bool holds = false;
  uint32_t pieces = 0;  ///< looked at: what the proof has cost
};

/// Whether the ball is proven to hold `wanted` and nothing else. Its box is halved along each axis until every piece
/// that meets the ball is proven, one of them is proven to hold something else, or the halvings or pieces are spent.
/// content: of boxes of positions; it must know boxes of one position.
BallProof proveBall(const Ball& ball, BoxContent wanted, const std::function<BoxContent(const IntBox&)>& content);

/// Thread-safe: called from every deriving thread.
class LowerLayers {
 public:
  virtual ~LowerLayers() = default;

  /// Whether the world made of the domain and the layers up to and including `layer` is solid at p.
  virtual bool solid(uint32_t layer, Int3 p) const = 0;

  /// Distance in units from `from` along `direction` (length 1) to the first solid point within `length` units; nothing
  /// where there is none, or where `from` itself is solid. This default samples every kProbeStep units (and at the
  /// end), then halves the interval down to one unit: the answer t is solid and t - 1 is not.
  virtual std::optional<int32_t> probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                                       int32_t length) const;

  /// proveBall() for the world of solid(). This default knows boxes of one position only.
  virtual BallProof prove(uint32_t layer, const Ball& ball, BoxContent wanted) const;
};

/// The point t units from `from` along `direction`, rounded to nearest on each axis.
Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t);

}  // namespace sgm
