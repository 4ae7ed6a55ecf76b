#include "world/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "godot/log.h"

namespace sgm_godot {
namespace {

constexpr int64_t kMaxPoints = int64_t{1} << 27;

/// Returns the nearest whole number of units; nullopt if `units` is not finite or beyond the runtime's coordinates.
std::optional<int32_t> wholeUnits(double units) {
  if (!(std::abs(units) <= std::numeric_limits<int32_t>::max())) return {};
  return static_cast<int32_t>(std::lround(units));
}

/// Computes, for each grid point, the metres of full density between the point and the sun. Works layer by layer from
/// the top, since light reaches a layer through the layer above it. `to_sun` points upwards.
class SunDepth {
 public:
  /// `spacing`: metres between neighbouring points of the sampled grid.
  SunDepth(Vector3i size, double spacing, Vector3 to_sun)
      : width_(static_cast<size_t>(size.x)),
        depth_(static_cast<size_t>(size.z)),
        step_x_(to_sun.x / to_sun.y),
        step_z_(to_sun.z / to_sun.y),
        metres_(static_cast<float>(spacing) / (255 * to_sun.y)),
        above_(width_ * depth_),
        here_(width_ * depth_) {}

  /// Processes the next lower layer. Returns, for each of its points, the metres of full density between the point and
  /// the sun. `densities`: the densities of this layer; x varies fastest; rows begin `pitch` bytes apart.
  const std::vector<float>& lower(const uint8_t* densities, size_t pitch) {
    for (size_t z = 0; z < depth_; ++z) {
      for (size_t x = 0; x < width_; ++x) {
        here_[z * width_ + x] = through(static_cast<float>(x) + step_x_, static_cast<float>(z) + step_z_) +
                                metres_ * static_cast<float>(densities[z * pitch + x]);
      }
    }
    std::swap(above_, here_);
    return above_;
  }

 private:
  float at(int64_t x, int64_t z) const {
    const bool inside = x >= 0 && z >= 0 && x < static_cast<int64_t>(width_) && z < static_cast<int64_t>(depth_);
    return inside ? above_[static_cast<size_t>(z) * width_ + static_cast<size_t>(x)] : 0;
  }
  float through(float x, float z) const {
    const float left = std::floor(x), back = std::floor(z), fx = x - left, fz = z - back;
    const auto i = static_cast<int64_t>(left), k = static_cast<int64_t>(back);
    return (at(i, k) * (1 - fx) + at(i + 1, k) * fx) * (1 - fz) +
           (at(i, k + 1) * (1 - fx) + at(i + 1, k + 1) * fx) * fz;
  }

  size_t width_, depth_;
  float step_x_, step_z_, metres_;
  std::vector<float> above_, here_;
};

}  // namespace

// May run on any thread, so it must not read the scene.
Bytes sampleDensity(const World& world, const Vector3& corner, double spacing, const Vector3i& size,
                    const Vector3& to_sun, double fade, double edge) {
  const ActiveSession::Placed placed = world.stage().active().placed();
  if (placed.session == nullptr) return {};
  const int64_t points = int64_t{size.x} * size.y * size.z;
  const double length = std::hypot(to_sun.x, to_sun.y, to_sun.z);
  if (size.x < 1 || size.y < 1 || size.z < 1 || size.x > 4096 || size.y > 4096 || size.z > 4096 ||
      points > kMaxPoints || !(to_sun.y > 0.05 * length) || !(fade > 0) || !(spacing > 0) || !(edge >= 0)) {
    logError(
        "SgmWorld3D: sample_density takes 1 to 4,096 points along each axis and 134,217,728 in all, a spacing and a "
        "fade above 0, an edge of 0 or more, and a sun that stands 3 degrees above the horizon or higher");
    return {};
  }
  sgm_density_desc desc = SGM_DENSITY_DESC_INIT;
  const Units first = Placement{Transform(), placed.origin}.localUnits(corner);
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::optional<int32_t> units = wholeUnits(first[axis]);
    if (!units) {
      logError("SgmWorld3D: sample_density: the corner's coordinate " + std::string(1, "xyz"[axis]) +
               " lies outside of the world; pass a number that with the node's origin is between -2,097,151 and "
               "2,097,151 metres");
      return {};
    }
    desc.origin[axis] = *units;
  }
  const std::optional<int32_t> step = wholeUnits(spacing * SGM_UNITS_PER_METRE);
  if (!step) {
    logError("SgmWorld3D: sample_density: the spacing is wider than the world; pass one of 2,097,151 metres or less");
    return {};
  }
  desc.spacing = std::max(1, *step);
  desc.size[0] = static_cast<uint32_t>(size.x);
  desc.size[1] = static_cast<uint32_t>(size.y);
  desc.size[2] = static_cast<uint32_t>(size.z);
  std::vector<uint8_t> densities(static_cast<size_t>(points));
  desc.edge = edge;
  desc.values = densities.data();
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_sample_density(placed.session->world(), &desc, &error) < SGM_OK) {
    logError(std::string("SgmWorld3D: ") + error.message);
    return {};
  }
  Packed<uint8_t> result(static_cast<size_t>(points) * 2);
  const size_t width = desc.size[0], slice = width * desc.size[1];
  const auto share_of = [length](float part) { return static_cast<float>(part / length); };
  SunDepth light(size, 1.0 * desc.spacing / SGM_UNITS_PER_METRE,
                 {share_of(to_sun.x), share_of(to_sun.y), share_of(to_sun.z)});
  for (size_t y = desc.size[1]; y-- > 0;) {
    const std::vector<float>& depths = light.lower(densities.data() + y * width, slice);
    for (size_t z = 0; z < desc.size[2]; ++z) {
      for (size_t x = 0; x < width; ++x) {
        const size_t at = z * slice + y * width + x;
        const double share = std::exp(-double{depths[z * width + x]} / fade);
        result.data()[2 * at] = densities[at];
        result.data()[2 * at + 1] = static_cast<uint8_t>(std::lround(255 * share));
      }
    }
  }
  return {result.take()};
}

}  // namespace sgm_godot
