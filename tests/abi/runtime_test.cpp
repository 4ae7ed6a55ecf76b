#include <chrono>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>

#include "fixture.h"
#include "scarce_threads.h"

extern "C" int sgm_layout_inits_c(void);
extern "C" int sgm_layout_inits_cpp(void);

TEST_CASE("the init macros fill their structs in C and in C++") {
  CHECK(sgm_layout_inits_c() == 1);
  CHECK(sgm_layout_inits_cpp() == 1);
}

TEST_CASE("header and library are of one version") {
  CHECK(sgm_version() == SGM_API_VERSION);
  CHECK(std::string(sgm_version_string()) == std::to_string(SGM_VERSION_MAJOR) + "." +
                                                 std::to_string(SGM_VERSION_MINOR) + "." +
                                                 std::to_string(SGM_VERSION_PATCH));
  CHECK(std::string(sgm_build_info()).find(sgm_version_string()) != std::string::npos);
}

TEST_CASE("every result has a name of its own") {
  std::set<std::string> names;
  for (int code = SGM_ERR_DEVICE_LOST; code <= SGM_INCOMPLETE; ++code) {
    const std::string name = sgm_result_name(static_cast<sgm_result>(code));
    CHECK(name.rfind("SGM_", 0) == 0);
    CHECK(names.insert(name).second);
  }
  CHECK(std::string(sgm_result_name(static_cast<sgm_result>(12345))) == "unknown");
}

TEST_CASE("a header of another version is refused") {
  for (const uint32_t version : {SGM_API_VERSION + 1'000'000u, SGM_API_VERSION + 1'000u, 0u, 0xFFFFFFFFu}) {
    sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
    desc.api_version = version;
    sgm_runtime* runtime = nullptr;
    sgm_error error = SGM_ERROR_INIT;
    CHECK(sgm_runtime_create(&desc, &runtime, &error) == SGM_ERR_VERSION);
    CHECK(runtime == nullptr);
    CHECK(error.code == SGM_ERR_VERSION);
    CHECK(std::strlen(error.message) > 0);
  }
  sgm_runtime_desc patch = SGM_RUNTIME_DESC_INIT;
  patch.api_version = SGM_API_VERSION + 1;
  makeRuntime(&patch);
}

TEST_CASE("a runtime with children is busy") {
  std::vector<std::string> errors;
  const sgm_log_sink sink{[](void* user, sgm_log_level level, const char* message) {
                            if (level != SGM_LOG_ERROR) return;
                            static_cast<std::vector<std::string>*>(user)->emplace_back(message);
                          },
                          &errors};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &sink;
  RuntimeOwner runtime = makeRuntime(&desc);
  GrammarOwner grammar = compile(runtime.get(), kBall);
  CHECK(sgm_runtime_destroy(runtime.get()) == SGM_ERR_BUSY);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].find("not destroyed: 1") != std::string::npos);
  FieldOwner field = makeField(runtime.get(), grammar.get());
  grammar.reset();
  CHECK(sgm_runtime_destroy(runtime.get()) == SGM_ERR_BUSY);
  // The grammar's handle is destroyed, but the field keeps the grammar alive.
  std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 0)});
  CHECK(viewOf(meshes[0]).index_count > 0);
  field.reset();
  CHECK(sgm_runtime_destroy(runtime.get()) == SGM_ERR_BUSY);
  CHECK(viewOf(meshes[0]).index_count > 0);
}

TEST_CASE("memory comes from the allocator and goes back to it whole") {
  struct Counter {
    std::mutex mutex;
    size_t live = 0, calls = 0;
    bool aligned = true;
  } counter;
  const sgm_allocator allocator{[](void* user, size_t size, size_t alignment) -> void* {
                                  auto& c = *static_cast<Counter*>(user);
                                  const std::lock_guard lock(c.mutex);
                                  c.live += size;
                                  ++c.calls;
                                  c.aligned = c.aligned && size > 0 && (alignment & (alignment - 1)) == 0;
                                  return ::operator new (size, std::align_val_t{alignment}, std::nothrow);
                                },
                                [](void* user, void* memory, size_t size, size_t alignment) {
                                  auto& c = *static_cast<Counter*>(user);
                                  const std::lock_guard lock(c.mutex);
                                  c.live -= size;
                                  ::operator delete (memory, std::align_val_t{alignment});
                                },
                                &counter};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.allocator = &allocator;
  {
    RuntimeOwner runtime = makeRuntime(&desc);
    uint64_t before = 1;
    REQUIRE(sgm_runtime_memory(runtime.get(), &before, nullptr) == SGM_OK);
    CHECK(before == 0);
    {
      GrammarOwner grammar = compile(runtime.get(), kBall);
      FieldOwner field = makeField(runtime.get(), grammar.get());
      const std::vector<MeshOwner> meshes = meshChunks(field.get(), {chunkAt({0, 0, 0, 0}, 63)});
      uint64_t live = 0, peak = 0;
      REQUIRE(sgm_runtime_memory(runtime.get(), &live, &peak) == SGM_OK);
      CHECK(live > 0);
      CHECK(peak >= live);
      CHECK(counter.live >= live);
    }
    // A worker that joined the batch late may hold its memory a moment longer, so try several times.
    uint64_t after = 1;
    for (int tries = 0; after != 0 && tries < 60'000; ++tries) {
      REQUIRE(sgm_runtime_memory(runtime.get(), &after, nullptr) == SGM_OK);
      if (after != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(after == 0);
  }
  CHECK(counter.live == 0);
  CHECK(counter.calls > 10);
  CHECK(counter.aligned);
}

TEST_CASE("the memory limit holds") {
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.memory_limit = 1 << 20;
  RuntimeOwner runtime = makeRuntime(&desc);
  std::vector<float> values(64 * 64 * 64);
  for (size_t i = 0; i < values.size(); ++i) values[i] = i % 2 == 0 ? -1.0f : 1.0f;
  sgm_grid_desc grid = SGM_GRID_DESC_INIT;
  grid.values = values.data();
  for (uint32_t& size : grid.size) size = 64;
  sgm_surface* surface = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_surface_from_grid(runtime.get(), &grid, &surface, &error) == SGM_ERR_OUT_OF_MEMORY);
  CHECK(surface == nullptr);
  CHECK(error.code == SGM_ERR_OUT_OF_MEMORY);
  uint64_t live = 1, peak = 0;
  REQUIRE(sgm_runtime_memory(runtime.get(), &live, &peak) == SGM_OK);
  CHECK(live == 0);
  CHECK(peak <= desc.memory_limit);
}

TEST_CASE("messages go to the sink") {
  struct Log {
    std::mutex mutex;
    std::vector<std::string> lines;
  } log;
  const sgm_log_sink sink{[](void* user, sgm_log_level, const char* message) {
                            auto& l = *static_cast<Log*>(user);
                            const std::lock_guard lock(l.mutex);
                            l.lines.emplace_back(message);
                          },
                          &log};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &sink;
  makeRuntime(&desc);
  REQUIRE(!log.lines.empty());
  CHECK(log.lines[0] == sgm_build_info());
}

TEST_CASE("what a field leaves out is logged as a warning, once a place") {
  struct Log {
    std::mutex mutex;
    std::vector<std::string> warnings;
  } log;
  const sgm_log_sink sink{[](void* user, sgm_log_level level, const char* message) {
                            auto& l = *static_cast<Log*>(user);
                            const std::lock_guard lock(l.mutex);
                            if (level == SGM_LOG_WARNING) l.warnings.emplace_back(message);
                          },
                          &log};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &sink;
  RuntimeOwner runtime = makeRuntime(&desc);
  const GrammarOwner grammar = compile(runtime.get(),
                                       "sgm 1; units m;\n"
                                       "domain infinite;\n"
                                       "layer main cell 8m reach 6m { start Blob; }\n"
                                       "rule Blob { sphere(1m); scale(rand(-1, 1)) sphere(2m); }\n");
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  // Derives many cells, half of which give the same warning about omitted shapes.
  meshChunks(field.get(), {chunkAt({0, 0, 0, 0}), chunkAt({0, 1, 0, 0}), chunkAt({0, 5, 0, 0})});
  INFO((log.warnings.empty() ? "no warning" : log.warnings[0]));
  REQUIRE(log.warnings.size() == 1);
  CHECK(log.warnings[0].rfind("4:", 0) == 0);
  CHECK(log.warnings[0].find("a scale must be positive") != std::string::npos);
  CHECK(log.warnings[0].find(")/Blob)") != std::string::npos);
  CHECK(log.warnings[0].find("first in main(") != std::string::npos);
}

#if defined(SGM_SCARCE_THREADS)
TEST_CASE("threads that do not start are done without, and their absence is an error only when it is total") {
  struct Log {
    std::vector<std::string> warnings;
  } log;
  const sgm_log_sink sink{[](void* user, sgm_log_level level, const char* message) {
                            if (level == SGM_LOG_WARNING) static_cast<Log*>(user)->warnings.emplace_back(message);
                          },
                          &log};
  sgm_runtime_desc desc = SGM_RUNTIME_DESC_INIT;
  desc.log = &sink;
  desc.threads = 1024;
  sgm_runtime* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  {
    const FailingThreads none(0);
    CHECK(sgm_runtime_create(&desc, &made, &error) == SGM_ERR_LIMIT);
  }
  CHECK(made == nullptr);
  CHECK(error.code == SGM_ERR_LIMIT);
  CHECK(std::string(error.message).find("thread") != std::string::npos);
  {
    const FailingThreads few(3);
    REQUIRE(sgm_runtime_create(&desc, &made, &error) == SGM_OK);
  }
  const RuntimeOwner runtime(made);
  CHECK(log.warnings.size() == 1);
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  const FieldOwner field = makeField(runtime.get(), grammar.get());
  CHECK(viewOf(meshChunks(field.get(), {chunkAt({0, 0, 0, 0})})[0]).index_count > 0);
}
#endif

TEST_CASE("the CPU backend is usable and exact, and auto chooses one that is usable") {
  RuntimeOwner runtime = makeRuntime();
  sgm_backend_info cpu = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_CPU, &cpu, nullptr) == SGM_OK);
  CHECK(cpu.usable == 1);
  CHECK(cpu.exact == 1);
  CHECK(cpu.concurrency >= 1);
  CHECK(std::string(cpu.name) == "cpu");
  CHECK(std::strlen(cpu.device) > 0);
  CHECK(std::strlen(cpu.reason) == 0);
  CHECK(cpu.chunks + cpu.chunks_on_cpu + cpu.losses == 0);
  sgm_backend_info chosen = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_AUTO, &chosen, nullptr) == SGM_OK);
  CHECK(chosen.usable == 1);
  for (const sgm_backend backend : {SGM_BACKEND_VULKAN, SGM_BACKEND_CUDA}) {
    sgm_backend_info info = SGM_BACKEND_INFO_INIT;
    REQUIRE(sgm_backend_query(runtime.get(), backend, &info, nullptr) == SGM_OK);
    CHECK((info.usable == 1) == (std::strlen(info.reason) == 0));
  }
}
