/* layout.c: where the members of structs are that the package reads and writes */
#include "web.h"
#include <froe/arrays.h>
#include <froe/formats.h>
#include <froe/query.h>

#define AT(type, member, offset) _Static_assert(offsetof(type, member) == (offset), #type "." #member)
#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type)

AT(froe_diagnostic, status, 0);
AT(froe_diagnostic, object, 4);
AT(froe_diagnostic, corner, 8);
AT(froe_diagnostic, axis, 12);
AT(froe_diagnostic, message, 16);
SIZE(froe_diagnostic, 260);

AT(froe_answers, starts, 0);
AT(froe_answers, ids, 4);
AT(froe_answers, values, 8);
AT(froe_answers, queries, 12);
SIZE(froe_answers, 24);

AT(froe_hit, object, 0);
AT(froe_hit, t, 8);
SIZE(froe_hit, 16);

AT(froe_pair, a, 0);
AT(froe_pair, b, 4);
AT(froe_pair, kind, 8);
SIZE(froe_pair, 12);
AT(froe_pairs, pairs, 0);
AT(froe_pairs, count, 4);
SIZE(froe_pairs, 16);

AT(froe_scene_arrays, dim, 0);
AT(froe_scene_arrays, object_count, 4);
AT(froe_scene_arrays, vertex_count, 8);
AT(froe_scene_arrays, corner_count, 12);
AT(froe_scene_arrays, coords, 16);
AT(froe_scene_arrays, kinds, 20);
AT(froe_scene_arrays, forms, 24);
AT(froe_scene_arrays, starts, 28);
AT(froe_scene_arrays, corners, 32);
AT(froe_scene_arrays, radii, 36);
AT(froe_scene_arrays, tags, 40);
AT(froe_scene_arrays, faces, 44);
AT(froe_scene_arrays, groups, 48);
SIZE(froe_scene_arrays, 60);

AT(froe_piece_arrays, dim, 0);
AT(froe_piece_arrays, count, 4);
AT(froe_piece_arrays, corner_count, 8);
AT(froe_piece_arrays, objects, 12);
AT(froe_piece_arrays, nodes, 16);
AT(froe_piece_arrays, whole, 20);
AT(froe_piece_arrays, starts, 24);
AT(froe_piece_arrays, coords, 28);
AT(froe_piece_arrays, made, 32);
SIZE(froe_piece_arrays, 44);

AT(froe_cell_arrays, count, 4);
AT(froe_cell_arrays, face_count, 8);
AT(froe_cell_arrays, corner_count, 12);
AT(froe_cell_arrays, nodes, 16);
AT(froe_cell_arrays, depths, 20);
AT(froe_cell_arrays, faces, 24);
AT(froe_cell_arrays, starts, 28);
AT(froe_cell_arrays, coords, 32);
SIZE(froe_cell_arrays, 44);

AT(web_bytes, at, 0);
AT(web_bytes, count, 4);
SIZE(web_bytes, 16);

AT(froe_group, name, 0);
AT(froe_group, material, 4);
AT(froe_group, left, 8);
AT(froe_group, right, 12);
AT(froe_group, colour, 16);
SIZE(froe_group, 20);

AT(froe_method_info, name, 0);
AT(froe_method_info, summary, 4);
AT(froe_method_info, source, 8);
AT(froe_method_info, guarantee, 12);
AT(froe_method_info, leaf, 52);
AT(froe_method_info, options, 60);

AT(froe_option_info, name, 0);
AT(froe_option_info, summary, 4);
AT(froe_option_info, standard, 8);
AT(froe_option_info, lo, 16);
AT(froe_option_info, hi, 24);
AT(froe_option_info, choices, 32);
AT(froe_option_info, whole, 36);
SIZE(froe_option_info, 40);

AT(froe_promise, name, 0);
AT(froe_promise, promised, 8);
AT(froe_promise, measured, 16);

AT(froe_generator_info, name, 0);
AT(froe_generator_info, dim, 4);
AT(froe_generator_info, kind, 8);
AT(froe_generator_info, summary, 12);
AT(froe_generator_info, usual, 16);

AT(froe_motion_generator_info, name, 0);
AT(froe_motion_generator_info, dim, 4);
AT(froe_motion_generator_info, summary, 8);
AT(froe_motion_generator_info, usual, 12);

AT(froe_defects, size, 0);
AT(froe_defects, zero_length, 8);
AT(froe_defects, overlaps, 48);
AT(froe_defects, first_crossing, 56);
AT(froe_defects, first_t_junction, 64);
AT(froe_defects, first_overlap, 72);
SIZE(froe_defects, 80);

AT(froe_query_stats, queries, 0);
AT(froe_query_stats, steps, 48);
SIZE(froe_query_stats, 96);

AT(froe_hit_place, point, 0);
AT(froe_hit_place, normal, 64);
AT(froe_hit_place, distance, 128);
SIZE(froe_hit_place, 136);

AT(froe_motion_options, dim, 4);
AT(froe_motion_options, begin, 8);
AT(froe_motion_options, end, 16);
AT(froe_motion_options, tick, 24);
SIZE(froe_motion_options, 32);

AT(froe_moving_object, vertices, 0);
AT(froe_moving_object, birth, 16);
AT(froe_moving_object, death, 24);
AT(froe_moving_object, group, 32);
AT(froe_moving_object, tag, 40);
SIZE(froe_moving_object, 48);

AT(froe_contact, a, 0);
AT(froe_contact, b, 4);
AT(froe_contact, begin, 8);
AT(froe_contact, end, 24);
AT(froe_contact, instant, 40);
AT(froe_contact, since_start, 41);
AT(froe_contact, to_stop, 42);
SIZE(froe_contact, 48);

AT(froe_event, kind, 0);
AT(froe_event, objects, 4);
AT(froe_event, object_count, 20);
AT(froe_event, edges, 24);
AT(froe_event, edge_count, 40);
AT(froe_event, tick, 48);
AT(froe_event, early, 56);
AT(froe_event, late, 64);
SIZE(froe_event, 72);

AT(froe_kinetic_place, on, 0);
AT(froe_kinetic_place, above, 4);
AT(froe_kinetic_place, below, 8);
SIZE(froe_kinetic_place, 12);

AT(froe_snapshot, tree, 0);
AT(froe_snapshot, rounded, 8);
AT(froe_snapshot, alike, 12);
SIZE(froe_snapshot, 48);
