/* surface.h: patches and edges, the parts of the polygons of a scene that pictures are made of, and what else these
 * show: wires and points.
 *
 *      +-----------+-----------+         one patch of three triangles; edges inside it (dotted) are no
 *      |         . |  other    |         lines of any picture
 *      |   .  `    |  group,   |
 *      | `  patch  |  other    |         edge_of[corner of the scene]  ->  vertices[2 e], [2 e + 1]
 *      +-----------+-----------+         uses[edge_starts[e] .. edge_starts[e+1])  ->  corners of the scene
 *
 * A wire is a segment of the scene. Its number as a line, which sightlines, stretches and intervals use, comes after
 * those of the edges: line edge_count + i is wire i, from its first corner to its second.
 *
 * It speaks for surface.c (the public calls), edges.c and patches.c (how these are found). */
#ifndef FROE_VIEW_VISIBILITY_SURFACE_H
#define FROE_VIEW_VISIBILITY_SURFACE_H
#include "num/context.h"
#include "scene/scene.h"
#include <froe/view.h>

struct froe_surface {
    froe_allocator alloc;
    const froe_scene *scene;
    uint32_t edge_count, patch_count, use_count, member_count, wire_count, point_count;
    uint32_t *edge_of;      /**< per corner of the scene, the edge that leaves it; FROE_NONE */
    uint32_t *vertices;     /**< two a line: of an edge ascending */
    uint32_t *wires;        /**< objects */
    uint32_t *points;       /**< objects */
    uint32_t *edge_starts;  /**< edge_count + 1 */
    uint32_t *uses;         /**< objects */
    uint8_t *inside;        /**< per edge: a patch goes on across it; not where it only overlaps itself */
    uint32_t *patch_of;     /**< per object; FROE_NONE */
    uint32_t *patch_starts; /**< patch_count + 1 */
    uint32_t *members;      /**< objects */
    uint8_t *straight;      /**< per corner of the scene: its polygon goes straight on there */
};

static inline bool surface_has(const froe_surface *s, uint32_t object) {
    return s->patch_of[object] != FROE_NONE;
}
/** Edges and wires. */
static inline size_t surface_line_count(const froe_surface *s) {
    return (size_t)s->edge_count + s->wire_count;
}
/** The object whose supporting plane stands for the patch. */
static inline uint32_t surface_first(const froe_surface *s, uint32_t patch) {
    return s->members[s->patch_starts[patch]];
}
/** Does a polygon run along its edge from the lower vertex to the higher? */
bool surface_ascends(const froe_surface *s, uint32_t object, uint32_t edge);
/** Finds all edges, wires and points. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status surface_find_edges(froe_surface *surface);
/** Finds all patches, when the edges are there. FROE_E_MEMORY. */
froe_status surface_find_patches(froe_surface *surface, num_context *context);
#endif
