/*
 * Checks, at compile time, sizes and offsets of every struct of sgm/sgm.h on machines with 64-bit pointers, and every
 * constant in it, so that a change that breaks programs built with the header of an earlier patch version does not
 * compile. Compiled as C99 and as C++20.
 */
#include <sgm/sgm.h>

#if defined(__cplusplus)
#define CHECK(name, truth) static_assert(truth, #name)
#define LAYOUT_INITS sgm_layout_inits_cpp
extern "C" int LAYOUT_INITS(void);
#else
#define CHECK(name, truth) typedef char check_##name[(truth) ? 1 : -1]
#define LAYOUT_INITS sgm_layout_inits_c
int LAYOUT_INITS(void);
#endif
#define SIZE(type, bytes) CHECK(sizeof_##type, sizeof(type) == (bytes))
#define PLACE(type, field, bytes) CHECK(offsetof_##type##_##field, offsetof(type, field) == (bytes))

CHECK(pointer_size, sizeof(void*) == 8);
CHECK(result_size, sizeof(sgm_result) == 4);
CHECK(log_level_size, sizeof(sgm_log_level) == 4);
CHECK(backend_size, sizeof(sgm_backend) == 4);
CHECK(quantity_size, sizeof(sgm_quantity) == 4);
CHECK(face_size, sizeof(sgm_face) == 4);
CHECK(density_format_size, sizeof(sgm_density_format) == 4);

/* Values of constants, which are compiled into programs and so must not change. */
CHECK(version_major, SGM_VERSION_MAJOR == 0);
CHECK(version_minor, SGM_VERSION_MINOR == 2);
CHECK(version_patch, SGM_VERSION_PATCH == 0);
CHECK(api_version, SGM_API_VERSION == 2000);
CHECK(units_per_metre, SGM_UNITS_PER_METRE == 1024);
CHECK(chunk_cells, SGM_CHUNK_CELLS == 32);
CHECK(subcell, SGM_SUBCELL == 256);
CHECK(max_level, SGM_MAX_LEVEL == 16);
CHECK(message_size, SGM_MESSAGE_SIZE == 500);
CHECK(name_size, SGM_NAME_SIZE == 256);
CHECK(time_buckets, SGM_TIME_BUCKETS == 21);
CHECK(time_first_exponent, SGM_TIME_FIRST_EXPONENT == -16);

CHECK(ok, SGM_OK == 0);
CHECK(incomplete, SGM_INCOMPLETE == 1);
CHECK(err_invalid_argument, SGM_ERR_INVALID_ARGUMENT == -1);
CHECK(err_struct_size, SGM_ERR_STRUCT_SIZE == -2);
CHECK(err_version, SGM_ERR_VERSION == -3);
CHECK(err_out_of_memory, SGM_ERR_OUT_OF_MEMORY == -4);
CHECK(err_grammar, SGM_ERR_GRAMMAR == -5);
CHECK(err_limit, SGM_ERR_LIMIT == -6);
CHECK(err_range, SGM_ERR_RANGE == -7);
CHECK(err_io, SGM_ERR_IO == -8);
CHECK(err_unsupported, SGM_ERR_UNSUPPORTED == -9);
CHECK(err_cancelled, SGM_ERR_CANCELLED == -10);
CHECK(err_busy, SGM_ERR_BUSY == -11);
CHECK(err_not_found, SGM_ERR_NOT_FOUND == -12);
CHECK(err_internal, SGM_ERR_INTERNAL == -13);
CHECK(err_data, SGM_ERR_DATA == -14);
CHECK(err_device_lost, SGM_ERR_DEVICE_LOST == -15);
CHECK(result_force, SGM_RESULT_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(log_debug, SGM_LOG_DEBUG == 0);
CHECK(log_info, SGM_LOG_INFO == 1);
CHECK(log_warning, SGM_LOG_WARNING == 2);
CHECK(log_error, SGM_LOG_ERROR == 3);
CHECK(log_force, SGM_LOG_LEVEL_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(backend_auto, SGM_BACKEND_AUTO == 0);
CHECK(backend_cpu, SGM_BACKEND_CPU == 1);
CHECK(backend_vulkan, SGM_BACKEND_VULKAN == 2);
CHECK(backend_cuda, SGM_BACKEND_CUDA == 3);
CHECK(backend_force, SGM_BACKEND_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(quantity_number, SGM_QUANTITY_NUMBER == 0);
CHECK(quantity_length, SGM_QUANTITY_LENGTH == 1);
CHECK(quantity_angle, SGM_QUANTITY_ANGLE == 2);
CHECK(quantity_other, SGM_QUANTITY_OTHER == 3);
CHECK(quantity_force, SGM_QUANTITY_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(density_unorm8, SGM_DENSITY_UNORM8 == 0);
CHECK(density_float32, SGM_DENSITY_FLOAT32 == 1);
CHECK(density_force, SGM_DENSITY_FORMAT_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(histogram_corrected, SGM_HISTOGRAM_CORRECTED == 0);
CHECK(histogram_printed, SGM_HISTOGRAM_PRINTED == 1);
CHECK(histogram_curvature, SGM_HISTOGRAM_CURVATURE == 2);
CHECK(histogram_mode_force, SGM_HISTOGRAM_MODE_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(measure_unique_edges, SGM_MEASURE_UNIQUE_EDGES == 1);
CHECK(measure_no_self_intersections, SGM_MEASURE_NO_SELF_INTERSECTIONS == 2);
CHECK(measure_flag_force, SGM_MEASURE_FLAG_FORCE_32_BIT == 0x7FFFFFFF);

CHECK(face_x_low, SGM_FACE_X_LOW == 0);
CHECK(face_x_high, SGM_FACE_X_HIGH == 1);
CHECK(face_y_low, SGM_FACE_Y_LOW == 2);
CHECK(face_y_high, SGM_FACE_Y_HIGH == 3);
CHECK(face_z_low, SGM_FACE_Z_LOW == 4);
CHECK(face_z_high, SGM_FACE_Z_HIGH == 5);
CHECK(world_by_distance, SGM_WORLD_BY_DISTANCE == 1);
CHECK(world_morph, SGM_WORLD_MORPH == 2);
CHECK(world_resident, SGM_WORLD_RESIDENT == 4);
CHECK(world_texture, SGM_WORLD_TEXTURE == 8);
CHECK(world_sharp, SGM_WORLD_SHARP == 16);
CHECK(meshing_texture, SGM_MESHING_TEXTURE == 1);
CHECK(meshing_sharp, SGM_MESHING_SHARP == 2);
CHECK(meshing_flag_width, SGM_MESHING_FLAG_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(way_found, SGM_WAY_FOUND == 0);
CHECK(way_from_in_rock, SGM_WAY_FROM_IN_ROCK == 1);
CHECK(way_to_in_rock, SGM_WAY_TO_IN_ROCK == 2);
CHECK(way_from_too_narrow, SGM_WAY_FROM_TOO_NARROW == 3);
CHECK(way_to_too_narrow, SGM_WAY_TO_TOO_NARROW == 4);
CHECK(way_apart, SGM_WAY_APART == 5);
CHECK(way_verdict_width, SGM_WAY_VERDICT_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(way_widest, SGM_WAY_WIDEST == 1);
CHECK(way_flag_width, SGM_WAY_FLAG_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(host_cut, SGM_HOST_CUT == 1);
CHECK(host_width, SGM_HOST_FLAG_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(defect_index, SGM_DEFECT_INDEX == 0);
CHECK(defect_outside, SGM_DEFECT_OUTSIDE == 1);
CHECK(defect_misplaced, SGM_DEFECT_MISPLACED == 2);
CHECK(defect_samples, SGM_DEFECT_SAMPLES == 3);
CHECK(defect_degenerate, SGM_DEFECT_DEGENERATE == 4);
CHECK(defect_flat, SGM_DEFECT_FLAT == 5);
CHECK(defect_duplicate, SGM_DEFECT_DUPLICATE == 6);
CHECK(defect_open_edge, SGM_DEFECT_OPEN_EDGE == 7);
CHECK(defect_turned_edge, SGM_DEFECT_TURNED_EDGE == 8);
CHECK(defect_nonmanifold_edge, SGM_DEFECT_NONMANIFOLD_EDGE == 9);
CHECK(defect_pinched_vertex, SGM_DEFECT_PINCHED_VERTEX == 10);
CHECK(defect_folded, SGM_DEFECT_FOLDED == 11);
CHECK(defect_self_intersection, SGM_DEFECT_SELF_INTERSECTION == 12);
CHECK(defect_force_32_bit, SGM_DEFECT_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(world_measure, SGM_WORLD_MEASURE == 32);
CHECK(world_flag_force_32_bit, SGM_WORLD_FLAG_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(event_ready, SGM_EVENT_READY == 0);
CHECK(event_shown, SGM_EVENT_SHOWN == 1);
CHECK(event_replaced, SGM_EVENT_REPLACED == 2);
CHECK(event_seams, SGM_EVENT_SEAMS == 3);
CHECK(event_removed, SGM_EVENT_REMOVED == 4);
CHECK(event_failed, SGM_EVENT_FAILED == 5);
CHECK(event_collider, SGM_EVENT_COLLIDER == 6);
CHECK(event_collider_removed, SGM_EVENT_COLLIDER_REMOVED == 7);
CHECK(brush_sphere, SGM_BRUSH_SPHERE == 0);
CHECK(brush_box, SGM_BRUSH_BOX == 1);
CHECK(brush_capsule, SGM_BRUSH_CAPSULE == 2);
CHECK(brush_shape_force_32_bit, SGM_BRUSH_SHAPE_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(event_kind_force_32_bit, SGM_EVENT_KIND_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(face_count, SGM_FACE_COUNT == 6);
CHECK(face_force, SGM_FACE_FORCE_32_BIT == 0x7FFFFFFF);
CHECK(vertex_own, SGM_VERTEX_OWN == 0);
CHECK(vertex_coarser, SGM_VERTEX_COARSER == 1);
CHECK(vertex_lateral, SGM_VERTEX_LATERAL == 2);
CHECK(vertex_feature, SGM_VERTEX_FEATURE == 0x8000);
CHECK(vertex_force, SGM_VERTEX_KIND_FORCE_32_BIT == 0x7FFFFFFF);

SIZE(sgm_error, 512);
PLACE(sgm_error, code, 0);
PLACE(sgm_error, line, 4);
PLACE(sgm_error, column, 8);
PLACE(sgm_error, message, 12);

SIZE(sgm_chain, 16);
PLACE(sgm_chain, struct_size, 0);
PLACE(sgm_chain, kind, 4);
PLACE(sgm_chain, next, 8);

SIZE(sgm_allocator, 24);
PLACE(sgm_allocator, allocate, 0);
PLACE(sgm_allocator, release, 8);
PLACE(sgm_allocator, user, 16);

SIZE(sgm_job_system, 32);
PLACE(sgm_job_system, concurrency, 0);
PLACE(sgm_job_system, submit, 8);
PLACE(sgm_job_system, help, 16);
PLACE(sgm_job_system, user, 24);

SIZE(sgm_log_sink, 16);
PLACE(sgm_log_sink, write, 0);
PLACE(sgm_log_sink, user, 8);

SIZE(sgm_profiler, 40);
PLACE(sgm_profiler, begin, 0);
PLACE(sgm_profiler, end, 8);
PLACE(sgm_profiler, thread, 16);
PLACE(sgm_profiler, plot, 24);
PLACE(sgm_profiler, user, 32);

SIZE(sgm_runtime_desc, 72);
PLACE(sgm_runtime_desc, struct_size, 0);
PLACE(sgm_runtime_desc, next, 8);
PLACE(sgm_runtime_desc, api_version, 16);
PLACE(sgm_runtime_desc, threads, 20);
PLACE(sgm_runtime_desc, allocator, 24);
PLACE(sgm_runtime_desc, jobs, 32);
PLACE(sgm_runtime_desc, log, 40);
PLACE(sgm_runtime_desc, memory_limit, 48);
PLACE(sgm_runtime_desc, profiler, 56);
PLACE(sgm_runtime_desc, pipeline_folder, 64);

SIZE(sgm_backend_info, 832);
PLACE(sgm_backend_info, struct_size, 0);
PLACE(sgm_backend_info, next, 8);
PLACE(sgm_backend_info, backend, 16);
PLACE(sgm_backend_info, usable, 20);
PLACE(sgm_backend_info, exact, 24);
PLACE(sgm_backend_info, concurrency, 28);
PLACE(sgm_backend_info, name, 32);
PLACE(sgm_backend_info, device, 288);
PLACE(sgm_backend_info, reason, 544);
PLACE(sgm_backend_info, chunks, 800);
PLACE(sgm_backend_info, chunks_on_cpu, 808);
PLACE(sgm_backend_info, losses, 816);
PLACE(sgm_backend_info, resident, 824);

SIZE(sgm_grammar_desc, 64);
PLACE(sgm_grammar_desc, struct_size, 0);
PLACE(sgm_grammar_desc, next, 8);
PLACE(sgm_grammar_desc, text, 16);
PLACE(sgm_grammar_desc, text_size, 24);
PLACE(sgm_grammar_desc, name, 32);
PLACE(sgm_grammar_desc, import_folder, 40);
PLACE(sgm_grammar_desc, import_text, 48);
PLACE(sgm_grammar_desc, import_user, 56);

SIZE(sgm_diagnostic, 64);
PLACE(sgm_diagnostic, struct_size, 0);
PLACE(sgm_diagnostic, next, 8);
PLACE(sgm_diagnostic, severity, 16);
PLACE(sgm_diagnostic, line, 20);
PLACE(sgm_diagnostic, column, 24);
PLACE(sgm_diagnostic, length, 28);
PLACE(sgm_diagnostic, file, 32);
PLACE(sgm_diagnostic, message, 40);
PLACE(sgm_diagnostic, hint, 48);
PLACE(sgm_diagnostic, source_line, 56);

SIZE(sgm_domain_info, 72);
PLACE(sgm_domain_info, struct_size, 0);
PLACE(sgm_domain_info, next, 8);
PLACE(sgm_domain_info, infinite, 16);
PLACE(sgm_domain_info, solid, 20);
PLACE(sgm_domain_info, density, 24);
PLACE(sgm_domain_info, material, 28);
PLACE(sgm_domain_info, cut, 32);
PLACE(sgm_domain_info, minimum, 44);
PLACE(sgm_domain_info, maximum, 56);
PLACE(sgm_domain_info, density_edge, 68);

SIZE(sgm_layer_info, 40);
PLACE(sgm_layer_info, struct_size, 0);
PLACE(sgm_layer_info, next, 8);
PLACE(sgm_layer_info, name, 16);
PLACE(sgm_layer_info, cell_units, 24);
PLACE(sgm_layer_info, reach_units, 36);

SIZE(sgm_parameter_info, 72);
PLACE(sgm_parameter_info, struct_size, 0);
PLACE(sgm_parameter_info, next, 8);
PLACE(sgm_parameter_info, name, 16);
PLACE(sgm_parameter_info, doc, 24);
PLACE(sgm_parameter_info, quantity, 32);
PLACE(sgm_parameter_info, whole, 36);
PLACE(sgm_parameter_info, default_value, 40);
PLACE(sgm_parameter_info, minimum, 48);
PLACE(sgm_parameter_info, maximum, 56);
PLACE(sgm_parameter_info, animated, 64);
PLACE(sgm_parameter_info, reserved, 68);

SIZE(sgm_host_lattice, 28);
PLACE(sgm_host_lattice, origin, 0);
PLACE(sgm_host_lattice, spacing, 12);
PLACE(sgm_host_lattice, count, 16);

SIZE(sgm_host_field, 80);
PLACE(sgm_host_field, struct_size, 0);
PLACE(sgm_host_field, next, 8);
PLACE(sgm_host_field, sample, 16);
PLACE(sgm_host_field, user, 24);
PLACE(sgm_host_field, identity, 32);
PLACE(sgm_host_field, minimum, 40);
PLACE(sgm_host_field, maximum, 52);
PLACE(sgm_host_field, steepness, 64);
PLACE(sgm_host_field, flags, 68);
PLACE(sgm_host_field, material, 72);
PLACE(sgm_host_field, tag, 74);
PLACE(sgm_host_field, smooth, 76);

SIZE(sgm_field_desc, 80);
PLACE(sgm_field_desc, struct_size, 0);
PLACE(sgm_field_desc, next, 8);
PLACE(sgm_field_desc, grammar, 16);
PLACE(sgm_field_desc, parameters, 24);
PLACE(sgm_field_desc, seed, 32);
PLACE(sgm_field_desc, cell_units, 40);
PLACE(sgm_field_desc, backend, 44);
PLACE(sgm_field_desc, cache_bytes, 48);
PLACE(sgm_field_desc, hosts, 56);
PLACE(sgm_field_desc, host_stride, 64);
PLACE(sgm_field_desc, host_count, 72);

SIZE(sgm_sample_desc, 88);
PLACE(sgm_sample_desc, struct_size, 0);
PLACE(sgm_sample_desc, next, 8);
PLACE(sgm_sample_desc, points, 16);
PLACE(sgm_sample_desc, point_stride, 24);
PLACE(sgm_sample_desc, count, 32);
PLACE(sgm_sample_desc, level, 40);
PLACE(sgm_sample_desc, q, 48);
PLACE(sgm_sample_desc, values, 56);
PLACE(sgm_sample_desc, gradients, 64);
PLACE(sgm_sample_desc, materials, 72);
PLACE(sgm_sample_desc, tags, 80);

SIZE(sgm_anchor, 64);
PLACE(sgm_anchor, position, 0);
PLACE(sgm_anchor, rotation, 12);
PLACE(sgm_anchor, kind, 48);
PLACE(sgm_anchor, name, 50);
PLACE(sgm_anchor, tag, 52);
PLACE(sgm_anchor, reserved, 54);
PLACE(sgm_anchor, key, 56);

SIZE(sgm_surface_point, 88);
PLACE(sgm_surface_point, struct_size, 0);
PLACE(sgm_surface_point, next, 8);
PLACE(sgm_surface_point, found, 16);
PLACE(sgm_surface_point, inside, 20);
PLACE(sgm_surface_point, position, 24);
PLACE(sgm_surface_point, normal, 48);
PLACE(sgm_surface_point, distance, 72);
PLACE(sgm_surface_point, material, 80);
PLACE(sgm_surface_point, tag, 82);
PLACE(sgm_surface_point, reserved, 84);

SIZE(sgm_ray_desc, 72);
PLACE(sgm_ray_desc, struct_size, 0);
PLACE(sgm_ray_desc, next, 8);
PLACE(sgm_ray_desc, from, 16);
PLACE(sgm_ray_desc, direction, 40);
PLACE(sgm_ray_desc, length, 64);

SIZE(sgm_closest_desc, 48);
PLACE(sgm_closest_desc, struct_size, 0);
PLACE(sgm_closest_desc, next, 8);
PLACE(sgm_closest_desc, position, 16);
PLACE(sgm_closest_desc, max_distance, 40);

SIZE(sgm_walk_desc, 80);
PLACE(sgm_walk_desc, struct_size, 0);
PLACE(sgm_walk_desc, next, 8);
PLACE(sgm_walk_desc, minimum, 16);
PLACE(sgm_walk_desc, maximum, 28);
PLACE(sgm_walk_desc, radius, 40);
PLACE(sgm_walk_desc, height, 48);
PLACE(sgm_walk_desc, step, 56);
PLACE(sgm_walk_desc, slope, 64);
PLACE(sgm_walk_desc, area, 72);

SIZE(sgm_walkable, 40);
PLACE(sgm_walkable, struct_size, 0);
PLACE(sgm_walkable, next, 8);
PLACE(sgm_walkable, walkable, 16);
PLACE(sgm_walkable, sides, 20);
PLACE(sgm_walkable, standing, 24);
PLACE(sgm_walkable, largest, 32);

SIZE(sgm_way_desc, 144);
PLACE(sgm_way_desc, struct_size, 0);
PLACE(sgm_way_desc, next, 8);
PLACE(sgm_way_desc, from, 16);
PLACE(sgm_way_desc, to, 40);
PLACE(sgm_way_desc, minimum, 64);
PLACE(sgm_way_desc, maximum, 76);
PLACE(sgm_way_desc, radius, 88);
PLACE(sgm_way_desc, flags, 96);
PLACE(sgm_way_desc, reserved, 100);
PLACE(sgm_way_desc, max_chunks, 104);
PLACE(sgm_way_desc, places, 112);
PLACE(sgm_way_desc, place_room, 120);
PLACE(sgm_way_desc, progress, 128);
PLACE(sgm_way_desc, progress_user, 136);

SIZE(sgm_way, 104);
PLACE(sgm_way, struct_size, 0);
PLACE(sgm_way, next, 8);
PLACE(sgm_way, verdict, 16);
PLACE(sgm_way, reserved, 20);
PLACE(sgm_way, place_count, 24);
PLACE(sgm_way, length, 32);
PLACE(sgm_way, from_clearance, 40);
PLACE(sgm_way, to_clearance, 48);
PLACE(sgm_way, widest, 56);
PLACE(sgm_way, from_volume, 64);
PLACE(sgm_way, to_volume, 72);
PLACE(sgm_way, largest_volume, 80);
PLACE(sgm_way, void_count, 88);
PLACE(sgm_way, sealed_count, 96);

SIZE(sgm_chunk_key, 16);
PLACE(sgm_chunk_key, level, 0);
PLACE(sgm_chunk_key, x, 4);
PLACE(sgm_chunk_key, y, 8);
PLACE(sgm_chunk_key, z, 12);

SIZE(sgm_chunk_request, 32);
PLACE(sgm_chunk_request, key, 0);
PLACE(sgm_chunk_request, seams, 16);
PLACE(sgm_chunk_request, coarser, 20);
PLACE(sgm_chunk_request, reserved, 24);

SIZE(sgm_chunks_desc, 64);
PLACE(sgm_chunks_desc, struct_size, 0);
PLACE(sgm_chunks_desc, next, 8);
PLACE(sgm_chunks_desc, requests, 16);
PLACE(sgm_chunks_desc, request_stride, 24);
PLACE(sgm_chunks_desc, count, 32);
PLACE(sgm_chunks_desc, progress, 40);
PLACE(sgm_chunks_desc, progress_user, 48);
PLACE(sgm_chunks_desc, flags, 56);
PLACE(sgm_chunks_desc, reserved, 60);

SIZE(sgm_vertex, 16);
PLACE(sgm_vertex, x, 0);
PLACE(sgm_vertex, y, 2);
PLACE(sgm_vertex, z, 4);
PLACE(sgm_vertex, material, 6);
PLACE(sgm_vertex, normal_x, 8);
PLACE(sgm_vertex, normal_y, 10);
PLACE(sgm_vertex, tag, 12);
PLACE(sgm_vertex, kind, 14);

SIZE(sgm_mesh_range, 24);
PLACE(sgm_mesh_range, first_vertex, 0);
PLACE(sgm_mesh_range, vertex_count, 4);
PLACE(sgm_mesh_range, first_index, 8);
PLACE(sgm_mesh_range, index_count, 12);
PLACE(sgm_mesh_range, hash, 16);

SIZE(sgm_mesh_view, 360);
PLACE(sgm_mesh_view, struct_size, 0);
PLACE(sgm_mesh_view, next, 8);
PLACE(sgm_mesh_view, key, 16);
PLACE(sgm_mesh_view, origin, 32);
PLACE(sgm_mesh_view, cell_units, 44);
PLACE(sgm_mesh_view, bounds_min, 48);
PLACE(sgm_mesh_view, bounds_max, 60);
PLACE(sgm_mesh_view, vertices, 72);
PLACE(sgm_mesh_view, indices, 80);
PLACE(sgm_mesh_view, vertex_count, 88);
PLACE(sgm_mesh_view, vertex_stride, 92);
PLACE(sgm_mesh_view, index_count, 96);
PLACE(sgm_mesh_view, index_stride, 100);
PLACE(sgm_mesh_view, body, 104);
PLACE(sgm_mesh_view, seams, 128);
PLACE(sgm_mesh_view, hash, 272);
PLACE(sgm_mesh_view, anchors, 280);
PLACE(sgm_mesh_view, anchor_count, 288);
PLACE(sgm_mesh_view, anchor_stride, 292);
PLACE(sgm_mesh_view, tags, 296);
PLACE(sgm_mesh_view, tag_count, 304);
PLACE(sgm_mesh_view, batch_count, 308);
PLACE(sgm_mesh_view, batches, 312);
PLACE(sgm_mesh_view, transforms, 320);
PLACE(sgm_mesh_view, morphs, 328);
PLACE(sgm_mesh_view, wedges, 336);
PLACE(sgm_mesh_view, wedge_indices, 344);
PLACE(sgm_mesh_view, wedge_count, 352);
PLACE(sgm_mesh_view, wedge_stride, 356);
SIZE(sgm_wedge, 20);
PLACE(sgm_wedge, vertex, 0);
PLACE(sgm_wedge, u, 4);
PLACE(sgm_wedge, v, 8);
PLACE(sgm_wedge, materials, 12);
PLACE(sgm_wedge, share, 16);
PLACE(sgm_wedge, plane_shares, 17);

SIZE(sgm_region_desc, 72);
PLACE(sgm_region_desc, struct_size, 0);
PLACE(sgm_region_desc, next, 8);
PLACE(sgm_region_desc, minimum, 16);
PLACE(sgm_region_desc, maximum, 28);
PLACE(sgm_region_desc, level, 40);
PLACE(sgm_region_desc, flags, 44);
PLACE(sgm_region_desc, max_chunks, 48);
PLACE(sgm_region_desc, progress, 56);
PLACE(sgm_region_desc, progress_user, 64);

SIZE(sgm_grid_desc, 72);
PLACE(sgm_grid_desc, struct_size, 0);
PLACE(sgm_grid_desc, next, 8);
PLACE(sgm_grid_desc, values, 16);
PLACE(sgm_grid_desc, size, 24);
PLACE(sgm_grid_desc, reserved, 36);
PLACE(sgm_grid_desc, stride_y, 40);
PLACE(sgm_grid_desc, stride_z, 48);
PLACE(sgm_grid_desc, cell, 56);
PLACE(sgm_grid_desc, normals, 64);
PLACE(sgm_grid_desc, reserved2, 68);

SIZE(sgm_measure_desc, 112);
PLACE(sgm_measure_desc, struct_size, 0);
PLACE(sgm_measure_desc, next, 8);
PLACE(sgm_measure_desc, positions, 16);
PLACE(sgm_measure_desc, positions_double, 24);
PLACE(sgm_measure_desc, position_count, 32);
PLACE(sgm_measure_desc, position_stride, 40);
PLACE(sgm_measure_desc, indices, 48);
PLACE(sgm_measure_desc, index_count, 56);
PLACE(sgm_measure_desc, weld, 64);
PLACE(sgm_measure_desc, cubes, 72);
PLACE(sgm_measure_desc, histogram_mode, 80);
PLACE(sgm_measure_desc, histogram_bins, 84);
PLACE(sgm_measure_desc, curvature_length, 88);
PLACE(sgm_measure_desc, flags, 96);
PLACE(sgm_measure_desc, histogram_capacity, 100);
PLACE(sgm_measure_desc, histogram, 104);

SIZE(sgm_measures, 368);
PLACE(sgm_measures, struct_size, 0);
PLACE(sgm_measures, next, 8);
PLACE(sgm_measures, watertight, 16);
PLACE(sgm_measures, valid, 20);
PLACE(sgm_measures, triangles, 24);
PLACE(sgm_measures, points, 32);
PLACE(sgm_measures, welded_points, 40);
PLACE(sgm_measures, non_finite_triangles, 48);
PLACE(sgm_measures, area, 56);
PLACE(sgm_measures, volume, 64);
PLACE(sgm_measures, area_vector, 72);
PLACE(sgm_measures, bounds_min, 96);
PLACE(sgm_measures, bounds_max, 120);
PLACE(sgm_measures, objects, 144);
PLACE(sgm_measures, shells, 152);
PLACE(sgm_measures, euler, 160);
PLACE(sgm_measures, genus, 168);
PLACE(sgm_measures, edges, 176);
PLACE(sgm_measures, open_edges, 184);
PLACE(sgm_measures, turned_edges, 192);
PLACE(sgm_measures, nonmanifold_edges, 200);
PLACE(sgm_measures, nonmanifold_vertices, 208);
PLACE(sgm_measures, degenerate_triangles, 216);
PLACE(sgm_measures, duplicate_triangles, 224);
PLACE(sgm_measures, sliver_triangles, 232);
PLACE(sgm_measures, inside_out_shells, 240);
PLACE(sgm_measures, cavity_shells, 248);
PLACE(sgm_measures, nested_shells, 256);
PLACE(sgm_measures, self_intersections, 264);
PLACE(sgm_measures, self_intersections_complete, 272);
PLACE(sgm_measures, histogram_first, 276);
PLACE(sgm_measures, histogram_bins, 280);
PLACE(sgm_measures, histogram_edges, 288);
PLACE(sgm_measures, histogram_left_out, 296);
PLACE(sgm_measures, flat, 304);
PLACE(sgm_measures, convex, 312);
PLACE(sgm_measures, concave, 320);
PLACE(sgm_measures, cubes_all, 328);
PLACE(sgm_measures, cubes_any, 336);
PLACE(sgm_measures, cubes_centre, 344);
PLACE(sgm_measures, flat_triangles, 352);
PLACE(sgm_measures, folded_triangles, 360);

SIZE(sgm_density_desc, 104);
PLACE(sgm_density_desc, struct_size, 0);
PLACE(sgm_density_desc, next, 8);
PLACE(sgm_density_desc, origin, 16);
PLACE(sgm_density_desc, spacing, 28);
PLACE(sgm_density_desc, size, 32);
PLACE(sgm_density_desc, level, 44);
PLACE(sgm_density_desc, edge, 48);
PLACE(sgm_density_desc, format, 56);
PLACE(sgm_density_desc, reserved, 60);
PLACE(sgm_density_desc, values, 64);
PLACE(sgm_density_desc, row_pitch, 72);
PLACE(sgm_density_desc, slice_pitch, 80);
PLACE(sgm_density_desc, progress, 88);
PLACE(sgm_density_desc, progress_user, 96);

SIZE(sgm_surface_view, 192);
PLACE(sgm_surface_view, struct_size, 0);
PLACE(sgm_surface_view, next, 8);
PLACE(sgm_surface_view, origin, 16);
PLACE(sgm_surface_view, cell_units, 28);
PLACE(sgm_surface_view, extent_min, 32);
PLACE(sgm_surface_view, extent_max, 44);
PLACE(sgm_surface_view, vertex_count, 56);
PLACE(sgm_surface_view, index_count, 64);
PLACE(sgm_surface_view, positions, 72);
PLACE(sgm_surface_view, normals, 80);
PLACE(sgm_surface_view, materials, 88);
PLACE(sgm_surface_view, tags, 96);
PLACE(sgm_surface_view, indices, 104);
PLACE(sgm_surface_view, position_stride, 112);
PLACE(sgm_surface_view, normal_stride, 116);
PLACE(sgm_surface_view, material_stride, 120);
PLACE(sgm_surface_view, tag_stride, 124);
PLACE(sgm_surface_view, bounds_min, 128);
PLACE(sgm_surface_view, bounds_max, 140);
PLACE(sgm_surface_view, chunk_count, 152);
PLACE(sgm_surface_view, wedges, 160);
PLACE(sgm_surface_view, wedge_indices, 168);
PLACE(sgm_surface_view, wedge_count, 176);
PLACE(sgm_surface_view, wedge_stride, 184);
PLACE(sgm_surface_view, reserved, 188);

SIZE(sgm_world_desc, 104);
PLACE(sgm_world_desc, struct_size, 0);
PLACE(sgm_world_desc, next, 8);
PLACE(sgm_world_desc, top_level, 16);
PLACE(sgm_world_desc, flags, 20);
PLACE(sgm_world_desc, finest_distance, 24);
PLACE(sgm_world_desc, view_distance, 32);
PLACE(sgm_world_desc, mesh_bytes, 40);
PLACE(sgm_world_desc, collider_distance, 48);
PLACE(sgm_world_desc, journal, 56);
PLACE(sgm_world_desc, cache_folder, 64);
PLACE(sgm_world_desc, cache_bytes, 72);
PLACE(sgm_world_desc, author, 80);
PLACE(sgm_world_desc, stores, 88);
PLACE(sgm_world_desc, store_count, 96);
PLACE(sgm_world_desc, max_colliders, 100);

SIZE(sgm_viewer, 56);
PLACE(sgm_viewer, position, 0);
PLACE(sgm_viewer, direction, 24);
PLACE(sgm_viewer, velocity, 36);
PLACE(sgm_viewer, fov, 48);
PLACE(sgm_viewer, weight, 52);

SIZE(sgm_world_event, 56);
PLACE(sgm_world_event, kind, 0);
PLACE(sgm_world_event, result, 4);
PLACE(sgm_world_event, key, 8);
PLACE(sgm_world_event, mesh, 24);
PLACE(sgm_world_event, collider, 32);
PLACE(sgm_world_event, seams, 40);
PLACE(sgm_world_event, coarser, 44);
PLACE(sgm_world_event, frame, 48);

SIZE(sgm_collider_view, 88);
PLACE(sgm_collider_view, struct_size, 0);
PLACE(sgm_collider_view, next, 8);
PLACE(sgm_collider_view, key, 16);
PLACE(sgm_collider_view, origin, 32);
PLACE(sgm_collider_view, vertex_count, 44);
PLACE(sgm_collider_view, index_count, 48);
PLACE(sgm_collider_view, positions, 56);
PLACE(sgm_collider_view, indices, 64);
PLACE(sgm_collider_view, materials, 72);
PLACE(sgm_collider_view, hash, 80);

SIZE(sgm_brush, 72);
PLACE(sgm_brush, shape, 0);
PLACE(sgm_brush, cut, 4);
PLACE(sgm_brush, material, 8);
PLACE(sgm_brush, tag, 10);
PLACE(sgm_brush, from, 12);
PLACE(sgm_brush, to, 24);
PLACE(sgm_brush, half, 36);
PLACE(sgm_brush, turn, 48);
PLACE(sgm_brush, radius, 64);
PLACE(sgm_brush, smooth, 68);

SIZE(sgm_edit_id, 16);
PLACE(sgm_edit_id, author, 0);
PLACE(sgm_edit_id, number, 8);

SIZE(sgm_instance_batch, 12);
PLACE(sgm_instance_batch, kind, 0);
PLACE(sgm_instance_batch, name, 2);
PLACE(sgm_instance_batch, first, 4);
PLACE(sgm_instance_batch, count, 8);

SIZE(sgm_drawn_chunk, 32);
PLACE(sgm_drawn_chunk, key, 0);
PLACE(sgm_drawn_chunk, mesh, 16);
PLACE(sgm_drawn_chunk, seams, 24);
PLACE(sgm_drawn_chunk, coarser, 28);

SIZE(sgm_world_stats, 272);
PLACE(sgm_world_stats, struct_size, 0);
PLACE(sgm_world_stats, next, 8);
PLACE(sgm_world_stats, frame, 16);
PLACE(sgm_world_stats, plans, 24);
PLACE(sgm_world_stats, chunks_meshed, 32);
PLACE(sgm_world_stats, finest_meshed, 40);
PLACE(sgm_world_stats, seam_jobs, 48);
PLACE(sgm_world_stats, chunks_in_vain, 56);
PLACE(sgm_world_stats, chunks_failed, 64);
PLACE(sgm_world_stats, stale, 72);
PLACE(sgm_world_stats, queued, 80);
PLACE(sgm_world_stats, in_work, 88);
PLACE(sgm_world_stats, drawn, 96);
PLACE(sgm_world_stats, kept, 104);
PLACE(sgm_world_stats, mesh_bytes, 112);
PLACE(sgm_world_stats, peak_mesh_bytes, 120);
PLACE(sgm_world_stats, detail, 128);
PLACE(sgm_world_stats, idle, 136);
PLACE(sgm_world_stats, reserved, 140);
PLACE(sgm_world_stats, fields_set, 144);
PLACE(sgm_world_stats, field_drawn, 152);
PLACE(sgm_world_stats, chunks_outdated, 160);
PLACE(sgm_world_stats, collider_bytes, 168);
PLACE(sgm_world_stats, edits, 176);
PLACE(sgm_world_stats, edits_state, 184);
PLACE(sgm_world_stats, edits_drawn, 192);
PLACE(sgm_world_stats, cache_hits, 200);
PLACE(sgm_world_stats, cache_misses, 208);
PLACE(sgm_world_stats, cache_damaged, 216);
PLACE(sgm_world_stats, cache_bytes, 224);
PLACE(sgm_world_stats, store_hits, 232);
PLACE(sgm_world_stats, store_misses, 240);
PLACE(sgm_world_stats, store_damaged, 248);
PLACE(sgm_world_stats, store_bytes, 256);
PLACE(sgm_world_stats, rounded_cells, 264);

SIZE(sgm_world_info, 896);
PLACE(sgm_world_info, struct_size, 0);
PLACE(sgm_world_info, next, 8);
PLACE(sgm_world_info, backend, 16);
PLACE(sgm_world_info, cell_units, 848);
PLACE(sgm_world_info, top_level, 852);
PLACE(sgm_world_info, flags, 856);
PLACE(sgm_world_info, threads, 860);
PLACE(sgm_world_info, finest_distance, 864);
PLACE(sgm_world_info, view_distance, 872);
PLACE(sgm_world_info, collider_distance, 880);
PLACE(sgm_world_info, mesh_bytes, 888);

SIZE(sgm_time_histogram, 184);
PLACE(sgm_time_histogram, counts, 0);
PLACE(sgm_time_histogram, sum, 168);
PLACE(sgm_time_histogram, longest, 176);

SIZE(sgm_world_times, 3712);
PLACE(sgm_world_times, struct_size, 0);
PLACE(sgm_world_times, next, 8);
PLACE(sgm_world_times, update, 16);
PLACE(sgm_world_times, poll, 200);
PLACE(sgm_world_times, read, 384);
PLACE(sgm_world_times, mesh, 568);
PLACE(sgm_world_times, clock_seconds, 3696);
PLACE(sgm_world_times, job_seconds, 3704);

SIZE(sgm_chunk_sums, 232);
PLACE(sgm_chunk_sums, bodies, 0);
PLACE(sgm_chunk_sums, seams, 8);
PLACE(sgm_chunk_sums, triangles, 16);
PLACE(sgm_chunk_sums, bytes, 24);
PLACE(sgm_chunk_sums, sliver_triangles, 32);
PLACE(sgm_chunk_sums, against_normals, 40);
PLACE(sgm_chunk_sums, border_edges, 48);
PLACE(sgm_chunk_sums, compared, 56);
PLACE(sgm_chunk_sums, defects, 64);
PLACE(sgm_chunk_sums, area, 192);
PLACE(sgm_chunk_sums, area_vector, 200);
PLACE(sgm_chunk_sums, flux, 224);

SIZE(sgm_world_measures, 496);
PLACE(sgm_world_measures, struct_size, 0);
PLACE(sgm_world_measures, next, 8);
PLACE(sgm_world_measures, drawn, 16);
PLACE(sgm_world_measures, made, 248);
PLACE(sgm_world_measures, measuring_seconds, 480);
PLACE(sgm_world_measures, meshing_seconds, 488);

SIZE(sgm_mesh_measures, 320);
PLACE(sgm_mesh_measures, struct_size, 0);
PLACE(sgm_mesh_measures, next, 8);
PLACE(sgm_mesh_measures, sums, 16);
PLACE(sgm_mesh_measures, vertices, 248);
PLACE(sgm_mesh_measures, edges, 256);
PLACE(sgm_mesh_measures, euler, 264);
PLACE(sgm_mesh_measures, border_edges, 272);

/* Every _INIT macro must initialise its struct, in C and in C++, without a warning. */
int LAYOUT_INITS(void) {
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
