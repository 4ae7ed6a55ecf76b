// Tests destroying handles twice: each second call must return an error code, write a line to the log, and have no
// other effect.

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <tuple>

#include "fixture.h"
#include "rounds.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SGM_TEST_WATCHES_ADDRESSES
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SGM_TEST_WATCHES_ADDRESSES
#endif
#if defined(SGM_TEST_WATCHES_ADDRESSES)
#include <sanitizer/asan_interface.h>
#endif

namespace {

constexpr int64_t kRemembered = 1024, kMaxKept = 512;

constexpr const char* kCavedRock =
    "sgm 1; units m; domain infinite solid;\nlayer l cell 32m reach 8m { start Ball; }\n"
    "rule Ball { at(8m, 8m, 8m) cut sphere(5m); }\n";

/// An allocator that counts allocations and can be made to fail, and a log that stores messages.
struct Watch {
  std::atomic<int64_t> blocks{0}, bytes{0};
  std::atomic<bool> lacking{false};
  std::mutex mutex;
  std::vector<std::string> lines;

  std::vector<std::string> takeLines() {
    const std::lock_guard lock(mutex);
    return std::exchange(lines, {});
  }

  RuntimeOwner makeRuntime(uint32_t threads = 1) {
    const sgm_allocator allocator{[](void* user, size_t size, size_t alignment) -> void* {
                                    auto& w = *static_cast<Watch*>(user);
                                    if (w.lacking) return nullptr;
                                    ++w.blocks;
                                    w.bytes += static_cast<int64_t>(size);
                                    return ::operator new (size, std::align_val_t{alignment});
                                  },
                                  [](void* user, void* memory, size_t size, size_t alignment) {
                                    auto& w = *static_cast<Watch*>(user);
                                    --w.blocks;
                                    w.bytes -= static_cast<int64_t>(size);
                                    ::operator delete (memory, std::align_val_t{alignment});
                                  },
                                  this};
    const sgm_log_sink sink{[](void* user, sgm_log_level level, const char* message) {
                              auto& w = *static_cast<Watch*>(user);
                              if (level == SGM_LOG_INFO) return;
                              const std::lock_guard lock(w.mutex);
                              w.lines.emplace_back(message);
                            },
                            this};
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.threads = threads;
    desc.allocator = &allocator;
    desc.log = &sink;
    return ::makeRuntime(&desc);
  }
};

sgm_parameters* makeParameters(const sgm_grammar* grammar) {
  sgm_parameters* parameters = nullptr;
  REQUIRE(sgm_parameters_create(grammar, &parameters, nullptr) == SGM_OK);
  return parameters;
}

sgm_world* makeSmallWorld(sgm_field* field) {
  sgm_world_desc desc = smallWorld();
  desc.collider_distance = 12;
  return makeWorld(field, desc).release();
}

sgm_surface* makeNoise(sgm_runtime* runtime, uint32_t size) {
  std::vector<float> values(size_t{size} * size * size);
  for (size_t i = 0; i < values.size(); ++i) values[i] = i % 2 == 0 ? -1.0f : 1.0f;
  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  grid.values = values.data();
  for (uint32_t& s : grid.size) s = size;
  sgm_surface* surface = nullptr;
  REQUIRE(sgm_surface_from_grid(runtime, &grid, &surface, nullptr) == SGM_OK);
  return surface;
}

uint64_t liveBytes(const RuntimeOwner& runtime) {
  uint64_t live = 0;
  REQUIRE(sgm_runtime_memory(runtime.get(), &live, nullptr) == SGM_OK);
  return live;
}

/// Destroys a handle, which must succeed, and then destroys it again, which must fail, also if no memory is available.
template <class Handle>
void endTwice(Watch& watch, const char* function, sgm_result (*end)(Handle*), Handle* handle) {
  CAPTURE(function);
  REQUIRE(handle != nullptr);
  watch.takeLines();
  CHECK(end(handle) == SGM_OK);
  CHECK(watch.takeLines().empty());
  const int64_t blocks = watch.blocks, bytes = watch.bytes;
  for (const bool lacking : {false, true, false}) {
    watch.lacking = lacking;
    const sgm_result again = end(handle);
    watch.lacking = false;
    CHECK(again == SGM_ERR_INVALID_ARGUMENT);
    const std::vector<std::string> lines = watch.takeLines();
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].rfind(std::string(function) + ": ", 0) == 0);
  }
  CHECK(watch.blocks == blocks);
  CHECK(watch.bytes == bytes);
}
#define END_TWICE(function, handle) endTwice(watch, #function, function, handle)

using ChunkId = std::tuple<int32_t, int32_t, int32_t, int32_t>;
ChunkId idOf(const sgm_chunk_key& key) { return {key.level, key.x, key.y, key.z}; }

/// An engine that holds the drawn meshes and colliders, releases them, and on request releases some a second time.
class CarelessEngine {
 public:
  CarelessEngine(bool careless, uint32_t seed) : careless_(careless), random_(seed) {}
  ~CarelessEngine() {
    for (const auto& [key, mesh] : meshes_) sgm_mesh_release(mesh);
    for (const auto& [key, collider] : colliders_) sgm_collider_release(collider);
  }

  void poll(sgm_world* world) {
    sgm_world_event event;
    for (size_t count = 1;; count = 1) {
      REQUIRE(sgm_world_poll(world, &event, 0, &count, nullptr) == SGM_OK);
      if (count == 0) return;
      REQUIRE(event.kind != SGM_EVENT_FAILED);
      take(meshes_, sgm_mesh_release, event.key, event.mesh, event.kind == SGM_EVENT_REMOVED);
      take(colliders_, sgm_collider_release, event.key, event.collider, event.kind == SGM_EVENT_COLLIDER_REMOVED);
    }
  }

  /// Returns the drawn bodies and seams and the collision triangles, by chunk, as the world's queries report them.
  std::map<ChunkId, std::tuple<uint64_t, uint32_t, uint32_t>> drawn(sgm_world* world) {
    size_t count = 0;
    REQUIRE(sgm_world_get_drawn(world, nullptr, 0, &count, nullptr) == SGM_OK);
    std::vector<sgm_drawn_chunk> chunks(count);
    REQUIRE(sgm_world_get_drawn(world, chunks.data(), 0, &count, nullptr) == SGM_OK);
    std::map<ChunkId, std::tuple<uint64_t, uint32_t, uint32_t>> all;
    for (const sgm_drawn_chunk& chunk : chunks) {
      sgm_mesh_view view = SGM_MESH_VIEW_INIT;
      REQUIRE(sgm_mesh_get_view(chunk.mesh, &view, nullptr) == SGM_OK);
      all[idOf(chunk.key)] = {view.body.hash, chunk.seams, 0};
      end(sgm_mesh_release, chunk.mesh);
    }
    for (const auto& [key, collider] : colliders_) {
      sgm_collider_view view = SGM_COLLIDER_VIEW_INIT;
      REQUIRE(sgm_collider_get_view(collider, &view, nullptr) == SGM_OK);
      std::get<2>(all[key]) = view.index_count;
    }
    return all;
  }

  size_t wrong() const { return wrong_; }

 private:
  template <class T>
  void take(std::map<ChunkId, T*>& all, sgm_result (*release)(T*), const sgm_chunk_key& key, T* made, bool removed) {
    if (made != nullptr) {
      std::swap(all[idOf(key)], made);
      if (made != nullptr) end(release, made);
    }
    if (!removed) return;
    end(release, all.at(idOf(key)));
    all.erase(idOf(key));
  }

  template <class T>
  void end(sgm_result (*release)(T*), T* handle) {
    CHECK(release(handle) == SGM_OK);
    if (!careless_) return;
    ended_.push_front([=] { return release(handle); });
    if (ended_.size() > kRemembered) ended_.pop_back();
    for (auto i = random_() % 3; i > 0; --i, ++wrong_)
      CHECK(ended_[random_() % ended_.size()]() == SGM_ERR_INVALID_ARGUMENT);
  }

  const bool careless_;
  std::mt19937 random_;
  std::map<ChunkId, sgm_mesh*> meshes_;
  std::map<ChunkId, sgm_collider*> colliders_;
  std::deque<std::function<sgm_result()>> ended_;  ///< calls that destroy an already destroyed handle once more; those
                                                   ///< for the handles destroyed last come first
  size_t wrong_ = 0;
};

}  // namespace

TEST_CASE("each kind of handle ended twice: a code, a line in the log, and no more") {
  Watch watch;
  {
    const RuntimeOwner runtime = watch.makeRuntime();
    sgm_grammar_desc text = SGM_GRAMMAR_DESC_INIT;
    text.text = kCavedRock;
    sgm_grammar* grammar = nullptr;
    sgm_diagnostics* diagnostics = nullptr;
    REQUIRE(sgm_grammar_compile(runtime.get(), &text, &grammar, &diagnostics, nullptr) == SGM_OK);
    sgm_parameters* parameters = makeParameters(grammar);
    sgm_field* field = makeField(runtime.get(), grammar, 512).release();
    sgm_mesh* mesh = meshChunks(field, {chunkAt({0, 0, 0, 0}, 63)})[0].release();
    sgm_region_desc desc = SGM_REGION_DESC_INIT;
    for (int32_t& v : desc.maximum) v = 1024;
    sgm_surface* region = nullptr;
    REQUIRE(sgm_surface_from_region(field, &desc, &region, nullptr) == SGM_OK);
    sgm_surface* grid = makeNoise(runtime.get(), 3);
    sgm_world* world = makeSmallWorld(field);
    const sgm_viewer viewer = SGM_VIEWER_INIT;
    REQUIRE(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr) == SGM_OK);

    // A created world keeps all objects alive that it needs for streaming, so the other handles can be destroyed now.
    END_TWICE(sgm_diagnostics_destroy, diagnostics);
    END_TWICE(sgm_parameters_destroy, parameters);
    END_TWICE(sgm_grammar_destroy, grammar);
    END_TWICE(sgm_surface_destroy, region);
    END_TWICE(sgm_surface_destroy, grid);
    END_TWICE(sgm_mesh_release, mesh);
    END_TWICE(sgm_field_destroy, field);
    CHECK(sgm_mesh_acquire(mesh) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(sgm_runtime_destroy(runtime.get()) == SGM_ERR_BUSY);

    REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK);
    int meshes = 0, colliders = 0;
    sgm_world_event event;
    for (size_t count = 1;; count = 1) {
      REQUIRE(sgm_world_poll(world, &event, 0, &count, nullptr) == SGM_OK);
      if (count == 0) break;
      if (event.mesh != nullptr && ++meshes > 0) END_TWICE(sgm_mesh_release, event.mesh);
      if (event.collider != nullptr && ++colliders > 0) END_TWICE(sgm_collider_release, event.collider);
    }
    CHECK(meshes > 20);
    CHECK(colliders > 0);
    END_TWICE(sgm_world_destroy, world);
    CHECK(sgm_field_destroy(field) == SGM_ERR_INVALID_ARGUMENT);
    CHECK(liveBytes(runtime) == 0);
  }
  CHECK(watch.blocks == 0);
  CHECK(watch.bytes == 0);
}

TEST_CASE("owners are counted, and a handle has ended once none is left, in any order of calls") {
  for (uint32_t seed = 1; seed <= sgm::rounds(5); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Watch watch;
    {
      const RuntimeOwner runtime = watch.makeRuntime();
      const GrammarOwner grammar = compile(runtime.get(), kBall);
      const FieldOwner field = makeField(runtime.get(), grammar.get());
      struct Known {
        sgm_mesh* mesh;
        sgm_parameters* parameters;
        int owners = 1;
        int64_t ended = 0;
      };
      std::vector<Known> known;
      int64_t ended = 0;
      const auto forgotten = [&](const Known& k) { return k.owners == 0 && ended - k.ended >= kRemembered; };
      const auto release = [&](Known& k) {
        CHECK((k.mesh != nullptr ? sgm_mesh_release(k.mesh) : sgm_parameters_destroy(k.parameters)) ==
              (k.owners > 0 ? SGM_OK : SGM_ERR_INVALID_ARGUMENT));
        CHECK(watch.takeLines().size() == (k.owners > 0 ? 0 : 1));
        if (k.owners > 0 && --k.owners == 0) k.ended = ++ended;
      };
      while (ended < 3 * kRemembered) {
        for (auto i = 1 + random() % 20; i > 0; --i) {
          if (random() % 2 == 0) {
            known.push_back({nullptr, makeParameters(grammar.get())});
          } else {  // the mesh of a chunk without a surface
            known.push_back({meshChunks(field.get(), {chunkAt({0, 99, 0, 0})})[0].release(), nullptr});
          }
        }
        for (auto i = random() % 40; i > 0; --i) {
          Known& k = known[random() % known.size()];
          if (forgotten(k)) continue;
          if (k.mesh == nullptr || random() % 3 > 0) {
            release(k);
          } else {
            CHECK(sgm_mesh_acquire(k.mesh) == (k.owners > 0 ? SGM_OK : SGM_ERR_INVALID_ARGUMENT));
            CHECK(watch.takeLines().size() == (k.owners > 0 ? 0 : 1));
            k.owners += k.owners > 0 ? 1 : 0;
          }
        }
        std::erase_if(known, forgotten);
        // The library recognises a limited number of destroyed handles. Also release a second time the oldest of those
        // that it still recognises.
        for (Known& k : known)
          if (k.owners == 0 && ended - k.ended == kRemembered - 1) release(k);
      }
      for (Known& k : known)
        while (k.owners > 0) release(k);
    }
    CHECK(watch.blocks == 0);
  }
}

TEST_CASE("of threads that end a handle at one time as many succeed as it has owners", "[threads]") {
  Watch watch;
  {
    const RuntimeOwner runtime = watch.makeRuntime(2);
    const GrammarOwner grammar = compile(runtime.get(), kBall);
    const FieldOwner field = makeField(runtime.get(), grammar.get());
    for (unsigned round = 0; round < sgm::rounds(200); ++round) {
      const unsigned owners = 1 + round % 4;
      CAPTURE(round, owners);
      sgm_mesh* mesh = meshChunks(field.get(), {chunkAt({0, 99, 0, 0})})[0].release();
      for (unsigned i = 1; i < owners; ++i) REQUIRE(sgm_mesh_acquire(mesh) == SGM_OK);
      sgm_parameters* parameters = makeParameters(grammar.get());
      sgm_surface* surface = makeNoise(runtime.get(), 2);
      constexpr unsigned kThreads = 3, kCalls = 2;
      std::atomic<unsigned> here{0}, meshes{0}, others{0}, wrong{0};
      std::vector<std::thread> threads;
      for (unsigned t = 0; t < kThreads; ++t)
        threads.emplace_back([&] {
          const auto count = [&](sgm_result result, std::atomic<unsigned>& done) {
            ++(result == SGM_OK ? done : wrong);
          };
          for (++here; here < kThreads;) {
          }
          for (unsigned i = 0; i < kCalls; ++i) {
            count(sgm_mesh_release(mesh), meshes);
            count(sgm_parameters_destroy(parameters), others);
            count(sgm_surface_destroy(surface), others);
          }
        });
      for (std::thread& thread : threads) thread.join();
      CHECK(meshes == owners);
      CHECK(others == 2);
      CHECK(meshes + others + wrong == 3 * kThreads * kCalls);
      CHECK(watch.takeLines().size() == wrong);
    }
  }
  CHECK(watch.blocks == 0);
}

TEST_CASE("handles that have ended keep little memory, and what they owned is freed at once") {
  Watch watch;
  {
    const RuntimeOwner runtime = watch.makeRuntime();
    const int64_t bytes = watch.bytes;
    for (int i = 0; i < 20; ++i) REQUIRE(sgm_surface_destroy(makeNoise(runtime.get(), 32)) == SGM_OK);
    CHECK(watch.bytes <= bytes + 20 * kMaxKept);
    CHECK(liveBytes(runtime) == 0);

    const GrammarOwner grammar = compile(runtime.get(), kBall);
    const uint64_t live = liveBytes(runtime);
    const int64_t blocks = watch.blocks - 20;
    for (int64_t i = 21; i <= 3 * kRemembered; ++i) {
      REQUIRE(sgm_parameters_destroy(makeParameters(grammar.get())) == SGM_OK);
      REQUIRE(watch.blocks == blocks + std::min(i, kRemembered));
      REQUIRE(liveBytes(runtime) == live);
    }
    CHECK(watch.bytes <= bytes + static_cast<int64_t>(live) + kRemembered * kMaxKept);
#if defined(SGM_TEST_WATCHES_ADDRESSES)
    sgm_parameters* parameters = makeParameters(grammar.get());
    CHECK(__asan_address_is_poisoned(parameters) == 0);
    sgm_parameters_destroy(parameters);
    CHECK(__asan_address_is_poisoned(parameters) != 0);
#endif
  }
  CHECK(watch.blocks == 0);
  CHECK(watch.bytes == 0);
}

TEST_CASE("an engine that gives meshes and colliders back too often sees the world that a careful one sees") {
  struct Run {
    Watch watch;
    RuntimeOwner runtime = watch.makeRuntime(2);
    FieldOwner field = makeField(runtime.get(), compile(runtime.get(), kCavedRock).get(), 512);
    WorldOwner world{makeSmallWorld(field.get())};
  };
  for (uint32_t seed = 1; seed <= sgm::rounds(1); ++seed) {
    CAPTURE(seed);
    Run careful, careless;
    CarelessEngine engine(false, seed), other(true, seed);
    for (const double x : {0.0, 20.0, 300.0}) {
      sgm_viewer viewer = SGM_VIEWER_INIT;
      viewer.position[0] = x;
      sgm_brush brush = SGM_BRUSH_INIT;
      brush.from[0] = static_cast<int32_t>(x) * SGM_UNITS_PER_METRE;
      brush.radius = 3000;
      std::map<ChunkId, std::tuple<uint64_t, uint32_t, uint32_t>> drawn[2];
      for (auto& [run, of, to] : {std::tuple(&careful, &engine, &drawn[0]), std::tuple(&careless, &other, &drawn[1])}) {
        sgm_world* world = run->world.get();
        REQUIRE(sgm_world_set_viewers(world, &viewer, 0, 1, nullptr) == SGM_OK);
        REQUIRE(sgm_world_edit(world, &brush, nullptr, nullptr) == SGM_OK);
        for (int frame = 0; frame < 5; ++frame) {
          REQUIRE(sgm_world_update(world, 1 << 20, nullptr) == SGM_OK);
          of->poll(world);
        }
        REQUIRE(sgm_world_wait_idle(world, nullptr, nullptr, nullptr) == SGM_OK);
        of->poll(world);
        *to = of->drawn(world);
      }
      CHECK(drawn[0].size() > 20);
      CHECK(drawn[0] == drawn[1]);
    }
    CHECK(careful.watch.takeLines().empty());
    CHECK(other.wrong() > 100);
    CHECK(careless.watch.takeLines().size() == other.wrong());
  }
}
