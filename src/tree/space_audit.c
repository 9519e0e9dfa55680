/* space_audit.c: is what a block of space says of an object true?
 *
 * Boxes. What an object has in the cell must lie in the box told: so it must not meet the rest of the cell, which is up
 * to six boxes. That is decided exactly; the sides of the box are moved out by the 2^-10 of a unit that searches allow
 * for, and by what doubles cannot tell apart. */
#include "geom/meet.h"
#include "tree/space.h"
#include <math.h>

typedef struct space_cell {
    double lo[3], hi[3];
} space_cell;

/* Does the object meet a part of the cell? */
static bool meets(num_context *context, const froe_scene *s, uint32_t object, const double corners[6]) {
    double lo[3], hi[3];
    scene_object_bounds(s, object, lo, hi);
    for (int k = 0; k < 3; k++)
        if (lo[k] > corners[3 + k] || hi[k] < corners[k]) return false;
    geom_convex box = {.core = GEOM_CORE_BOX, .dim = 3, .count = 8, .coords = corners};
    geom_convex set = {.dim = 3, .coords = s->coords, .ids = s->corners + s->starts[object]};
    set.count = scene_corners(s, object);
    if (scene_form(s, object) == FROE_BALL) set.count = 1, set.radius = scene_radius(s, object);
    if (scene_form(s, object) == FROE_BOX) set.core = GEOM_CORE_BOX, set.count = 8;
    return geom_meet(context, &set, &box);
}

static bool within(num_context *context, const froe_tree *t, const space_header *h, const space_cell *cell,
                   uint32_t object, const uint16_t lo[3], const uint16_t hi[3]) {
    for (int k = 0; k < 3; k++) {
        double slack = 0x1p-50 * (fabs(cell->lo[k]) + fabs(cell->hi[k]));
        double low = h->lo[k] + (lo[k] - 0x1p-10) / h->scale - slack;
        double high = h->lo[k] + (hi[k] + 0x1p-10) / h->scale + slack;
        for (int upper = 0; upper < 2; upper++) {
            double c[6] = {cell->lo[0], cell->lo[1], cell->lo[2], cell->hi[0], cell->hi[1], cell->hi[2]};
            c[upper ? k : 3 + k] = upper ? high : low;
            if (c[k] <= c[3 + k] && meets(context, t->scene, object, c)) return false;
        }
    }
    return true;
}

/* Corner c of triangle i. */
static bool corner_fits(const space_header *h, uint32_t i, int c, const double *x) {
    for (int k = 0; k < 3; k++)
        if (!(fabs((x[k] - h->lo[k]) * h->scale - space_row(h, 3 * c + k)[i]) <= 0.5 + 0x1p-20)) return false;
    return true;
}

const char *space_refuted(num_context *context, const froe_tree *t, uint32_t piece) {
    space_cell cell;
    const tree_node *leaf = t->nodes + packed_leaf_in(t, piece, cell.lo, cell.hi);
    const space_header *h = space_block(t, leaf->child);
    const uint32_t i = piece - leaf->u.list.first, id = space_ids(h)[i], object = id & PACKED_OBJECT;
    uint16_t box[2][3];
    double lo[3], hi[3];
    scene_object_bounds(t->scene, object, lo, hi);
    for (int k = 0; k < 3; k++)
        if (lo[k] > cell.hi[k] || hi[k] < cell.lo[k]) return "a piece where the object is not";
    if (h->scale == 0) return NULL;
    bool triangle = i < h->triangles;
    for (int c = 0; triangle && c < 3; c++)
        if (!corner_fits(h, i, c, scene_point(t->scene, object, (uint32_t)c))) return "a triangle with wrong units";
    for (int k = 0; k < 3; k++) {
        box[0][k] = triangle ? h->box[0][k] : space_row(h, k)[i];
        box[1][k] = triangle ? h->box[1][k] : space_row(h, 3 + k)[i];
        if (box[0][k] < h->box[0][k] || box[1][k] > h->box[1][k]) return "a box outside the box of its leaf";
    }
    return within(context, t, h, &cell, object, box[0], box[1]) ? NULL : "a box that the object leaves";
}
