#include "sgm/sgm_vulkan.h"

#include <algorithm>
#include <span>

#include "api/backend_request.h"
#include "api/barrier.h"
#include "api/mesh.h"
#include "api/runtime.h"
#include "backend/vulkan/device_meshes.h"

using namespace sgm::api;

namespace {

sgm::vulkan::BorrowedDevice deviceOf(const sgm_vulkan_device_desc& desc) {
  sgm::vulkan::BorrowedDevice external;
  external.get_instance_proc_addr = desc.get_instance_proc_addr;
  external.instance = desc.instance;
  external.physical = desc.physical_device;
  external.device = desc.device;
  external.queue = desc.queue;
  external.family = desc.queue_family;
  const std::span readers(desc.reader_families, desc.reader_family_count);
  external.readers.assign(readers.begin(), readers.end());
  external.lock = desc.lock_queue;
  external.unlock = desc.unlock_queue;
  external.user = desc.user;
  external.api_version = desc.api_version;
  external.timeline_semaphores = desc.timeline_semaphores != 0;
  external.memory_budget = desc.memory_budget != 0;
  external.external_memory = desc.external_memory != 0;
  if (desc.mesh_bytes != 0) external.resident_cap = desc.mesh_bytes;
  return external;
}

sgm_vulkan_part partOf(const sgm::vulkan::VulkanPart& part) {
  return {part.buffer(), part.vertexOffset(), part.indexOffset(), part.drawOffset(), part.vertexCount(), part.draw()};
}

}  // namespace

sgm_result sgm_runtime_lend_vulkan(sgm_runtime* runtime, const sgm_vulkan_device_desc* desc, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (desc->reader_families == nullptr && desc->reader_family_count != 0) {
      return nullArgument(error, "desc.reader_families");
    }
    const sgm::Result<void> external = lendVulkan(
        *runtime, std::make_shared<const sgm::vulkan::BorrowedDevice>(deviceOf(*desc)), desc->external_memory != 0);
    return external ? SGM_OK : fail(error, external.error());
  });
}

sgm_result sgm_mesh_get_vulkan_view(const sgm_mesh* mesh, sgm_vulkan_mesh_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    sgm_vulkan_mesh_view found = SGM_VULKAN_MESH_VIEW_INIT;
    const sgm::ChunkSurface& surface = *mesh->surface;
    for (size_t p = 0; p < surface.on_device.size(); ++p) {
      if (surface.mesh.ranges[p].index_count == 0) continue;
      const sgm::DevicePart* part = surface.on_device[p].get();
      if (part == nullptr || part->kind() != sgm::BackendKind::vulkan) {
        return fail(
            error, SGM_ERR_NOT_FOUND,
            "the mesh is not on the external Vulkan device: the world is not SGM_WORLD_RESIDENT, or the "
            "device's memory (sgm_vulkan_device_desc.mesh_bytes) is used up; upload the data of sgm_mesh_get_view");
      }
      const auto& placed = static_cast<const sgm::vulkan::VulkanPart&>(*part);
      const sgm::vulkan::Queue& queue = placed.memory().meshes().queue();
      if (queue.lost()) return fail(error, SGM_ERR_DEVICE_LOST, "the Vulkan device was lost, and the mesh with it");
      if (!placed.there()) {
        return fail(error, SGM_ERR_NOT_FOUND,
                    "the mesh could not be copied to the external Vulkan device: upload the data of sgm_mesh_get_view");
      }
      found.semaphore = queue.semaphore();
      found.value = std::max(found.value, placed.memory().value());
      (p == 0 ? found.body : found.seams[p - 1]) = partOf(placed);
    }
    *view = found;
    return SGM_OK;
  });
}
