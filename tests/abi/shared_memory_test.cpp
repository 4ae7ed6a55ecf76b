// Tests an engine whose Vulkan device draws the meshes that CUDA makes, through external memory. With LD_LIBRARY_PATH
// set, libcuda.so.1 is a simulated driver, whose GPU poses as the Vulkan device.

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include "cuda_lender.h"
#include "seed.h"
#include "vulkan/have_device.h"
#include "vulkan_lender.h"

/// Suppresses leak reports about the validation layer, which keeps objects in reference cycles. The layer itself
/// checks, when the device is destroyed, that our Vulkan objects were destroyed.
extern "C" const char* __lsan_default_suppressions(void);
extern "C" const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation.so"; }

namespace {

/// Lets the simulated CUDA GPU pose as the Vulkan device, and counts the memory that is imported.
class OneGpu {
 public:
  explicit OneGpu(const Lender& lender) : state_(pretendedGpu()), before_(state_.imports + state_.mapped) {
    state_.id = lender.info().id;
  }
  ~OneGpu() {
    state_.fail_call.clear();
    state_.fail_nth = 0;
    state_.lasts = false;
    // A lost context releases its imported memory itself, so the count is exact only if no context was lost.
    if (!state_.unsure) CHECK(state_.imports + state_.mapped == before_);
    state_.unsure = false;
  }
  OneGpu(const OneGpu&) = delete;
  OneGpu& operator=(const OneGpu&) = delete;
  sgm::cuda::FakeState& state() const { return state_; }
  int imports() const { return state_.imports; }

 private:
  sgm::cuda::FakeState& state_;
  const int before_;
};

/// Tries to create a field on a backend; returns the result.
sgm_result fieldOn(const RuntimeOwner& runtime, sgm_backend backend, sgm_error& error) {
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  sgm_field_desc desc = SGM_FIELD_DESC_INIT;
  desc.grammar = grammar.get();
  desc.cell_units = 256;
  desc.backend = backend;
  sgm_field* field = nullptr;
  const sgm_result result = sgm_field_create(runtime.get(), &desc, &field, &error);
  const FieldOwner owner(field);
  return result;
}

}  // namespace

TEST_CASE("what CUDA meshes lies on the Vulkan device that draws, wherever the viewer goes", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const sgm_backend backend = GENERATE(SGM_BACKEND_CUDA, SGM_BACKEND_AUTO);
  CAPTURE(backend);
  const RuntimeOwner runtime = externalRuntime(lender);
  {
    const GrammarOwner grammar = compile(runtime.get(), kLumps);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, backend);
    wanderBeside(field.get(), kLumps, [&](const MeshOwner& mesh) {
      CHECK(infoOf(runtime, backend).resident > 0);
      sgm_cuda_mesh_view view = SGM_CUDA_MESH_VIEW_INIT;
      const size_t triangles = checkMesh(lender, mesh);
      if (triangles > 0) CHECK(sgm_mesh_get_cuda_view(mesh.get(), &view, nullptr) == SGM_ERR_NOT_FOUND);
      return triangles;
    });
    const sgm_backend_info info = infoOf(runtime, backend);
    CHECK(info.backend == SGM_BACKEND_CUDA);
    CHECK(info.chunks > 0);
    CHECK(info.chunks_on_cpu == 0);
    CHECK(gpu.imports() > 0);
  }
  // Work that the device does for the last meshes may still be running, so wait for it.
  for (int tries = 0; infoOf(runtime, backend).resident != 0 && tries < 60'000; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(infoOf(runtime, backend).resident == 0);
}

TEST_CASE("so does what comes from the disk, and what was dug", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const auto folder = std::filesystem::temp_directory_path() / ("sgm_shared_" + std::to_string(getpid()));
  for (const bool again : {false, true}) {
    const RuntimeOwner runtime = externalRuntime(lender);
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT, folder.c_str());
    const auto checkAll = [&] {
      waitIdle(world.get());
      size_t triangles = 0;
      for (const MeshOwner& mesh : drawnOf(world.get())) triangles += checkMesh(lender, mesh);
      return triangles;
    };
    look(world.get(), 0, 0);
    const size_t before = checkAll();
    CHECK(before > 0);
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
    CHECK((stats.cache_hits > 0) == again);
    if (!again) CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks_on_cpu == 0);
    CHECK(gpu.imports() > 0);
    sgm_brush brush = SGM_BRUSH_INIT;
    for (int32_t& place : brush.from) place = 12 * SGM_UNITS_PER_METRE;
    brush.radius = 3 * SGM_UNITS_PER_METRE;
    sgm_edit_id id{};
    REQUIRE(sgm_world_edit(world.get(), &brush, &id, nullptr) == SGM_OK);
    CHECK(checkAll() != before);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("a lent CUDA context meshes for the Vulkan device, too; meshes outlive their world", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const CudaLender context(GENERATE(false, true));
  const RuntimeOwner runtime = externalRuntime(lender);
  const sgm_cuda_device_desc desc = context.lend();
  REQUIRE(sgm_runtime_lend_cuda(runtime.get(), &desc, nullptr) == SGM_OK);
  std::vector<MeshOwner> meshes;
  {
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
    look(world.get(), 0, 0);
    waitIdle(world.get());
    meshes = drawnOf(world.get());
    CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks > 0);
    CHECK(infoOf(runtime, SGM_BACKEND_CUDA).chunks_on_cpu == 0);
  }
  size_t triangles = 0;
  for (const MeshOwner& mesh : meshes) triangles += checkMesh(lender, mesh);
  CHECK(triangles > 0);
}

TEST_CASE("what CUDA meshes keeps to the bytes that it may have on the Vulkan device", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const RuntimeOwner runtime = externalRuntime(lender, 100000);
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
  const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
  look(world.get(), 0, 0);
  waitIdle(world.get());
  checkPartlyThere(lender, world.get());
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).resident <= 100000);
}

TEST_CASE("an engine without a lock has both backends on its queue at once", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const RuntimeOwner runtime = makeRuntime();
  sgm_vulkan_device_desc desc = lender.lend();
  desc.lock_queue = desc.unlock_queue = nullptr;
  REQUIRE(sgm_runtime_lend_vulkan(runtime.get(), &desc, nullptr) == SGM_OK);
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  std::vector<FieldOwner> fields;
  std::vector<WorldOwner> worlds;
  for (const sgm_backend backend : {SGM_BACKEND_CUDA, SGM_BACKEND_VULKAN}) {
    fields.push_back(makeField(runtime.get(), grammar.get(), 256, backend));
    worlds.push_back(makeWorld(fields.back().get(), SGM_WORLD_RESIDENT));
  }
  for (const double x : {0.0, 60.0, 120.0}) {
    for (const WorldOwner& world : worlds) look(world.get(), x, 0);
    for (const WorldOwner& world : worlds) REQUIRE(sgm_world_update(world.get(), 1 << 20, nullptr) == SGM_OK);
    for (const WorldOwner& world : worlds) waitIdle(world.get());
    // At this point no world submits work to the engine's queue. So the engine may use the queue itself, which it does
    // only here.
    for (const WorldOwner& world : worlds) {
      size_t triangles = 0;
      for (const MeshOwner& mesh : drawnOf(world.get())) triangles += checkMesh(lender, mesh);
      CHECK(triangles > 0);
    }
  }
}

TEST_CASE("where CUDA is lost, or must be opened again, all meshes are right where they are", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  const unsigned seed = sgm::testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-40, 40);
  const RuntimeOwner runtime = externalRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), kLumps);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
  const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
  std::vector<MeshOwner> kept;
  // Makes each of these driver calls fail once, in a runtime that has not meshed anything yet.
  double x = 0;
  for (const char* call : {"launchKernel", "memcpyDtoDAsync", "eventSynchronize", "importExternalMemory"}) {
    CAPTURE(call);
    // importExternalMemory is called again only after a loss of the device. So to make it fail, first let another call
    // fail, which loses the device.
    const bool opening = std::strcmp(call, "importExternalMemory") == 0;
    gpu.state().fail_call = opening ? "launchKernel" : call;
    gpu.state().fail_nth = 1 + static_cast<unsigned>(random() % 3);
    gpu.state().fail_result = 700;
    look(world.get(), x += 200, place(random));
    waitIdle(world.get());
    gpu.state().fail_call = opening ? call : "";
    gpu.state().fail_nth = opening ? 1 : 0;
    look(world.get(), x += 200, place(random));
    waitIdle(world.get());
    std::vector<MeshOwner> meshes = drawnOf(world.get());
    size_t there = 0;
    for (const MeshOwner& mesh : meshes) {
      sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
      const sgm_result result = sgm_mesh_get_vulkan_view(mesh.get(), &view, nullptr);
      REQUIRE((result == SGM_OK || result == SGM_ERR_NOT_FOUND));
      if (result == SGM_OK) there += checkMesh(lender, mesh);
    }
    CHECK(there > 0);
    for (const MeshOwner& mesh : kept) checkMesh(lender, mesh);
    std::erase_if(meshes, [](const MeshOwner& mesh) {
      sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
      return sgm_mesh_get_vulkan_view(mesh.get(), &view, nullptr) != SGM_OK;
    });
    kept = std::move(meshes);
  }
  CHECK(infoOf(runtime, SGM_BACKEND_CUDA).losses >= 3);
}

TEST_CASE("where CUDA cannot share memory with the device that draws it says so", "[shared]") {
  if (!vk::haveDevice()) return;
  Lender lender(true);
  const OneGpu gpu(lender);
  sgm_error error = SGM_ERROR_INIT;
  SECTION("another GPU") {
    gpu.state().id[0] ^= 1;
    const RuntimeOwner runtime = externalRuntime(lender);
    CHECK(fieldOn(runtime, SGM_BACKEND_CUDA, error) == SGM_ERR_UNSUPPORTED);
    CHECK_THAT(error.message, Catch::Contains("the drawing GPU"));
    CHECK(infoOf(runtime, SGM_BACKEND_AUTO).backend != SGM_BACKEND_CUDA);
    const CudaLender context;
    const sgm_cuda_device_desc desc = context.lend();
    CHECK(sgm_runtime_lend_cuda(runtime.get(), &desc, &error) == SGM_ERR_UNSUPPORTED);
    CHECK_THAT(error.message, Catch::Contains("the drawing GPU"));
  }
  SECTION("a driver that imports nothing") {
    gpu.state().fail_call = GENERATE("importExternalMemory", "externalMemoryGetMappedBuffer");
    gpu.state().fail_nth = 1;
    gpu.state().fail_result = 801;
    const RuntimeOwner runtime = externalRuntime(lender);
    CHECK(fieldOn(runtime, SGM_BACKEND_CUDA, error) == SGM_ERR_UNSUPPORTED);
    CHECK_THAT(error.message, Catch::Contains("importing the drawing device's memory"));
    CHECK(fieldOn(runtime, SGM_BACKEND_CUDA, error) == SGM_OK);
  }
  SECTION("a Vulkan device without the extension") {
    Lender without;
    sgm_vulkan_device_desc desc = without.lend();
    desc.external_memory = 1;
    const RuntimeOwner runtime = makeRuntime();
    CHECK(sgm_runtime_lend_vulkan(runtime.get(), &desc, &error) == SGM_ERR_UNSUPPORTED);
    CHECK_THAT(error.message, Catch::Contains("VK_KHR_external_memory_fd"));
  }
  SECTION("lent when CUDA meshes already") {
    const RuntimeOwner runtime = makeRuntime();
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CUDA);
    const sgm_vulkan_device_desc desc = lender.lend();
    CHECK(sgm_runtime_lend_vulkan(runtime.get(), &desc, &error) == SGM_ERR_BUSY);
    CHECK_THAT(error.message, Catch::Contains("lend the Vulkan device first"));
  }
}
