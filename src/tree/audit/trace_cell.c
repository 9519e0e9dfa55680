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
#include <string.h>

typedef struct trace_cell {
    tree_trace *t;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /* the solid's bounding box, within the cuts and walls across an axis */
    ARRAY(double) normals, offsets;
} trace_cell;

static bool divides(tree_trace *t, const geom_plane *plane, const geom_convex *solid) {
    if (solid->radius > 0) return geom_side_ball(&t->context, plane, geom_convex_point(solid, 0), solid->radius) == 2;
    unsigned reached = 0;
    for (uint32_t i = 0; i < solid->count && reached != 3; i++) {
        double x[FROE_MAX_DIM] = {0};
        for (int k = 0; k < t->tree->scene->dim; k++) x[k] = geom_convex_coordinate(solid, i, k);
        const int side = geom_side_vertex(&t->context, plane, x);
        if (side) reached |= side > 0 ? 2 : 1;
    }
    return reached == 3;
}

/* Keeps what is on one side of a plane, as n' . x <= c' for the image n' of its normal (turned outwards). The double c'
 * is such that within the box this holds only on that open side. Through points o it is n' . o less the sum of
 * |n - n'| |x - o|. It is -infinity or no number where nothing is certain of the image. False without memory. */
static bool keep_side(trace_cell *c, const geom_plane *plane, int side) {
    const froe_allocator *alloc = &c->t->alloc;
    num_ball at = {plane->c, plane->c_err};
    for (int k = 0; k < plane->dim && (geom_has_points(plane) || plane->form == GEOM_FINE); k++) {
        const double o = geom_has_points(plane) ? plane->p[0][k] : 0;
        const double reach = fmax(fabs(c->lo[k] - o), fabs(c->hi[k] - o)) * NUM_BALL_UP;
        at = num_ball_add(at, num_ball_mul(num_ball_from(plane->n[k]), num_ball_from(o)));
        at = num_ball_add(at, num_ball_mul((num_ball){0, plane->n_err}, (num_ball){0, reach}));
    }
    const double offset = nextafter(side < 0 ? at.x - at.e : -at.x - at.e, -(double)INFINITY);
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

froe_status trace_cell_meets(tree_trace *t, uint32_t leaf, bool *meets) {
    const froe_scene *s = t->tree->scene;
    const tree_node *nodes = t->tree->nodes;
    trace_cell c = {.t = t};
    bool room = true, certain = true;
    const geom_convex solid = scene_convex(s, t->object);
    scene_object_bounds(s, t->object, c.lo, c.hi);
    for (uint32_t node = 0, next; room && node != leaf; node = next) {
        const geom_plane *plane = trace_plane(t, node);
        /* numbers below the positive child begin with those of its children */
        const uint32_t positive = nodes[node].child + 1;
        const bool below = !tree_is_leaf(nodes + positive) && leaf >= nodes[positive].child;
        next = leaf == positive || below ? positive : positive - 1;
        if (!divides(t, plane, &solid)) continue;
        if (s->dim > 3 && plane->form != GEOM_AXIS) return FROE_OK; /* only boxes are compared there */
        room = keep_side(&c, plane, next == positive ? 1 : -1);
    }
    /* nothing is certain of an empty box, nor where a halfspace is too rough */
    for (int k = 0; k < s->dim; k++) certain = certain && c.lo[k] <= c.hi[k];
    for (size_t i = 0; room && i < c.offsets.count; i++) certain = certain && isfinite(c.offsets.data[i]);
    if (certain && s->dim > 3) {
        double ends[2 * FROE_MAX_DIM];
        memcpy(ends, c.lo, (size_t)s->dim * sizeof *ends);
        memcpy(ends + s->dim, c.hi, (size_t)s->dim * sizeof *ends);
        const geom_convex box = {.core = GEOM_CORE_BOX, .dim = s->dim, .count = 1u << s->dim, .coords = ends};
        *meets = geom_meet(&t->context, &solid, &box);
    } else if (room && certain) {
        geom_polytope cell = {.error = 0};
        room = geom_polytope_make(&t->context, &t->alloc, s->dim, c.normals.data, c.offsets.data, c.offsets.count, c.lo,
                                  c.hi, &cell);
        const geom_convex set = geom_polytope_convex(&cell, s->dim);
        if (room) *meets = set.count && geom_meet(&t->context, &solid, &set);
        geom_polytope_free(&cell, &t->alloc);
    }
    array_free(&t->alloc, &c.normals);
    array_free(&t->alloc, &c.offsets);
    return room ? FROE_OK : FROE_E_MEMORY;
}
