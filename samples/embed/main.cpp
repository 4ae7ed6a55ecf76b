// embed FILE.sgm [FRAMES [MEGABYTES]]: streams a grammar's world around a viewer that flies through it, as an engine
// does that provides the library's memory, threads, log and profiler; then prints the measured times and memory.

#include <sgm/sgm.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "engine_jobs.h"
#include "engine_memory.h"
#include "engine_profiler.h"
#include "grammar_file.h"
#include "handles.h"
#include "streaming.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kFrameTime = std::chrono::milliseconds(4);
constexpr auto kLongestLoad = std::chrono::minutes(1);
constexpr double kSpeed = 100;  // speed of the viewer, metres per second

/// The engine's log: counts warnings, and prints them.
struct Log {
  std::atomic<int> warnings{0};
  sgm_log_sink table() {
    return {[](void* user, sgm_log_level level, const char* message) {
              if (level < SGM_LOG_WARNING) return;
              ++static_cast<Log*>(user)->warnings;
              std::fprintf(stderr, "embed: warning: %s\n", message);
            },
            this};
  }
};

FieldOwner makeField(sgm_runtime* runtime, const sgm_grammar* grammar) {
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar;
  desc.seed = 7;
  desc.cell_units = SGM_UNITS_PER_METRE / 2;
  sgm_field* field = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_field_create(runtime, &desc, &field, &error), error);
  return FieldOwner(field);
}

WorldOwner makeWorld(sgm_field* field) {
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.top_level = 5;
  desc.finest_distance = 24;
  desc.view_distance = 300;
  desc.mesh_bytes = 64 << 20;
  sgm_world* world = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_world_create(field, &desc, &world, &error), error);
  return WorldOwner(world);
}

/// Finds two places near anchors of the grammar, about a thousand kilometres from the origin: the start of the flight,
/// and a place that gives its direction.
std::pair<Place, Place> findPath(sgm_field* field) {
  constexpr int32_t kFar = 1'000'000 * SGM_UNITS_PER_METRE, kAround = 384 * SGM_UNITS_PER_METRE;
  const int32_t low[3] = {kFar - kAround, -kAround, kFar - kAround};
  const int32_t high[3] = {kFar + kAround, kAround, kFar + kAround};
  sgm_anchor anchors[2];
  size_t count = 2;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_field_anchors(field, low, high, anchors, 0, &count, &error), error);
  if (count < 2) throw std::runtime_error("the grammar names no two places there");
  const auto place = [](const sgm_anchor& anchor) {
    Place p;
    for (size_t axis = 0; axis < 3; ++axis) p[axis] = anchor.position[axis] / double{SGM_UNITS_PER_METRE};
    return p;
  };
  return {place(anchors[0]), place(anchors[1])};
}

void fly(Streaming& streaming, const std::pair<Place, Place>& path, int frames) {
  const auto [from, to] = path;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  Place at = from, velocity{};
  for (size_t axis = 0; axis < 3; ++axis) velocity[axis] = kSpeed * (to[axis] - from[axis]) / length;
  for (int i = 0; i < frames; ++i) {
    const double seconds = i * std::chrono::duration<double>(kFrameTime).count();
    for (size_t axis = 0; axis < 3; ++axis) at[axis] = from[axis] + velocity[axis] * seconds;
    const Clock::time_point next = Clock::now() + kFrameTime;
    streaming.frame(at, velocity);
    std::this_thread::sleep_until(next);
  }
  // After the flight, the viewer stands still until all chunks are drawn.
  for (const Clock::time_point limit = Clock::now() + kLongestLoad; !streaming.idle();) {
    if (Clock::now() > limit) throw std::runtime_error("the world does not come to rest");
    streaming.frame(at, {});
    std::this_thread::sleep_for(kFrameTime);
  }
  if (!streaming.agrees()) throw std::runtime_error("the events do not lead to what the world draws");
}

double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

void print(const Flight& flight, const EngineMemory& memory, const EngineJobs& jobs, const EngineProfiler& profiler) {
  std::printf("frames          %10d\nchunks drawn    %10zu\ntriangles       %10zu\n", flight.frames,
              flight.drawn.chunks, flight.drawn.triangles);
  std::printf("farthest        %10.1f m from the camera\nuploaded        %10.1f MiB\npeak memory     %10.1f MiB\n",
              static_cast<double>(flight.drawn.farthest), static_cast<double>(flight.uploaded) / (1 << 20),
              static_cast<double>(memory.peak()) / (1 << 20));
  std::printf("longest update  %10.3f ms\njobs            %10zu\n\nzone             count     alone ms   longest ms\n",
              milliseconds(flight.longest_update), jobs.jobsRun());
  for (const auto& [name, zone] : profiler.zones()) {
    std::printf("%-12.*s %9llu %12.1f %12.3f\n", static_cast<int>(name.size()), name.data(),
                static_cast<unsigned long long>(zone.count), milliseconds(zone.alone), milliseconds(zone.longest));
  }
  std::printf("\nplot               highest\n");
  for (const auto& [name, value] : profiler.highest()) {
    std::printf("%-15.*s %10.0f\n", static_cast<int>(name.size()), name.data(), value);
  }
}

void run(const char* path, int frames, size_t budget) {
  // These objects must outlive the runtime, because its tables point to them.
  EngineMemory memory(budget);
  EngineJobs jobs(std::clamp(std::thread::hardware_concurrency(), 2u, 4u) - 1);
  EngineProfiler profiler;
  Log log;
  const sgm_allocator allocator = memory.table();
  const sgm_job_system job_system = jobs.table();
  const sgm_profiler zones = profiler.table();
  const sgm_log_sink sink = log.table();
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.allocator = &allocator;
  desc.jobs = &job_system;
  desc.log = &sink;
  desc.profiler = &zones;
  sgm_runtime* runtime = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_runtime_create(&desc, &runtime, &error), error);
  RuntimeOwner owner(runtime);
  Flight flight;
  {
    const GrammarOwner grammar = compileFile(runtime, path);
    const FieldOwner field = makeField(runtime, grammar.get());
    const std::pair<Place, Place> way = findPath(field.get());
    const WorldOwner world = makeWorld(field.get());
    Streaming streaming(world.get());
    fly(streaming, way, frames);
    flight = streaming.flight();
  }
  if (sgm_runtime_destroy(owner.release()) != SGM_OK) throw std::runtime_error("a handle was not given back");
  print(flight, memory, jobs, profiler);
  if (memory.blocks() != 0 || memory.live() != 0) {
    throw std::runtime_error(std::to_string(memory.live()) + " bytes in " + std::to_string(memory.blocks()) +
                             " blocks were not given back");
  }
  if (!profiler.nested() || profiler.zones().empty()) throw std::runtime_error("zones are missing, or do not nest");
  if (log.warnings != 0) throw std::runtime_error("there were warnings");
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 2 ? std::atoi(argv[2]) : 300;
  const int megabytes = argc > 3 ? std::atoi(argv[3]) : 256;
  if (argc < 2 || argc > 4 || frames < 1 || megabytes < 1) {
    std::fprintf(stderr, "usage: embed FILE.sgm [FRAMES [MEGABYTES]]\n");
    return 2;
  }
  try {
    run(argv[1], frames, static_cast<size_t>(megabytes) << 20);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "embed: %s\n", e.what());
    return 1;
  }
  return 0;
}
