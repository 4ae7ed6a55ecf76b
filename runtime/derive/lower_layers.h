#pragma once
// What a layer may see of the layers below it. Implemented over finished cells by stream/; a pure function of the
// world.

#include <array>
#include <cstdint>
#include <optional>

#include "base/fixed.h"

namespace sgm {

inline constexpr int32_t kProbeStep = 256;  ///< units between the samples of a probe: thinner walls may be missed

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
};

/// The point t units from `from` along `direction`, rounded to nearest on each axis.
Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t);

}  // namespace sgm
