/* arcs.c: finds the pairs of a visible piece and a part under it that another node paints.
 *
 * Each node may be painted whole, once, if it comes after every node that paints behind it where it is visible. Then
 * the node painted last at any point is the one that is visible there. A grid on the page finds pairs of a visible
 * piece and a part. Separating axes in doubles decide almost all of them, sightlines the rest: parts that touch must
 * not count. */
#include "view/picture/grid.h"
#include "view/picture/parts.h"
#include <math.h>

/* Bounds on the page. */
typedef struct arc_box {
    float x0, y0, x1, y1;
} arc_box;

typedef struct finder {
    view_parts *parts;
    view_sightlines *sights;
    view_arcs *arcs;
    view_grid grid;
    print_ring piece;
    view_ring own, ring;
    arc_box *boxes;  /* per part */
    uint32_t *known; /* per node: the node + 1 that is known to come after it */
    uint64_t most, *tests;
} finder;

/* ---------------------------------------------------------------------- overlap -- */

static bool ring_is_beyond(view_sightlines *s, const view_corner *a, uint32_t a_count, const view_corner *b,
                           uint32_t b_count) {
    for (uint32_t i = 0; i < a_count; i++) {
        const view_way way = a[i].way;
        bool all = true;
        for (uint32_t j = 0; j < b_count && all; j++) {
            const int side = view_side(s, way >> 1, &b[j].ray, b[j].vertex, b[j ? j - 1 : b_count - 1].way, b[j].way);
            all = way & 1 ? side >= 0 : side <= 0;
        }
        if (all) return true;
    }
    return false;
}

/* A superfluous arc does no harm: so it is without memory. */
static bool overlap_exactly(finder *f, uint32_t visible, const paint_part *part, int kind) {
    const froe_visibility *v = f->parts->v;
    const bool ok = view_ring_of_visible(v, f->sights, visible, &f->own) &&
                    (kind == PART_VISIBLE ? view_ring_of_visible(v, f->sights, part->source, &f->ring)
                     : kind == PART_PIECE ? view_beam_of(f->sights, part->source, &f->ring)
                                          : view_beam_of_object(f->sights, part->source, &f->ring));
    const view_corner *a = f->own.data, *b = f->ring.data;
    const uint32_t a_count = (uint32_t)f->own.count, b_count = (uint32_t)f->ring.count;
    return !ok ||
           (!ring_is_beyond(f->sights, a, a_count, b, b_count) && !ring_is_beyond(f->sights, b, b_count, a, a_count));
}

/* Bounds of points, widened by more than is unsure. */
static arc_box box_of(const print_point *ring, size_t count, double unsure) {
    double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        x0 = ring[i].x < x0 ? ring[i].x : x0, x1 = ring[i].x > x1 ? ring[i].x : x1;
        y0 = ring[i].y < y0 ? ring[i].y : y0, y1 = ring[i].y > y1 ? ring[i].y : y1;
    }
    const float out = 0x1p-23f; /* more than rounding to a float moves a bound, in shares of itself */
    const arc_box box = {(float)(x0 - unsure), (float)(y0 - unsure), (float)(x1 + unsure), (float)(y1 + unsure)};
    return (arc_box){box.x0 - out * fabsf(box.x0), box.y0 - out * fabsf(box.y0), box.x1 + out * fabsf(box.x1),
                     box.y1 + out * fabsf(box.y1)};
}

static bool boxes_meet(const arc_box *a, const arc_box *b) {
    return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

/* ------------------------------------------------------------------------- arcs -- */

/* Finds the arcs from parts that lie under a visible piece. */
static froe_status compare_piece(finder *f, uint32_t visible) {
    const view_piece *piece = f->parts->v->pieces + visible;
    const uint32_t node = f->parts->node_of[visible];
    const double unsure = 1e-9 * (f->parts->view->width + f->parts->view->height);
    f->piece.count = 0;
    if (!view_print_visible(f->parts, visible, &f->piece)) return FROE_E_MEMORY;
    if (f->piece.count < 3) return FROE_OK;
    const arc_box box = box_of(f->piece.data, f->piece.count, unsure);
    view_grid_walk walk = view_grid_begin(&f->grid, view_grid_cells(&f->grid, f->piece.data, f->piece.count, 0));
    for (uint32_t i; view_grid_next(&walk, &i);) {
        if (!boxes_meet(&box, f->boxes + i)) continue;
        const paint_part *part = f->parts->parts.data + i;
        if (part->node == node || f->known[part->node] == node + 1) continue;
        if (f->parts->clear && part->place <= piece->place) continue;
        if (++*f->tests > f->most) return FROE_E_BUDGET;
        /* Do their interiors overlap? Sightlines decide where rounding could hide that. */
        const print_point *ring = f->parts->points.data + part->first;
        if (!print_overlap(f->piece.data, f->piece.count, ring, part->count, -unsure)) continue;
        if (!print_overlap(f->piece.data, f->piece.count, ring, part->count, unsure) &&
            !overlap_exactly(f, visible, part, f->parts->kinds.data[i]))
            continue;
        f->known[part->node] = node + 1;
        if (!array_push(&f->parts->v->alloc, f->arcs, (graph_arc){part->node, node})) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static const print_point *arc_points(const void *user, size_t i, size_t *points) {
    const view_parts *p = user;
    *points = p->parts.data[i].count;
    return p->points.data + p->parts.data[i].first;
}

froe_status view_find_arcs(view_parts *parts, view_sightlines *sights, uint64_t most, view_arcs *arcs,
                           uint64_t *tests) {
    const froe_allocator *alloc = &parts->v->alloc;
    finder f = {.parts = parts, .sights = sights, .arcs = arcs, .most = most, .tests = tests};
    const size_t part_count = parts->parts.count, node_count = parts->nodes.count;
    arcs->count = 0;
    const double unsure = 1e-9 * (parts->view->width + parts->view->height);
    f.known = support_calloc(alloc, node_count + 1, sizeof *f.known);
    f.boxes = support_calloc(alloc, part_count + 1, sizeof *f.boxes);
    froe_status status = f.known && f.boxes ? FROE_OK : FROE_E_MEMORY;
    for (size_t i = 0; i < part_count && !status; i++)
        f.boxes[i] = box_of(parts->points.data + parts->parts.data[i].first, parts->parts.data[i].count, unsure);
    if (!status) status = view_grid_new(alloc, parts->view, part_count, arc_points, parts, &f.grid);
    for (uint32_t i = 0; i < parts->v->piece_count && !status; i++) status = compare_piece(&f, i);
    support_free(alloc, f.known, (node_count + 1) * sizeof *f.known);
    support_free(alloc, f.boxes, (part_count + 1) * sizeof *f.boxes);
    view_grid_free(alloc, &f.grid);
    array_free(alloc, &f.piece);
    array_free(alloc, &f.own);
    array_free(alloc, &f.ring);
    return status;
}
