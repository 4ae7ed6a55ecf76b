/* clang-format off */
/*
 * sgm_vulkan.h: an engine's own Vulkan device as an external device of the runtime, and meshes that stay on it.
 *
 * In libraries that were built with SGM_VULKAN. Needs Vulkan's own header, and calls Vulkan only through the given
 * vkGetInstanceProcAddr. The conventions of sgm.h hold here too.
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

/* The engine's device, created for Vulkan 1.2 or newer (VkApplicationInfo.apiVersion), with the feature
 * timelineSemaphore and a compute queue. All handles must outlive the runtime.
 *
 * The runtime submits to the queue from any thread, and waits for its own work by a timeline semaphore: never for the
 * queue or the device. A batch has up to 64 chunks, and other work on the queue waits behind it: if the device has a
 * second queue, preferably one that only computes, lend that one. */
typedef struct sgm_vulkan_device_desc {
  uint32_t struct_size;
  const void* next;
  uint32_t api_version;  /* VkApplicationInfo.apiVersion of the instance */
  uint32_t queue_family; /* of `queue` */
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  VkQueue queue;
  /* All families other than queue_family whose queues use meshes: buffers are shared with these
   * (VK_SHARING_MODE_CONCURRENT), and no ownership is transferred. NULL if the count is 0. Copied. */
  const uint32_t* reader_families;
  uint32_t reader_family_count;
  int32_t timeline_semaphores; /* 1: VkPhysicalDeviceVulkan12Features.timelineSemaphore is enabled. Required, and not
                                  verified */
  int32_t memory_budget;   /* 1: VK_EXT_memory_budget is enabled, so that the runtime keeps to the remaining memory */
  int32_t external_memory; /* 1: VK_KHR_external_memory_fd is enabled, so that CUDA may mesh for this device (below) */
  /* Called around every use of the queue, on the thread that uses it, for engines that share the queue; both or
   * neither. They may wait, and must not call the runtime. Any function of the runtime may use the queue: call none
   * while holding the lock. */
  void (*lock_queue)(void* user);
  void (*unlock_queue)(void* user);
  void* user;
  uint64_t mesh_bytes; /* most bytes of the device's memory for resident meshes, allocated in blocks; a mesh that does
                          not fit is not on the device (SGM_ERR_NOT_FOUND). 0: as many as the driver gives */
} sgm_vulkan_device_desc;

#define SGM_VULKAN_DEVICE_DESC_INIT                                                                                    \
  {                                                                                                                    \
    SGM_SIZEOF(sgm_vulkan_device_desc), SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, 0, \
        0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0                                                                       \
  }

/* Makes the runtime's Vulkan backend use this device. A software device is used for SGM_BACKEND_VULKAN alone, not for
 * AUTO.
 *
 * CUDA meshes, Vulkan draws: a device lent with external_memory shares memory with CUDA, and meshes that the runtime's
 * CUDA backend leaves on the GPU (SGM_WORLD_RESIDENT) lie in this device's buffers: sgm_mesh_get_vulkan_view returns
 * them. Lend the device before the runtime's first CUDA field, and before sgm_runtime_lend_cuda. A field with
 * SGM_BACKEND_CUDA is then refused (SGM_ERR_UNSUPPORTED) if CUDA does not run on the same GPU or cannot import its
 * memory; SGM_BACKEND_AUTO takes CUDA if that is possible, and else this device. mesh_bytes limits the meshes of each
 * of the two backends separately. If this device is lost, CUDA continues to mesh, and meshes are not on a device.
 *
 * SGM_ERR_INVALID_ARGUMENT: a handle is missing, only one lock function is given, or the queue family does not exist.
 * SGM_ERR_UNSUPPORTED: the device lacks something, which the message names. SGM_ERR_BUSY: the runtime already has an
 * external device, or a field on a Vulkan device of its own, or with external_memory on a CUDA device. On failure
 * nothing changes.
 *
 * An external device that is lost stays lost: the CPU meshes from then on, with the same bytes, and meshes are not on a
 * device. To lend a replacement, destroy the runtime and create another. */
SGM_API sgm_result sgm_runtime_lend_vulkan(sgm_runtime* runtime, const sgm_vulkan_device_desc* desc, sgm_error* error);

/* A body or a seam in a VkBuffer of the runtime, among others; the buffer's usage has VERTEX, INDEX, INDIRECT, STORAGE
 * and TRANSFER_SRC. Vertices are sgm_vertex, indices uint32_t counted from the part's first vertex. To bind the part as
 * storage, begin at a multiple of minStorageBufferOffsetAlignment below it, and mind maxStorageBufferRange: the buffer
 * is larger. Morph offsets (SGM_WORLD_MORPH) are not there: upload sgm_mesh_view.morphs. */
typedef struct sgm_vulkan_part {
  VkBuffer buffer;            /* VK_NULL_HANDLE: no triangles; all other members are 0 then */
  VkDeviceSize vertex_offset; /* bytes in buffer; a multiple of sizeof(sgm_vertex) */
  VkDeviceSize index_offset;  /* bytes; a multiple of 4 */
  VkDeviceSize draw_offset;   /* bytes; a multiple of 4. A copy of `draw` lies there, for vkCmdDrawIndexedIndirect */
  uint32_t vertex_count;
  /* For the buffer bound from its beginning both as vertices and as indices (VK_INDEX_TYPE_UINT32): one instance, so
   * that one vkCmdDrawIndexedIndirect with commands that the engine gathers draws all parts of a buffer. firstInstance
   * is 0; an engine replaces it by the number of its own record of the chunk's place (the origin and cell_units of
   * sgm_mesh_get_view). */
  VkDrawIndexedIndirectCommand draw;
} sgm_vulkan_part;

/* Filled by sgm_mesh_get_vulkan_view. */
typedef struct sgm_vulkan_mesh_view {
  uint32_t struct_size;
  void* next;
  /* The parts are ready when the timeline semaphore reaches this value: usually before the mesh is READY, so that
   * waiting takes no time; for meshes of CUDA, as soon as the external queue gets to it. The wait makes the parts
   * visible: the engine's submission must wait for the value, on the device, at the stages that read them
   * (VERTEX_INPUT, DRAW_INDIRECT for the data at draw_offset, or those of its own shaders and copies). The signal was
   * submitted before, so that a wait on the external queue itself ends. The semaphore is the same for all meshes of a
   * backend of the runtime, and lives as long as any of them; for several meshes the largest value counts.
   * VK_NULL_HANDLE and 0: no triangles, nothing to wait for. */
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

/* Returns where the mesh lies on the external device, with the same bytes as in sgm_mesh_get_view. Valid until the mesh
 * is destroyed: release it only when the device has finished with it. Meshes of one chunk share common parts.
 *
 * SGM_ERR_NOT_FOUND: the mesh is not there, or not all of it: the world is not SGM_WORLD_RESIDENT, no memory was left
 * on the device, or the device was lost before. Upload the data of sgm_mesh_get_view. SGM_ERR_DEVICE_LOST: the device
 * was lost afterwards. */
SGM_API sgm_result sgm_mesh_get_vulkan_view(const sgm_mesh* mesh, sgm_vulkan_mesh_view* view, sgm_error* error);

#if defined(__cplusplus)
}
#endif

#endif
