/* Checks sizes and offsets of every struct of sgm/sgm_cuda.h, and its _INIT macros. */
#include <sgm/sgm_cuda.h>

#include "layout.h"

SIZE(sgm_cuda_device_desc, 40);
PLACE(sgm_cuda_device_desc, context, 16);
PLACE(sgm_cuda_device_desc, stream, 24);
PLACE(sgm_cuda_device_desc, mesh_bytes, 32);
SIZE(sgm_cuda_part, 24);
PLACE(sgm_cuda_part, vertices, 0);
PLACE(sgm_cuda_part, indices, 8);
PLACE(sgm_cuda_part, vertex_count, 16);
PLACE(sgm_cuda_part, index_count, 20);
SIZE(sgm_cuda_mesh_view, 184);
PLACE(sgm_cuda_mesh_view, body, 16);
PLACE(sgm_cuda_mesh_view, seams, 40);

INITS(sgm_cuda_inits) {
  const sgm_cuda_device_desc device = SGM_CUDA_DEVICE_DESC_INIT;
  const sgm_cuda_mesh_view view = SGM_CUDA_MESH_VIEW_INIT;
  return device.struct_size == sizeof(device) && device.next == SGM_NULL && device.context == SGM_NULL &&
         device.stream == SGM_NULL && device.mesh_bytes == 0 && view.struct_size == sizeof(view) &&
         view.next == SGM_NULL && view.body.vertices == 0 && view.seams[5].index_count == 0;
}
