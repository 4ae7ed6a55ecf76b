/*
 * Checks, at compile time, sizes and offsets of sgm.h's structs of the runtime, of grammars, fields and queries, on
 * machines with 64-bit pointers.
 */
#include <sgm/sgm.h>

#include "layout.h"

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
