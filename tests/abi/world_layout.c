/*
 * Checks, at compile time, sizes and offsets of sgm.h's structs of streamed worlds, on machines with 64-bit pointers.
 */
#include <sgm/sgm.h>

#include "layout.h"

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
