/* layout.c: where the members of structs are that package/core.js reads and writes */
#include <froe/arrays.h>
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
