/* arcs.c: finds the pairs of a visible piece and a part under it that another node paints.
 *
 * Each node may be painted whole, once, if it comes after every node that paints behind it where it is visible. Then
 * the node painted last at any point is the one that is visible there. A grid on the page finds pairs of a visible
 * piece and a part. Separating axes in doubles decide almost all of them, sightlines the rest: parts that touch must
 * not count. */
#include "view/picture/grid.h"
#include "view/picture/parts.h"

typedef struct finder {
    view_parts *parts;
    view_sightlines *sights;
    view_arcs *arcs;
    view_grid grid;
    print_ring piece;
    view_ring own, ring;
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

/* ------------------------------------------------------------------------- arcs -- */

/* Finds the arcs from parts that lie under a visible piece. */
static froe_status compare_piece(finder *f, uint32_t visible) {
    const view_piece *piece = f->parts->v->pieces + visible;
    const uint32_t node = f->parts->node_of[visible];
    const double unsure = 1e-9 * (f->parts->view->width + f->parts->view->height);
    f->piece.count = 0;
    if (!view_print_visible(f->parts, visible, &f->piece)) return FROE_E_MEMORY;
    if (f->piece.count < 3) return FROE_OK;
    view_grid_walk walk = view_grid_begin(&f->grid, view_grid_cells(&f->grid, f->piece.data, f->piece.count, 0));
    for (uint32_t i; view_grid_next(&walk, &i);) {
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
    f.known = support_calloc(alloc, node_count + 1, sizeof *f.known);
    froe_status status = f.known ? FROE_OK : FROE_E_MEMORY;
    if (!status) status = view_grid_new(alloc, parts->view, part_count, arc_points, parts, &f.grid);
    for (uint32_t i = 0; i < parts->v->piece_count && !status; i++) status = compare_piece(&f, i);
    support_free(alloc, f.known, (node_count + 1) * sizeof *f.known);
    view_grid_free(alloc, &f.grid);
    array_free(alloc, &f.piece);
    array_free(alloc, &f.own);
    array_free(alloc, &f.ring);
    return status;
}
