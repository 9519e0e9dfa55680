/* trace_cell.c: does a solid meet an open cell, in which none of its corners need lie?
 *
 *        /  cut             The cell is an intersection of halfspaces n . x < c, but for cuts that do not divide the
 *     .-/-----.             solid. Axis-parallel cuts and separating planes have n and c as doubles. So that closed
 *     |/ solid|             sets can be compared, every c is moved inwards to the next double: what a solid has in
 *     /-------'----- cut    that margin alone is not asked for. */
#include "geom/meet/meet.h"
#include "geom/polytope.h"
#include "scene/convex.h"
#include "tree/audit/trace.h"
#include <math.h>

typedef struct trace_cell {
    trace *t;
    ARRAY(double) normals, offsets;
    bool known; /* has every cut that matters a normal? */
} trace_cell;

/* The child below which a node lies, or which it is: numbers below the positive child begin with those of its children.
 */
static uint32_t step_towards(const froe_tree *t, uint32_t from, uint32_t node) {
    const uint32_t positive = t->nodes[from].child + 1;
    const bool below = !tree_is_leaf(t->nodes + positive) && node >= t->nodes[positive].child;
    return node == positive || below ? positive : positive - 1;
}

static bool divides(trace *t, const geom_plane *plane) {
    const froe_scene *s = t->tree->scene;
    const geom_convex solid = scene_convex(s, t->object);
    if (solid.radius > 0) return geom_side_ball(&t->context, plane, geom_convex_point(&solid, 0), solid.radius) == 2;
    unsigned reached = 0;
    for (uint32_t i = 0; i < solid.count && reached != 3; i++) {
        double x[3] = {0};
        for (int k = 0; k < s->dim; k++) x[k] = geom_convex_coordinate(&solid, i, k);
        const int side = geom_side_vertex(&t->context, plane, x);
        if (side) reached |= side > 0 ? 2 : 1;
    }
    return reached == 3;
}

/* The halfspace on one side of a cut. False without memory. */
static bool add_side(trace_cell *c, const froe_cut *cut, int side) {
    const froe_allocator *alloc = &c->t->alloc;
    const int dim = c->t->tree->scene->dim;
    bool room = true;
    for (int k = 0; k < dim; k++) {
        const double n = cut->kind == FROE_CUT_AXIS ? k == cut->axis : cut->normal[k];
        room = room && array_push(alloc, &c->normals, side < 0 ? n : -n);
    }
    const double offset = side < 0 ? cut->value : -cut->value;
    return room && array_push(alloc, &c->offsets, nextafter(offset, -(double)INFINITY));
}

static bool gather_cell_planes(trace_cell *c, uint32_t leaf) {
    const froe_tree *t = c->t->tree;
    bool room = true;
    for (uint32_t node = 0, next; c->known && room && node != leaf; node = next) {
        next = step_towards(t, node, leaf);
        const froe_cut cut = tree_cut_at(t, node);
        if (!divides(c->t, trace_plane(c->t, node))) continue;
        c->known = cut.kind == FROE_CUT_AXIS || cut.kind == FROE_CUT_PLANE;
        if (c->known) room = add_side(c, &cut, next == t->nodes[node].child ? -1 : 1);
    }
    return room;
}

static froe_status compare(trace_cell *c, bool *meets) {
    trace *t = c->t;
    const froe_scene *s = t->tree->scene;
    const geom_convex solid = scene_convex(s, t->object);
    geom_polytope cell = {.error = 0};
    double lo[3], hi[3];
    scene_object_bounds(s, t->object, lo, hi);
    const bool made = geom_polytope_make(&t->context, &t->alloc, s->dim, c->normals.data, c->offsets.data,
                                         c->offsets.count, lo, hi, &cell) &&
                      !num_arena_reserve(&t->alloc, &t->context.arena, geom_meet_arena);
    const geom_convex set = geom_polytope_convex(&cell, s->dim);
    if (made) *meets = set.count && geom_meet(&t->context, &solid, &set);
    geom_polytope_free(&cell, &t->alloc);
    return made ? FROE_OK : FROE_E_MEMORY;
}

froe_status trace_cell_meets(trace *t, uint32_t leaf, bool *meets) {
    trace_cell c = {.t = t, .known = t->tree->scene->dim <= 3};
    froe_status status = gather_cell_planes(&c, leaf) ? FROE_OK : FROE_E_MEMORY;
    if (!status && c.known) status = compare(&c, meets);
    array_free(&t->alloc, &c.normals);
    array_free(&t->alloc, &c.offsets);
    return status;
}
