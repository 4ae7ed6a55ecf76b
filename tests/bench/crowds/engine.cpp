#include "crowds/engine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace crowds {

namespace {

uint64_t hashOf(const void* bytes, size_t count, uint64_t hash) {
  for (size_t i = 0; i < count; ++i) hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001B3u;
  return hash;
}

/// Returns a hash of all data of a collider that a physics engine reads.
uint64_t hashOf(const sgm_collider* collider) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_collider_view view = SGM_COLLIDER_VIEW_INIT;
  must(sgm_collider_get_view(collider, &view, &error), error);
  uint64_t hash = hashOf(view.positions, view.vertex_count * 3 * sizeof(float), 0xCBF29CE484222325u);
  hash = hashOf(view.indices, view.index_count * sizeof(uint32_t), hash);
  return hashOf(view.materials, view.index_count / 3 * sizeof(uint16_t), hash);
}

Key keyOf(const sgm_chunk_key& key) { return {key.level, key.x, key.y, key.z}; }

}  // namespace

void must(sgm_result result, const sgm_error& error) {
  if (result >= SGM_OK) return;
  std::fprintf(stderr, "crowds: %s: %s\n", sgm_result_name(result), error.message);
  std::exit(1);
}

double distanceTo(const Key& key, const Place& place, double finest_cell_m) {
  const auto [level, x, y, z] = key;
  const double edge = std::ldexp(SGM_CHUNK_CELLS * finest_cell_m, level);
  const std::array<int32_t, 3> at{x, y, z};
  double squares = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double low = edge * at[axis];
    const double away = std::max({low - place[axis], place[axis] - (low + edge), 0.0});
    squares += away * away;
  }
  return std::sqrt(squares);
}

Engine::Engine(sgm_field* field, const sgm_world_desc& desc) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_world* world = nullptr;
  must(sgm_world_create(field, &desc, &world, &error), error);
  world_.reset(world);
  sgm_world_info info = SGM_WORLD_INFO_INIT;
  must(sgm_world_get_info(world, &info, &error), error);
  finest_cell_m_ = static_cast<double>(info.cell_units) / SGM_UNITS_PER_METRE;
}

void Engine::setViewers(std::span<const sgm_viewer> viewers) {
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_world_set_viewers(world(), viewers.data(), 0, viewers.size(), &error), error);
}

void Engine::frame(uint64_t max_bytes) {
  sgm_error error = SGM_ERROR_INIT;
  bytes_ = frame_colliders_ = 0;
  must(sgm_world_update(world(), max_bytes, &error), error);
  sgm_world_event events[64];
  for (size_t count = std::size(events); count > 0;) {
    count = std::size(events);
    must(sgm_world_poll(world(), events, 0, &count, &error), error);
    for (size_t i = 0; i < count; ++i) take(events[i]);
  }
  counts_.peak_bytes = std::max(counts_.peak_bytes, bytes_);
  counts_.max_colliders = std::max(counts_.max_colliders, frame_colliders_);
}

void Engine::take(const sgm_world_event& event) {
  const Key key = keyOf(event.key);
  switch (event.kind) {
    case SGM_EVENT_READY: {
      sgm_error error = SGM_ERROR_INIT;
      sgm_mesh_view view = SGM_MESH_VIEW_INIT;
      must(sgm_mesh_get_view(event.mesh, &view, &error), error);
      bytes_ += uint64_t{view.vertex_count} * view.vertex_stride + uint64_t{view.index_count} * view.index_stride;
      meshes_[key].reset(event.mesh);
      break;
    }
    case SGM_EVENT_SHOWN:
      drawn_.insert(key);
      break;
    case SGM_EVENT_REMOVED:
      drawn_.erase(key);
      meshes_.erase(key);
      break;
    case SGM_EVENT_COLLIDER: {
      const uint64_t hash = hashOf(event.collider);
      static_cast<void>(sgm_collider_release(event.collider));
      const auto [had, is_new] = colliders_.try_emplace(key, hash);
      counts_.equal_colliders += !is_new && had->second == hash;
      had->second = hash;
      ++counts_.colliders;
      ++frame_colliders_;
      break;
    }
    case SGM_EVENT_COLLIDER_REMOVED:
      colliders_.erase(key);
      break;
    case SGM_EVENT_FAILED:
      ++counts_.failed;
      break;
    default:
      break;
  }
}

sgm_world_stats Engine::stats() const {
  sgm_error error = SGM_ERROR_INIT;
  sgm_world_stats stats = SGM_WORLD_STATS_INIT;
  must(sgm_world_get_stats(world(), &stats, &error), error);
  return stats;
}

sgm_world_times Engine::times() const {
  sgm_error error = SGM_ERROR_INIT;
  sgm_world_times times = SGM_WORLD_TIMES_INIT;
  must(sgm_world_get_times(world(), &times, &error), error);
  return times;
}

bool Engine::isDrawn(const Place& place, double radius_m, double cell_m) const {
  bool any = false;
  for (const Key& key : drawn_) {
    if (distanceTo(key, place, finest_cell_m_) > radius_m) continue;
    if (std::ldexp(finest_cell_m_, std::get<0>(key)) > cell_m) return false;
    any = true;
  }
  return any;
}

size_t Engine::countDrawn(int32_t level) const {
  return static_cast<size_t>(
      std::count_if(drawn_.begin(), drawn_.end(), [level](const Key& key) { return std::get<0>(key) == level; }));
}

}  // namespace crowds
