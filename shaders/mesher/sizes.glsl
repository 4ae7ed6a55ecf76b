// The push constants of all kernels that mesh (backend/vulkan/batch_layout.h, Sizes).
layout(push_constant) uniform Sizes {
  uint part_count;
  uint seam_records;  // where in batch the seams' records begin
  uint cell_list;     // where in scratch the list of active cells begins
  uint max_vertices;  // what the buffers have room for
  uint max_indices;
  uint max_cells;
};
