#include <cmath>
#include <cstring>
#include <filesystem>

#include "api/barrier.h"
#include "api/collider.h"
#include "api/mesh.h"
#include "api/world.h"
#include "mesh/hash.h"
#include "store/source.h"

using namespace sgm::api;

namespace {

constexpr uint64_t kDefaultMeshBytes = uint64_t{256} << 20;

sgm_chunk_key keyOf(const sgm::ChunkKey& key) { return {key.level, key.at.x, key.at.y, key.at.z}; }

void plotStats(const sgm_world& world) {
  const sgm::Profiler& profiler = world.runtime.profiler;
  if (profiler.plot == nullptr) return;
  const sgm::WorldStats now = world.world->stats();
  profiler.plot(profiler.user, sgm::plot::kQueued, static_cast<double>(now.queued));
  profiler.plot(profiler.user, sgm::plot::kInWork, static_cast<double>(now.in_work));
  profiler.plot(profiler.user, sgm::plot::kMeshBytes, static_cast<double>(now.surface_bytes));
}

sgm::Viewer viewerOf(const sgm_viewer& viewer) {
  sgm::Viewer v;
  for (size_t axis = 0; axis < 3; ++axis) {
    v.position[axis] = viewer.position[axis] * sgm::kUnitsPerMetre;
    v.direction[axis] = static_cast<double>(viewer.direction[axis]);
    v.velocity[axis] = static_cast<double>(viewer.velocity[axis]) * sgm::kUnitsPerMetre;
  }
  v.fov = static_cast<double>(viewer.fov);
  v.weight = static_cast<double>(viewer.weight);
  return v;
}

sgm_event_kind kindOf(sgm::WorldEvent::Kind kind) {
  using Kind = sgm::WorldEvent::Kind;
  switch (kind) {
    case Kind::ready:
      return SGM_EVENT_READY;
    case Kind::shown:
      return SGM_EVENT_SHOWN;
    case Kind::replaced:
      return SGM_EVENT_REPLACED;
    case Kind::seams:
      return SGM_EVENT_SEAMS;
    case Kind::removed:
      return SGM_EVENT_REMOVED;
    case Kind::failed:
      return SGM_EVENT_FAILED;
    case Kind::collider:
      return SGM_EVENT_COLLIDER;
    case Kind::collider_removed:
      return SGM_EVENT_COLLIDER_REMOVED;
  }
  return SGM_EVENT_FAILED;
}

}  // namespace

sgm_result sgm_world_create(sgm_field* field, const sgm_world_desc* desc, sgm_world** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    if (field == nullptr) return nullArgument(error, "field");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    sgm::WorldSettings settings;
    settings.lod.finest_cell = field->content->world.settings().finest_cell;
    if (sgm_result r = checkLevel(settings.lod.finest_cell, desc->top_level, error); r != SGM_OK) return r;
    settings.lod.top = desc->top_level;
    settings.lod.finest_distance = desc->finest_distance * sgm::kUnitsPerMetre;
    settings.lod.view_distance = desc->view_distance * sgm::kUnitsPerMetre;
    constexpr uint32_t kFlags = SGM_WORLD_BY_DISTANCE | SGM_WORLD_MORPH | SGM_WORLD_RESIDENT | SGM_WORLD_TEXTURE |
                                SGM_WORLD_SHARP | SGM_WORLD_MEASURE;
    if ((desc->flags & ~kFlags) != 0)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.flags has unknown bits: pass 0 or values of sgm_world_flag");
    settings.morph = (desc->flags & SGM_WORLD_MORPH) != 0;
    settings.sharp = (desc->flags & SGM_WORLD_SHARP) != 0;
    settings.measure = (desc->flags & SGM_WORLD_MEASURE) != 0;
    settings.texture = (desc->flags & SGM_WORLD_TEXTURE) != 0;
    settings.resident = (desc->flags & SGM_WORLD_RESIDENT) != 0;
    if (settings.resident && !field->content->backend->capabilities().lends_meshes)
      return fail(error, SGM_ERR_UNSUPPORTED,
                  "desc.flags has SGM_WORLD_RESIDENT, but the field's backend is not on an external device: call "
                  "sgm_runtime_lend_vulkan or sgm_runtime_lend_cuda before sgm_field_create, and pass it "
                  "SGM_BACKEND_VULKAN (AUTO only if the device is hardware) or SGM_BACKEND_CUDA");
    settings.by_reach = (desc->flags & SGM_WORLD_BY_DISTANCE) == 0;
    settings.mesh_bytes = desc->mesh_bytes != 0 ? desc->mesh_bytes : kDefaultMeshBytes;
    if (!(desc->collider_distance >= 0) || !std::isfinite(desc->collider_distance))
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.collider_distance is not a finite number of at least 0");
    settings.collider_distance = desc->collider_distance * sgm::kUnitsPerMetre;
    const sgm::Program& program = *field->content->world.settings().program;
    settings.edits.author = desc->author;
    settings.edits.max_material = static_cast<uint16_t>(program.materials.size() - 1);
    settings.edits.max_tag = static_cast<uint16_t>(program.tags.size() - 1);
    settings.journal = pathOf(desc->journal);
    settings.cache = pathOf(desc->cache_folder);
    if (desc->cache_bytes != 0) settings.cache_bytes = desc->cache_bytes;
    sgm_runtime& runtime = field->runtime;
    settings.on_warning = [&runtime](const std::string& message) { runtime.log(SGM_LOG_WARNING, message); };
    if (desc->max_colliders != 0) settings.max_colliders = desc->max_colliders;
    if (desc->store_count != 0) {
      if (desc->stores == nullptr) return nullArgument(error, "desc.stores");
      std::vector<std::string> places;
      for (uint32_t i = 0; i < desc->store_count; ++i) {
        if (desc->stores[i] == nullptr) return nullArgument(error, "desc.stores[i]");
        places.emplace_back(desc->stores[i]);
      }
      sgm::Result<std::shared_ptr<sgm::BakedParts>> opened =
          sgm::store::openStores(places, settings.on_warning, &runtime.memory);
      if (!opened) return failData(error, opened.error());
      settings.baked = std::move(*opened);
    }
    sgm::Result<std::unique_ptr<sgm::World>> world =
        sgm::World::create(worldField(field->content), *field->content->backend, *runtime.jobs, settings,
                           &runtime.memory, runtime.plan_turns);
    if (!world) return failData(error, world.error());
    *out = makeHandle<sgm_world>(runtime, field->content->backend, settings.lod.finest_cell, std::move(*world));
    return SGM_OK;
  });
}

sgm_result sgm_world_destroy(sgm_world* world) { return releaseHandle(world, __func__); }

sgm_result sgm_world_set_viewers(sgm_world* world, const sgm_viewer* viewers, size_t viewer_stride, size_t count,
                                 sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (viewers == nullptr && count != 0) return nullArgument(error, "viewers");
    if (sgm_result r = checkStride<sgm_viewer>(error, viewer_stride, "viewer_stride"); r != SGM_OK) return r;
    std::vector<sgm::Viewer> all;
    all.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      sgm_viewer viewer;
      std::memcpy(&viewer, reinterpret_cast<const char*>(viewers) + i * viewer_stride, sizeof viewer);
      all.push_back(viewerOf(viewer));
    }
    const sgm::Result<void> set = world->world->setViewers(all);
    return set ? SGM_OK : failLogged(*world, error, set.error());
  });
}

sgm_result sgm_world_update(sgm_world* world, uint64_t max_bytes, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (max_bytes == 0) {
      return failLogged(
          *world, error,
          {sgm::Code::invalid_argument, "max_bytes is 0: pass at least 1, so that meshes can be handed over"});
    }
    const sgm::ProfileScope scope(world->runtime.profiler, sgm::zone::kUpdate);
    if (!world->world->update(max_bytes)) return SGM_INCOMPLETE;
    plotStats(*world);
    return SGM_OK;
  });
}

sgm_result sgm_world_poll(sgm_world* world, sgm_world_event* events, size_t event_stride, size_t* count,
                          sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (count == nullptr) return nullArgument(error, "count");
    const size_t room = *count;
    *count = 0;
    if (world == nullptr) return nullArgument(error, "world");
    if (events == nullptr) return nullArgument(error, "events");
    if (sgm_result r = checkStride<sgm_world_event>(error, event_stride, "event_stride"); r != SGM_OK) return r;
    const sgm::ProfileScope scope(world->runtime.profiler, sgm::zone::kPoll);
    char* at = reinterpret_cast<char*>(events);
    const auto handOut = [&](const sgm::WorldEvent& event) {
      sgm_world_event out{};
      out.kind = kindOf(event.kind);
      out.key = keyOf(event.key);
      out.seams = event.seams;
      out.coarser = event.coarser;
      out.frame = event.frame;
      if (event.error) {
        out.result = resultOf(event.error->code);
        world->runtime.log(SGM_LOG_ERROR, event.error->message);
      }
      if (event.collider != nullptr) out.collider = makeHandle<sgm_collider>(world->runtime, event.collider);
      if (event.surface != nullptr) out.mesh = makeHandle<sgm_mesh>(world->runtime, event.surface);
      std::memcpy(at, &out, sizeof out);
      at += event_stride;
      ++*count;
    };
    world->world->poll([&](const sgm::WorldEvent& event) {
      if (*count == room) return false;
      try {
        handOut(event);
        return true;
      } catch (...) {
        if (*count == 0) throw;
        return false;  // the events before this one were delivered; the next call retries this event
      }
    });
    return SGM_OK;
  });
}

sgm_result sgm_world_get_drawn(sgm_world* world, sgm_drawn_chunk* chunks, size_t chunk_stride, size_t* count,
                               sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (count == nullptr) return nullArgument(error, "count");
    if (sgm_result r = checkStride<sgm_drawn_chunk>(error, chunk_stride, "chunk_stride"); r != SGM_OK) return r;
    const std::shared_ptr<const sgm::DrawnFrame> frame = world->world->drawn();
    const size_t room = *count;
    *count = frame->drawn.size();
    if (chunks == nullptr) return SGM_OK;
    if (room < frame->drawn.size()) return SGM_INCOMPLETE;
    std::vector<sgm_mesh*> made;
    try {
      made.reserve(frame->drawn.size());
      for (const sgm::DrawnChunk& chunk : frame->drawn) {
        made.push_back(makeHandle<sgm_mesh>(world->runtime, chunk.surface));
      }
    } catch (...) {
      for (sgm_mesh* mesh : made) sgm_mesh_release(mesh);
      throw;
    }
    char* at = reinterpret_cast<char*>(chunks);
    for (size_t i = 0; i < made.size(); ++i, at += chunk_stride) {
      const sgm::DrawnChunk& chunk = frame->drawn[i];
      const sgm_drawn_chunk out{keyOf(chunk.key), made[i], chunk.seams, chunk.coarser};
      std::memcpy(at, &out, sizeof out);
    }
    return SGM_OK;
  });
}

sgm_result sgm_world_wait_idle(sgm_world* world, sgm_progress_function progress, void* progress_user,
                               sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    const sgm::Result<void> waited = world->world->waitIdle([&] {
      if (progress == nullptr) return true;
      const sgm::WorldStats stats = world->world->stats();
      const uint64_t done = stats.planner.meshed;
      return progress(progress_user, done, done + stats.queued + stats.in_work) == 0;
    });
    return waited ? SGM_OK : fail(error, waited.error());
  });
}

sgm_result sgm_world_set_field(sgm_world* world, sgm_field* field, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (field == nullptr) return nullArgument(error, "field");
    if (&field->runtime != &world->runtime)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "the field belongs to another runtime than the world");
    const sgm::Result<void> set = world->world->setField(worldField(field->content));
    return set ? SGM_OK : failLogged(*world, error, set.error());
  });
}

void sgm_world_cancel(sgm_world* world) {
  if (world != nullptr) world->world->cancel();
}

sgm_result sgm_world_hash(sgm_world* world, const int32_t minimum[3], const int32_t maximum[3], int32_t level,
                          uint64_t* hash, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (minimum == nullptr) return nullArgument(error, "minimum");
    if (maximum == nullptr) return nullArgument(error, "maximum");
    if (hash == nullptr) return nullArgument(error, "hash");
    if (sgm_result r = checkLevel(world->finest_cell, level, error); r != SGM_OK) return r;
    const sgm::IntBox region{{minimum[0], minimum[1], minimum[2]}, {maximum[0], maximum[1], maximum[2]}};
    const sgm::Result<sgm::ContentHash> sum = world->world->hashBodies(region, level);
    if (!sum) return fail(error, sum.error());
    *hash = sum->value();
    return SGM_OK;
  });
}

sgm_result sgm_world_get_stats(const sgm_world* world, sgm_world_stats* stats, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (sgm_result r = checkDesc(error, stats, "stats"); r != SGM_OK) return r;
    const sgm::WorldStats now = world->world->stats();
    stats->frame = now.frame;
    stats->plans = now.plans;
    stats->chunks_meshed = now.planner.meshed;
    stats->finest_meshed = now.planner.finest;
    stats->seam_jobs = now.planner.seam_jobs;
    stats->chunks_in_vain = now.planner.never_drawn;
    stats->chunks_failed = now.planner.failed;
    stats->stale = now.stale;
    stats->queued = now.queued;
    stats->in_work = now.in_work;
    stats->drawn = now.planner.drawn;
    stats->kept = now.planner.records;
    stats->mesh_bytes = now.surface_bytes;
    stats->peak_mesh_bytes = now.peak_surface_bytes;
    stats->detail = now.planner.detail;
    stats->idle = now.idle ? 1 : 0;
    stats->reserved = 0;
    stats->fields_set = now.fields.wanted;
    stats->field_drawn = now.fields.drawn;
    stats->chunks_outdated = now.planner.outdated;
    stats->collider_bytes = now.collider_bytes;
    stats->edits = world->world->editCount();
    stats->edits_state = now.edits;
    stats->edits_drawn = now.edits_drawn;
    stats->cache_hits = now.cache.hits;
    stats->cache_misses = now.cache.misses;
    stats->cache_damaged = now.cache.damaged;
    stats->cache_bytes = now.cache.bytes;
    stats->store_hits = now.baked.hits;
    stats->store_misses = now.baked.misses;
    stats->store_damaged = now.baked.damaged;
    stats->store_bytes = now.baked.bytes;
    stats->rounded_cells = now.planner.rounded;
    return SGM_OK;
  });
}
