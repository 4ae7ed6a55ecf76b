#include "world/statistics.h"

#include "colliders.h"

namespace sgm_godot {

Dictionary statistics(const World& world) {
  Dictionary result;
  const Stage& stage = world.stage();
  const std::shared_ptr<Session>& session = stage.session();
  sgm_world_stats s = SGM_WORLD_STATS_INIT;
  if (session == nullptr || sgm_world_get_stats(world.stage().session()->world(), &s, nullptr) != SGM_OK) return result;
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
  d.set("backend", world.stage().session()->backend());
  d.set("device", world.stage().session()->device());
  d.set("top_level", world.stage().session()->topLevel());
  d.set("main_thread_ms", world.frameTimes().last());
  d.set("main_thread_p99_ms", world.frameTimes().percentile(0.99));
  d.set("mesh_mib", static_cast<double>(s.mesh_bytes) / (1 << 20));
  const Picture::Counts drawn = stage.pictures().current()->counts();
  d.set("surfaces", static_cast<int64_t>(drawn.chunks));
  d.set("triangles", static_cast<int64_t>(drawn.triangles));
  d.set("uploads_waiting", static_cast<int64_t>(drawn.waiting));
  const Colliders::Counts bodies = stage.colliders() != nullptr ? stage.colliders()->counts() : Colliders::Counts();
  d.set("colliders", static_cast<int64_t>(bodies.chunks));
  d.set("colliders_waiting", static_cast<int64_t>(bodies.waiting));
  return result;
}

double figure(const World& world, const std::string& key) { return statistics(world).value.get(key).to<double>(); }

}  // namespace sgm_godot
