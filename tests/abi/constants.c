/*
 * Checks, at compile time, every constant of sgm/sgm.h and the sizes of its enums. So a change that breaks programs built
 * with the header of an earlier patch version does not compile.
 */
#include <sgm/sgm.h>

#include "layout.h"

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
