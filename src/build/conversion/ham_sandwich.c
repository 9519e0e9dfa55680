/* ham_sandwich.c: medians on both sides of a line, and the line through both. */
#include "build/conversion/ham_sandwich.h"
#include "geom/predicates.h"
#include <math.h>
#include <string.h>

enum { BISECTIONS = 40 };

/** A vertex beside the line that divides its set: how far from it, how far along it; and a key for medians. */
typedef struct ham_point {
    uint32_t vertex;
    double beside, along, key;
} ham_point;

/** An inner node whose cut is known; its points are on top of all others. */
typedef struct ham_cell {
    uint32_t node, count;
} ham_cell;

typedef struct ham {
    point_tree *tree;
    num_context *context;
    ARRAY(ham_cell) cells;
    ARRAY(uint32_t) points;
    ARRAY(ham_point) side[2]; /* of the cell at hand */
} ham;

/* ----------------------------------------------------------------- medians -- */

/** The point in the middle by key; quickselect (Hoare 1961) with the middle as pivot. */
static const ham_point *median(ham_point *p, size_t count) {
    size_t low = 0, high = count - 1, middle = count / 2;
    while (low < high) {
        double pivot = p[low + (high - low) / 2].key;
        size_t i = low, j = high;
        while (i <= j) {
            while (p[i].key < pivot) i++;
            while (p[j].key > pivot) j--;
            if (i > j) break;
            ham_point swap = p[i];
            p[i++] = p[j];
            p[j] = swap;
            if (!j--) break;
        }
        if (j != SIZE_MAX && middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            break; /* between both: equal to the pivot */
    }
    return p + middle;
}

/** The line y = slope x + b that halves a set, where x is the distance from the dividing line. */
static const ham_point *halving(ham_point *p, size_t count, double slope) {
    for (size_t i = 0; i < count; i++) {
        double key = p[i].along - slope * p[i].beside;
        p[i].key = key == key ? key : 0; /* beyond the range of doubles */
    }
    return median(p, count);
}

/** Turns the line until both sets are halved. The set below the dividing line has beside < 0. */
static froe_cut sandwich(ham *h) {
    double low = -1, high = 1;
    froe_cut cut = {.kind = FROE_CUT_VERTICES};
    for (int turn = 0; turn < BISECTIONS; turn++) {
        double s = 0.5 * low + 0.5 * high, slope = s / (1 - fabs(s));
        const ham_point *p = halving(h->side[0].data, h->side[0].count, slope);
        const ham_point *q = halving(h->side[1].data, h->side[1].count, slope);
        cut.id[0] = p->vertex;
        cut.id[1] = q->vertex;
        if (p->key == q->key) break;
        *(p->key < q->key ? &low : &high) = s; /* the median of the side below rises with the slope */
    }
    return cut;
}

/** Halves one set, across the axis on which it is wider. */
static froe_cut halve_points(const ham *h, ham_point *p, size_t count) {
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            double x = scene_vertex(h->tree->scene, p[i].vertex)[k];
            lo[k] = x < lo[k] ? x : lo[k];
            hi[k] = x > hi[k] ? x : hi[k];
        }
    int axis = 0.5 * hi[1] - 0.5 * lo[1] > 0.5 * hi[0] - 0.5 * lo[0];
    for (size_t i = 0; i < count; i++) p[i].key = scene_vertex(h->tree->scene, p[i].vertex)[axis];
    return (froe_cut){.kind = FROE_CUT_AXIS, .axis = axis, .value = median(p, count)->key};
}

/* ------------------------------------------------------------------- cells -- */

/** Deals the points of a cell, which are on top, to both sides of its cut; those in the cut are done. */
static froe_status deal_points(ham *h, const ham_cell *cell, const froe_cut *cut) {
    const froe_allocator *alloc = &h->tree->alloc;
    geom_plane plane = scene_cut_plane(h->tree->scene, cut);
    double length = sqrt(plane.n[0] * plane.n[0] + plane.n[1] * plane.n[1]), n[2], origin[2];
    for (int k = 0; k < 2; k++) n[k] = plane.n[k] / length, h->side[k].count = 0;
    for (int k = 0; k < 2; k++)
        if (!array_reserve(alloc, &h->side[k], cell->count)) return FROE_E_MEMORY;
    h->points.count -= cell->count;
    const uint32_t *points = h->points.data + h->points.count;
    memcpy(origin, scene_vertex(h->tree->scene, points[0]), sizeof origin);
    if (cut->kind == FROE_CUT_VERTICES) memcpy(origin, scene_vertex(h->tree->scene, cut->id[0]), sizeof origin);
    if (cut->kind == FROE_CUT_AXIS) origin[cut->axis] = cut->value;
    for (uint32_t i = 0; i < cell->count; i++) {
        const double *x = scene_vertex(h->tree->scene, points[i]);
        double w[2] = {x[0] - origin[0], x[1] - origin[1]};
        int side = geom_side_vertex(h->context, &plane, x);
        if (!side) continue;
        h->side[side > 0].data[h->side[side > 0].count++] =
            (ham_point){.vertex = points[i], .beside = n[0] * w[0] + n[1] * w[1], .along = n[0] * w[1] - n[1] * w[0]};
    }
    return FROE_OK;
}

/** Gives a child its points and its cut, unless it is a leaf. */
static froe_status push_child(ham *h, uint32_t node, int side, const froe_cut *cut) {
    const froe_allocator *alloc = &h->tree->alloc;
    size_t count = h->side[side].count;
    if (count < 2) return FROE_OK;
    if (!array_reserve(alloc, &h->points, count)) return FROE_E_MEMORY;
    for (size_t i = 0; i < count; i++) h->points.data[h->points.count++] = h->side[side].data[i].vertex;
    h->tree->nodes.data[node].cut = *cut;
    return array_push(alloc, &h->cells, (ham_cell){node, (uint32_t)count}) ? FROE_OK : FROE_E_MEMORY;
}

froe_status point_tree_by_ham_sandwich(point_tree *tree, num_context *context, base_task *task) {
    ham h = {.tree = tree, .context = context};
    /* all endpoints of the scene, each once, below the root */
    const uint32_t vertices = tree->scene->vertex_count;
    froe_status status = array_reserve(&tree->alloc, &h.side[0], vertices) ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; i < vertices && !status; i++) h.side[0].data[h.side[0].count++] = (ham_point){.vertex = i};
    if (h.side[0].count > 1) {
        froe_cut cut = halve_points(&h, h.side[0].data, h.side[0].count);
        status = push_child(&h, 0, 0, &cut);
    }
    for (uint32_t turn = 0; h.cells.count && !status; turn++) {
        ham_cell cell = h.cells.data[--h.cells.count];
        /* splits the node by the cut it was given, and names one for both children */
        froe_cut cut = tree->nodes.data[cell.node].cut, next[2];
        uint32_t child;
        status = deal_points(&h, &cell, &cut);
        if (!status) status = point_tree_split(tree, cell.node, &cut, &child);
        if (status) break;
        if (h.side[0].count > 1 && h.side[1].count > 1)
            next[0] = next[1] = sandwich(&h);
        else
            for (int s = 0; s < 2; s++)
                if (h.side[s].count > 1) next[s] = halve_points(&h, h.side[s].data, h.side[s].count);
        for (int s = 1; s >= 0 && !status; s--) status = push_child(&h, child + (uint32_t)s, s, &next[s]);
        if (!status && turn % 16 == 0 && !base_progress(task, task->done)) status = FROE_E_CANCELLED;
    }
    array_free(&tree->alloc, &h.cells);
    array_free(&tree->alloc, &h.points);
    for (int k = 0; k < 2; k++) array_free(&tree->alloc, &h.side[k]);
    return status;
}
