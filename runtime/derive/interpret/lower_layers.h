#pragma once
// The interface through which a layer's derivation queries the layers below it. Answers are a pure function of the
// world. world/layers_below.h implements it.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/fixed.h"

namespace sgm {

/// Distance in units between samples of a probe. A probe may miss walls that are thinner than this.
inline constexpr int32_t kProbeStep = 256;

/// What is proven about all positions in a box: all void (open), all solid, or neither (unknown).
enum class BoxContent : uint8_t { open, solid, unknown };

/// All integer positions (units) at most `radius` units from the centre.
struct Ball {
  Int3 centre;
  int32_t radius = 0;
};

/// maximum number of times that the ball's box is halved along each axis, which gives up to 64 pieces along each axis
inline constexpr int kBallHalvings = 6;
/// maximum number of pieces of the ball's box that a proof visits; if it needs more, nothing is proven
inline constexpr uint32_t kMaxBallPieces = 4096;

struct BallProof {
  bool holds = false;
  uint32_t pieces = 0;  ///< number of pieces of the ball's box that the proof visited, as a measure of the work
};

/// Tries to prove that all positions in the ball are `wanted`. Subdivides the ball's box, halving each axis, until
/// every piece that intersects the ball is proven, one piece is proven to differ, or the limits above are reached.
/// content: classifies a box of positions; must not return `unknown` for a box of one position.
BallProof proveBall(const Ball& ball, BoxContent wanted, const std::function<BoxContent(const IntBox&)>& content);

/// Answers queries about the layers below the layer that is derived. Thread-safe: called concurrently by all deriving
/// threads.
class LowerLayers {
 public:
  virtual ~LowerLayers() = default;

  /// Whether the domain with all layers up to and including `layer` is solid at p.
  virtual bool solid(uint32_t layer, Int3 p) const = 0;

  /// Returns the distance in units from `from`, along `direction` (of length 1), to the first solid position within
  /// `length` units; nullopt if there is none, or if `from` is solid. The default implementation samples every
  /// kProbeStep units and at the end, then bisects to one unit: position t is solid and t - 1 is not.
  virtual std::optional<int32_t> probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                                       int32_t length) const;

  /// Calls proveBall() with the answers of solid() for `layer`. The default implementation classifies only boxes of one
  /// position: for a larger box its answer is `unknown`.
  virtual BallProof prove(uint32_t layer, const Ball& ball, BoxContent wanted) const;
};

/// Returns the position t units from `from` along `direction`, rounded to nearest on each axis.
Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t);

}  // namespace sgm
