#pragma once
// Position and view of the camera. Its position is rounded to whole units, so that offsets to chunks are exact.

#include <sgm/sgm.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

using Place = std::array<double, 3>;       ///< a position in metres, or a direction
using Matrix = std::array<float, 16>;      ///< a 4x4 matrix, column-major, as in shaders
using UnitPlace = std::array<int32_t, 3>;  ///< a position in the library's units

struct ViewPoint {
  static constexpr float kFov = 1.2f;    ///< vertical, radians
  static constexpr float kNear = 0.05f;  ///< distance of the near plane in metres

  Place at{};
  Place forward{};  ///< the viewing direction: a unit vector, not vertical

  UnitPlace units() const {
    UnitPlace units{};
    for (size_t axis = 0; axis < 3; ++axis) {
      units[axis] = static_cast<int32_t>(std::floor(at[axis] * SGM_UNITS_PER_METRE));
    }
    return units;
  }

  /// The matrix from metres relative to units() to Vulkan's clip space: y down, depth 1 at kNear and 0 at infinity.
  Matrix matrix(double aspect) const {
    const double level = std::hypot(forward[0], forward[2]);
    const Place right{-forward[2] / level, 0, forward[0] / level};
    const Place up{right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2],
                   right[0] * forward[1] - right[1] * forward[0]};
    const double scale = 1 / std::tan(kFov / 2);
    Matrix matrix{};
    for (size_t axis = 0; axis < 3; ++axis) {
      matrix[4 * axis + 0] = static_cast<float>(right[axis] * scale / aspect);
      matrix[4 * axis + 1] = static_cast<float>(-up[axis] * scale);
      matrix[4 * axis + 3] = static_cast<float>(forward[axis]);
    }
    matrix[14] = kNear;
    return matrix;
  }
};
