/* Checks that every _INIT macro of sgm.h initialises its struct, in C and in C++, without a warning. */
#include <sgm/sgm.h>

#include "layout.h"

INITS(sgm_layout_inits) {
  const sgm_error error = SGM_ERROR_INIT;
  const sgm_runtime_desc runtime_desc = SGM_RUNTIME_DESC_INIT;
  const sgm_backend_info backend_info = SGM_BACKEND_INFO_INIT;
  const sgm_grammar_desc grammar_desc = SGM_GRAMMAR_DESC_INIT;
  const sgm_diagnostic diagnostic = SGM_DIAGNOSTIC_INIT;
  const sgm_domain_info domain_info = SGM_DOMAIN_INFO_INIT;
  const sgm_layer_info layer_info = SGM_LAYER_INFO_INIT;
  const sgm_parameter_info parameter_info = SGM_PARAMETER_INFO_INIT;
  const sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
  const sgm_sample_desc sample_desc = SGM_SAMPLE_DESC_INIT;
  const sgm_surface_point surface_point = SGM_SURFACE_POINT_INIT;
  const sgm_ray_desc ray_desc = SGM_RAY_DESC_INIT;
  const sgm_closest_desc closest_desc = SGM_CLOSEST_DESC_INIT;
  const sgm_walk_desc walk_desc = SGM_WALK_DESC_INIT;
  const sgm_walkable walkable = SGM_WALKABLE_INIT;
  const sgm_way_desc way_desc = SGM_WAY_DESC_INIT;
  const sgm_way way = SGM_WAY_INIT;
  const sgm_chunk_request chunk_request = SGM_CHUNK_REQUEST_INIT;
  const sgm_chunks_desc chunks_desc = SGM_CHUNKS_DESC_INIT;
  const sgm_mesh_range mesh_range = SGM_MESH_RANGE_INIT;
  const sgm_mesh_view mesh_view = SGM_MESH_VIEW_INIT;
  const sgm_region_desc region_desc = SGM_REGION_DESC_INIT;
  const sgm_grid_desc grid_desc = SGM_GRID_DESC_INIT;
  const sgm_measure_desc measure_desc = SGM_MEASURE_DESC_INIT;
  const sgm_measures measures = SGM_MEASURES_INIT;
  const sgm_surface_view surface_view = SGM_SURFACE_VIEW_INIT;
  const sgm_density_desc density_desc = SGM_DENSITY_DESC_INIT;
  const sgm_host_field host_field = SGM_HOST_FIELD_INIT;
  const sgm_world_desc world_desc = SGM_WORLD_DESC_INIT;
  const sgm_collider_view collider_view = SGM_COLLIDER_VIEW_INIT;
  const sgm_brush brush = SGM_BRUSH_INIT;
  const sgm_viewer viewer = SGM_VIEWER_INIT;
  const sgm_world_stats world_stats = SGM_WORLD_STATS_INIT;
  const sgm_world_info world_info = SGM_WORLD_INFO_INIT;
  const sgm_time_histogram time_histogram = SGM_TIME_HISTOGRAM_INIT;
  const sgm_world_times world_times = SGM_WORLD_TIMES_INIT;
  const sgm_chunk_sums chunk_sums = SGM_CHUNK_SUMS_INIT;
  const sgm_world_measures world_measures = SGM_WORLD_MEASURES_INIT;
  const sgm_mesh_measures mesh_measures = SGM_MESH_MEASURES_INIT;
  return error.code == SGM_OK && runtime_desc.struct_size == sizeof(runtime_desc) && runtime_desc.next == SGM_NULL &&
         backend_info.struct_size == sizeof(backend_info) && backend_info.next == SGM_NULL &&
         grammar_desc.struct_size == sizeof(grammar_desc) && grammar_desc.next == SGM_NULL &&
         diagnostic.struct_size == sizeof(diagnostic) && diagnostic.next == SGM_NULL &&
         domain_info.struct_size == sizeof(domain_info) && domain_info.next == SGM_NULL &&
         layer_info.struct_size == sizeof(layer_info) && layer_info.next == SGM_NULL &&
         parameter_info.struct_size == sizeof(parameter_info) && parameter_info.next == SGM_NULL &&
         field_desc.struct_size == sizeof(field_desc) && field_desc.next == SGM_NULL &&
         host_field.struct_size == sizeof(host_field) && host_field.next == SGM_NULL && host_field.steepness == 0.0f &&
         sample_desc.struct_size == sizeof(sample_desc) && sample_desc.next == SGM_NULL &&
         surface_point.struct_size == sizeof(surface_point) && surface_point.next == SGM_NULL &&
         ray_desc.struct_size == sizeof(ray_desc) && ray_desc.next == SGM_NULL &&
         closest_desc.struct_size == sizeof(closest_desc) && closest_desc.next == SGM_NULL &&
         walk_desc.struct_size == sizeof(walk_desc) && walk_desc.next == SGM_NULL &&
         walkable.struct_size == sizeof(walkable) && walkable.next == SGM_NULL &&
         way_desc.struct_size == sizeof(way_desc) && way_desc.next == SGM_NULL && way.struct_size == sizeof(way) &&
         way.next == SGM_NULL && chunk_request.coarser == 0 &&
         chunk_request.reserved[1] == 0 && chunks_desc.struct_size == sizeof(chunks_desc) &&
         chunks_desc.next == SGM_NULL && mesh_range.hash == 0 && mesh_view.struct_size == sizeof(mesh_view) &&
         mesh_view.next == SGM_NULL && region_desc.struct_size == sizeof(region_desc) && region_desc.next == SGM_NULL &&
         grid_desc.struct_size == sizeof(grid_desc) && grid_desc.next == SGM_NULL &&
         measure_desc.struct_size == sizeof(measure_desc) && measure_desc.next == SGM_NULL &&
         measure_desc.histogram_bins == 33 && measures.struct_size == sizeof(measures) && measures.next == SGM_NULL &&
         surface_view.struct_size == sizeof(surface_view) && surface_view.next == SGM_NULL &&
         density_desc.struct_size == sizeof(density_desc) && density_desc.next == SGM_NULL &&
         collider_view.struct_size == sizeof(collider_view) && collider_view.next == SGM_NULL && brush.cut == 1 &&
         world_desc.struct_size == sizeof(world_desc) && world_desc.next == SGM_NULL && viewer.fov == 0.0f &&
         viewer.weight > 0.5f && world_stats.struct_size == sizeof(world_stats) && world_stats.next == SGM_NULL &&
         world_info.struct_size == sizeof(world_info) && world_info.next == SGM_NULL &&
         world_info.backend.struct_size == sizeof(world_info.backend) && world_info.mesh_bytes == 0 &&
         time_histogram.counts[SGM_TIME_BUCKETS - 1] == 0 && world_times.struct_size == sizeof(world_times) &&
         world_times.next == SGM_NULL && world_times.mesh[SGM_MAX_LEVEL].counts[0] == 0 &&
         chunk_sums.defects[15] == 0 && world_measures.struct_size == sizeof(world_measures) &&
         world_measures.next == SGM_NULL && mesh_measures.struct_size == sizeof(mesh_measures) &&
         mesh_measures.next == SGM_NULL;
}
