/* clang-format off */
/*
 * sgm_cuda.h: an engine's own CUDA context, lent to the runtime, and meshes that stay on its GPU.
 *
 * Takes no header of CUDA's, and is there in every library; one that was built without kernels (SGM_CUDA=OFF, or AUTO
 * where there was no nvcc), or finds no driver, refuses with the reason. What sgm.h says of every declaration holds here
 * as well.
 *
 * The way through it
 *   sgm_runtime_lend_cuda   before the runtime's first field
 *   sgm_field_create        with SGM_BACKEND_CUDA, or AUTO
 *   sgm_world_create        with SGM_WORLD_RESIDENT
 *   sgm_mesh_get_cuda_view  of every mesh that is READY; read it there, upload nothing
 *
 * Who draws with Vulkan lends that device with external_memory before (sgm_vulkan.h): meshes are in its buffers then, and
 * not here.
 */
/* clang-format on */
#ifndef SGM_SGM_CUDA_H
#define SGM_SGM_CUDA_H

#include <sgm/sgm.h>

#if defined(__cplusplus)
extern "C" {
#endif

struct CUctx_st;
struct CUstream_st;

/* The engine's context, of a GPU with compute capability 7.5 or newer. Both handles must outlive the runtime.
 *
 * The runtime makes the context current around its calls, on whatever thread they are, and leaves every thread the one
 * that it had. Of a stream it waits only for an event behind what it gave it itself. But CUDA may make it wait for the
 * whole device where kernels are loaded or pinned memory is taken or given back: at lending, at the runtime's end,
 * while batches still grow, and where memory of a Vulkan device that draws is taken or given back for meshes. A kernel
 * of the engine's that waits for the host must not wait for the runtime's then. Nor may the engine capture a graph
 * meanwhile, but in the mode RELAXED, or CU_STREAM_CAPTURE_MODE_THREAD_LOCAL on threads that do not call the runtime:
 * calls of the runtime's would end the capture. */
typedef struct sgm_cuda_device_desc {
  uint32_t struct_size;
  const void* next;
  struct CUctx_st* context;   /* CUcontext. The primary one will do */
  struct CUstream_st* stream; /* CUstream for all batches, one behind the other and between what the engine gives it;
                                 not one that is being captured, nor CU_STREAM_PER_THREAD, which is another on every
                                 thread. NULL: streams of the runtime's own, several at a time, that wait for nothing of
                                 the engine's */
  uint64_t mesh_bytes;        /* the most bytes of the GPU's memory for meshes that stay there; what has no room is not
                                 there (SGM_ERR_NOT_FOUND). 0: as many as the driver gives. Of no use where meshes stay on a
                                 Vulkan device, whose own mesh_bytes counts */
} sgm_cuda_device_desc;

#define SGM_CUDA_DEVICE_DESC_INIT \
  { SGM_SIZEOF(sgm_cuda_device_desc), SGM_NULL, SGM_NULL, SGM_NULL, 0 }

/* From now on the runtime's CUDA backend is in this context, and so is AUTO's, unless a Vulkan device that is hardware
 * was lent before without external_memory.
 *
 * SGM_ERR_INVALID_ARGUMENT: no context, or a stream that is not of it. SGM_ERR_UNSUPPORTED: no kernels in this build,
 * no driver, a GPU that cannot mesh, or is not the one that draws, or a context that takes no calls; the message says
 * which. SGM_ERR_BUSY: the runtime has lent one, or a field on a CUDA device of its own. When it fails nothing has
 * changed.
 *
 * A lent context that is lost stays lost, as CUDA's do: the CPU meshes from then on, with the same bytes, and meshes
 * are not on the GPU. */
SGM_API sgm_result sgm_runtime_lend_cuda(sgm_runtime* runtime, const sgm_cuda_device_desc* desc, sgm_error* error);

/* A body or a seam in the GPU's memory: CUdeviceptr, at multiples of 256. Morph offsets (SGM_WORLD_MORPH) are not
 * there: upload sgm_mesh_view.morphs. */
typedef struct sgm_cuda_part {
  uint64_t vertices; /* sgm_vertex each. 0: no triangles; all else is 0 then */
  uint64_t indices;  /* uint32_t each, counted from the part's first vertex */
  uint32_t vertex_count;
  uint32_t index_count;
} sgm_cuda_part;

/* Filled by sgm_mesh_get_cuda_view. */
typedef struct sgm_cuda_mesh_view {
  uint32_t struct_size;
  void* next;
  sgm_cuda_part body;
  sgm_cuda_part seams[6]; /* by sgm_face; draw those that the chunk's events name */
} sgm_cuda_mesh_view;

#define SGM_CUDA_PART_INIT \
  { 0, 0, 0, 0 }
#define SGM_CUDA_MESH_VIEW_INIT                                                                           \
  {                                                                                                       \
    SGM_SIZEOF(sgm_cuda_mesh_view), SGM_NULL, SGM_CUDA_PART_INIT, {                                       \
      SGM_CUDA_PART_INIT, SGM_CUDA_PART_INIT, SGM_CUDA_PART_INIT, SGM_CUDA_PART_INIT, SGM_CUDA_PART_INIT, \
          SGM_CUDA_PART_INIT                                                                              \
    }                                                                                                     \
  }

/* Where the mesh lies in the lent context, with the same bytes as in sgm_mesh_get_view. They are there when the
 * function returns: whatever the engine gives a stream from then on may read them, and must not write. Good until the
 * mesh ends: release it only when the GPU has done with it. Meshes of one chunk share what they have in common.
 *
 * SGM_ERR_NOT_FOUND: it is not there, or not all of it: the world is not SGM_WORLD_RESIDENT, no memory was left on the
 * GPU, the context was lost before, or meshes stay on a Vulkan device. Upload what sgm_mesh_get_view shows.
 * SGM_ERR_DEVICE_LOST: the context was lost after it, as far as the runtime has heard. */
SGM_API sgm_result sgm_mesh_get_cuda_view(const sgm_mesh* mesh, sgm_cuda_mesh_view* view, sgm_error* error);

#if defined(__cplusplus)
}
#endif

#endif
