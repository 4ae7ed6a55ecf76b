// An engine that lends its Vulkan device through the C interface, and draws meshes from where they lie on it.

#include <sgm/sgm_vulkan.h>

#include <cstring>
#include <filesystem>
#include <mutex>
#include <random>

#include "backend/vulkan/commands.h"
#include "resident_worlds.h"
#include "rounds.h"
#include "vulkan/engine.h"
#include "vulkan/have_device.h"

extern "C" int sgm_vulkan_inits_c(void);
extern "C" int sgm_vulkan_inits_cpp(void);

/// To a leak checker: what the validation layer keeps in circles of its own. Of ours it has to say, at the device's
/// end, that everything was destroyed.
extern "C" const char* __lsan_default_suppressions(void);
extern "C" const char* __lsan_default_suppressions(void) { return "leak:libVkLayer_khronos_validation.so"; }

namespace {

namespace vk = sgm::vulkan;

/// The engine's side: a device, its queue behind a mutex, and a way to read what lies in its memory.
class Lender {
 public:
  Lender() {
    vk::BorrowedDevice own = engine_.lend();
    own.lock = [](void* user) { static_cast<Lender*>(user)->mutex_.lock(); };
    own.unlock = [](void* user) { static_cast<Lender*>(user)->mutex_.unlock(); };
    own.user = this;
    device_ = take(vk::Device::borrow(own));
    queue_ = take(vk::Queue::create(*device_));
    memory_ = std::make_unique<vk::Memory>(*device_);
    ring_ = take(vk::CommandRing::create(*queue_));
  }

  sgm_vulkan_device_desc lend() {
    const vk::BorrowedDevice own = engine_.lend();
    sgm_vulkan_device_desc desc = SGM_VULKAN_DEVICE_DESC_INIT;
    desc.api_version = VK_API_VERSION_1_2;
    desc.queue_family = own.family;
    desc.get_instance_proc_addr = own.get_instance_proc_addr;
    desc.instance = own.instance;
    desc.physical_device = own.physical;
    desc.device = own.device;
    desc.queue = own.queue;
    desc.reader_families = &family_;
    desc.reader_family_count = 1;
    desc.timeline_semaphores = 1;
    desc.lock_queue = [](void* user) { static_cast<Lender*>(user)->mutex_.lock(); };
    desc.unlock_queue = [](void* user) { static_cast<Lender*>(user)->mutex_.unlock(); };
    desc.user = this;
    return desc;
  }

  void await(VkSemaphore semaphore, uint64_t value) const {
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &semaphore;
    info.pValues = &value;
    REQUIRE(engine_.calls.vkWaitSemaphores(device_->handle(), &info, UINT64_MAX) == VK_SUCCESS);
  }

  /// By the device: bytes of a buffer of the runtime's.
  template <class T>
  std::vector<T> read(VkBuffer buffer, VkDeviceSize offset, size_t count) {
    std::vector<T> values(count);
    if (count == 0) return values;
    vk::BufferRange from;
    from.handle = buffer;
    from.offset = offset;
    from.size = count * sizeof(T);
    const vk::Buffer back = take(memory_->buffer(vk::MemoryKind::readback, from.size));
    vk::Commands commands = take(ring_->begin());
    commands.barrier(vk::kTransfer, vk::kTransfer);
    commands.copy(from, back);
    commands.barrier(vk::kTransfer, vk::kHost);
    const uint64_t value = take(ring_->submit(std::move(commands)));
    REQUIRE(take(queue_->wait(value)));
    REQUIRE(back.beforeRead());
    std::memcpy(values.data(), back.data(), from.size);
    return values;
  }

 private:
  template <class T>
  static T take(sgm::Result<T> result) {
    INFO((result ? std::string() : result.error().message));
    REQUIRE(result);
    return std::move(*result);
  }

  vk::Engine engine_;
  std::mutex mutex_;
  uint32_t family_ = 0;
  std::unique_ptr<vk::Device> device_;
  std::unique_ptr<vk::Queue> queue_;
  std::unique_ptr<vk::Memory> memory_;
  std::unique_ptr<vk::CommandRing> ring_;
};

sgm_vulkan_mesh_view placeOf(const MeshOwner& mesh) {
  sgm_vulkan_mesh_view place = SGM_VULKAN_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_mesh_get_vulkan_view(mesh.get(), &place, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return place;
}

void checkPart(Lender& lender, const sgm_mesh_view& view, const sgm_mesh_range& range, const sgm_vulkan_part& part) {
  REQUIRE((part.buffer != VK_NULL_HANDLE) == (range.index_count > 0));
  CHECK(part.vertex_count == range.vertex_count);
  CHECK(part.draw.indexCount == range.index_count);
  if (range.index_count == 0) return;
  CHECK(part.draw.instanceCount == 1);
  CHECK(part.draw.firstInstance == 0);
  CHECK(static_cast<uint64_t>(part.draw.vertexOffset) * sizeof(sgm_vertex) == part.vertex_offset);
  CHECK(uint64_t{part.draw.firstIndex} * sizeof(uint32_t) == part.index_offset);
  const auto command = lender.read<VkDrawIndexedIndirectCommand>(part.buffer, part.draw_offset, 1);
  CHECK(std::memcmp(command.data(), &part.draw, sizeof part.draw) == 0);
  const auto vertices = lender.read<sgm_vertex>(part.buffer, part.vertex_offset, part.vertex_count);
  CHECK(std::memcmp(vertices.data(), view.vertices + range.first_vertex, vertices.size() * sizeof(sgm_vertex)) == 0);
  auto indices = lender.read<uint32_t>(part.buffer, part.index_offset, part.draw.indexCount);
  for (uint32_t& index : indices) index += range.first_vertex;
  CHECK(std::equal(indices.begin(), indices.end(), view.indices + range.first_index));
}

/// What the device has is what the host has. Returns how many triangles there are.
size_t checkMesh(Lender& lender, const MeshOwner& mesh) {
  const sgm_mesh_view view = viewOf(mesh);
  if (view.index_count == 0) return 0;
  const sgm_vulkan_mesh_view place = placeOf(mesh);
  lender.await(place.semaphore, place.value);
  checkPart(lender, view, view.body, place.body);
  for (size_t face = 0; face < 6; ++face) checkPart(lender, view, view.seams[face], place.seams[face]);
  return view.index_count / 3;
}

RuntimeOwner lentRuntime(Lender& lender) {
  RuntimeOwner runtime = makeRuntime();
  const sgm_vulkan_device_desc desc = lender.lend();
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_runtime_lend_vulkan(runtime.get(), &desc, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return runtime;
}

}  // namespace

TEST_CASE("what the Vulkan header's macros set is the same in C and in C++", "[vulkan]") {
  CHECK(sgm_vulkan_inits_c() == 1);
  CHECK(sgm_vulkan_inits_cpp() == 1);
}

TEST_CASE("a mesh lies on the lent device with the bytes that the host sees, wherever the viewer goes", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const unsigned seed = std::random_device()();
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-40, 40);
  const char* text = GENERATE(kBalls, kLumps);
  const RuntimeOwner runtime = lentRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), text);
  const FieldOwner field = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_VULKAN);
  const WorldOwner world = makeWorld(field.get(), SGM_WORLD_RESIDENT);
  const RuntimeOwner other = makeRuntime();
  const GrammarOwner other_grammar = compile(other.get(), text);
  const FieldOwner other_field = makeField(other.get(), other_grammar.get(), 256, SGM_BACKEND_CPU);
  const WorldOwner on_cpu = makeWorld(other_field.get(), 0);
  std::vector<MeshOwner> kept;
  for (unsigned step = 0; step < sgm::rounds(3); ++step) {
    const double x = place(random), z = place(random);
    look(world.get(), x, z);
    look(on_cpu.get(), x, z);
    waitIdle(world.get());
    waitIdle(on_cpu.get());
    std::vector<MeshOwner> meshes = drawnOf(world.get());
    const std::vector<MeshOwner> expected = drawnOf(on_cpu.get());
    CHECK(meshes.size() == expected.size());
    size_t triangles = 0;
    for (const MeshOwner& mesh : meshes) triangles += checkMesh(lender, mesh);
    CHECK(triangles > 0);
    // What the engine holds is not overwritten by what comes after.
    for (const MeshOwner& mesh : kept) checkMesh(lender, mesh);
    kept = std::move(meshes);
  }
}

TEST_CASE("what comes from the disk lies on the lent device, too", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const auto folder = std::filesystem::temp_directory_path() / ("sgm_resident_" + std::to_string(getpid()));
  for (const bool again : {false, true}) {
    const RuntimeOwner runtime = lentRuntime(lender);
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

TEST_CASE("a dig and its undo lie on the lent device, as do seams that come later", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  const RuntimeOwner runtime = lentRuntime(lender);
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
  const RuntimeOwner runtime = lentRuntime(lender);
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

TEST_CASE("meshes keep to the bytes that they may have on the device, and the rest is not there", "[vulkan]") {
  if (!vk::haveDevice()) return;
  Lender lender;
  sgm_vulkan_device_desc desc = lender.lend();
  desc.mesh_bytes = 100000;
  const RuntimeOwner runtime = makeRuntime();
  REQUIRE(sgm_runtime_lend_vulkan(runtime.get(), &desc, nullptr) == SGM_OK);
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
    size_t there = 0, missing = 0;
    for (const MeshOwner& mesh : drawnOf(world.get())) {
      sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
      const sgm_result result = sgm_mesh_get_vulkan_view(mesh.get(), &view, nullptr);
      REQUIRE((result == SGM_OK || result == SGM_ERR_NOT_FOUND));
      ++(result == SGM_OK ? there : missing);
      if (result == SGM_OK) checkMesh(lender, mesh);
    }
    CHECK(there > 0);
    CHECK(missing > 0);
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
  // Software is not chosen by itself.
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
  const RuntimeOwner runtime = lentRuntime(lender);
  const GrammarOwner grammar = compile(runtime.get(), kBalls);
  const FieldOwner on_cpu = makeField(runtime.get(), grammar.get(), 256, SGM_BACKEND_CPU);
  sgm_world_desc desc = SGM_WORLD_DESC_INIT;
  desc.flags = SGM_WORLD_RESIDENT;
  sgm_world* refused = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  CHECK(sgm_world_create(on_cpu.get(), &desc, &refused, &error) == SGM_ERR_UNSUPPORTED);
  CHECK_THAT(error.message, Catch::Contains("sgm_runtime_lend_vulkan"));
  const WorldOwner world = makeWorld(on_cpu.get(), 0);
  look(world.get(), 0, 0);
  waitIdle(world.get());
  const std::vector<MeshOwner> meshes = drawnOf(world.get());
  REQUIRE(!meshes.empty());
  sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
  CHECK(sgm_mesh_get_vulkan_view(meshes[0].get(), &view, &error) == SGM_ERR_NOT_FOUND);
  CHECK_THAT(error.message, Catch::Contains("SGM_WORLD_RESIDENT"));
  CHECK(view.body.buffer == VK_NULL_HANDLE);
  CHECK(sgm_mesh_get_vulkan_view(nullptr, &view, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_mesh_get_vulkan_view(meshes[0].get(), nullptr, nullptr) == SGM_ERR_INVALID_ARGUMENT);
  view.struct_size = 1;
  CHECK(sgm_mesh_get_vulkan_view(meshes[0].get(), &view, nullptr) == SGM_ERR_STRUCT_SIZE);
}
