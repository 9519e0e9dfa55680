/* store.h: a scene while it grows.
 *
 *     froe_scene   pointers and counts that all readers use
 *         ^ scene_publish()
 *     scene_store  the growing arrays behind them, and the table that finds equal vertices
 *
 * A call that adds writes behind the published counts and publishes at its end. A call that fails drops its new
 * vertices, and readers have seen nothing of it. The table is made when a small batch comes, and given up when a large
 * one or a tree comes. In corners.c and vertices.c (vertices), bulk.c (the same for large batches), settle.c (objects)
 * and groups.c (groups). */
#ifndef FROE_SCENE_STORE_H
#define FROE_SCENE_STORE_H
#include "scene/match.h"
#include "scene/scene.h"
#include "scene/table.h"
#include "support/array.h"

struct scene_store {
    scene_table table; /**< of the vertices; empty: not made */
    uint32_t vertex_count, object_count, corner_count;
    ARRAY(double) coords;
    ARRAY(uint8_t) kind_of; /**< this and the next three: count 0 while it would say nothing (scene.h) */
    ARRAY(uint8_t) form_of;
    ARRAY(uint32_t) start_of;
    ARRAY(uint32_t) vertex_of;
    ARRAY(double) radii;
    ARRAY(uint64_t) tags; /**< this and the next two: count 0 while all objects have the default */
    ARRAY(uint32_t) faces;
    ARRAY(uint32_t) groups;
    ARRAY(scene_group) group_table;
    ARRAY(char) text;
    num_context context; /**< for polygons; arena taken by the first of them */
    bool context_ready;
    bool trusted; /**< num_machine_trusted() */
    match_plan plan;
};

/** Ids stay below 2^31 - 2. */
#define SCENE_LIMIT 2147483646u
/** Corners are numbered with all 32 bits. */
#define SCENE_CORNER_LIMIT (UINT32_MAX - 1)

/** Is the scene still the caller's to change? FROE_OK or FROE_E_FROZEN. */
froe_status scene_growable(const froe_scene *s, froe_diagnostic *diag);
/** Shows the arrays of the store to the readers of the scene. */
void scene_publish(froe_scene *s);

/** Most points of one scene_vertices_add(). */
#define SCENE_CHUNK 64
/** The vertices of count <= SCENE_CHUNK points (finite, no -0), new ones appended. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status scene_vertices_add(froe_scene *s, const double *points, size_t count, uint32_t *ids);
/** Forgets all vertices from the given count, which are published, on. O(1) expected each. */
void scene_vertices_truncate(froe_scene *s, uint32_t count);
/** Hash of one point. */
uint32_t scene_vertex_tag(const double *point, int dim);
#endif
