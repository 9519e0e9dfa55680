/* trace_cell.c: does a solid meet an open cell, in which none of its corners need lie?
 *
 *        /  cut             The cell is an intersection of open halfspaces n . x < c, but for cuts that do not divide
 *     .-/-----.             the solid. It is compared as a closed set of halfspaces n' . x <= c' of doubles, each of
 *     |/ solid|             which lies within the true one as far as the solid's bounding box goes. Where n is given
 *     /-------'----- cut    as doubles, n' = n and c' is the next double inwards; where a cut runs through vertices,
 *                           n' is the image of n, and c' is moved by what n' may be wrong. So what is found is there;
 *                           what a solid has in that margin alone is not asked for. */
#include "geom/formulas.h"
#include "geom/meet/meet.h"
#include "geom/polytope.h"
#include "scene/convex.h"
#include "tree/audit/trace.h"
#include <math.h>

typedef struct trace_cell {
    trace *t;
    double lo[3], hi[3]; /* the solid's bounding box, within the cuts and walls across an axis */
    ARRAY(double) normals, offsets;
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

/* A double c' such that n' . x <= c' within the box holds only on that open side of the plane, for the image n' of its
 * normal (turned outwards). Through points o it is n' . o less the sum of |n - n'| |x - o|. -infinity or no number where
 * nothing is certain of the image. */
static double inner_offset(const trace_cell *c, const geom_plane *plane, int side) {
    num_ball at = {plane->c, plane->c_err};
    for (int k = 0; k < plane->dim && geom_has_points(plane); k++) {
        const double o = plane->p[0][k], reach = fmax(fabs(c->lo[k] - o), fabs(c->hi[k] - o)) * NUM_BALL_UP;
        at = num_ball_add(at, num_ball_mul(num_ball_from(plane->n[k]), num_ball_from(o)));
        at = num_ball_add(at, num_ball_mul((num_ball){0, plane->n_err}, (num_ball){0, reach}));
    }
    return nextafter(side < 0 ? at.x - at.e : -at.x - at.e, -(double)INFINITY);
}

/* Keeps what is on one side of a plane. False without memory. */
static bool keep_side(trace_cell *c, const geom_plane *plane, int side) {
    const froe_allocator *alloc = &c->t->alloc;
    const double offset = inner_offset(c, plane, side);
    if (plane->form <= GEOM_AT_CROSSING) {
        if (side < 0) c->hi[plane->axis] = fmin(c->hi[plane->axis], offset);
        if (side > 0) c->lo[plane->axis] = fmax(c->lo[plane->axis], -offset);
        return true;
    }
    bool room = true;
    for (int k = 0; k < plane->dim; k++)
        room = room && array_push(alloc, &c->normals, side < 0 ? plane->n[k] : -plane->n[k]);
    return room && array_push(alloc, &c->offsets, offset);
}

static bool gather_cell_planes(trace_cell *c, uint32_t leaf) {
    const froe_tree *t = c->t->tree;
    bool room = true;
    for (uint32_t node = 0, next; room && node != leaf; node = next) {
        const geom_plane *plane = trace_plane(c->t, node);
        next = step_towards(t, node, leaf);
        if (divides(c->t, plane)) room = keep_side(c, plane, next == t->nodes[node].child ? -1 : 1);
    }
    return room;
}

/* Is the box empty, or a halfspace of which nothing is certain? */
static bool nothing_certain(const trace_cell *c) {
    bool nothing = false;
    for (int k = 0; k < c->t->tree->scene->dim; k++) nothing |= !(c->lo[k] <= c->hi[k]);
    for (size_t i = 0; i < c->offsets.count; i++) nothing |= !isfinite(c->offsets.data[i]);
    return nothing;
}

static froe_status compare(trace_cell *c, bool *meets) {
    trace *t = c->t;
    const froe_scene *s = t->tree->scene;
    const geom_convex solid = scene_convex(s, t->object);
    geom_polytope cell = {.error = 0};
    const bool made = geom_polytope_make(&t->context, &t->alloc, s->dim, c->normals.data, c->offsets.data,
                                         c->offsets.count, c->lo, c->hi, &cell) &&
                      !num_arena_reserve(&t->alloc, &t->context.arena, geom_meet_arena);
    const geom_convex set = geom_polytope_convex(&cell, s->dim);
    if (made) *meets = set.count && geom_meet(&t->context, &solid, &set);
    geom_polytope_free(&cell, &t->alloc);
    return made ? FROE_OK : FROE_E_MEMORY;
}

froe_status trace_cell_meets(trace *t, uint32_t leaf, bool *meets) {
    trace_cell c = {.t = t};
    if (t->tree->scene->dim > 3) return FROE_OK;
    scene_object_bounds(t->tree->scene, t->object, c.lo, c.hi);
    froe_status status = gather_cell_planes(&c, leaf) ? FROE_OK : FROE_E_MEMORY;
    if (!status && !nothing_certain(&c)) status = compare(&c, meets);
    array_free(&t->alloc, &c.normals);
    array_free(&t->alloc, &c.offsets);
    return status;
}
