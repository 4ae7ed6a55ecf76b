#include "world/viewers.h"

#include <algorithm>
#include <cmath>

#include "viewer.h"

namespace sgm_godot {
namespace {

// speed in metres per second; a viewer that moves faster counts as teleported, and gets the velocity 0
constexpr double kFastest = 200;
// metres per frame; if a viewer moves farther, the ground below it is checked again
constexpr float kLeap = 16;

}  // namespace

void Viewers::add(uint64_t id, const Seen& seen, const Placement& placement, double delta) {
  sgm_viewer viewer = SGM_VIEWER_INIT;
  const Units units = placement.toUnits(seen.place.origin);
  for (size_t axis = 0; axis < 3; ++axis) viewer.position[axis] = units[axis] / SGM_UNITS_PER_METRE;
  const Transform inverse = placement.node.inverse();
  if (seen.directional) {
    const Vector3 ahead = inverse.turn(seen.place.column(2) * -1.0f);
    viewer.direction[0] = ahead.x;
    viewer.direction[1] = ahead.y;
    viewer.direction[2] = ahead.z;
  }
  Watched& watched = watched_[id];
  const Vector3 step = watched.seen ? seen.place.origin - watched.position : Vector3{};
  const double length = std::hypot(step.x, step.y, step.z);
  if (length > kLeap) watched.walkable = false;
  if (delta > 0 && length / delta <= kFastest) {
    const Vector3 velocity = inverse.turn(step) * static_cast<float>(1 / delta);
    viewer.velocity[0] = velocity.x;
    viewer.velocity[1] = velocity.y;
    viewer.velocity[2] = velocity.z;
  }
  watched.position = seen.place.origin;
  watched.seen = true;
  viewer.fov = seen.fov > 0 ? static_cast<float>(std::min(seen.fov, 170.0) * 3.14159265358979 / 180) : 0;
  viewer.weight = static_cast<float>(std::clamp(seen.weight, 0.01, 100.0));
  viewers_.push_back(viewer);
  places_.push_back(seen.place.origin);
  units_.push_back(units);
}

void Viewers::gather(double delta) {
  viewers_.clear();
  places_.clear();
  units_.clear();
  for (auto& [id, watched] : watched_) watched.seen = watched.seen && id != 0;
  const Placement placement = node_.placement();
  if (node_.plugin.in_editor) {
    if (editor_view_) add(0, {*editor_view_, editor_fov_, 1, false}, placement, delta);
    return;
  }
  const Variant tree = node_.call("get_tree");
  const Object space = node_.call("get_world_3d").object();
  const Variant nodes = tree.call("get_nodes_in_group", Name(Viewer::kGroup));
  std::unordered_map<uint64_t, Watched> still;
  const int64_t count = nodes.size();
  for (int64_t i = 0; i < count; ++i) {
    const Variant node = nodes.get(i);
    const auto* viewer = instanceOf<Viewer>(node);
    if (viewer == nullptr || !viewer->enabled() || node.call("get_world_3d").object() != space) continue;
    const uint64_t id = engine().object_get_instance_id(node.object());
    add(id, {node.call("get_global_transform").to<Transform>(), viewer->fov(), viewer->weight(), viewer->directional()},
        placement, delta);
    still[id] = watched_[id];
  }
  if (viewers_.empty()) {
    const Variant camera = node_.call("get_viewport").call("get_camera_3d");
    if (camera.object() != nullptr) {
      const uint64_t id = engine().object_get_instance_id(camera.object());
      add(id, {camera.call("get_global_transform").to<Transform>(), camera.call("get_fov").to<double>(), 1, false},
          placement, delta);
      still[id] = watched_[id];
    }
  }
  watched_ = std::move(still);
}

void Viewers::clear() {
  viewers_.clear();
  places_.clear();
  units_.clear();
  watched_.clear();
}

void Viewers::setEditorView(const Transform& view, double fov) {
  editor_view_ = view;
  editor_fov_ = fov;
}

void Viewers::lookForGround(const std::function<bool(Vector3 position)>& has_ground) {
  for (auto& [id, watched] : watched_) {
    if (watched.walkable) continue;
    const Object viewer = engine().object_get_instance_from_id(id);
    if (viewer == nullptr || !has_ground(watched.position)) continue;
    watched.walkable = true;
    node_.messages.announce("walkable", viewer);
  }
}

void Viewers::forgetGround() {
  for (auto& [id, watched] : watched_) watched.walkable = false;
}

}  // namespace sgm_godot
