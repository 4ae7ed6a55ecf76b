// The push constants of all kernels of the mesher (struct Sizes in backend/vulkan/batch_layout.h).
layout(push_constant) uniform Sizes {
  uint part_count;
  uint seam_records;  // offset in `batch` of the records of seams
  uint cell_list;     // offset in `scratch` of the list of active cells
  uint max_vertices;  // number of vertices that fit into the buffers
  uint max_indices;
  uint max_cells;
  uint chunk_count;
  uint jobs_at;      // offset in `batch` of the pruning jobs
  uint items_at;     // offset in `scratch` of the items, which are bricks and planes (items.glsl)
  uint sampled_at;   // offset in `scratch` of the list of items that have to be sampled
  uint vertices_at;  // offset in `scratch` of the list of vertices by brick
  uint units_at;     // offset in `scratch` of the units: groups of vertices whose attributes are evaluated together
};
