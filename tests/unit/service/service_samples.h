#pragma once
// Worlds, and random samples of worlds, for the tests of the service.

#include <sgm/sgm.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "catch.h"
#include "tools/service/watch/service_state.h"
#include "tools/service/watch/watched_worlds.h"

namespace sgm::service {

/// A world of balls around the origin, which an engine's thread streams from fly() on.
class StreamedWorld {
 public:
  explicit StreamedWorld(uint32_t flags = 0) {
    REQUIRE(sgm_runtime_create(nullptr, &runtime_, nullptr) == SGM_OK);
    sgm_grammar_desc grammar = SGM_GRAMMAR_DESC_INIT;
    grammar.text =
        "sgm 1; units m; domain infinite;\nlayer l cell 32m reach 8m detail 2m { start Ball; }\n"
        "rule Ball { at(8m, 8m, 8m) sphere(7m); }\n";
    sgm_grammar* compiled = nullptr;
    REQUIRE(sgm_grammar_compile(runtime_, &grammar, &compiled, nullptr, nullptr) == SGM_OK);
    sgm_field_desc of = SGM_FIELD_DESC_INIT;
    of.grammar = compiled;
    of.cell_units = 512;
    of.backend = SGM_BACKEND_CPU;
    REQUIRE(sgm_field_create(runtime_, &of, &field_, nullptr) == SGM_OK);
    sgm_grammar_destroy(compiled);
    world = make(flags);
  }
  ~StreamedWorld() {
    stop();
    for (sgm_world* other : others_) sgm_world_destroy(other);
    sgm_field_destroy(field_);
    // A runtime that is still in use cannot be destroyed, so the test finds meshes and worlds that were not released.
    CHECK(sgm_runtime_destroy(runtime_) == SGM_OK);
  }
  StreamedWorld(const StreamedWorld&) = delete;
  StreamedWorld& operator=(const StreamedWorld&) = delete;

  /// Makes another world of the same field; it is destroyed with this object.
  sgm_world* make(uint32_t flags = 0) {
    sgm_world_desc desc = SGM_WORLD_DESC_INIT;
    desc.top_level = 3;
    desc.flags = flags;
    desc.finest_distance = 10;
    desc.view_distance = 60;
    sgm_world* made = nullptr;
    REQUIRE(sgm_world_create(field_, &desc, &made, nullptr) == SGM_OK);
    others_.push_back(made);
    return made;
  }

  /// Starts a thread that moves the viewer and updates the world.
  void fly() {
    ends_ = false;
    engine_ = std::thread([this] {
      for (double x = 0; !ends_; x = x < 5000 ? x + 1 : 0) step(x);
    });
  }
  void stop() {
    ends_ = true;
    if (engine_.joinable()) engine_.join();
  }
  void settle() {
    step(0);
    REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK);
    poll();
  }

  sgm_world* world = nullptr;
  std::atomic<uint64_t> updates{0};

 private:
  void step(double x) {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    viewer.position[0] = x;
    sgm_world_set_viewers(world, &viewer, 0, 1, nullptr);
    if (sgm_world_update(world, 1 << 22, nullptr) == SGM_OK) ++updates;
    poll();
  }
  void poll() {
    std::vector<sgm_world_event> events(64);
    for (size_t count = 1; count > 0;) {
      count = events.size();
      if (sgm_world_poll(world, events.data(), 0, &count, nullptr) != SGM_OK) return;
      for (size_t i = 0; i < count; ++i) sgm_mesh_release(events[i].mesh);
    }
  }

  sgm_runtime* runtime_ = nullptr;
  sgm_field* field_ = nullptr;
  std::vector<sgm_world*> others_;
  std::atomic<bool> ends_{false};
  std::thread engine_;
};

/// Random states of a world and a service, including impossible ones: numbers that are not finite.
class RandomSamples {
 public:
  explicit RandomSamples(unsigned seed) : random_(seed) {}

  WorldSample world(std::string name, bool finite = true) {
    WorldSample sample;
    sample.name = std::move(name);
    sample.info.backend.backend = below(2) == 0 ? SGM_BACKEND_CPU : SGM_BACKEND_VULKAN;
    std::snprintf(sample.info.backend.name, SGM_NAME_SIZE, "%s", below(2) == 0 ? "cpu" : "vulkan");
    std::snprintf(sample.info.backend.device, SGM_NAME_SIZE, "a \"device\" \\ of\n\xff %u", unsigned(below(9)));
    sample.info.backend.resident = below(1 << 30);
    sample.info.backend.losses = below(4);
    sample.info.cell_units = static_cast<int32_t>(1 + below(4096));
    sample.info.top_level = static_cast<int32_t>(below(SGM_MAX_LEVEL + 1));
    sample.info.threads = static_cast<uint32_t>(below(65));
    sample.info.view_distance = number(finite);
    sample.info.mesh_bytes = below(uint64_t{1} << 40);
    sgm_world_stats& stats = sample.stats;
    for (uint64_t* count : {&stats.frame,           &stats.chunks_meshed,   &stats.finest_meshed,  &stats.seam_jobs,
                            &stats.chunks_in_vain,  &stats.chunks_failed,   &stats.stale,          &stats.queued,
                            &stats.in_work,         &stats.drawn,           &stats.kept,           &stats.mesh_bytes,
                            &stats.peak_mesh_bytes, &stats.chunks_outdated, &stats.collider_bytes, &stats.edits,
                            &stats.cache_hits,      &stats.cache_misses,    &stats.cache_damaged,  &stats.cache_bytes})
      *count = below(uint64_t{1} << below(50));
    stats.detail = number(finite);
    stats.idle = static_cast<int32_t>(below(2));
    for (sgm_time_histogram* times : {&sample.times.update, &sample.times.poll, &sample.times.read})
      *times = histogram(finite);
    for (sgm_time_histogram& times : sample.times.mesh) times = histogram(finite);
    if (below(2) == 0) {
      sample.measures = sgm_world_measures SGM_WORLD_MEASURES_INIT;
      sample.measures->drawn.area = number(finite);
      sample.measures->drawn.flux = number(finite);
      sample.measures->drawn.triangles = below(1 << 30);
      sample.measures->drawn.sliver_triangles = below(1 << 20);
      for (uint64_t& defect : sample.measures->made.defects) defect = below(4);
    }
    sample.viewers.resize(below(3), sgm_viewer SGM_VIEWER_INIT);
    for (sgm_viewer& viewer : sample.viewers) viewer.position[1] = number(finite);
    sample.chunks_per_second = number(finite);
    if (below(2) == 0) sample.parallel_speedup = number(finite);
    sample.taken = std::chrono::steady_clock::now() - std::chrono::milliseconds(below(5000));
    return sample;
  }

  ServiceState service() {
    ServiceState state;
    state.started = std::chrono::steady_clock::now() - std::chrono::seconds(below(100));
    state.operations_port = static_cast<uint16_t>(below(65536));
    for (http::ServerCounts* counts : {&state.work, &state.operations}) {
      counts->connections = below(9);
      for (int i = 0; i < 6; ++i) counts->answers[200 + below(400)] += below(1000);
    }
    InspectorCounts& inspector = state.inspector;
    inspector.running = static_cast<unsigned>(below(3));
    inspector.waiting = static_cast<unsigned>(below(17));
    for (uint64_t* count : {&inspector.valid, &inspector.invalid, &inspector.refused, &inspector.failed})
      *count = below(100);
    uint64_t within = 0;
    const uint64_t all = inspector.valid + inspector.invalid + inspector.refused + inspector.failed;
    for (uint64_t& count : inspector.seconds) count = within = std::min(all, within + below(30));
    inspector.seconds_sum = static_cast<double>(below(1000)) / 7;
    state.inspects = below(2) == 0;
    state.max_waiting = 16;
    state.max_upload_bytes = uint64_t{64} << 20;
    state.reports = below(65);
    return state;
  }

  uint64_t below(uint64_t end) { return std::uniform_int_distribution<uint64_t>(0, end - 1)(random_); }

 private:
  double number(bool finite) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kNone[] = {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()};
    if (!finite && below(2) == 0) return kNone[below(3)];
    return std::ldexp(static_cast<double>(below(1 << 20)) - (1 << 19), static_cast<int>(below(40)) - 30);
  }
  sgm_time_histogram histogram(bool finite) {
    sgm_time_histogram times = SGM_TIME_HISTOGRAM_INIT;
    for (uint64_t& count : times.counts) count = below(3) == 0 ? below(1000) : 0;
    times.sum = finite ? static_cast<double>(below(1000)) / 3 : number(false);
    times.longest = finite ? static_cast<double>(below(1000)) / 3 : number(false);
    return times;
  }

  std::mt19937_64 random_;
};

}  // namespace sgm::service
