#include "tools/cli/fly/fly_report.h"
#include "tools/cli/fly/commands.h"

#include <fmt/core.h>

#include <algorithm>

namespace sgm::cli {
namespace {

/// A dig must be visible after at most this number of new drawn frames: the frame that was in preparation when the dig
/// was made, and the frame after it.
constexpr double kMaxDigFrames = 2;

double shareOf(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

double megabytes(uint64_t bytes) { return static_cast<double>(bytes) / 1e6; }

Json toJson(const Spread& spread) { return {{"p50", spread.p50}, {"p99", spread.p99}, {"max", spread.max}}; }

Json staleJson(const FlightReport& report) {
  if (report.stale.empty()) return nullptr;
  const Spread stale = spreadOf(report.stale);
  return {{"median", stale.p50}, {"worst", stale.max}, {"teleports", report.stale.size()}};
}

}  // namespace

Json toJson(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance) {
  const FlightReport& r = flown.report;
  const FrameReport& worst = r.checked.worst;
  Json json = {
      {"frames", r.frames},
      {"commits", r.commits},
      {"checked", options.check},
      {"open_edges", worst.open_edges},
      {"nonmanifold_edges", worst.nonmanifold_edges},
      {"degenerate_triangles", worst.degenerate_triangles},
      {"flat_triangles", worst.flat_triangles},
      {"folded_triangles", worst.folded_triangles},
      {"self_intersections", worst.self_intersections},
      {"overlaps", worst.overlaps},
      {"whole_checks", r.checked.whole_checks},
      {"whole_failures", r.checked.whole_failures},
      {"cuts_between_parts", r.checked.between_parts},
      {"main_thread_ms", toJson(r.main_thread)},
      {"time_to_walkable_ms", r.walkable_ms},
      {"chunks_meshed", r.stats.chunks_meshed},
      {"finest_meshed", r.stats.finest_meshed},
      {"rounded_cells", r.stats.rounded_cells},
      {"seam_jobs", r.stats.seam_jobs},
      {"chunks_per_second", r.seconds > 0 ? static_cast<double>(r.stats.chunks_meshed) / r.seconds : 0.0},
      {"wasted_fraction", shareOf(r.stats.chunks_in_vain, r.stats.chunks_meshed)},
      {"work_at_teleports", r.work_at_teleports},
      {"stale_after_2_frames", staleJson(r)},
      {"lod0_coverage", shareOf(r.seen_finest, r.seen)},
      {"lod0_covered_frames", shareOf(r.frames_covered, r.frames_seen)},
      {"fields", flown.fields},
      {"fields_drawn", flown.fields_drawn},
      {"chunks_outdated", r.stats.chunks_outdated},
      {"digs", r.digs.digs()},
      {"digs_by_kind", {{"cuts", r.digs.cuts}, {"adds", r.digs.adds}, {"undos", r.digs.undos}}},
      {"dig_frames", toJson(r.digs.frames)},
      {"dig_ms", toJson(r.digs.milliseconds)},
      {"most_queued_while_digging", r.digs.max_queued},
      {"colliders",
       {{"count", r.colliders.colliders},
        {"missing", r.colliders.missing},
        {"unlike", r.colliders.unlike},
        {"stray", r.colliders.stray}}},
      {"peak_bytes",
       {{"meshes", r.stats.peak_mesh_bytes},
        {"colliders", r.peak_collider_bytes},
        {"runtime", flown.runtime_peak_bytes},
        {"disk_cache", r.stats.cache_bytes},
        {"handed_over_per_frame", {{"largest", r.peak_handed_over}, {"cap", flown.frame_bytes}}}}},
      {"cache", {{"hits", r.stats.cache_hits}, {"misses", r.stats.cache_misses}, {"damaged", r.stats.cache_damaged}}},
      {"stores",
       {{"hits", r.stats.store_hits},
        {"misses", r.stats.store_misses},
        {"damaged", r.stats.store_damaged},
        {"bytes", r.stats.store_bytes}}},
      {"edits", r.stats.edits},
      {"backend", flown.backend.name},
      {"device", flown.backend.device},
      {"on_device",
       {{"chunks", flown.backend.chunks - flown.backend.chunks_on_cpu},
        {"chunks_on_cpu", flown.backend.chunks_on_cpu},
        {"losses", flown.backend.losses}}},
      {"pictures_by", {{"sun", flown.lights.sun}, {"lamp", flown.lights.lamp}, {"none", flown.lights.none}}},
      {"world_hash", fmt::format("{:016x}", flown.hash)},
      {"seconds", r.seconds}};
  if (flown.measures) json["measures"] = toJson(*flown.measures);
  if (by_distance) {
    json["finest_meshed_by_distance"] = by_distance->stats.finest_meshed;
    json["finest_saved"] = 1 - shareOf(r.stats.finest_meshed, by_distance->stats.finest_meshed);
  }
  return json;
}

void print(const FlyOptions& options, const Flown& flown, const std::optional<FlightReport>& by_distance) {
  const FlightReport& r = flown.report;
  fmt::print("{} frames at {} m/s, {} frames of changes, {:.1f} s\n", r.frames, options.speed, r.commits, r.seconds);
  if (options.check) {
    const FrameReport& worst = r.checked.worst;
    fmt::print(
        "  surface   {} open edges, {} non-manifold, {} overlaps in any frame (up to {} triangles); {} of {} checks of "
        "a whole frame failed\n",
        worst.open_edges, worst.nonmanifold_edges, worst.overlaps, worst.triangles, r.checked.whole_failures,
        r.checked.whole_checks);
    fmt::print("            {} degenerate triangles, {} flat, {} folded, {} self intersections, {} between parts\n",
               worst.degenerate_triangles, worst.flat_triangles, worst.folded_triangles, worst.self_intersections,
               r.checked.between_parts);
  }
  fmt::print("  frame     {:.3f} ms of the caller's thread (median), {:.3f} at 99 %, {:.3f} at most\n",
             r.main_thread.p50, r.main_thread.p99, r.main_thread.max);
  if (r.walkable_ms >= 0) {
    fmt::print("  start     everything visible within {} m has level 0 and colliders after {:.0f} ms\n",
               kWalkableDistance, r.walkable_ms);
  } else if (r.commits == 0) {
    fmt::print(
        "  start     the flight ended before anything was drawn: fly longer (--frames), or with larger cells "
        "(--cell)\n");
  } else if (r.seen > 0) {
    fmt::print(
        "  start     the flight ended before everything visible within {} m had level 0: fly longer (--frames)\n",
        kWalkableDistance);
  }
  if (r.seen > 0) {
    fmt::print("  level 0   {:.2f} % of the surfaces visible within {} m, all of them in {:.2f} % of the frames\n",
               100 * shareOf(r.seen_finest, r.seen), options.finest, 100 * shareOf(r.frames_covered, r.frames_seen));
  } else {
    fmt::print("  level 0   no surface was visible within {} m: choose another path with --path\n", options.finest);
  }
  fmt::print("  chunks    {} meshed ({} of level 0), {} given further seams, {:.1f} % never drawn\n",
             r.stats.chunks_meshed, r.stats.finest_meshed, r.stats.seam_jobs,
             100 * shareOf(r.stats.chunks_in_vain, r.stats.chunks_meshed));
  if (r.stats.rounded_cells > 0) {
    fmt::print("  edges     {} cells keep rounded edges, since sharp ones would fold or cut the surface\n",
               r.stats.rounded_cells);
  }
  if (!r.stale.empty()) {
    const Spread stale = spreadOf(r.stale);
    fmt::print("  leaps     2 frames later at most {:.1f} % of the work for the old place was left (median {:.1f} %)\n",
               100 * stale.max, 100 * stale.p50);
  }
  if (flown.fields > 0) {
    fmt::print(
        "  fields    {} with other parameters, {} of them drawn; for them and for digs {} chunks were meshed again, "
        "{:.1f} % of all\n",
        flown.fields, flown.fields_drawn, r.stats.chunks_outdated,
        100 * shareOf(r.stats.chunks_outdated, r.stats.chunks_meshed));
  }
  if (r.digs.digs() > 0) {
    fmt::print("  digs      {} ({} cuts, {} adds, {} undos), drawn {} frames of changes later (median), {} at most\n",
               r.digs.digs(), r.digs.cuts, r.digs.adds, r.digs.undos, r.digs.frames.p50, r.digs.frames.max);
    fmt::print("            after {:.0f} ms (median), {:.0f} at 99 %, {:.0f} at most; up to {} chunks waited\n",
               r.digs.milliseconds.p50, r.digs.milliseconds.p99, r.digs.milliseconds.max, r.digs.max_queued);
  }
  if (by_distance) {
    fmt::print("  reach     {} chunks of level 0 instead of {} by distance alone: {:.1f} % saved\n",
               r.stats.finest_meshed, by_distance->stats.finest_meshed,
               100 * (1 - shareOf(r.stats.finest_meshed, by_distance->stats.finest_meshed)));
  }
  fmt::print("  colliders {} at the end; {} missing within {} m, {} unlike the drawn mesh, {} without a drawn mesh\n",
             r.colliders.colliders, r.colliders.missing, kWalkableDistance, r.colliders.unlike, r.colliders.stray);
  fmt::print("  memory    at most {:.1f} MB of meshes, {:.1f} of colliders, {:.1f} in all; {:.2f} MB in one frame\n",
             megabytes(r.stats.peak_mesh_bytes), megabytes(r.peak_collider_bytes), megabytes(flown.runtime_peak_bytes),
             megabytes(r.peak_handed_over));
  if (!options.cache.empty()) {
    fmt::print("  cache     {} parts of chunks found, {} not found ({} damaged), {:.1f} MB\n", r.stats.cache_hits,
               r.stats.cache_misses, r.stats.cache_damaged, megabytes(r.stats.cache_bytes));
  }
  if (!options.stores.empty()) {
    fmt::print("  stores    {} parts of chunks found, {} not found ({} damaged), {:.1f} MB read\n", r.stats.store_hits,
               r.stats.store_misses, r.stats.store_damaged, megabytes(r.stats.store_bytes));
  }
  if (flown.backend.chunks > 0) {
    fmt::print("  device    {} meshed {} parts of chunks, the CPU {} instead; the device was lost {} times\n",
               flown.backend.device, flown.backend.chunks - flown.backend.chunks_on_cpu, flown.backend.chunks_on_cpu,
               flown.backend.losses);
  }
  if (flown.lights.sun + flown.lights.lamp > 0 && options.light == "auto") {
    fmt::print("  light     pictures lit by the sun: {}, by a lamp: {} (--light chooses)\n", flown.lights.sun,
               flown.lights.lamp);
  }
  if (flown.measures) print(*flown.measures);
  fmt::print("  hash      {:016x} (level 0 within 32 m of the end, seed {})\n", flown.hash, options.seed);
}

std::optional<std::string> defectOf(const Flown& flown) {
  const FlightReport& report = flown.report;
  if (!report.checked.worst.closed()) return "a frame's surface was not closed";
  if (!report.checked.worst.valid() || report.checked.between_parts > 0)
    return "a frame's surface has triangles that are flat, fold or cut each other";
  if (report.checked.whole_failures > 0) return "a check of a whole frame failed";
  if (!report.colliders.fit()) return "colliders differ from the drawn meshes";
  if (report.digs.frames.max > kMaxDigFrames)
    return fmt::format("a dig was drawn {} frames of changes later", report.digs.frames.max);
  if (flown.measures) return defectOf(*flown.measures);
  return {};
}

}  // namespace sgm::cli
