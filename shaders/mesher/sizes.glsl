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
  uint sampled_at;   // the numbers of those to sample,
  uint vertices_at;  // and the vertices of each brick
  uint planes;       // of attributes.comp: 0 bricks, 1 planes
};
