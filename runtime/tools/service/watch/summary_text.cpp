#include "tools/service/watch/summary_text.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/platform/figures.h"
#include "tools/service/watch/defect_names.h"
#include "tools/service/watch/time_quantile.h"

namespace sgm::service {
namespace {

using nlohmann::json;

double milliseconds(double seconds) { return seconds * 1000; }

std::string timeText() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::array<char, 32> text{};
  if (gmtime_r(&now, &parts) == nullptr) return "";
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

double secondsSince(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

json viewersJson(const std::vector<sgm_viewer>& viewers) {
  json all = json::array();
  for (const sgm_viewer& viewer : viewers)
    all.push_back({{"position", viewer.position}, {"direction", viewer.direction}});
  return all;
}

json measuresJson(const std::optional<sgm_world_measures>& measures) {
  if (!measures) return nullptr;
  json defects = json::object();
  uint64_t total = 0;
  for (size_t kind = 0; kind < kDefectNames.size(); ++kind) {
    defects[kDefectNames[kind]] = measures->made.defects[kind];
    total += measures->made.defects[kind];
  }
  return {{"area_square_meters", measures->drawn.area},
          {"volume_cubic_meters", measures->drawn.flux},
          {"triangles", measures->drawn.triangles},
          {"slivers", measures->drawn.sliver_triangles},
          {"defects_total", total},
          {"defects", std::move(defects)}};
}

json parallelJson(const WorldSample& world) {
  if (!world.parallel_speedup) return nullptr;
  const double threads = std::max(1.0, static_cast<double>(world.info.threads));
  return {{"threads", world.info.threads},
          {"speedup", *world.parallel_speedup},
          {"efficiency", *world.parallel_speedup / threads}};
}

json updateJson(const sgm_time_histogram& times) {
  const uint64_t count = countOf(times);
  return {{"count", count},
          {"mean_ms", count == 0 ? 0 : milliseconds(times.sum / static_cast<double>(count))},
          {"p50_ms", milliseconds(quantile(times, 0.5))},
          {"p99_ms", milliseconds(quantile(times, 0.99))},
          {"max_ms", milliseconds(times.longest)}};
}

double cellMetres(const WorldSample& world) { return world.info.cell_units / double{SGM_UNITS_PER_METRE}; }

json worldJson(const WorldSample& world) {
  const sgm_world_stats& stats = world.stats;
  return {{"name", world.name},
          {"backend", world.info.backend.name},
          {"device", world.info.backend.device},
          {"cell_meters", cellMetres(world)},
          {"top_level", world.info.top_level},
          {"view_distance_meters", world.info.view_distance},
          {"idle", stats.idle != 0},
          {"frame", stats.frame},
          {"sampled_seconds_ago", secondsSince(world.taken)},
          {"chunks",
           {{"meshed", stats.chunks_meshed},
            {"per_second", world.chunks_per_second},
            {"finest_meshed", stats.finest_meshed},
            {"seam_jobs", stats.seam_jobs},
            {"in_vain", stats.chunks_in_vain},
            {"failed", stats.chunks_failed},
            {"outdated", stats.chunks_outdated},
            {"drawn", stats.drawn},
            {"kept", stats.kept}}},
          {"queue", {{"waiting", stats.queued}, {"in_work", stats.in_work}, {"stale", stats.stale}}},
          {"memory",
           {{"mesh_bytes", stats.mesh_bytes},
            {"peak_mesh_bytes", stats.peak_mesh_bytes},
            {"mesh_limit_bytes", world.info.mesh_bytes},
            {"collider_bytes", stats.collider_bytes}}},
          {"detail", stats.detail},
          {"edits", stats.edits},
          {"cache",
           {{"hits", stats.cache_hits},
            {"misses", stats.cache_misses},
            {"damaged", stats.cache_damaged},
            {"bytes", stats.cache_bytes}}},
          {"update", updateJson(world.times.update)},
          {"parallel", parallelJson(world)},
          {"viewers", viewersJson(world.viewers)},
          {"measures", measuresJson(world.measures)}};
}

/// Converts JSON to text. Replaces invalid UTF-8, which may occur in device names from drivers.
std::string jsonText(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

}  // namespace

std::string summaryText(const ServiceState& state, const std::vector<WorldSample>& worlds) {
  json all = json::array();
  for (const WorldSample& world : worlds) all.push_back(worldJson(world));
  const InspectorCounts& inspector = state.inspector;
  const std::optional<uint64_t> resident = platform::processFigures().resident_bytes;
  return jsonText({{"version", sgm_version_string()},
                   {"build", sgm_build_info()},
                   {"now", timeText()},
                   {"uptime_seconds", secondsSince(state.started)},
                   {"operations_port", state.operations_port},
                   {"service",
                    {{"connections", state.work.connections},
                     {"validator", state.inspects},
                     {"jobs_running", inspector.running},
                     {"jobs_waiting", inspector.waiting},
                     {"jobs_most_waiting", state.max_waiting},
                     {"validated", inspector.valid + inspector.invalid + inspector.refused + inspector.failed},
                     {"reports", state.reports},
                     {"resident_bytes", resident ? json(*resident) : json()},
                     {"most_upload_bytes", state.max_upload_bytes}}},
                   {"worlds", std::move(all)}});
}

std::string chunksText(const WorldMap& map) {
  json chunks = json::array();
  for (const DrawnChunk& chunk : map.chunks)
    chunks.push_back({chunk.level, chunk.x, chunk.y, chunk.z, chunk.triangles});
  return jsonText({{"name", map.world.name},
                   {"frame", map.world.stats.frame},
                   {"cell_meters", cellMetres(map.world)},
                   {"chunk_cells", SGM_CHUNK_CELLS},
                   {"viewers", viewersJson(map.world.viewers)},
                   {"total", map.total},
                   {"truncated", map.chunks.size() < map.total},
                   {"chunks", std::move(chunks)}});
}

}  // namespace sgm::service
