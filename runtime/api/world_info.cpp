// Statistics of a world for monitoring. All functions may be called from any thread.

#include <algorithm>
#include <cstring>

#include "api/backend_request.h"
#include "api/barrier.h"
#include "api/world.h"

using namespace sgm::api;

namespace {

sgm_viewer viewerOf(const sgm::Viewer& viewer) {
  sgm_viewer v = SGM_VIEWER_INIT;
  for (size_t axis = 0; axis < 3; ++axis) {
    v.position[axis] = viewer.position[axis] / sgm::kUnitsPerMetre;
    v.direction[axis] = static_cast<float>(viewer.direction[axis]);
    v.velocity[axis] = static_cast<float>(viewer.velocity[axis] / sgm::kUnitsPerMetre);
  }
  v.fov = static_cast<float>(viewer.fov);
  v.weight = static_cast<float>(viewer.weight);
  return v;
}

sgm_time_histogram histogramOf(const sgm::TimeHistogram& times) {
  sgm_time_histogram out = SGM_TIME_HISTOGRAM_INIT;
  static_assert(SGM_TIME_BUCKETS == sgm::TimeHistogram::kBuckets &&
                SGM_TIME_FIRST_EXPONENT == sgm::TimeHistogram::kFirstExponent);
  std::copy(times.counts.begin(), times.counts.end(), out.counts);
  out.sum = times.sum;
  out.longest = times.longest;
  return out;
}

}  // namespace

sgm_result sgm_world_get_info(const sgm_world* world, sgm_world_info* info, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (sgm_result r = checkDesc(error, info, "info"); r != SGM_OK) return r;
    const sgm::WorldSettings& settings = world->world->settings();
    fillInfo(*world->backend, info->backend);
    info->cell_units = world->finest_cell;
    info->top_level = settings.lod.top;
    info->flags =
        (settings.by_reach ? 0u : unsigned{SGM_WORLD_BY_DISTANCE}) | (settings.morph ? unsigned{SGM_WORLD_MORPH} : 0u) |
        (settings.resident ? unsigned{SGM_WORLD_RESIDENT} : 0u) |
        (settings.texture ? unsigned{SGM_WORLD_TEXTURE} : 0u) | (settings.sharp ? unsigned{SGM_WORLD_SHARP} : 0u) |
        (settings.measure ? unsigned{SGM_WORLD_MEASURE} : 0u);
    info->threads = world->runtime.jobs->concurrency();
    info->finest_distance = settings.lod.finest_distance / sgm::kUnitsPerMetre;
    info->view_distance = settings.lod.view_distance / sgm::kUnitsPerMetre;
    info->collider_distance = settings.collider_distance / sgm::kUnitsPerMetre;
    info->mesh_bytes = settings.mesh_bytes;
    return SGM_OK;
  });
}

sgm_result sgm_world_get_viewers(const sgm_world* world, sgm_viewer* viewers, size_t viewer_stride, size_t* count,
                                 sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (count == nullptr) return nullArgument(error, "count");
    if (sgm_result r = checkStride<sgm_viewer>(error, viewer_stride, "viewer_stride"); r != SGM_OK) return r;
    const std::vector<sgm::Viewer> now = world->world->viewers();
    const size_t room = *count;
    *count = now.size();
    if (viewers == nullptr) return SGM_OK;
    if (room < now.size()) return SGM_INCOMPLETE;
    char* at = reinterpret_cast<char*>(viewers);
    for (const sgm::Viewer& viewer : now) {
      const sgm_viewer out = viewerOf(viewer);
      std::memcpy(at, &out, sizeof out);
      at += viewer_stride;
    }
    return SGM_OK;
  });
}

sgm_result sgm_world_get_times(const sgm_world* world, sgm_world_times* times, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (sgm_result r = checkDesc(error, times, "times"); r != SGM_OK) return r;
    const sgm::WorldTimes now = world->world->times();
    times->update = histogramOf(now.update);
    times->poll = histogramOf(now.poll);
    times->read = histogramOf(now.read);
    static_assert(std::tuple_size_v<decltype(now.mesh)> == std::size(decltype(sgm_world_times{}.mesh){}));
    times->clock_seconds = now.clock_seconds;
    times->job_seconds = now.job_seconds;
    std::transform(now.mesh.begin(), now.mesh.end(), times->mesh, histogramOf);
    return SGM_OK;
  });
}
