#pragma once
// The view of a layer on the layers below it. stream/ implements it for finished cells; a pure function of the world.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/fixed.h"

namespace sgm {

inline constexpr int32_t kProbeStep = 256;  ///< units between samples of a probe: thinner walls may be missed

/// The content of all positions of a box, if proven.
enum class BoxContent : uint8_t { open, solid, unknown };

/// All integer positions (units) at most `radius` units from the centre.
struct Ball {
  Int3 centre;
  int32_t radius = 0;
};

inline constexpr int kBallHalvings = 6;            ///< of the ball's box along each axis: 64 pieces of it
inline constexpr uint32_t kMostBallPieces = 4096;  ///< visited pieces; a ball that needs more stays unproven

struct BallProof {
  bool holds = false;
  uint32_t pieces = 0;  ///< visited pieces: the cost of the proof
};

/// Tries to prove that the ball contains only `wanted`. Its box is halved along each axis until every piece that meets
/// the ball is proven, one of them is proven to differ, or the halvings or pieces are used up. content: of boxes of
/// positions; it must give a proven answer for boxes of one position.
BallProof proveBall(const Ball& ball, BoxContent wanted, const std::function<BoxContent(const IntBox&)>& content);

/// Thread-safe: called from every deriving thread.
class LowerLayers {
 public:
  virtual ~LowerLayers() = default;

  /// True if the world of the domain and the layers up to and including `layer` is solid at p.
  virtual bool solid(uint32_t layer, Int3 p) const = 0;

  /// The distance in units from `from` along `direction` (length 1) to the first solid point within `length` units;
  /// nullopt if there is none, or if `from` itself is solid. The default samples every kProbeStep units (and at the
  /// end), then halves the interval down to one unit: position t is solid and t - 1 is not.
  virtual std::optional<int32_t> probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                                       int32_t length) const;

  /// proveBall() for the world of solid(). The default only answers for boxes of one position.
  virtual BallProof prove(uint32_t layer, const Ball& ball, BoxContent wanted) const;
};

/// The point t units from `from` along `direction`, rounded to nearest on each axis.
Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t);

}  // namespace sgm
