#pragma once
// Code shared by the rows of the benchmark: the field of the ground, positions in the void, moving viewers, and counts
// of jobs.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "crowds/engine.h"

namespace crowds {

using Clock = std::chrono::steady_clock;

inline constexpr uint32_t kSeed = 1;

/// The total time, on all threads, of profiler zones with a given name.
struct ZoneTimes {
  static constexpr const char* kPlan = "sgm.plan";
  std::atomic<uint64_t> plan_ns{0};

  static uint64_t begin(void*, const char* zone) {
    return std::strcmp(zone, kPlan) == 0 ? static_cast<uint64_t>(Clock::now().time_since_epoch().count()) : 0;
  }
  static void end(void* user, uint64_t begun) {
    if (begun == 0) return;
    static_cast<ZoneTimes*>(user)->plan_ns += static_cast<uint64_t>(Clock::now().time_since_epoch().count()) - begun;
  }
};

struct Ground {
  ZoneTimes zones;
  RuntimeOwner runtime;
  GrammarOwner grammar;
  FieldOwner field;
  int32_t cell_units = SGM_UNITS_PER_METRE / 2;

  explicit Ground(const std::string& path) {
    sgm_error error = SGM_ERROR_INIT;
    sgm_runtime_desc runtime_desc = SGM_RUNTIME_DESC_INIT;
    runtime_desc.threads = 2;
    const sgm_profiler profiler{ZoneTimes::begin, ZoneTimes::end, nullptr, nullptr, &zones};
    runtime_desc.profiler = &profiler;
    sgm_runtime* made = nullptr;
    must(sgm_runtime_create(&runtime_desc, &made, &error), error);
    runtime.reset(made);
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    sgm_grammar_desc grammar_desc = SGM_GRAMMAR_DESC_INIT;
    grammar_desc.text = all.c_str();
    grammar_desc.name = path.c_str();
    sgm_grammar* compiled = nullptr;
    must(sgm_grammar_compile(made, &grammar_desc, &compiled, nullptr, &error), error);
    grammar.reset(compiled);
    sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
    field_desc.grammar = compiled;
    field_desc.seed = 3;
    field_desc.cell_units = cell_units;
    sgm_field* of = nullptr;
    must(sgm_field_create(made, &field_desc, &of, &error), error);
    field.reset(of);
  }

  double planSeconds() const { return static_cast<double>(zones.plan_ns.load()) * 1e-9; }
  uint64_t memory() const {
    uint64_t live = 0;
    static_cast<void>(sgm_runtime_memory(runtime.get(), &live, nullptr));
    return live;
  }
};

inline sgm_world_desc worldDesc() {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.collider_distance = 16;
  return desc;
}

/// Returns positions within `reach_m` metres of the origin that have two metres of void around them.
inline std::vector<Place> placesInVoid(const Ground& ground, size_t count, int32_t reach_m) {
  std::mt19937 random(kSeed);
  std::vector<Place> places;
  constexpr size_t kAtOnce = 4096;
  while (places.size() < count) {
    std::vector<int32_t> points(kAtOnce * 3);
    for (int32_t& p : points)
      p = (static_cast<int32_t>(random() % static_cast<uint32_t>(2 * reach_m)) - reach_m) * SGM_UNITS_PER_METRE;
    std::vector<float> values(kAtOnce);
    sgm_sample_desc desc = SGM_SAMPLE_DESC_INIT;
    desc.points = points.data();
    desc.count = kAtOnce;
    desc.values = values.data();
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_field_sample(ground.field.get(), &desc, &error), error);
    for (size_t i = 0; i < kAtOnce && places.size() < count; ++i) {
      if (values[i] < 2) continue;
      Place place;
      for (size_t axis = 0; axis < 3; ++axis)
        place[axis] = static_cast<double>(points[3 * i + axis]) / SGM_UNITS_PER_METRE;
      places.push_back(place);
    }
  }
  return places;
}

/// A viewer that moves horizontally in a straight line.
struct Mover {
  Place from{};
  double speed = 0, turn = 0;  ///< m/s, radians

  Place at(double seconds) const {
    return {from[0] + speed * seconds * std::cos(turn), from[1], from[2] + speed * seconds * std::sin(turn)};
  }
  sgm_viewer viewer(double seconds) const {
    sgm_viewer viewer = SGM_VIEWER_INIT;
    const Place place = at(seconds);
    for (size_t axis = 0; axis < 3; ++axis) viewer.position[axis] = place[axis];
    viewer.velocity[0] = viewer.direction[0] = static_cast<float>(speed * std::cos(turn));
    viewer.velocity[2] = viewer.direction[2] = static_cast<float>(speed * std::sin(turn));
    return viewer;
  }
};

/// Calls frame(time) `rate` times a second, until `seconds` have passed or it returns false. time: seconds since the
/// start. Frames that are already late are skipped.
inline void paced(double seconds, double rate, const std::function<bool(double)>& frame) {
  const Clock::time_point start = Clock::now();
  const auto now = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  for (double at = now(); at < seconds; at = now()) {
    if (!frame(at)) return;
    const double next = (std::floor(now() * rate) + 1) / rate;
    std::this_thread::sleep_until(start +
                                  std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(next)));
  }
}

inline void dig(const Engine& engine, const Place& place, double radius_m) {
  sgm_brush brush = SGM_BRUSH_INIT;
  for (size_t axis = 0; axis < 3; ++axis)
    brush.from[axis] = static_cast<int32_t>(std::lround(place[axis] * SGM_UNITS_PER_METRE));
  brush.radius = static_cast<int32_t>(radius_m * SGM_UNITS_PER_METRE);
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_world_edit(engine.world(), &brush, nullptr, &error), error);
}

/// Numbers and times of all worlds' finished jobs.
struct Work {
  uint64_t meshed = 0, in_vain = 0, plans = 0, seams = 0;
  double mesh_seconds = 0, longest_update = 0;

  void add(const Engine& engine) {
    const sgm_world_stats stats = engine.stats();
    const sgm_world_times times = engine.times();
    meshed += stats.chunks_meshed;
    in_vain += stats.chunks_in_vain;
    seams += stats.seam_jobs;
    plans += stats.plans;
    mesh_seconds += times.job_seconds;
    longest_update = std::max(longest_update, times.update.longest);
  }
  void print(const Ground& ground) const {
    std::printf(
        "\"chunks\": %llu, \"in_vain\": %llu, \"seam_jobs\": %llu, \"plans\": %llu, \"plan_seconds\": %.3f, "
        "\"mesh_seconds\": %.3f, \"longest_update_ms\": %.3f",
        static_cast<unsigned long long>(meshed), static_cast<unsigned long long>(in_vain),
        static_cast<unsigned long long>(seams), static_cast<unsigned long long>(plans), ground.planSeconds(),
        mesh_seconds, 1000 * longest_update);
  }
};

}  // namespace crowds
