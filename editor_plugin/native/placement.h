#pragma once
// Converts between coordinates of the runtime's world and of the scene.

#include <sgm/sgm.h>

#include <array>

#include "godot/variant.h"

namespace sgm_godot {

using Units = std::array<double, 3>;

/// The transform of the node, and the position in the world (in metres) that lies at the node's own origin. A game
/// moves this position along with its player, so that in an endless world single-precision coordinates stay near 0.
struct Placement {
  Transform node;
  Vector3i origin;

  Units toUnits(Vector3 global) const { return localUnits(node.inverse().apply(global)); }
  Units localUnits(Vector3 local) const {
    return {(double{local.x} + origin.x) * SGM_UNITS_PER_METRE, (double{local.y} + origin.y) * SGM_UNITS_PER_METRE,
            (double{local.z} + origin.z) * SGM_UNITS_PER_METRE};
  }
  Vector3 local(const double units[3]) const {
    return {static_cast<float>(units[0] / SGM_UNITS_PER_METRE - origin.x),
            static_cast<float>(units[1] / SGM_UNITS_PER_METRE - origin.y),
            static_cast<float>(units[2] / SGM_UNITS_PER_METRE - origin.z)};
  }
  Vector3 local(const int32_t units[3]) const {
    const double exact[3] = {double(units[0]), double(units[1]), double(units[2])};
    return local(exact);
  }
  Vector3 toGlobal(const double units[3]) const { return node.apply(local(units)); }
  /// The transform of a chunk's or collider's coordinates, which are metres from its corner.
  Transform ofCorner(const int32_t units[3]) const {
    Transform corner;
    corner.origin = local(units);
    return node.after(corner);
  }
  /// The box of the world that contains a box of the scene.
  void box(const Aabb& global, int32_t minimum[3], int32_t maximum[3]) const;
};

}  // namespace sgm_godot
