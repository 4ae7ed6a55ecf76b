// Tests an engine that provides its Vulkan device through the C interface, and reads the meshes in its memory.

#include <cstring>
#include <filesystem>

#include "vulkan/have_device.h"
#include "vulkan_lender.h"

extern "C" int sgm_vulkan_inits_c(void);
extern "C" int sgm_vulkan_inits_cpp(void);

/// Suppresses leak reports about the validation layer, which keeps objects in reference cycles. The layer itself
/// checks, when the device is destroyed, that our Vulkan objects were destroyed.
extern "C" const char* __lsan_default_suppressions(void);
extern "C" const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation.so"; }

TEST_CASE("what the Vulkan header's macros set is the same in C and in C++", "[vulkan]") {
  CHECK(sgm_vulkan_inits_c() == 1);
  CHECK(sgm_vulkan_inits_cpp() == 1);
}

TEST_CASE("a mesh lies on the lent device with the bytes that the host sees, wherever the viewer goes",
          "[vulkan][costly]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const char* text = GENERATE(kBalls, kLumps);
  const RuntimeOwner runtime = externalRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), text);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
  wanderBeside(field.get(), text, [&](const MeshOwner& mesh) { return checkMesh(lender, mesh); });
}

TEST_CASE("what comes from the disk lies on the lent device, too", "[vulkan][costly]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const auto folder = std::filesystem::temp_directory_path() / ("sgm_resident_" + std::to_string(getpid()));
  for (const bool again : {false, true}) {
    const RuntimeOwner runtime = externalRuntime(lender);
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT, folder.c_str());
    look(world.get(), 0, 0);
    waitIdle(world.get());
    sgm_world_stats stats = SGM_WORLD_STATS_INIT;
    REQUIRE(sgm_world_get_stats(world.get(), &stats, nullptr) == SGM_OK);
    CHECK((stats.cache_hits > 0) == again);
    size_t triangles = 0;
    for (const MeshOwner& mesh : drawnOf(world.get())) triangles += checkMesh(lender, mesh);
    CHECK(triangles > 0);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("a dig and its undo lie on the lent device, as do seams that come later", "[vulkan][costly]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = externalRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
  const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
  const auto checkAll = [&] {
    waitIdle(world.get());
    std::vector<uint64_t> hashes;
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      checkMesh(lender, mesh);
      hashes.push_back(viewOf(mesh).hash);
    }
    return hashes;
  };
  look(world.get(), 0, 0);
  const std::vector<uint64_t> before = checkAll();
  sgm_brush brush = SGM_BRUSH_INIT;
  for (int32_t& place : brush.from) place = 12 * SGM_UNITS_PER_METRE;
  brush.radius = 3 * SGM_UNITS_PER_METRE;
  sgm_edit_id id{};
  REQUIRE(sgm_world_edit(world.get(), &brush, &id, nullptr) == SGM_OK);
  CHECK(checkAll() != before);
  REQUIRE(sgm_world_undo(world.get(), &id, nullptr, nullptr) == SGM_OK);
  CHECK(checkAll() == before);
  for (const double x : {8.0, 24.0, 0.0}) {
    look(world.get(), x, 0);
    checkAll();
  }
}

TEST_CASE("meshes outlive the world that they were streamed in", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = externalRuntime(lender);
  std::vector<MeshOwner> meshes;
  {
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
    look(world.get(), 0, 0);
    waitIdle(world.get());
    meshes = drawnOf(world.get());
  }
  size_t triangles = 0;
  for (const MeshOwner& mesh : meshes) triangles += checkMesh(lender, mesh);
  CHECK(triangles > 0);
}

TEST_CASE("meshes keep to the bytes that they may have on the device, and the rest is not there", "[vulkan][costly]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = externalRuntime(lender, 100000);
  const auto residentNow = [&] {
    sgm_backend_info info = SGM_BACKEND_INFO_INIT;
    REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_VULKAN, &info, nullptr) == SGM_OK);
    return info.resident;
  };
  {
    const GrammarOwner grammar = compile(runtime.get(), kBalls);
    const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
    const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
    look(world.get(), 0, 0);
    waitIdle(world.get());
    checkPartlyThere(lender, world.get());
    CHECK(residentNow() > 0);
    CHECK(residentNow() <= 100000);
  }
  CHECK(residentNow() == 0);
}

TEST_CASE("a device that cannot be lent is refused, for a reason, and changes nothing", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = makeRuntime();
  const sgm_vulkan_device_desc good = lender.lend();
  sgm_error error = SGM_ERROR_INIT;
  const auto refused = [&](sgm_result result, const char* word, const auto& change) {
    sgm_vulkan_device_desc desc = good;
    change(desc);
    CHECK(sgm_runtime_lend_vulkan(runtime.get(), &desc, &error) == result);
    CHECK_THAT(error.message, Catch::Contains(word));
  };
  CHECK(sgm_runtime_lend_vulkan(nullptr, &good, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_runtime_lend_vulkan(runtime.get(), nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  refused(SGM_ERR_STRUCT_SIZE, "struct_size", [](auto& d) { d.struct_size = 8; });
  refused(SGM_ERR_UNSUPPORTED, "next", [](auto& d) { d.next = &d; });
  refused(SGM_ERR_INVALID_ARGUMENT, "vkGetInstanceProcAddr", [](auto& d) { d.get_instance_proc_addr = nullptr; });
  refused(SGM_ERR_INVALID_ARGUMENT, "queue", [](auto& d) { d.queue = nullptr; });
  refused(SGM_ERR_INVALID_ARGUMENT, "lock", [](auto& d) { d.lock_queue = nullptr; });
  refused(SGM_ERR_INVALID_ARGUMENT, "queue family 77", [](auto& d) { d.queue_family = 77; });
  refused(SGM_ERR_INVALID_ARGUMENT, "reader_families", [](auto& d) { d.reader_families = nullptr; });
  const uint32_t none = 88;
  refused(SGM_ERR_INVALID_ARGUMENT, "queue family 88", [&](auto& d) { d.reader_families = &none; });
  refused(SGM_ERR_UNSUPPORTED, "Vulkan 1.2", [](auto& d) { d.api_version = VK_API_VERSION_1_1; });
  refused(SGM_ERR_UNSUPPORTED, "timelineSemaphore", [](auto& d) { d.timeline_semaphores = 0; });
  REQUIRE(sgm_runtime_lend_vulkan(runtime.get(), &good, nullptr) == SGM_OK);
  refused(SGM_ERR_BUSY, "already", [](auto&) {});
  // SGM_BACKEND_AUTO does not select a software device.
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_VULKAN, &info, nullptr) == SGM_OK);
  CHECK(info.usable == 1);
  const bool software = std::strstr(info.device, "llvmpipe") != nullptr;
  REQUIRE(sgm_backend_query(runtime.get(), SGM_BACKEND_AUTO, &info, nullptr) == SGM_OK);
  CHECK((info.backend == SGM_BACKEND_VULKAN) == !software);
}

TEST_CASE("what is not on a lent device says so", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = externalRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner on_cpu = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CPU);
  checkNothingBorrowed(on_cpu.get(), "sgm_runtime_lend_vulkan", sgm_vulkan_mesh_view SGM_VULKAN_MESH_VIEW_INIT,
                       sgm_mesh_get_vulkan_view,
                       [](const sgm_vulkan_mesh_view& view) { return view.body.buffer == VK_NULL_HANDLE; });
}
