/* clang-format off */
/*
 * sgm_vulkan.h: an engine's own Vulkan device, lent to the runtime, and meshes that stay on it.
 *
 * In libraries that were built with SGM_VULKAN; takes Vulkan's own header, and calls no function of Vulkan's that is
 * not reached through the vkGetInstanceProcAddr given here. What sgm.h says of every declaration holds here as well.
 *
 * The way through it
 *   sgm_runtime_lend_vulkan   before the runtime's first field
 *   sgm_field_create          with SGM_BACKEND_VULKAN, or AUTO where the device is hardware
 *   sgm_world_create          with SGM_WORLD_RESIDENT
 *   sgm_mesh_get_vulkan_view  of every mesh that is READY; draw it from there, upload nothing
 */
/* clang-format on */
#ifndef SGM_SGM_VULKAN_H
#define SGM_SGM_VULKAN_H

#include <sgm/sgm.h>
#include <vulkan/vulkan_core.h>

#if defined(__cplusplus)
extern "C" {
#endif

/* The engine's device. Made for Vulkan 1.2 or newer (VkApplicationInfo.apiVersion), with the feature timelineSemaphore
 * and a queue that computes. All handles must outlive the runtime.
 *
 * The runtime submits to the queue from any thread, and waits for what it has submitted by a timeline semaphore: never
 * for the queue, nor for the device. A batch has up to 64 chunks, and what else is submitted to the queue waits behind
 * it: where the device has a second queue, best one that only computes, lend that one. */
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
   * (VK_SHARING_MODE_CONCURRENT), and no ownership is transferred. NULL where the count is 0. Copied. */
  const uint32_t* reader_families;
  uint32_t reader_family_count;
  int32_t
      timeline_semaphores; /* 1: VkPhysicalDeviceVulkan12Features.timelineSemaphore is enabled. Needed, and believed */
  int32_t memory_budget;   /* 1: VK_EXT_memory_budget is enabled, so that the runtime keeps to what is left */
  int32_t external_memory; /* 1: VK_KHR_external_memory_fd is enabled, so that CUDA may mesh for this device (below) */
  /* Called around every use of the queue, on the thread that uses it, for who shares it; both or neither. They may
   * wait, and must not call the runtime. Any function of the runtime's may use the queue: hold the lock in none. */
  void (*lock_queue)(void* user);
  void (*unlock_queue)(void* user);
  void* user;
  uint64_t mesh_bytes; /* the most bytes of the device's memory for meshes that stay there, taken in blocks; what has no
                          room is not on the device (SGM_ERR_NOT_FOUND). 0: as many as the driver gives */
} sgm_vulkan_device_desc;

#define SGM_VULKAN_DEVICE_DESC_INIT                                                                                    \
  {                                                                                                                    \
    SGM_SIZEOF(sgm_vulkan_device_desc), SGM_NULL, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, SGM_NULL, 0, \
        0, 0, 0, SGM_NULL, SGM_NULL, SGM_NULL, 0                                                                       \
  }

/* From now on the runtime's Vulkan backend is this device. A software one is taken for SGM_BACKEND_VULKAN alone.
 *
 * CUDA meshes, Vulkan draws: of a device lent with external_memory, memory is shared with CUDA, and what the runtime's
 * CUDA backend leaves on the GPU (SGM_WORLD_RESIDENT) lies in this device's buffers: sgm_mesh_get_vulkan_view shows it.
 * Lend it before the runtime's first CUDA field, and before sgm_runtime_lend_cuda. A field with SGM_BACKEND_CUDA is
 * then refused (SGM_ERR_UNSUPPORTED) where CUDA does not run on the same GPU or cannot import its memory;
 * SGM_BACKEND_AUTO takes CUDA where that can be had, and else this device. mesh_bytes holds for what either of the two
 * backends leaves there, each for itself. Where this device is lost CUDA meshes on, and meshes are not on a device.
 *
 * SGM_ERR_INVALID_ARGUMENT: a handle is missing, half a lock, no such queue family. SGM_ERR_UNSUPPORTED: the device
 * lacks something, which the message names. SGM_ERR_BUSY: the runtime has lent one, or a field on a Vulkan device of
 * its own, or with external_memory on a CUDA one. When it fails nothing has changed.
 *
 * A lent device that is lost stays lost: the CPU meshes from then on, with the same bytes, and meshes are not on a
 * device. To lend the one that takes its place, end the runtime. */
SGM_API sgm_result sgm_runtime_lend_vulkan(sgm_runtime* runtime, const sgm_vulkan_device_desc* desc, sgm_error* error);

/* A body or a seam in a VkBuffer of the runtime's, among others; its usage has VERTEX, INDEX, INDIRECT, STORAGE and
 * TRANSFER_SRC. Vertices are sgm_vertex, indices uint32_t counted from the part's first vertex. To bind it as storage
 * begin at a multiple of minStorageBufferOffsetAlignment below, and mind maxStorageBufferRange: the buffer is larger.
 * Morph offsets (SGM_WORLD_MORPH) are not there: upload sgm_mesh_view.morphs. */
typedef struct sgm_vulkan_part {
  VkBuffer buffer;            /* VK_NULL_HANDLE: no triangles; all else is 0 then */
  VkDeviceSize vertex_offset; /* bytes in buffer; a multiple of sizeof(sgm_vertex) */
  VkDeviceSize index_offset;  /* bytes; a multiple of 4 */
  VkDeviceSize draw_offset;   /* bytes; a multiple of 4. `draw` lies there, for vkCmdDrawIndexedIndirect */
  uint32_t vertex_count;
  /* With the buffer bound from its beginning both as vertices and as indices (VK_INDEX_TYPE_UINT32): one instance, so
   * that all parts of a buffer are drawn by one vkCmdDrawIndexedIndirect with commands that the engine gathers.
   * firstInstance is 0; there an engine puts the number of a record of its own with the chunk's place (the origin and
   * cell_units of sgm_mesh_get_view). */
  VkDrawIndexedIndirectCommand draw;
} sgm_vulkan_part;

/* Filled by sgm_mesh_get_vulkan_view. */
typedef struct sgm_vulkan_mesh_view {
  uint32_t struct_size;
  void* next;
  /* The parts are there from the moment at which the timeline semaphore has this value, which is before the mesh is
   * READY as a rule, so that waiting takes no time; of what CUDA meshed, as soon as the lent queue gets to it. But it
   * makes them visible: the engine's submission waits for the value, on the device, at the stages that read them
   * (VERTEX_INPUT, DRAW_INDIRECT for what lies at draw_offset, or those of its own shaders and copies). What signals it
   * was submitted before, so that a wait on the lent queue itself ends. The semaphore is the same for all meshes of a
   * backend of the runtime's, and lives as long as any of them; of several the largest value counts. VK_NULL_HANDLE and
   * 0: no triangles, nothing to wait for. */
  VkSemaphore semaphore;
  uint64_t value;
  sgm_vulkan_part body;
  sgm_vulkan_part seams[6]; /* by sgm_face; draw those that the chunk's events name */
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

/* Where the mesh lies on the lent device, with the same bytes as in sgm_mesh_get_view. Good until the mesh ends:
 * release it only when the device has done with it. Meshes of one chunk share what they have in common.
 *
 * SGM_ERR_NOT_FOUND: it is not there, or not all of it: the world is not SGM_WORLD_RESIDENT, no memory was left on the
 * device, or it was lost before. Upload what sgm_mesh_get_view shows. SGM_ERR_DEVICE_LOST: the device was lost after
 * it. */
SGM_API sgm_result sgm_mesh_get_vulkan_view(const sgm_mesh* mesh, sgm_vulkan_mesh_view* view, sgm_error* error);

#if defined(__cplusplus)
}
#endif

#endif
