// SgmWorld3D: queries of the world.

#include <cmath>

#include "godot/log.h"
#include "world.h"

namespace sgm_godot {
namespace {

void tellFailure(const sgm_error& error) { logError(std::string("SgmWorld3D: ") + error.message); }

Variant vector(const Transform& node, const double direction[3]) {
  return node.turn(
      {static_cast<float>(direction[0]), static_cast<float>(direction[1]), static_cast<float>(direction[2])});
}

// Figures that the engine's debugger plots: the displayed title, and the key in the statistics.
struct Monitor {
  const char* title;
  const char* key;
};
constexpr Monitor kMonitors[] = {
    {"main thread (ms)", "main_thread_ms"},
    {"main thread p99 (ms)", "main_thread_p99_ms"},
    {"chunks drawn", "drawn"},
    {"chunks waiting", "queued"},
    {"triangles", "triangles"},
    {"mesh memory (MiB)", "mesh_mib"},
    {"uploads waiting", "uploads_waiting"},
    {"colliders", "colliders"},
    {"colliders waiting", "colliders_waiting"},
};

}  // namespace

Dictionary World::described(const sgm_surface_point& point) const {
  Dictionary result;
  if (point.found == 0) return result;
  const Placement here = placement();
  const sgm_grammar* grammar = session_->grammar().get();
  const auto text = [](const char* name) { return Variant(name == nullptr ? "" : name); };
  result.value.set("position", here.toGlobal(point.position));
  result.value.set("normal", vector(here.node, point.normal));
  result.value.set("distance", point.distance);
  result.value.set("material", text(sgm_grammar_material(grammar, point.material)));
  result.value.set("tag", text(point.tag == 0 ? "" : sgm_grammar_tag(grammar, point.tag)));
  result.value.set("inside", point.inside != 0);
  return result;
}

Dictionary World::rayCast(const Vector3& from, const Vector3& direction, double length) {
  if (!ready()) return {};
  const Placement here = placement();
  sgm_ray_desc desc = SGM_RAY_DESC_INIT;
  const Units start = here.toUnits(from);
  const Vector3 ahead = here.node.inverse().turn(direction);
  std::copy_n(start.data(), 3, desc.from);
  desc.direction[0] = ahead.x;
  desc.direction[1] = ahead.y;
  desc.direction[2] = ahead.z;
  desc.length = length;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_ray_cast(session_->world(), &desc, &point, &error) < SGM_OK) {
    tellFailure(error);
    return {};
  }
  return described(point);
}

Dictionary World::closestPoint(const Vector3& position, double max_distance) {
  if (!ready()) return {};
  sgm_closest_desc desc = SGM_CLOSEST_DESC_INIT;
  const Units units = placement().toUnits(position);
  std::copy_n(units.data(), 3, desc.position);
  desc.max_distance = max_distance;
  sgm_surface_point point = SGM_SURFACE_POINT_INIT;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_closest_point(session_->world(), &desc, &point, &error) < SGM_OK) {
    tellFailure(error);
    return {};
  }
  return described(point);
}

Points World::findWay(const Vector3& from, const Vector3& to, double radius) {
  if (!ready()) return {};
  const Placement here = placement();
  sgm_way_desc desc = SGM_WAY_DESC_INIT;
  const Units start = here.toUnits(from), end = here.toUnits(to);
  std::copy_n(start.data(), 3, desc.from);
  std::copy_n(end.data(), 3, desc.to);
  desc.radius = radius;
  // Enlarge the searched box, so that the path may make detours.
  const double edge = static_cast<double>(session_->cellUnits()) * SGM_CHUNK_CELLS * 2;
  for (size_t axis = 0; axis < 3; ++axis) {
    desc.minimum[axis] = static_cast<int32_t>(std::max(std::min(start[axis], end[axis]) - edge, -2147000000.0));
    desc.maximum[axis] = static_cast<int32_t>(std::min(std::max(start[axis], end[axis]) + edge, 2147000000.0));
  }
  std::vector<int32_t> places(3 << 14);
  sgm_way way = SGM_WAY_INIT;
  sgm_error error = SGM_ERROR_INIT;
  for (;;) {
    desc.places = places.data();
    desc.place_room = places.size() / 3;
    const sgm_result result = sgm_world_find_way(session_->world(), &desc, &way, &error);
    if (result < SGM_OK) {
      tellFailure(error);
      return {};
    }
    if (way.place_count <= desc.place_room) break;
    places.resize(way.place_count * 3);
  }
  Packed<Vector3> points(way.place_count);
  for (size_t i = 0; i < way.place_count; ++i) points.data()[i] = here.node.apply(here.local(places.data() + 3 * i));
  return {points.take()};
}

Array World::anchors(const Aabb& box) {
  Array list;
  if (!ready()) return list;
  const Placement here = placement();
  int32_t minimum[3], maximum[3];
  here.box(box, minimum, maximum);
  std::vector<sgm_anchor> found(64);
  size_t count = found.size();
  sgm_error error = SGM_ERROR_INIT;
  sgm_result result;
  while ((result = sgm_field_anchors(session_->field(), minimum, maximum, found.data(), 0, &count, &error)) ==
         SGM_INCOMPLETE) {
    found.resize(count);
  }
  if (result < SGM_OK) {
    tellFailure(error);
    return list;
  }
  for (size_t i = 0; i < count; ++i) list.value.append(anchorOf(session_->grammar().get(), found[i], here));
  return list;
}

Aabb World::bounds() const {
  if (picture_ == nullptr || session_ == nullptr) return {};
  int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
  bool any = false;
  for (const Picture::Shown& shown : picture_->shown()) {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (sgm_mesh_get_view(shown.mesh, &view, nullptr) != SGM_OK || view.index_count == 0) continue;
    any = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], view.bounds_min[axis]);
      high[axis] = std::max(high[axis], view.bounds_max[axis]);
    }
  }
  if (!any) return {};
  const Placement local{Transform(), settings_.origin};
  const Vector3 first = local.local(low);
  return {first, local.local(high) - first};
}

int64_t World::worldHash(const Aabb& box, int64_t level) {
  if (!ready()) return 0;
  int32_t minimum[3], maximum[3];
  placement().box(box, minimum, maximum);
  uint64_t hash = 0;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_world_hash(session_->world(), minimum, maximum, static_cast<int32_t>(level), &hash, &error) < SGM_OK) {
    tellFailure(error);
    return 0;
  }
  return static_cast<int64_t>(hash);
}

Dictionary World::statistics() const {
  Dictionary result;
  sgm_world_stats s = SGM_WORLD_STATS_INIT;
  if (session_ == nullptr || sgm_world_get_stats(session_->world(), &s, nullptr) != SGM_OK) return result;
  Variant& d = result.value;
  const std::pair<const char*, uint64_t> counts[] = {
      {"frame", s.frame},
      {"plans", s.plans},
      {"chunks_meshed", s.chunks_meshed},
      {"finest_meshed", s.finest_meshed},
      {"seam_jobs", s.seam_jobs},
      {"chunks_in_vain", s.chunks_in_vain},
      {"chunks_failed", s.chunks_failed},
      {"stale", s.stale},
      {"queued", s.queued},
      {"in_work", s.in_work},
      {"drawn", s.drawn},
      {"kept", s.kept},
      {"mesh_bytes", s.mesh_bytes},
      {"peak_mesh_bytes", s.peak_mesh_bytes},
      {"fields_set", s.fields_set},
      {"field_drawn", s.field_drawn},
      {"chunks_outdated", s.chunks_outdated},
      {"collider_bytes", s.collider_bytes},
      {"edits", s.edits},
      {"edits_state", s.edits_state},
      {"edits_drawn", s.edits_drawn},
      {"rounded_cells", s.rounded_cells},
      {"cache_hits", s.cache_hits},
      {"cache_misses", s.cache_misses},
      {"cache_damaged", s.cache_damaged},
      {"cache_bytes", s.cache_bytes},
      {"store_hits", s.store_hits},
      {"store_misses", s.store_misses},
      {"store_damaged", s.store_damaged},
  };
  for (const auto& [name, count] : counts) d.set(name, count);
  d.set("detail", s.detail);
  d.set("idle", s.idle != 0);
  d.set("backend", session_->backend());
  d.set("device", session_->device());
  d.set("top_level", session_->topLevel());
  d.set("main_thread_ms", times_.last());
  d.set("main_thread_p99_ms", times_.percentile(0.99));
  d.set("mesh_mib", static_cast<double>(s.mesh_bytes) / (1 << 20));
  const Picture::Counts drawn = picture_->counts();
  d.set("surfaces", static_cast<int64_t>(drawn.chunks));
  d.set("triangles", static_cast<int64_t>(drawn.triangles));
  d.set("uploads_waiting", static_cast<int64_t>(drawn.waiting));
  const Colliders::Counts bodies = colliders_ ? colliders_->counts() : Colliders::Counts();
  d.set("colliders", static_cast<int64_t>(bodies.chunks));
  d.set("colliders_waiting", static_cast<int64_t>(bodies.waiting));
  return result;
}

double World::monitor(const std::string& key) const { return statistics().value.get(key).to<double>(); }

void World::addMonitors() {
  const Variant performance(engine().global_get_singleton(Name("Performance").get()));
  const std::string owner = "SG+M " + own("get_name").to<std::string>();
  const Variant ask = callable(self(), Name("_monitor"));
  for (const Monitor& m : kMonitors) {
    const std::string id = owner + "/" + m.title;
    // Another world of that name already provides this monitor.
    if (performance.call("has_custom_monitor", Name(id)).truth()) continue;
    const Variant arguments = Variant::array();
    arguments.append(m.key);
    performance.call("add_custom_monitor", Name(id), ask, arguments);
    monitors_.push_back(id);
  }
}

void World::removeMonitors() {
  const Variant performance(engine().global_get_singleton(Name("Performance").get()));
  for (const std::string& id : monitors_) performance.call("remove_custom_monitor", Name(id));
  monitors_.clear();
}

}  // namespace sgm_godot
