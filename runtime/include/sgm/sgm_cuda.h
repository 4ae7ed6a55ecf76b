/* clang-format off */
/*
 * sgm_cuda.h: an engine's own CUDA context as an external device of the runtime, and meshes that stay on its GPU.
 *
 * This header needs no header of CUDA, and every library has its functions. If the library was built without kernels
 * (SGM_CUDA=OFF, or AUTO without nvcc) or finds no driver, sgm_runtime_lend_cuda fails and reports the reason. The
 * conventions of sgm.h hold here too.
 *
 * Order of calls
 *   sgm_runtime_lend_cuda   before the runtime's first field
 *   sgm_field_create        with SGM_BACKEND_CUDA, or AUTO
 *   sgm_world_create        with SGM_WORLD_RESIDENT
 *   sgm_mesh_get_cuda_view  for every mesh that is READY; read it there, upload nothing
 *
 * An engine that draws with Vulkan lends that device with external_memory first (sgm_vulkan.h): meshes are then in
 * buffers of the Vulkan device, and sgm_mesh_get_cuda_view does not find them.
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

/* An engine's CUDA context, on a GPU with compute capability 7.5 or newer. Context and stream must outlive the runtime.
 * The runtime makes the context current during its calls, on any thread, and then restores the thread's previous
 * context. On a stream, the runtime waits only for an event after its own work. But CUDA itself may wait for the whole
 * device when kernels are loaded, or pinned memory is allocated or freed. This happens when the context is lent, when
 * the runtime is destroyed, while batches still grow, and when memory for meshes is allocated or freed on a Vulkan
 * device that draws. At these times, a kernel of the engine that waits for the host must not wait for the runtime. Nor
 * may the engine then capture a graph, except in the mode RELAXED, or in the mode CU_STREAM_CAPTURE_MODE_THREAD_LOCAL
 * on threads that do not call the runtime: the runtime's calls would end the capture. */
typedef struct sgm_cuda_device_desc {
  uint32_t struct_size;
  const void* next;
  struct CUctx_st* context;   /* CUcontext; the primary context is allowed */
  struct CUstream_st* stream; /* CUstream for all batches, in order among each other and with the engine's work on it;
                                 not one that is being captured, nor CU_STREAM_PER_THREAD, which is another stream on
                                 every thread. NULL: several streams of the runtime, which do not wait for the engine's
                                 work */
  uint64_t mesh_bytes;        /* maximum number of bytes of the GPU's memory for resident meshes; a mesh that does not
                                 fit is not there (SGM_ERR_NOT_FOUND). 0: as many as the driver gives. Unused if meshes
                                 stay on a Vulkan device, whose own mesh_bytes counts */
} sgm_cuda_device_desc;

#define SGM_CUDA_DEVICE_DESC_INIT \
  { SGM_SIZEOF(sgm_cuda_device_desc), SGM_NULL, SGM_NULL, SGM_NULL, 0 }

/* Makes the runtime's CUDA backend use this context. SGM_BACKEND_AUTO uses it too, unless a hardware Vulkan device was
 * lent before, without external_memory.
 * SGM_ERR_INVALID_ARGUMENT: the context is NULL, or the stream belongs to another context. SGM_ERR_UNSUPPORTED: the
 * build has no kernels, there is no driver, the GPU cannot mesh or is not the one that draws, or the context accepts no
 * calls; the message says which. SGM_ERR_BUSY: the runtime already has an external context, or a field that uses a CUDA
 * context created by the runtime. On failure nothing changes.
 * If the context is lost, it stays lost, as in CUDA itself: from then on the CPU meshes, with the same bytes, and
 * meshes are not on the GPU. */
SGM_API sgm_result sgm_runtime_lend_cuda(sgm_runtime* runtime, const sgm_cuda_device_desc* desc, sgm_error* error);

/* The body or a seam of a mesh in GPU memory. Addresses are CUdeviceptr, multiples of 256. Morph offsets
 * (SGM_WORLD_MORPH) are not in GPU memory: upload sgm_mesh_view.morphs. */
typedef struct sgm_cuda_part {
  uint64_t vertices; /* array of sgm_vertex. 0: no triangles; all other members are 0 then */
  uint64_t indices;  /* array of uint32_t, counted from the part's first vertex */
  uint32_t vertex_count;
  uint32_t index_count;
} sgm_cuda_part;

/* Filled by sgm_mesh_get_cuda_view. */
typedef struct sgm_cuda_mesh_view {
  uint32_t struct_size;
  void* next;
  sgm_cuda_part body;
  sgm_cuda_part seams[6]; /* by sgm_face; draw those named by the chunk's events */
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

/* Returns the addresses of a mesh in the external context; its data is the same as in sgm_mesh_get_view. The data is
 * complete when the function returns: work that the engine submits to a stream afterwards may read it, but must not
 * write it. Valid until the mesh is destroyed: release the mesh only when the GPU has finished using it. Meshes of one
 * chunk may share parts.
 * SGM_ERR_NOT_FOUND: the mesh is not, or not completely, in GPU memory: the world is not SGM_WORLD_RESIDENT, the GPU
 * had no memory left, the context was lost before, or meshes stay on a Vulkan device. In this case, upload the data of
 * sgm_mesh_get_view. SGM_ERR_DEVICE_LOST: the context was lost afterwards, as far as the runtime knows. */
SGM_API sgm_result sgm_mesh_get_cuda_view(const sgm_mesh* mesh, sgm_cuda_mesh_view* view, sgm_error* error);

#if defined(__cplusplus)
}
#endif

#endif
