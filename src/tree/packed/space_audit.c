/* space_audit.c: is what a block of space stores of an object right?
 *
 *     |   |<-- stored -->|   |      No point of the object in the cell may lie outside of the box stored, by more than
 *     |   | .----------. |   |      2^-20 units: it must not meet the rest of the cell, which is up to six boxes.
 *     |   | |  object  | |   |      Searches rely on it. Of boxes and points they rely on more: the box stored is
 *     |   | '----------' |   |      the object's own, less than a unit and 2^-20 larger on each side.
 *    cell                  cell
 *
 * The sides of boxes are exact numbers; where one is no double the next double further out stands for it. Between the
 * two lies no coordinate of a vertex, a cut or a window. */
#include "geom/meet/meet.h"
#include "scene/convex.h"
#include "tree/packed/space.h"
#include <math.h>

typedef struct audited_cell {
    double lo[3], hi[3];
} audited_cell;

/* The sign of (x - lo) scale - unit. */
static int beside(num_context *context, const space_header *h, int k, double x, double unit) {
    num_arena *arena = &context->arena;
    arena->top = 0;
    const num_dyadic off = num_dyadic_sub(arena, num_dyadic_from(arena, x), num_dyadic_from(arena, h->lo[k]));
    return num_dyadic_compare(num_dyadic_mul(arena, off, num_dyadic_from(arena, h->scale)),
                              num_dyadic_from(arena, unit));
}

/* The double next to lo + unit / scale: the last one that is less, or the first that is greater. The scale is a power
 * of 2, so the sum is rounded once, and one step away at most. */
static double outside(num_context *context, const space_header *h, int k, double unit, int direction) {
    double x = h->lo[k] + unit / h->scale;
    const double end = direction < 0 ? -(double)INFINITY : (double)INFINITY;
    while (isfinite(x) && beside(context, h, k, x, unit) * direction <= 0) x = nextafter(x, end);
    return x;
}

/* Is nothing of the object in the cell outside of the box? */
static bool is_within_cell(num_context *context, const froe_tree *t, const space_header *h, const audited_cell *cell,
                           uint32_t object, const uint16_t box[2][3]) {
    const geom_convex set = scene_convex(t->scene, object);
    double least[3], most[3];
    scene_object_bounds(t->scene, object, least, most);
    for (int k = 0; k < 3; k++) {
        const double low = outside(context, h, k, box[0][k] - 0x1p-20, -1);
        const double high = outside(context, h, k, box[1][k] + 0x1p-20, 1);
        for (int upper = 0; upper < 2; upper++) {
            double c[6] = {cell->lo[0], cell->lo[1], cell->lo[2], cell->hi[0], cell->hi[1], cell->hi[2]};
            c[upper ? k : 3 + k] = upper ? high : low;
            bool apart = c[k] > c[3 + k];
            for (int i = 0; i < 3; i++) apart = apart || least[i] > c[3 + i] || most[i] < c[i];
            const geom_convex outer = {.core = GEOM_CORE_BOX, .dim = 3, .count = 8, .coords = c};
            if (!apart && geom_meet(context, &set, &outer)) return false;
        }
    }
    return true;
}

const char *space_refuted(num_context *context, const froe_tree *t, uint32_t piece) {
    audited_cell cell;
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
    for (int c = 0; triangle && c < 9; c++) {
        const double x = scene_point(t->scene, object, (uint32_t)c / 3)[c % 3], unit = space_row(h, c)[i];
        if (!(fabs((x - h->lo[c % 3]) * h->scale - unit) <= 0.5 + 0x1p-20)) return "a triangle with wrong units";
    }
    for (int k = 0; k < 3; k++) {
        box[0][k] = triangle ? h->box[0][k] : space_row(h, k)[i];
        box[1][k] = triangle ? h->box[1][k] : space_row(h, 3 + k)[i];
        if (box[0][k] < h->box[0][k] || box[1][k] > h->box[1][k]) return "a box outside the box of its leaf";
    }
    for (int k = 0; id & SPACE_EXACT && k < 3; k++) { /* the part in the cell is a box, too */
        const double from = lo[k] > cell.lo[k] ? lo[k] : cell.lo[k], to = hi[k] < cell.hi[k] ? hi[k] : cell.hi[k];
        if (beside(context, h, k, from, box[0][k] + 1 + 0x1p-20) > 0 ||
            beside(context, h, k, to, box[1][k] - 1 - 0x1p-20) < 0)
            return "a box larger than the object";
    }
    return is_within_cell(context, t, h, &cell, object, (const uint16_t(*)[3])box) ? NULL
                                                                                   : "a box that the object leaves";
}
