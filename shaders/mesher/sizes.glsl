// The push constants of all kernels that mesh (backend/vulkan/batch_layout.h, Sizes).
layout(push_constant) uniform Sizes {
  uint part_count;
  uint seam_records;  // where in batch the seams' records begin
  uint cell_list;     // where in scratch the list of active cells begins
  uint max_vertices;  // what the buffers have room for
  uint max_indices;
  uint max_cells;
  uint chunk_count;
  uint jobs_at;      // where in batch the jobs of pruning begin
  uint items_at;     // in scratch: bricks and planes (items.glsl),
  uint sampled_at;   // what is to be sampled,
  uint vertices_at;  // the vertices of each brick,
  uint units_at;     // and the units of attributes
};
