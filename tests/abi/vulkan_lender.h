#pragma once
// A test engine that provides its Vulkan device to the library, and reads the meshes in the device's memory.

#include <sgm/sgm_vulkan.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "backend/vulkan/commands.h"
#include "resident_worlds.h"
#include "vulkan/engine.h"

namespace vk = sgm::vulkan;

/// The test engine: owns a device and a mutex for its queue, and can read the device's memory.
class Lender {
 public:
  /// external_memory: enables the extensions by which the device shares memory with another API.
  explicit Lender(bool external_memory = false)
      : engine_(vk::Validation::synchronization, external_memory), external_memory_(external_memory) {
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
    desc.external_memory = external_memory_ ? 1 : 0;
    desc.lock_queue = [](void* user) { static_cast<Lender*>(user)->mutex_.lock(); };
    desc.unlock_queue = [](void* user) { static_cast<Lender*>(user)->mutex_.unlock(); };
    desc.user = this;
    return desc;
  }

  const vk::DeviceInfo& info() const { return device_->info(); }

  void await(VkSemaphore semaphore, uint64_t value) const {
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &semaphore;
    info.pValues = &value;
    REQUIRE(engine_.calls.vkWaitSemaphores(device_->handle(), &info, UINT64_MAX) == VK_SUCCESS);
  }

  /// Reads data from a buffer of the runtime, by a copy on the device.
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
  const bool external_memory_;
  std::mutex mutex_;
  uint32_t family_ = 0;
  std::unique_ptr<vk::Device> device_;
  std::unique_ptr<vk::Queue> queue_;
  std::unique_ptr<vk::Memory> memory_;
  std::unique_ptr<vk::CommandRing> ring_;
};

inline sgm_vulkan_mesh_view placeOf(const MeshOwner& mesh) {
  sgm_vulkan_mesh_view place = SGM_VULKAN_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_mesh_get_vulkan_view(mesh.get(), &place, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return place;
}

inline void checkPart(Lender& lender, const sgm_mesh_view& view, const sgm_mesh_range& range,
                      const sgm_vulkan_part& part) {
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

/// Checks that a mesh has the same bytes on the device and on the host. Returns the number of triangles.
inline size_t checkMesh(Lender& lender, const MeshOwner& mesh) {
  const sgm_mesh_view view = viewOf(mesh);
  if (view.index_count == 0) return 0;
  const sgm_vulkan_mesh_view place = placeOf(mesh);
  lender.await(place.semaphore, place.value);
  checkPart(lender, view, view.body, place.body);
  for (size_t face = 0; face < 6; ++face) checkPart(lender, view, view.seams[face], place.seams[face]);
  return view.index_count / 3;
}

inline RuntimeOwner externalRuntime(Lender& lender, uint64_t mesh_bytes = 0) {
  RuntimeOwner runtime = makeRuntime();
  sgm_vulkan_device_desc desc = lender.lend();
  desc.mesh_bytes = mesh_bytes;
  sgm_error error = SGM_ERROR_INIT;
  const sgm_result result = sgm_runtime_lend_vulkan(runtime.get(), &desc, &error);
  INFO(error.message);
  REQUIRE(result == SGM_OK);
  return runtime;
}

/// Checks that some of the drawn meshes are in device memory, with the right bytes, and that others are not, because
/// that memory was full.
inline void checkPartlyThere(Lender& lender, sgm_world* world) {
  size_t there = 0, missing = 0;
  for (const MeshOwner& mesh : drawnOf(world)) {
    sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
    const sgm_result result = sgm_mesh_get_vulkan_view(mesh.get(), &view, nullptr);
    REQUIRE((result == SGM_OK || result == SGM_ERR_NOT_FOUND));
    ++(result == SGM_OK ? there : missing);
    if (result == SGM_OK) checkMesh(lender, mesh);
  }
  CHECK(there > 0);
  CHECK(missing > 0);
}
