/* clang-format off */
/*
 * sgm_vulkan.h: an engine's own Vulkan device as an external device of the runtime, and meshes that stay on it.
 *
 * Only libraries that were built with SGM_VULKAN have these functions. This header needs Vulkan's own header; the
 * library calls Vulkan only through the given vkGetInstanceProcAddr. The conventions of sgm.h hold here too.
 *
 * Order of calls
 *   sgm_runtime_lend_vulkan   before the runtime's first field
 *   sgm_field_create          with SGM_BACKEND_VULKAN, or AUTO if the device is hardware
 *   sgm_world_create          with SGM_WORLD_RESIDENT
 *   sgm_mesh_get_vulkan_view  for every mesh that is READY; draw it from there, upload nothing
 */
/* clang-format on */
#ifndef SGM_SGM_VULKAN_H
#define SGM_SGM_VULKAN_H

#include <sgm/sgm.h>
#include <vulkan/vulkan_core.h>

#if defined(__cplusplus)
extern "C" {
#endif

/* The engine's Vulkan device. It must be created for Vulkan 1.2 or newer (VkApplicationInfo.apiVersion), with the
 * feature timelineSemaphore and a compute queue. All handles must outlive the runtime.
 * The runtime submits to the queue from any thread. It waits for its own work by a timeline semaphore, never for the
 * whole queue or device. A batch has up to 64 chunks, and other work on the queue waits until it is finished: if the
 * device has a second queue, preferably one for compute only, lend that one. */
typedef struct sgm_vulkan_device_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;  /* VkApplicationInfo.apiVersion of the instance */
  uint32_t queue_family; /* index of the family of `queue` */
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  VkQueue queue;
  /* All queue families other than queue_family whose queues read meshes. Buffers are shared with these families
   * (VK_SHARING_MODE_CONCURRENT), so no ownership transfers are needed. NULL if the count is 0. Copied. */
  const uint32_t* reader_families;
  uint32_t reader_family_count;
  int32_t timeline_semaphores; /* 1: VkPhysicalDeviceVulkan12Features.timelineSemaphore is enabled. Required, and not
                                  verified */
  int32_t memory_budget;   /* 1: VK_EXT_memory_budget is enabled, so that the runtime keeps to the remaining memory */
  int32_t external_memory; /* 1: VK_KHR_external_memory_fd is enabled, so that CUDA may mesh for this device (below) */
  /* For engines that use the queue themselves: the runtime calls these functions before and after every use of the
   * queue, on the thread that uses it. Either both are given or neither. They may wait, and must not call the runtime.
   * Any function of the runtime may use the queue, so do not call the runtime while holding the lock. */
  void (*lock_queue)(void* user);
  void (*unlock_queue)(void* user);
  void* user;
  uint64_t mesh_bytes; /* maximum number of bytes of the device's memory for resident meshes, allocated in blocks; a
                          mesh that does not fit is not on the device (SGM_ERR_NOT_FOUND). 0: as many as the driver
                          gives */
} sgm_vulkan_device_desc;

#define SGM_VULKAN_DEVICE_DESC_INIT                                                                                    \
  {                                                                                                                    \
    SGM_SIZEOF(sgm_vulkan_device_desc), SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, 0, \
        0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0                                                                       \
  }

/* Makes the runtime's Vulkan backend use this device. A software device is used only for SGM_BACKEND_VULKAN, not for
 * SGM_BACKEND_AUTO.
 * Meshing with CUDA, drawing with Vulkan: a device lent with external_memory shares memory with CUDA. Meshes that the
 * runtime's CUDA backend keeps on the GPU (SGM_WORLD_RESIDENT) are then in buffers of this device, and
 * sgm_mesh_get_vulkan_view returns them. Lend the device before the runtime's first CUDA field is created, and before
 * sgm_runtime_lend_cuda. A field with SGM_BACKEND_CUDA is then refused (SGM_ERR_UNSUPPORTED) if CUDA does not run on
 * the same GPU or cannot import its memory; SGM_BACKEND_AUTO uses CUDA if that is possible, and otherwise this device.
 * mesh_bytes limits the meshes of each of the two backends separately. If this device is lost, CUDA continues to mesh,
 * but meshes are no longer on a device.
 * SGM_ERR_INVALID_ARGUMENT: a handle is missing, only one lock function is given, or the queue family does not exist.
 * SGM_ERR_UNSUPPORTED: the device lacks a feature, which the message names. SGM_ERR_BUSY: the runtime already has an
 * external device, or a field that uses a Vulkan device opened by the runtime, or (with external_memory) a CUDA device.
 * On failure nothing changes.
 * If an external device is lost, it stays lost: from then on the CPU meshes, with the same bytes, and meshes are not on
 * a device. To lend a replacement, destroy the runtime and create another. */
SGM_API sgm_result sgm_runtime_lend_vulkan(sgm_runtime* runtime, const sgm_vulkan_device_desc* desc, sgm_error* error);

/* The body or a seam of a mesh. It lies in a VkBuffer of the runtime together with other parts; the buffer's usage has
 * VERTEX, INDEX, INDIRECT, STORAGE and TRANSFER_SRC. Vertices are sgm_vertex; indices are uint32_t, counted from the
 * part's first vertex. To bind the part as a storage buffer, round the offset down to a multiple of
 * minStorageBufferOffsetAlignment, and observe maxStorageBufferRange, because the buffer is larger. Morph offsets
 * (SGM_WORLD_MORPH) are not on the device: upload sgm_mesh_view.morphs. */
typedef struct sgm_vulkan_part {
  VkBuffer buffer;            /* VK_NULL_HANDLE: no triangles; all other members are 0 then */
  VkDeviceSize vertex_offset; /* bytes in buffer; a multiple of sizeof(sgm_vertex) */
  VkDeviceSize index_offset;  /* bytes; a multiple of 4 */
  VkDeviceSize draw_offset;   /* bytes; a multiple of 4. A copy of `draw` lies there, for vkCmdDrawIndexedIndirect */
  uint32_t vertex_count;
  /* A draw command for one instance, for the buffer bound at offset 0 both as vertex buffer and as index buffer
   * (VK_INDEX_TYPE_UINT32). So an engine can gather the commands of all parts of a buffer, and draw them by one
   * vkCmdDrawIndexedIndirect. firstInstance is 0; an engine replaces it by the index of its own record of the chunk's
   * place (origin and cell_units of sgm_mesh_get_view). */
  VkDrawIndexedIndirectCommand draw;
} sgm_vulkan_part;

/* Filled by sgm_mesh_get_vulkan_view. */
typedef struct sgm_vulkan_mesh_view {
  uint32_t struct_size;
  void* next;
  /* The parts are ready when this timeline semaphore reaches `value`. This is usually the case before the mesh is
   * READY, so that waiting takes no time; meshes of CUDA are ready as soon as the external queue executes the runtime's
   * submission. The wait also makes the parts visible: the engine's submission must wait for the value, on the device,
   * at the stages that read the parts (VERTEX_INPUT; DRAW_INDIRECT for the data at draw_offset; or the stages of its
   * own shaders and copies). The signal was submitted before, so a wait on the external queue itself does not deadlock.
   * The semaphore is the same for all meshes of one backend of the runtime, and lives as long as any of them; for
   * several meshes, wait for the largest value. VK_NULL_HANDLE and 0: there are no triangles, and nothing to wait
   * for. */
  VkSemaphore semaphore;
  uint64_t value;
  sgm_vulkan_part body;
  sgm_vulkan_part seams[6]; /* by sgm_face; draw those named by the chunk's events */
} sgm_vulkan_mesh_view;

#define SGM_VULKAN_PART_INIT                      \
  {                                               \
    VK_NULL_HANDLE, 0, 0, 0, 0, { 0, 0, 0, 0, 0 } \
  }
#define SGM_VULKAN_MESH_VIEW_INIT                                                                                   \
  {                                                                                                                 \
    SGM_SIZEOF(sgm_vulkan_mesh_view), SGM_NULL, VK_NULL_HANDLE, 0, SGM_VULKAN_PART_INIT, {                          \
      SGM_VULKAN_PART_INIT, SGM_VULKAN_PART_INIT, SGM_VULKAN_PART_INIT, SGM_VULKAN_PART_INIT, SGM_VULKAN_PART_INIT, \
          SGM_VULKAN_PART_INIT                                                                                      \
    }                                                                                                               \
  }

/* Returns the location of a mesh on the external device; its data is the same as in sgm_mesh_get_view. Valid until the
 * mesh is destroyed: release the mesh only when the device has finished using it. Meshes of one chunk may share parts.
 * SGM_ERR_NOT_FOUND: the mesh is not, or not completely, on the device: the world is not SGM_WORLD_RESIDENT, the device
 * had no memory left, or it was lost before. In this case, upload the data of sgm_mesh_get_view. SGM_ERR_DEVICE_LOST:
 * the device was lost afterwards. */
SGM_API sgm_result sgm_mesh_get_vulkan_view(const sgm_mesh* mesh, sgm_vulkan_mesh_view* view, sgm_error* error);

#if defined(__cplusplus)
}
#endif

#endif
