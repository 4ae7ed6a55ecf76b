/* Checks sizes and offsets of every struct of sgm/sgm_vulkan.h, and its _INIT macros. */
#include <sgm/sgm_vulkan.h>

#include "layout.h"

SIZE(sgm_vulkan_device_desc, 120);
PLACE(sgm_vulkan_device_desc, api_version, 16);
PLACE(sgm_vulkan_device_desc, queue_family, 20);
PLACE(sgm_vulkan_device_desc, get_instance_proc_addr, 24);
PLACE(sgm_vulkan_device_desc, instance, 32);
PLACE(sgm_vulkan_device_desc, physical_device, 40);
PLACE(sgm_vulkan_device_desc, device, 48);
PLACE(sgm_vulkan_device_desc, queue, 56);
PLACE(sgm_vulkan_device_desc, reader_families, 64);
PLACE(sgm_vulkan_device_desc, reader_family_count, 72);
PLACE(sgm_vulkan_device_desc, timeline_semaphores, 76);
PLACE(sgm_vulkan_device_desc, memory_budget, 80);
PLACE(sgm_vulkan_device_desc, external_memory, 84);
PLACE(sgm_vulkan_device_desc, lock_queue, 88);
PLACE(sgm_vulkan_device_desc, unlock_queue, 96);
PLACE(sgm_vulkan_device_desc, user, 104);
PLACE(sgm_vulkan_device_desc, mesh_bytes, 112);
SIZE(sgm_vulkan_part, 56);
PLACE(sgm_vulkan_part, buffer, 0);
PLACE(sgm_vulkan_part, vertex_offset, 8);
PLACE(sgm_vulkan_part, index_offset, 16);
PLACE(sgm_vulkan_part, draw_offset, 24);
PLACE(sgm_vulkan_part, vertex_count, 32);
PLACE(sgm_vulkan_part, draw, 36);
SIZE(sgm_vulkan_mesh_view, 424);
PLACE(sgm_vulkan_mesh_view, semaphore, 16);
PLACE(sgm_vulkan_mesh_view, value, 24);
PLACE(sgm_vulkan_mesh_view, body, 32);
PLACE(sgm_vulkan_mesh_view, seams, 88);

INITS(sgm_vulkan_inits) {
  const sgm_vulkan_device_desc device = SGM_VULKAN_DEVICE_DESC_INIT;
  const sgm_vulkan_mesh_view view = SGM_VULKAN_MESH_VIEW_INIT;
  return device.struct_size == sizeof(device) && device.next == SGM_NULL && device.timeline_semaphores == 0 &&
         device.user == SGM_NULL && view.struct_size == sizeof(view) && view.next == SGM_NULL && view.value == 0 &&
         view.body.draw.indexCount == 0 && view.seams[5].vertex_count == 0;
}
