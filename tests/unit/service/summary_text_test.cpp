// Tests that the summary and the map have exactly the members that openapi.json describes, for any state of the worlds.

#include "tools/service/watch/summary_text.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "rounds.h"
#include "seed.h"
#include "service_samples.h"
#include "tools/service/watch/time_quantile.h"

namespace sgm::service {
namespace {

using nlohmann::json;

std::set<std::string> keysOf(const json& object) {
  REQUIRE(object.is_object());
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}
using Keys = std::set<std::string>;

bool isNumberOrNull(const json& value) { return value.is_number() || value.is_null(); }

sgm_time_histogram histogramOf(const std::vector<double>& times) {
  sgm_time_histogram made = SGM_TIME_HISTOGRAM_INIT;
  for (const double time : times) {
    int bucket = 0;
    while (bucket + 1 < SGM_TIME_BUCKETS && time > std::ldexp(1.0, bucket + SGM_TIME_FIRST_EXPONENT)) ++bucket;
    ++made.counts[bucket];
    made.sum += time;
    made.longest = std::max(made.longest, time);
  }
  return made;
}

}  // namespace

TEST_CASE("the summary has exactly its members") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  RandomSamples random(seed);
  for (unsigned round = 0; round < rounds(40); ++round) {
    std::vector<WorldSample> worlds;
    const size_t count = random.below(5);
    for (size_t i = 0; i < count; ++i) worlds.push_back(random.world("w" + std::to_string(i), round % 2 == 0));
    const ServiceState state = random.service();
    const std::string text = summaryText(state, worlds);
    const json summary = json::parse(text);
    CHECK(keysOf(summary) == Keys{"version", "build", "now", "uptime_seconds", "operations_port", "service", "worlds"});
    CHECK(summary["version"] == sgm_version_string());
    CHECK(
        std::regex_match(summary["now"].get<std::string>(), std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ")));
    CHECK(summary["operations_port"] == state.operations_port);
    CHECK(keysOf(summary["service"]) == Keys{"connections", "validator", "jobs_running", "jobs_waiting",
                                             "jobs_most_waiting", "validated", "reports", "resident_bytes",
                                             "most_upload_bytes"});
    CHECK(summary["service"]["validator"] == state.inspects);
    CHECK(summary["service"]["jobs_waiting"] == state.inspector.waiting);
    CHECK(summary["service"]["resident_bytes"].get<uint64_t>() > 1000000);
    REQUIRE(summary["worlds"].size() == worlds.size());
    for (size_t i = 0; i < worlds.size(); ++i) {
      const json& world = summary["worlds"][i];
      const WorldSample& sample = worlds[i];
      CHECK(keysOf(world) == Keys{"name", "backend", "device", "cell_meters", "top_level", "view_distance_meters",
                                  "idle", "frame", "sampled_seconds_ago", "chunks", "queue", "memory", "detail",
                                  "edits", "cache", "update", "parallel", "viewers", "measures"});
      CHECK(keysOf(world["chunks"]) == Keys{"meshed", "per_second", "finest_meshed", "seam_jobs", "in_vain", "failed",
                                            "outdated", "drawn", "kept"});
      CHECK(keysOf(world["queue"]) == Keys{"waiting", "in_work", "stale"});
      CHECK(keysOf(world["memory"]) == Keys{"mesh_bytes", "peak_mesh_bytes", "mesh_limit_bytes", "collider_bytes"});
      CHECK(keysOf(world["cache"]) == Keys{"hits", "misses", "damaged", "bytes"});
      CHECK(keysOf(world["update"]) == Keys{"count", "mean_ms", "p50_ms", "p99_ms", "max_ms"});
      CHECK(world["name"] == sample.name);
      CHECK(world["cell_meters"] == sample.info.cell_units / 1024.0);
      CHECK(world["frame"] == sample.stats.frame);
      CHECK(world["chunks"]["meshed"] == sample.stats.chunks_meshed);
      CHECK(world["memory"]["mesh_limit_bytes"] == sample.info.mesh_bytes);
      CHECK(world["idle"] == (sample.stats.idle != 0));
      for (const char* number : {"detail", "view_distance_meters", "sampled_seconds_ago"})
        CHECK(isNumberOrNull(world[number]));
      CHECK(world["detail"].is_null() != std::isfinite(sample.stats.detail));
      REQUIRE(world["viewers"].size() == sample.viewers.size());
      for (const json& viewer : world["viewers"]) {
        CHECK(keysOf(viewer) == Keys{"position", "direction"});
        CHECK(viewer["position"].size() == 3);
        CHECK(viewer["direction"].size() == 3);
      }
      CHECK(world["parallel"].is_null() != sample.parallel_speedup.has_value());
      if (sample.parallel_speedup) CHECK(keysOf(world["parallel"]) == Keys{"threads", "speedup", "efficiency"});
      CHECK(world["measures"].is_null() != sample.measures.has_value());
      if (!sample.measures) continue;
      CHECK(keysOf(world["measures"]) ==
            Keys{"area_square_meters", "volume_cubic_meters", "triangles", "slivers", "defects_total", "defects"});
      CHECK(keysOf(world["measures"]["defects"]) ==
            Keys{"index", "outside", "misplaced", "samples", "degenerate", "flat", "duplicate", "open_edge",
                 "turned_edge", "nonmanifold_edge", "pinched_vertex", "folded", "self_intersection"});
      CHECK(world["measures"]["defects"]["pinched_vertex"] == sample.measures->made.defects[SGM_DEFECT_PINCHED_VERTEX]);
      uint64_t total = 0;
      for (const json& defect : world["measures"]["defects"]) total += defect.get<uint64_t>();
      CHECK(world["measures"]["defects_total"] == total);
    }
  }
}

TEST_CASE("the map has exactly its members, and says whether it is all") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  RandomSamples random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    WorldMap map;
    map.world = random.world("cave", round % 2 == 0);
    map.chunks.resize(random.below(300));
    for (DrawnChunk& chunk : map.chunks) {
      chunk.level = static_cast<int32_t>(random.below(17));
      for (int32_t* at : {&chunk.x, &chunk.y, &chunk.z}) *at = static_cast<int32_t>(random.below(2000)) - 1000;
      chunk.triangles = static_cast<uint32_t>(random.below(10000));
    }
    map.total = map.chunks.size() + random.below(2);
    const json told = json::parse(chunksText(map));
    CHECK(keysOf(told) ==
          Keys{"name", "frame", "cell_meters", "chunk_cells", "viewers", "total", "truncated", "chunks"});
    CHECK(told["name"] == "cave");
    CHECK(told["chunk_cells"] == 32);
    CHECK(told["total"] == map.total);
    CHECK(told["truncated"] == (map.total > map.chunks.size()));
    REQUIRE(told["chunks"].size() == map.chunks.size());
    for (size_t i = 0; i < map.chunks.size(); ++i) {
      const DrawnChunk& chunk = map.chunks[i];
      CHECK(told["chunks"][i] == json::array({chunk.level, chunk.x, chunk.y, chunk.z, chunk.triangles}));
    }
  }
}

TEST_CASE("quantiles lie in the bucket of the true one, rise, and end with the longest") {
  CHECK(quantile(histogramOf({}), 0.5) == 0);
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-20, 6);
  for (unsigned round = 0; round < rounds(200); ++round) {
    std::vector<double> times(1 + random() % 100);
    for (double& time : times) time = std::exp2(exponent(random));
    const sgm_time_histogram histogram = histogramOf(times);
    std::sort(times.begin(), times.end());
    double before = 0;
    for (int percent = 1; percent <= 100; ++percent) {
      const double told = quantile(histogram, percent / 100.0);
      CHECK(told >= before);
      CHECK(told <= histogram.longest);
      before = told;
      const auto rank = static_cast<size_t>(std::ceil(percent / 100.0 * static_cast<double>(times.size())));
      const double exact = times[std::max<size_t>(rank, 1) - 1];
      if (exact > std::exp2(SGM_TIME_FIRST_EXPONENT) && exact <= 8) {
        CHECK(told <= 2 * exact * 1.0001);
        CHECK(told >= exact / 2 * 0.9999);
      }
    }
    CHECK(before >= histogram.longest * (1 - 1e-12));
  }
}

}  // namespace sgm::service
