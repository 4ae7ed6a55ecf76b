// Tests that the metrics text has exactly Prometheus' format, for any state of the worlds.

#include "tools/service/watch/metrics_text.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <set>

#include "metrics_reader.h"
#include "rounds.h"
#include "seed.h"
#include "service_samples.h"
#include "temporary_folder.h"

namespace sgm::service {
namespace {

/// Whether two values agree to sixteen digits: the one that the metrics text gives, and the expected one.
bool isWritten(double told, double value) { return std::abs(told - value) <= 1e-15 * std::abs(value); }

const Series* find(const Metrics& metrics, const std::string& family, const std::string& name,
                   const std::vector<std::pair<std::string, std::string>>& labels) {
  const auto of = metrics.find(family);
  if (of == metrics.end()) return nullptr;
  for (const Series& series : of->second.series)
    if (series.name == name && series.labels == labels) return &series;
  return nullptr;
}

double valueOf(const Metrics& metrics, const std::string& name,
               const std::vector<std::pair<std::string, std::string>>& labels) {
  const Series* series = find(metrics, name, name, labels);
  INFO(name);
  REQUIRE(series != nullptr);
  return series->value;
}

/// Whether promtool is installed, which some tests need. With SGM_REQUIRE_ALL, it is an error if promtool is missing.
bool hasPromtool() {
  const bool there = std::system("promtool --version >/dev/null 2>&1") == 0;
  if (std::getenv("SGM_REQUIRE_ALL") != nullptr) REQUIRE(there);
  if (!there) WARN("promtool is not here: install the package prometheus to have the text checked by it");
  return there;
}

}  // namespace

TEST_CASE("metrics of random worlds are well formed, with a closed set of names and labels") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  RandomSamples random(seed);
  const std::set<std::string> names = {"world", "backend", "result", "lod",     "stage", "le",
                                       "kind",  "heap",    "port",   "version", "code",  "state"};
  for (unsigned round = 0; round < rounds(40); ++round) {
    std::vector<WorldSample> worlds;
    const size_t count = random.below(kMaxWorlds + 1);
    for (size_t i = 0; i < count; ++i)
      worlds.push_back(random.world("w" + std::to_string(i) + (i % 2 == 0 ? "" : "_-."), round % 2 == 0));
    const Metrics metrics = MetricsReader::read(metricsText(random.service(), worlds));
    std::map<std::string, size_t> of_world;
    for (const auto& [name, family] : metrics) {
      CHECK((name.substr(0, 4) == "sgm_" || name.substr(0, 8) == "process_"));
      for (const Series& series : family.series) {
        for (const auto& [label, value] : series.labels) CHECK(names.count(label) == 1);
        ++of_world[series.label("world")];
      }
    }
    for (const WorldSample& world : worlds) {
      CHECK(of_world[world.name] > 20);
      CHECK(of_world[world.name] <= 500);
    }
    CHECK(of_world.size() == worlds.size() + 1);
    CHECK(valueOf(metrics, "sgm_worlds", {}) == static_cast<double>(count));
  }
}

TEST_CASE("a world with all that there can be has at most 500 series") {
  RandomSamples random(1);
  WorldSample world = random.world("most");
  world.info.top_level = SGM_MAX_LEVEL;
  world.info.backend.backend = SGM_BACKEND_VULKAN;
  world.measures = sgm_world_measures SGM_WORLD_MEASURES_INIT;
  world.parallel_speedup = 1;
  size_t count = 0;
  for (const auto& [name, family] : MetricsReader::read(metricsText({}, {world})))
    for (const Series& series : family.series) count += series.label("world") == "most" ? 1u : 0u;
  CHECK(count > 400);
  CHECK(count <= 500);
}

TEST_CASE("metrics say what the samples say") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  RandomSamples random(seed);
  for (unsigned round = 0; round < rounds(20); ++round) {
    WorldSample world = random.world("cave");
    world.stats.cache_damaged = std::min(world.stats.cache_damaged, world.stats.cache_misses);
    const ServiceState service = random.service();
    const Metrics metrics = MetricsReader::read(metricsText(service, {world}));
    const std::string backend = world.info.backend.name;
    const auto of = [&](const std::string& name, std::vector<std::pair<std::string, std::string>> labels = {}) {
      labels.insert(labels.begin(), {"world", "cave"});
      return valueOf(metrics, name, labels);
    };
    CHECK(of("sgm_world_info", {{"backend", backend}}) == 1);
    CHECK(valueOf(metrics, "sgm_build_info", {{"version", sgm_version_string()}}) == 1);
    uint64_t meshed = 0;
    for (const sgm_time_histogram& level : world.times.mesh)
      for (const uint64_t counted : level.counts) meshed += counted;
    CHECK(of("sgm_chunks_built_total", {{"backend", backend}, {"result", "meshed"}}) == static_cast<double>(meshed));
    CHECK(of("sgm_chunks_built_total", {{"backend", backend}, {"result", "failed"}}) ==
          static_cast<double>(world.stats.chunks_failed));
    CHECK(of("sgm_chunks_built_total", {{"backend", backend}, {"result", "in_vain"}}) ==
          static_cast<double>(world.stats.chunks_in_vain));
    CHECK(of("sgm_queue_depth", {{"stage", "waiting"}}) == static_cast<double>(world.stats.queued));
    CHECK(of("sgm_queue_depth", {{"stage", "in_work"}}) == static_cast<double>(world.stats.in_work));
    CHECK(of("sgm_chunks_drawn") == static_cast<double>(world.stats.drawn));
    CHECK(of("sgm_chunks_kept") == static_cast<double>(world.stats.kept));
    CHECK(of("sgm_frames_total") == static_cast<double>(world.stats.frame));
    CHECK(of("sgm_mesh_bytes") == static_cast<double>(world.stats.mesh_bytes));
    CHECK(of("sgm_mesh_peak_bytes") == static_cast<double>(world.stats.peak_mesh_bytes));
    CHECK(of("sgm_mesh_limit_bytes") == static_cast<double>(world.info.mesh_bytes));
    CHECK(of("sgm_collider_bytes") == static_cast<double>(world.stats.collider_bytes));
    CHECK(isWritten(of("sgm_detail_ratio"), world.stats.detail));
    CHECK(of("sgm_world_idle") == world.stats.idle);
    CHECK(of("sgm_edits") == static_cast<double>(world.stats.edits));
    CHECK(of("sgm_chunk_cache_bytes") == static_cast<double>(world.stats.cache_bytes));
    // In the metrics, each request counts once; in the statistics, a damaged entry also counts as a miss.
    CHECK(of("sgm_chunk_cache_requests_total", {{"result", "hit"}}) == static_cast<double>(world.stats.cache_hits));
    CHECK(of("sgm_chunk_cache_requests_total", {{"result", "miss"}}) +
              of("sgm_chunk_cache_requests_total", {{"result", "damaged"}}) ==
          static_cast<double>(world.stats.cache_misses));
    const bool device = world.info.backend.backend != SGM_BACKEND_CPU;
    CHECK(metrics.count("sgm_gpu_memory_bytes") == (device ? 1 : 0));
    CHECK(metrics.count("sgm_device_lost_total") == (device ? 1 : 0));
    CHECK(metrics.count("sgm_triangles") == (world.measures ? 1 : 0));
    CHECK(metrics.count("sgm_parallel_speedup_ratio") == (world.parallel_speedup ? 1 : 0));
    if (world.measures) {
      CHECK(isWritten(of("sgm_surface_area_square_meters"), world.measures->drawn.area));
      CHECK(isWritten(of("sgm_volume_cubic_meters"), world.measures->drawn.flux));
      CHECK(of("sgm_mesh_defects_total", {{"kind", "open_edge"}}) ==
            static_cast<double>(world.measures->made.defects[SGM_DEFECT_OPEN_EDGE]));
      CHECK(metrics.at("sgm_mesh_defects_total").series.size() == 13);
    }
    if (world.parallel_speedup) CHECK(isWritten(of("sgm_parallel_speedup_ratio"), *world.parallel_speedup));

    // Compares the buckets of one histogram at each bound.
    double below = 0;
    for (int i = 0; i + 1 < SGM_TIME_BUCKETS; ++i) {
      below += static_cast<double>(world.times.update.counts[i]);
      const double bound = std::ldexp(1.0, i + SGM_TIME_FIRST_EXPONENT);
      bool found = false;
      for (const Series& series : metrics.at("sgm_world_update_seconds").series) {
        if (series.label("le").empty() || std::stod(series.label("le")) != bound) continue;
        found = true;
        CHECK(series.value == below);
      }
      CHECK(found);
    }
    CHECK(
        isWritten(find(metrics, "sgm_world_update_seconds", "sgm_world_update_seconds_sum", {{"world", "cave"}})->value,
                  world.times.update.sum));
    std::set<std::string> levels;
    for (const Series& series : metrics.at("sgm_chunk_build_seconds").series) levels.insert(series.label("lod"));
    CHECK(levels.size() == static_cast<size_t>(world.info.top_level) + 1);

    CHECK(valueOf(metrics, "sgm_validations_total", {{"result", "refused"}}) ==
          static_cast<double>(service.inspector.refused));
    CHECK(valueOf(metrics, "sgm_validation_queue_depth", {{"state", "running"}}) == service.inspector.running);
    CHECK(valueOf(metrics, "sgm_reports_kept", {}) == static_cast<double>(service.reports));
    for (size_t code = 0; code < service.work.answers.size(); ++code) {
      if (service.work.answers[code] == 0) continue;
      CHECK(valueOf(metrics, "sgm_http_requests_total", {{"port", "work"}, {"code", std::to_string(code)}}) ==
            static_cast<double>(service.work.answers[code]));
    }
  }
}

TEST_CASE("metrics tell of this process") {
  const auto read = [] { return MetricsReader::read(metricsText({}, {})); };
  const Metrics before = read();
  CHECK(valueOf(before, "process_resident_memory_bytes", {}) > 1e6);
  CHECK(valueOf(before, "process_cpu_seconds_total", {}) >= 0);
  const double started = valueOf(before, "process_start_time_seconds", {});
  const auto now = static_cast<double>(std::time(nullptr));
  CHECK(started <= now + 2);
  CHECK(started > now - 24 * 3600);
  // The metric counts the two descriptors of the pipe, but not the descriptors that the metric itself opens to read
  // /proc.
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  CHECK(valueOf(read(), "process_open_fds", {}) == valueOf(before, "process_open_fds", {}) + 2);
  close(ends[0]);
  close(ends[1]);
  volatile double work = 0;
  const std::clock_t until = std::clock() + CLOCKS_PER_SEC / 10;
  while (std::clock() < until) work = work + 1;
  CHECK(valueOf(read(), "process_cpu_seconds_total", {}) > valueOf(before, "process_cpu_seconds_total", {}));
}

TEST_CASE("numbers are written alike wherever a program lives") {
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  RandomSamples random(3);
  WorldSample world = random.world("cave");
  world.stats.detail = 0.5;
  world.stats.mesh_bytes = 1234567;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Commas));
  const std::string text = metricsText({}, {world});
  std::locale::global(before);
  const Metrics metrics = MetricsReader::read(text);
  CHECK(valueOf(metrics, "sgm_detail_ratio", {{"world", "cave"}}) == 0.5);
  CHECK(valueOf(metrics, "sgm_mesh_bytes", {{"world", "cave"}}) == 1234567);
}

TEST_CASE("promtool finds nothing wrong with the metrics") {
  if (!hasPromtool()) return;
  const unsigned seed = testSeed();
  CAPTURE(seed);
  RandomSamples random(seed);
  const TemporaryFolder folder;
  for (unsigned round = 0; round < 4; ++round) {
    std::vector<WorldSample> worlds;
    for (unsigned i = 0; i < round * 3; ++i) worlds.push_back(random.world("w" + std::to_string(i), round < 2));
    const std::string file = (folder.path / "metrics").string();
    { std::ofstream(file) << metricsText(random.service(), worlds); }
    CHECK(std::system(("promtool check metrics <" + file + " >" + file + ".out 2>&1").c_str()) == 0);
    INFO(contentOf(file + ".out"));
    CHECK(contentOf(file + ".out").empty());
  }
}

}  // namespace sgm::service
