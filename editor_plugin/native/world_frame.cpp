// SgmWorld3D: the work of every frame.

#include <chrono>
#include <cmath>

#include "godot/log.h"
#include "plugin.h"
#include "viewer.h"
#include "world.h"

namespace sgm_godot {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint64_t kBytesAFrame = 4 << 20;
// Parts of chunks that wait for upload; beyond this, the world is not updated, so the runtime pauses.
constexpr size_t kMostWaiting = 512;
constexpr double kFastest = 200;      // metres per second; a faster motion counts as a teleport
constexpr double kFileSeconds = 0.5;  // seconds between two checks of the grammar's file
constexpr int kMostInTheWay = 8;      // maximum number of bodies between a viewer and its ground
constexpr float kGroundBelow = 32;    // metres below a viewer within which its ground is searched
constexpr float kLeap = 16;           // metres of motion in a frame after which a viewer's ground must be checked again

Variant singleton(const char* name) { return Variant(engine().global_get_singleton(Name(name).get())); }

}  // namespace

void World::addViewer(uint64_t id, const Transform& place, double fov, double weight, bool directional, double delta) {
  sgm_viewer viewer = SGM_VIEWER_INIT;
  const Placement here = placement();
  const Units units = here.toUnits(place.origin);
  for (size_t axis = 0; axis < 3; ++axis) viewer.position[axis] = units[axis] / SGM_UNITS_PER_METRE;
  const Transform inverse = here.node.inverse();
  if (directional) {
    const Vector3 ahead = inverse.turn(place.column(2) * -1.0f);
    viewer.direction[0] = ahead.x;
    viewer.direction[1] = ahead.y;
    viewer.direction[2] = ahead.z;
  }
  Watched& watched = watched_[id];
  const Vector3 way = watched.seen ? place.origin - watched.position : Vector3{};
  const double length = std::hypot(way.x, way.y, way.z);
  if (length > kLeap) watched.walkable = false;
  if (delta > 0 && length / delta <= kFastest) {
    const Vector3 velocity = inverse.turn(way) * static_cast<float>(1 / delta);
    viewer.velocity[0] = velocity.x;
    viewer.velocity[1] = velocity.y;
    viewer.velocity[2] = velocity.z;
  }
  watched.position = place.origin;
  watched.seen = true;
  viewer.fov = fov > 0 ? static_cast<float>(std::min(fov, 170.0) * 3.14159265358979 / 180) : 0;
  viewer.weight = static_cast<float>(std::clamp(weight, 0.01, 100.0));
  viewers_.push_back(viewer);
  viewer_places_.push_back(place.origin);
  viewer_units_.push_back(units);
}

void World::gatherViewers(double delta) {
  viewers_.clear();
  viewer_places_.clear();
  viewer_units_.clear();
  for (auto& [id, watched] : watched_) watched.seen = watched.seen && id != 0;
  if (plugin().in_editor) {
    if (editor_view_) addViewer(0, *editor_view_, editor_fov_, 1, false, delta);
    return;
  }
  const Variant tree = own("get_tree");
  const Object space = own("get_world_3d").object();
  const Variant nodes = tree.call("get_nodes_in_group", Name(Viewer::kGroup));
  std::unordered_map<uint64_t, Watched> still;
  const int64_t count = nodes.size();
  for (int64_t i = 0; i < count; ++i) {
    const Variant node = nodes.get(i);
    const auto* viewer = instanceOf<Viewer>(node);
    if (viewer == nullptr || !viewer->enabled() || node.call("get_world_3d").object() != space) continue;
    const uint64_t id = engine().object_get_instance_id(node.object());
    addViewer(id, node.call("get_global_transform").to<Transform>(), viewer->fov(), viewer->weight(),
              viewer->directional(), delta);
    still[id] = watched_[id];
  }
  if (viewers_.empty()) {
    const Variant camera = own("get_viewport").call("get_camera_3d");
    if (camera.object() != nullptr) {
      const uint64_t id = engine().object_get_instance_id(camera.object());
      addViewer(id, camera.call("get_global_transform").to<Transform>(), camera.call("get_fov").to<double>(), 1, false,
                delta);
      still[id] = watched_[id];
    }
  }
  watched_ = std::move(still);
}

void World::frame() {
  times_.nextFrame();
  {
    const FrameTimes::Span span(times_);
    const Clock::time_point start = Clock::now();
    const double delta = own("get_process_delta_time").to<double>();
    followFile(delta);
    followChanges();
    if (session_ != nullptr) {
      stream(delta, [&] {
        return settings_.frame_budget / 1000 - std::chrono::duration<double>(Clock::now() - start).count();
      });
    }
  }
  emitAnnounced();
}

void World::stream(double delta, const std::function<double()>& left) {
  gatherViewers(delta);
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_set_viewers(session_->world(), viewers_.data(), 0, viewers_.size(), &error) < SGM_OK &&
      error_ != error.message) {
    logWarning(std::string("SgmWorld3D: ") + error.message);
    fail(error.message);
  }
  if (picture_->counts().waiting < kMostWaiting) {
    std::vector<sgm_world_event> events;
    if (Failure failure = session_->update(kBytesAFrame, events)) fail(*failure);
    receive(std::move(events));
  }
  // If the budget did not suffice for both, collision bodies come first in the next frame, so that the drawn surface
  // also collides.
  const bool first = std::exchange(colliders_first_, false);
  if (first && colliders_) colliders_->advance(left(), viewer_places_);
  tell(picture_->advance(left()));
  if (!first && colliders_) {
    if (left() > 0) {
      colliders_->advance(left(), viewer_places_);
    } else {
      colliders_first_ = true;
    }
  }
  materials_.update(viewer_places_,
                    settings_.morph
                        ? morphRanges(picture_->shown(), viewer_units_, session_->cellUnits(), session_->topLevel())
                        : MorphRanges(),
                    settings_.cell_size, placement());
  const bool idle = isIdle();
  if (idle) retired_.reset();  // also if nothing of the new world is in view
  if (idle && !was_idle_) announce("became_idle");
  was_idle_ = idle;
  placeScenes(left());
}

void World::receive(std::vector<sgm_world_event>&& events) {
  if (events.empty()) return;
  picture_->take(events);
  if (colliders_) {
    colliders_->take(events);
  } else {
    for (const sgm_world_event& event : events) static_cast<void>(sgm_collider_release(event.collider));
  }
  for (const sgm_world_event& event : events) {
    if (event.kind != SGM_EVENT_FAILED) continue;
    const std::string message = "the chunk at " + std::to_string(event.key.x) + ", " + std::to_string(event.key.y) +
                                ", " + std::to_string(event.key.z) + " of level " + std::to_string(event.key.level) +
                                " cannot be made: " + sgm_result_name(event.result);
    if (error_.empty()) logWarning("SgmWorld3D: " + message + " (further ones are told by `failed` alone)");
    fail(message);
  }
}

void World::tell(std::vector<Picture::Change>&& changes) {
  if (changes.empty()) return;
  const auto shows = [](const Picture::Change& change) { return change.kind != Picture::Change::kRemoved; };
  if (std::any_of(changes.begin(), changes.end(), shows)) retired_.reset();
  for (const Picture::Change& change : changes) {
    const Vector4i key{change.key.x, change.key.y, change.key.z, change.key.level};
    announce(change.kind == Picture::Change::kRemoved ? "chunk_removed" : "chunk_ready", key);
  }
  tellOfAnchors(changes);
}

void World::tellOfAnchors(const std::vector<Picture::Change>& changes) {
  const Anchors::News news = anchors_.follow(changes);
  for (const uint64_t key : news.gone) {
    removeScene(key);
    announce("anchor_removed", key);
  }
  const Placement here = placement();
  for (const sgm_anchor& anchor : news.come) {
    const Variant described = anchorOf(session_->grammar().get(), anchor, here);
    announce("anchor_ready", described);
    if (settings_.anchor_scenes.has(described.get("kind"))) unplaced_.push_back(anchor);
  }
}

// Instantiates scenes at anchors. A scene may do anything when it enters the tree, even end this world.
void World::placeScenes(double seconds) {
  const Clock::time_point start = Clock::now();
  const std::shared_ptr<Session> session = session_;
  const std::shared_ptr<bool> alive = alive_;
  while (*alive && session_ == session && !unplaced_.empty()) {
    const sgm_anchor anchor = unplaced_.front();
    unplaced_.pop_front();
    const Variant described = anchorOf(session->grammar().get(), anchor, {Transform(), settings_.origin});
    const Variant scene = settings_.anchor_scenes.get(described.get("kind"));
    const Variant node = scene.object() != nullptr ? scene.call("instantiate") : Variant();
    if (node.object() != nullptr && !node.call("is_class", "Node3D").truth()) {
      logWarning("SgmWorld3D: the root of a scene in anchor_scenes is no Node3D: it stays out");
      node.call("free");
    } else if (node.object() != nullptr) {
      node.call("set_transform", described.get("transform"));
      scenes_[anchor.key] = {engine().object_get_instance_id(node.object()), anchor};
      own("add_child", node, false, int64_t{1});  // as internal children, which are not saved with a scene
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return;
  }
}

void World::moveScenes() {
  for (const auto& [key, placed] : scenes_) {
    const Object node = engine().object_get_instance_from_id(placed.node);
    if (node == nullptr) continue;
    const Variant described = anchorOf(session_->grammar().get(), placed.anchor, {Transform(), settings_.origin});
    Variant(node).call("set_transform", described.get("transform"));
  }
}

void World::removeScene(uint64_t key) {
  std::erase_if(unplaced_, [&](const sgm_anchor& anchor) { return anchor.key == key; });
  const auto found = scenes_.find(key);
  if (found == scenes_.end()) return;
  const Object node = engine().object_get_instance_from_id(found->second.node);
  scenes_.erase(found);
  if (node != nullptr) Variant(node).call("queue_free");
}

void World::followFile(double delta) {
  since_file_ += delta;
  if (since_file_ < kFileSeconds || !settings_.hot_reload) return;
  since_file_ = 0;
  if (!plugin().in_editor && !singleton("OS").call("is_debug_build").truth()) return;
  if (auto* grammar = instanceOf<Grammar>(grammar_)) grammar->followFile();
}

// Whether a viewer's ground has a collider. The engine's own ray decides: whatever else is known, a viewer must not
// fall.
bool World::standsOnCollider(Vector3 position) {
  const Aabb below{position - Vector3{1, kGroundBelow, 1}, {2, kGroundBelow, 2}};
  if (colliders_->waitsIn(below)) return false;
  const Variant query = Variant(engine().classdb_construct_object(Name("PhysicsRayQueryParameters3D").get()));
  query.call("set_from", position);
  query.call("set_to", position - Vector3{0, kGroundBelow, 0});
  query.call("set_collision_mask", settings_.collision_layer);
  const Variant space = own("get_world_3d").call("get_direct_space_state");
  Variant hit = space.call("intersect_ray", query);
  // The viewer's own body, or something on which it stands, may be in the way: exclude it and cast again.
  const Variant others = Variant::ofType(GDEXTENSION_VARIANT_TYPE_ARRAY);
  for (int i = 0; i < kMostInTheWay && hit.size() != 0 && hit.get("collider").object() != self(); ++i) {
    others.call("push_back", hit.get("rid"));
    query.call("set_exclude", others);
    hit = space.call("intersect_ray", query);
  }
  if (hit.size() == 0 || hit.get("collider").object() != self()) return false;
  // Check that the ray has hit the world's current ground there, and not an older surface below it.
  const Vector3 ground = hit.get("position").to<Vector3>();
  const Units from = placement().toUnits(position);
  sgm_ray_desc ray = SGM_RAY_DESC_INIT;
  std::copy_n(from.data(), 3, ray.from);
  const Vector3 down = placement().node.inverse().turn({0, -1, 0});
  ray.direction[0] = down.x;
  ray.direction[1] = down.y;
  ray.direction[2] = down.z;
  ray.length = kGroundBelow;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  if (sgm_world_ray_cast(session_->world(), &ray, &point, nullptr) != SGM_OK || point.found == 0) return false;
  const double cell = settings_.cell_size * 4;
  return std::abs(point.distance - double{position.y - ground.y}) <= cell;
}

void World::physicsFrame() {
  if (!colliders_ || session_ == nullptr) return;
  {
    const FrameTimes::Span span(times_);
    for (auto& [id, watched] : watched_) {
      if (watched.walkable) continue;
      const Object viewer = engine().object_get_instance_from_id(id);
      if (viewer == nullptr || !standsOnCollider(watched.position)) continue;
      watched.walkable = true;
      announce("walkable", viewer);
    }
  }
  emitAnnounced();
}

void World::setEditorView(const Transform& view, double fov) {
  editor_view_ = view;
  editor_fov_ = fov;
}

bool World::isIdle() const {
  if (session_ == nullptr || picture_ == nullptr || !picture_->complete()) return false;
  if (colliders_ && colliders_->counts().waiting > 0) return false;
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  return sgm_world_get_stats(session_->world(), &stats, nullptr) == SGM_OK && stats.idle != 0 && !viewers_.empty();
}

bool World::waitUntilIdle(double seconds) {
  followChanges();
  if (session_ == nullptr) return false;
  gatherViewers(0);
  sgm_error error = SGM_ERROR_INIT;
  bool idle = false, failed = false;
  if (sgm_world_set_viewers(session_->world(), viewers_.data(), 0, viewers_.size(), &error) < SGM_OK) {
    fail(error.message);
    failed = true;
  }
  const Clock::time_point limit = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6)));
  while (!failed) {
    std::vector<sgm_world_event> events;
    if (Failure failure = session_->update(kBytesAFrame, events)) {
      fail(*failure);
      break;
    }
    receive(std::move(events));
    tell(picture_->finish());
    if (colliders_) colliders_->advance(0.01, viewer_places_);
    idle = isIdle();
    if (idle || Clock::now() >= limit) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  emitAnnounced();
  return idle;
}

}  // namespace sgm_godot
