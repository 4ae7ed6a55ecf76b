#include "world/ground.h"

#include <algorithm>
#include <cmath>

namespace sgm_godot {
namespace {

constexpr int kMaxObstacles = 8;  // maximum number of bodies between a viewer and its ground that the search skips
constexpr float kDepth = 32;      // metres below a viewer within which ground is searched

}  // namespace

// Only a ray cast in the engine's physics decides: even if the world's field has ground here, the viewer would fall
// through it as long as it has no collider.
bool hasGround(Vector3 position, const WorldNode& node, const Colliders& colliders, const Session& session) {
  const Aabb below{position - Vector3{1, kDepth, 1}, {2, kDepth, 2}};
  if (colliders.waitsIn(below)) return false;
  const Variant query = Variant(engine().classdb_construct_object(Name("PhysicsRayQueryParameters3D").get()));
  query.call("set_from", position);
  query.call("set_to", position - Vector3{0, kDepth, 0});
  query.call("set_collision_mask", node.settings.collision_layer);
  const Variant space = node.call("get_world_3d").call("get_direct_space_state");
  Variant hit = space.call("intersect_ray", query);
  // The ray may hit the viewer's own body, or another body below it, before the ground; such bodies are excluded.
  const Variant others = Variant::array();
  for (int i = 0; i < kMaxObstacles && hit.size() != 0 && hit.get("collider").object() != node.object; ++i) {
    others.call("push_back", hit.get("rid"));
    query.call("set_exclude", others);
    hit = space.call("intersect_ray", query);
  }
  if (hit.size() == 0 || hit.get("collider").object() != node.object) return false;
  // The hit must be at the height of the ground in the world's field. Otherwise the ray has hit a collider farther
  // below.
  const Vector3 ground = hit.get("position").to<Vector3>();
  const Placement placement = node.placement();
  const Units from = placement.toUnits(position);
  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  std::copy_n(from.data(), 3, ray.from);
  const Vector3 down = placement.node.inverse().turn({0, -1, 0});
  ray.direction[0] = down.x;
  ray.direction[1] = down.y;
  ray.direction[2] = down.z;
  ray.length = kDepth;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  if (sgm_world_ray_cast(session.world(), &ray, &point, nullptr) != SGM_OK || point.found == 0) return false;
  const double tolerance = node.settings.cell_size * 4;
  return std::abs(point.distance - double{position.y - ground.y}) <= tolerance;
}

}  // namespace sgm_godot
