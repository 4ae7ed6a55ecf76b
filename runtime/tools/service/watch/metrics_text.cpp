#include "tools/service/watch/metrics_text.h"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include "base/platform/figures.h"
#include "tools/service/watch/defect_names.h"
#include "tools/service/watch/time_quantile.h"

namespace sgm::service {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

/// Collects metric families in the order of their first use. Each use states the family's name and help text again.
class Families {
 public:
  void gauge(const char* name, const char* help, Labels labels, double value) {
    ClientMetric metric;
    metric.gauge.value = value;
    add(name, help, MetricType::Gauge, std::move(labels), std::move(metric));
  }
  void counter(const char* name, const char* help, Labels labels, double value) {
    ClientMetric metric;
    metric.counter.value = value;
    add(name, help, MetricType::Counter, std::move(labels), std::move(metric));
  }
  void counter(const char* name, const char* help, Labels labels, uint64_t value) {
    counter(name, help, std::move(labels), static_cast<double>(value));
  }
  void gauge(const char* name, const char* help, Labels labels, uint64_t value) {
    gauge(name, help, std::move(labels), static_cast<double>(value));
  }
  void histogram(const char* name, const char* help, Labels labels, ClientMetric::Histogram value) {
    ClientMetric metric;
    metric.histogram = std::move(value);
    add(name, help, MetricType::Histogram, std::move(labels), std::move(metric));
  }
  std::string text() const {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    prometheus::TextSerializer().Serialize(out, families_);
    return out.str();
  }

 private:
  void add(const char* name, const char* help, MetricType type, Labels labels, ClientMetric metric) {
    metric.label = std::move(labels);
    for (MetricFamily& family : families_)
      if (family.name == name) return family.metric.push_back(std::move(metric));
    families_.push_back({name, help, type, {std::move(metric)}});
  }

  std::vector<MetricFamily> families_;
};

ClientMetric::Histogram histogramOf(const sgm_time_histogram& times) {
  ClientMetric::Histogram histogram;
  for (int bucket = 0; bucket < SGM_TIME_BUCKETS; ++bucket) {
    histogram.sample_count += times.counts[bucket];
    histogram.bucket.push_back({histogram.sample_count, upperBound(bucket)});
  }
  histogram.sample_sum = times.sum;
  return histogram;
}

void addChunks(Families& all, const WorldSample& world, const Labels& backend) {
  const auto with = [&](const char* name, std::string value) {
    Labels labels = backend;
    labels.push_back({name, std::move(value)});
    return labels;
  };
  const sgm_world_stats& stats = world.stats;
  constexpr const char* kBuilt = "sgm_chunks_built_total";
  constexpr const char* kBuiltHelp = "Bodies of chunks by result; those in_vain also count as meshed or cached.";
  const uint64_t cached = countOf(world.times.read);
  uint64_t meshed = 0;
  for (const sgm_time_histogram& level : world.times.mesh) meshed += countOf(level);
  all.counter(kBuilt, kBuiltHelp, with("result", "meshed"), meshed);
  all.counter(kBuilt, kBuiltHelp, with("result", "cached"), cached);
  all.counter(kBuilt, kBuiltHelp, with("result", "failed"), stats.chunks_failed);
  all.counter(kBuilt, kBuiltHelp, with("result", "in_vain"), stats.chunks_in_vain);
  // Write a value for every level from the first scrape on, even if it is 0. Otherwise, a level's series would begin
  // with its first chunks, and Prometheus would not count these as an increase.
  const int top = std::clamp(world.info.top_level, 0, SGM_MAX_LEVEL);
  for (int level = 0; level <= top; ++level) {
    all.histogram("sgm_chunk_build_seconds", "Time to make a chunk's body, from the grammar to its packed mesh.",
                  with("lod", std::to_string(level)), histogramOf(world.times.mesh[level]));
  }
}

void addMeasures(Families& all, const WorldSample& world, const Labels& labels) {
  if (!world.measures) return;
  for (size_t kind = 0; kind < kDefectNames.size(); ++kind) {
    Labels with = labels;
    with.push_back({"kind", kDefectNames[kind]});
    all.counter("sgm_mesh_defects_total", "Defects of the chunks that were made; a count other than 0 means a bug.",
                std::move(with), world.measures->made.defects[kind]);
  }
  all.gauge("sgm_surface_area_square_meters", "Area of the drawn surface.", labels, world.measures->drawn.area);
  all.gauge("sgm_volume_cubic_meters",
            "Volume of the solid inside the drawn surface; below 0 if the inside is void, as in a cave.", labels,
            world.measures->drawn.flux);
  all.gauge("sgm_triangles", "Triangles of the drawn surface.", labels, world.measures->drawn.triangles);
}

void addDevice(Families& all, const WorldSample& world, const Labels& labels) {
  if (world.info.backend.backend == SGM_BACKEND_CPU) return;
  Labels heap = labels;
  heap.push_back({"heap", "meshes"});
  all.gauge("sgm_gpu_memory_bytes", "Bytes of meshes on the device.", std::move(heap), world.info.backend.resident);
  all.counter("sgm_device_lost_total", "Losses of the device.", labels, world.info.backend.losses);
}

void addWorld(Families& all, const WorldSample& world) {
  const Labels labels{{"world", world.name}};
  const Labels backend{{"world", world.name}, {"backend", world.info.backend.name}};
  const auto with = [&](const char* name, const char* value) {
    Labels more = labels;
    more.push_back({name, value});
    return more;
  };
  const sgm_world_stats& stats = world.stats;
  all.gauge("sgm_world_info", "Watched worlds and the backends that compute them.", backend, 1.0);
  addChunks(all, world, backend);
  all.histogram("sgm_world_update_seconds", "Duration of sgm_world_update, on the engine's thread.", labels,
                histogramOf(world.times.update));
  constexpr const char* kQueueHelp = "Chunks that wait or are being made.";
  all.gauge("sgm_queue_depth", kQueueHelp, with("stage", "waiting"), stats.queued);
  all.gauge("sgm_queue_depth", kQueueHelp, with("stage", "in_work"), stats.in_work);
  all.gauge("sgm_chunks_drawn", "Drawn chunks that have triangles or anchors.", labels, stats.drawn);
  all.gauge("sgm_chunks_kept", "Known chunks, including chunks that are empty or not drawn.", labels, stats.kept);
  all.counter("sgm_frames_total", "Frames of changes of the drawn chunks; not frames of the engine.", labels,
              stats.frame);
  all.gauge("sgm_mesh_bytes", "Bytes of meshes, the engine's included.", labels, stats.mesh_bytes);
  all.gauge("sgm_mesh_peak_bytes", "Highest number of bytes of meshes so far.", labels, stats.peak_mesh_bytes);
  all.gauge("sgm_mesh_limit_bytes", "Limit of the bytes of meshes.", labels, world.info.mesh_bytes);
  all.gauge("sgm_collider_bytes", "Bytes of colliders.", labels, stats.collider_bytes);
  all.gauge("sgm_detail_ratio", "Factor on the distances of detail; below 1 where memory is scarce.", labels,
            stats.detail);
  all.gauge("sgm_world_idle", "1 if everything that the viewers need is drawn, else 0.", labels,
            stats.idle != 0 ? 1.0 : 0.0);
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - world.taken;
  all.gauge("sgm_world_sample_age_seconds",
            "Age of the last sample of the world, from which all its other metrics come.", labels, age.count());
  all.gauge("sgm_edits", "Known edits, including undos.", labels, stats.edits);
  constexpr const char* kRequests = "sgm_chunk_cache_requests_total";
  constexpr const char* kRequestsHelp = "Lookups of parts of chunks in the disk cache.";
  all.counter(kRequests, kRequestsHelp, with("result", "hit"), stats.cache_hits);
  all.counter(kRequests, kRequestsHelp, with("result", "miss"),
              stats.cache_misses - std::min(stats.cache_misses, stats.cache_damaged));
  all.counter(kRequests, kRequestsHelp, with("result", "damaged"), stats.cache_damaged);
  all.gauge("sgm_chunk_cache_bytes", "Bytes of the files of the disk cache that were scanned so far.", labels,
            stats.cache_bytes);
  addMeasures(all, world, labels);
  if (world.parallel_speedup) {
    const double threads = std::max(1.0, static_cast<double>(world.info.threads));
    all.gauge("sgm_parallel_speedup_ratio", "Mean number of jobs that made chunks concurrently, while there were any.",
              labels, *world.parallel_speedup);
    all.gauge("sgm_parallel_efficiency_ratio", "sgm_parallel_speedup_ratio over the number of worker threads.", labels,
              *world.parallel_speedup / threads);
  }
  addDevice(all, world, labels);
}

void addServer(Families& all, const char* port, const http::ServerCounts& counts) {
  for (size_t status = 0; status < counts.answers.size(); ++status) {
    // Write these statuses even if their count is 0: if a series began with its first error, Prometheus would compute
    // no rate.
    const bool always = status == 200 || status == 500 || status == 503;
    if (counts.answers[status] == 0 && !always) continue;
    all.counter("sgm_http_requests_total", "Answered requests.", {{"port", port}, {"code", std::to_string(status)}},
                counts.answers[status]);
  }
  all.gauge("sgm_http_connections", "Open connections.", {{"port", port}}, counts.connections);
}

void addInspector(Families& all, const InspectorCounts& counts) {
  constexpr const char* kJudged = "sgm_validations_total";
  constexpr const char* kHelp = "Validated uploads; those with result refused could not be read.";
  all.counter(kJudged, kHelp, {{"result", "valid"}}, counts.valid);
  all.counter(kJudged, kHelp, {{"result", "invalid"}}, counts.invalid);
  all.counter(kJudged, kHelp, {{"result", "refused"}}, counts.refused);
  all.counter(kJudged, kHelp, {{"result", "failed"}}, counts.failed);
  ClientMetric::Histogram seconds;
  for (size_t i = 0; i < counts.seconds.size(); ++i)
    seconds.bucket.push_back({counts.seconds[i], std::ldexp(1.0, static_cast<int>(i) - 8)});
  seconds.sample_count =
      std::max(counts.valid + counts.invalid + counts.refused + counts.failed, counts.seconds.back());
  seconds.bucket.push_back({seconds.sample_count, std::numeric_limits<double>::infinity()});
  seconds.sample_sum = counts.seconds_sum;
  all.histogram("sgm_validation_seconds", "Time to validate an upload, without its time in the queue.", {},
                std::move(seconds));
  constexpr const char* kQueue = "sgm_validation_queue_depth";
  constexpr const char* kQueueHelp = "Uploads that are being validated or wait.";
  all.gauge(kQueue, kQueueHelp, {{"state", "waiting"}}, uint64_t{counts.waiting});
  all.gauge(kQueue, kQueueHelp, {{"state", "running"}}, uint64_t{counts.running});
}

void addProcess(Families& all) {
  const platform::ProcessFigures figures = platform::processFigures();
  if (figures.resident_bytes)
    all.gauge("process_resident_memory_bytes", "Resident memory size in bytes.", {}, *figures.resident_bytes);
  if (figures.cpu_seconds)
    all.counter("process_cpu_seconds_total", "Total user and system CPU time spent in seconds.", {},
                *figures.cpu_seconds);
  if (figures.open_files) all.gauge("process_open_fds", "Number of open file descriptors.", {}, *figures.open_files);
  if (figures.start_seconds)
    all.gauge("process_start_time_seconds", "Start time of the process since unix epoch in seconds.", {},
              *figures.start_seconds);
}

}  // namespace

std::string metricsText(const ServiceState& state, const std::vector<WorldSample>& worlds) {
  Families all;
  all.gauge("sgm_build_info", "Always 1; the label has the version of the library.",
            {{"version", sgm_version_string()}}, 1.0);
  all.gauge("sgm_worlds", "Watched worlds.", {}, uint64_t{worlds.size()});
  for (const WorldSample& world : worlds) addWorld(all, world);
  addServer(all, "work", state.work);
  addServer(all, "operations", state.operations);
  addInspector(all, state.inspector);
  all.gauge("sgm_reports_kept", "Reports that are kept.", {}, uint64_t{state.reports});
  addProcess(all);
  return all.text();
}

}  // namespace sgm::service
