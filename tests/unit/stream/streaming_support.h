#pragma once
// A streamed world with an engine that draws it, and checks that must hold for every frame.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <random>
#include <thread>

#include "backend/open/open_backend.h"
#include "mesh/check.h"
#include "mesh/vertex.h"
#include "stream/plan/frame.h"
#include "stream/world.h"
#include "world/world_support.h"

namespace sgm {

inline constexpr int32_t kStreamedCell = 512;

/// A job system that runs jobs only within help(), in random order: it is as late and as disorderly as the contract
/// allows.
class LateJobs final : public JobSystem {
 public:
  explicit LateJobs(uint32_t seed) : random_(seed) {}
  ~LateJobs() override {
    while (help()) {
    }
  }
  unsigned concurrency() const override { return 3; }
  void submit(void (*function)(void*), void* argument, int) override {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({function, argument});
  }
  bool help() override {
    std::pair<void (*)(void*), void*> job;
    {
      const std::lock_guard lock(mutex_);
      if (jobs_.empty()) return false;
      std::swap(jobs_[random_() % jobs_.size()], jobs_.back());
      job = jobs_.back();
      jobs_.pop_back();
    }
    job.first(job.second);
    return true;
  }

 private:
  std::mutex mutex_;
  std::mt19937 random_;
  std::vector<std::pair<void (*)(void*), void*>> jobs_;
};

inline WorldFieldSettings withHosts(WorldFieldSettings settings, std::vector<HostField> hosts) {
  settings.hosts = std::move(hosts);
  return settings;
}

/// The backend that SGM_TEST_BACKEND names, or the CPU, so that the same tests run with every backend. If that backend
/// is unavailable, the whole program is skipped with exit status 77, unless SGM_REQUIRE_VULKAN forbids that.
inline const BackendRequest& testedBackend() {
  static const BackendRequest tested = [] {
    BackendRequest request;
    const char* name = std::getenv("SGM_TEST_BACKEND");
    if (name == nullptr) return request;
    REQUIRE((std::string(name) == "vulkan" || std::string(name) == "cuda"));
    request.kind = std::string(name) == "cuda" ? BackendKind::cuda : BackendKind::vulkan;
    const auto jobs = *makeThreadPool(1);
    const auto made = makeBackend(request, *jobs, std::pmr::get_default_resource());
    if (made) return request;
    INFO(made.error().message);
    REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
    std::fprintf(stderr, "SKIPPED: %s\n", made.error().message.c_str());
    std::exit(77);
  }();
  return tested;
}

/// A backend that waits until its device is ready, so that the tests stream on the device, and not on the CPU
/// meanwhile.
class PatientBackend final : public Backend {
 public:
  explicit PatientBackend(std::unique_ptr<Backend> backend) : backend_(std::move(backend)) {}
  const BackendCapabilities& capabilities() const override { return backend_->capabilities(); }
  BackendCounters counters() const override { return backend_->counters(); }
  uint32_t batch() const override { return backend_->batch(); }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk) override {
    for (ChunkJob& job : jobs) job.prompt = false;
    return backend_->submit(std::move(jobs), std::move(after_chunk));
  }
  Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const> parts) override {
    return backend_->upload(parts);
  }

 private:
  std::unique_ptr<Backend> backend_;
};

/// A shared_ptr that does not own the field, which must outlive all users of the pointer.
inline std::shared_ptr<const WorldField> external(const WorldField& field) { return {std::shared_ptr<void>(), &field}; }

struct Scene {
  explicit Scene(std::unique_ptr<JobSystem> jobs_in, const std::string& text = caveText(),
                 WorldSettings settings_in = {}, std::vector<HostField> hosts = {},
                 const BackendRequest& request = testedBackend())
      : field(withHosts(settingsOf(text, kStreamedCell, 3), std::move(hosts)), std::pmr::get_default_resource()),
        jobs(std::move(jobs_in)),
        settings(settings_in) {
    std::pmr::memory_resource* memory = field.memory();
    settings.lod.top = 3;
    settings.lod.finest_cell = kStreamedCell;
    if (settings_in.lod.finest_distance == WorldSettings{}.lod.finest_distance) {
      settings.lod.finest_distance = 20.0 * kUnitsPerMetre;
    }
    settings.lod.view_distance = 120.0 * kUnitsPerMetre;
    Result<std::unique_ptr<Backend>> made = makeBackend(request, *jobs, memory);
    REQUIRE(made);
    backend = std::make_unique<PatientBackend>(std::move(*made));
    Result<std::unique_ptr<World>> created = World::create(external(field), *backend, *jobs, settings, memory);
    REQUIRE(created);
    world = std::move(*created);
  }

  WorldField field;
  std::unique_ptr<JobSystem> jobs;
  WorldSettings settings;
  std::unique_ptr<Backend> backend;
  std::unique_ptr<World> world;
};

/// An engine that knows of a world only what its events report.
class Engine {
 public:
  struct Shown {
    std::shared_ptr<const ChunkSurface> surface;
    uint8_t seams = 0;
    Neighbourhood coarser = 0;
  };

  /// Processes all events. Returns the number of bytes of surfaces that arrived since the last call.
  size_t take(World& world) {
    using Kind = WorldEvent::Kind;
    size_t bytes = 0;
    world.poll([&](const WorldEvent& event) {
      switch (event.kind) {
        case Kind::ready:
          REQUIRE(event.surface != nullptr);
          ready_[event.key] = event.surface;
          bytes += event.surface->mesh.bytes();
          break;
        case Kind::shown:
          CHECK(shown.count(event.key) == 0);
          shown[event.key] = {surfaceOf(event.key), event.seams, event.coarser};
          break;
        case Kind::replaced:
          REQUIRE(shown.count(event.key) == 1);
          shown[event.key] = {surfaceOf(event.key), event.seams, event.coarser};
          break;
        case Kind::seams:
          REQUIRE(shown.count(event.key) == 1);
          shown[event.key].seams = event.seams;
          shown[event.key].coarser = event.coarser;
          break;
        case Kind::removed:
          CHECK(shown.erase(event.key) + ready_.erase(event.key) > 0);
          break;
        case Kind::collider:
          colliders[event.key] = event.collider;
          break;
        case Kind::collider_removed:
          CHECK(colliders.erase(event.key) == 1);
          break;
        case Kind::failed:
          if (!fails_may_come) FAIL(event.error->message);
          break;
      }
      return true;
    });
    return bytes;
  }

  std::map<ChunkKey, Shown> shown;
  std::map<ChunkKey, std::shared_ptr<const Collider>> colliders;
  bool fails_may_come = false;

 private:
  const std::shared_ptr<const ChunkSurface>& surfaceOf(const ChunkKey& key) {
    REQUIRE(ready_.count(key) == 1);
    return ready_[key];
  }
  std::map<ChunkKey, std::shared_ptr<const ChunkSurface>> ready_;
};

using PartHashes = std::map<std::pair<ChunkKey, size_t>, ContentHash>;

/// Checks that the engine draws exactly the frame of the octree, part by part, and that the frame is closed at every
/// vertex.
inline void checkFrame(const Scene& scene, const Engine& engine, const EditSnapshot* edits = nullptr,
                       const WorldField* field = nullptr) {
  const std::shared_ptr<const DrawnFrame> frame = scene.world->drawn();
  PartHashes drawn, wanted;
  for (const auto& [key, shown] : engine.shown) {
    for (size_t i = 0; i < shown.surface->mesh.ranges.size(); ++i) {
      if (i > 0 && !(shown.seams >> (i - 1) & 1)) continue;
      const PackedRange& range = shown.surface->mesh.ranges[i];
      if (range.index_count > 0) drawn[{key, i}] = range.hash;
    }
  }
  std::vector<ChunkRequest> requests = frameRequests(frame->tree);
  for (ChunkRequest& request : requests) request.sharp = scene.settings.sharp;
  const std::pmr::vector<PlacedChunk> chunks = meshAll(field != nullptr ? *field : scene.field, requests, 2, edits);
  std::vector<const MeshPart*> parts;
  for (const PlacedChunk& chunk : chunks) {
    std::vector<PlacedPart> placed;
    appendParts(chunk, placed);
    for (const PlacedPart& part : placed) {
      wanted[{chunk.key, static_cast<size_t>(part.number)}] = part.mesh->hash;
      parts.push_back(part.mesh);
    }
  }
  CHECK(drawn == wanted);
  CHECK(checkParts(parts).closed());
}

/// Waits until the world has nothing left to do, and processes its events.
inline void comeToRest(Scene& scene, Engine& engine) {
  REQUIRE(scene.world->waitIdle());
  engine.take(*scene.world);
}

/// Moves the only viewer, waits until the world has nothing left to do, and processes its events.
inline void lookFrom(Scene& scene, Engine& engine, const Viewer& viewer) {
  REQUIRE(scene.world->setViewers({&viewer, 1}));
  comeToRest(scene, engine);
}

/// Spends about the time of one frame. Either runs jobs of the world, as an engine does that lends its thread; or just
/// waits.
inline void workOrWait(Scene& scene) {
  for (int jobs = 0; jobs < 50; ++jobs) {
    if (!scene.jobs->help()) return std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

inline Viewer viewerAt(double x, double y, double z) {
  Viewer viewer;
  viewer.position = {x * kUnitsPerMetre, y * kUnitsPerMetre, z * kUnitsPerMetre};
  return viewer;
}

/// Moves a viewer one step: it walks with turns, and sometimes teleports to another part of the world.
inline Viewer wander(std::mt19937& random, Viewer viewer) {
  const auto step = [&](double most) {
    return (static_cast<double>(random() % 2001) / 1000.0 - 1) * most * kUnitsPerMetre;
  };
  const bool leap = random() % 12 == 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    viewer.position[axis] += leap ? step(150) : step(6);
    viewer.velocity[axis] = leap ? 0 : step(20);
    viewer.direction[axis] = step(1);
  }
  return viewer;
}

}  // namespace sgm
