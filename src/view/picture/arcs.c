/* arcs.c: finds the pairs of a visible piece and a part under it that another node paints.
 *
 * Each node may be painted whole, once, if it comes after every node that paints behind it where it is visible. Then
 * the node painted last at any point is the one that is visible there. A grid on the page finds pairs of a visible
 * piece and a part. Separating axes in doubles decide almost all of them, sightlines the rest: parts that touch must
 * not count. */
#include "view/grid.h"
#include "view/picture/parts.h"
#include <math.h>

/* Bounds on the page. */
typedef struct arc_box {
    float x0, y0, x1, y1;
} arc_box;

enum { NODES_A_JOB = 1024 };

/* What all threads share. */
typedef struct arc_search {
    view_parts *parts;
    arc_box *boxes; /* per part */
    view_grid grid; /* of parts */
    uint64_t most;
    atomic_uint_least64_t tests;
    struct finder *finders;
    unsigned finder_count;
} arc_search;

/* One thread. */
typedef struct finder {
    view_parts parts;
    view_sightlines own_sights, *sights;
    view_grid grid;
    view_arcs arcs;
    print_ring piece;
    view_ring own, ring;
    uint32_t *known; /* per node: the node + 1 that is known to come after it */
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
    const froe_visibility *v = f->parts.v;
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
static arc_box box_of_arc(const print_point *ring, size_t count, double unsure) {
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
static froe_status compare_piece(const arc_search *s, finder *f, uint32_t visible, uint64_t *tests) {
    const view_piece *piece = f->parts.v->pieces + visible;
    const uint32_t node = f->parts.node_of[visible];
    const double unsure = 1e-9 * (f->parts.view->width + f->parts.view->height);
    f->piece.count = 0;
    if (!view_print_visible(&f->parts, visible, &f->piece)) return FROE_E_MEMORY;
    if (f->piece.count < 3) return FROE_OK;
    const arc_box box = box_of_arc(f->piece.data, f->piece.count, unsure);
    view_grid_walk walk = view_grid_begin(&f->grid, view_grid_cells(&f->grid, f->piece.data, f->piece.count, 0));
    for (uint32_t i; view_grid_next(&walk, &i);) {
        if (!boxes_meet(&box, s->boxes + i)) continue;
        const paint_part *part = f->parts.parts.data + i;
        if (part->node == node || f->known[part->node] == node + 1) continue;
        if (f->parts.clear && part->place <= piece->place) continue;
        if (++*tests > s->most) return FROE_E_BUDGET;
        /* Do their interiors overlap? Sightlines decide where rounding could hide that. */
        const print_point *ring = f->parts.points.data + part->first;
        if (!print_overlap(f->piece.data, f->piece.count, ring, part->count, -unsure)) continue;
        if (!print_overlap(f->piece.data, f->piece.count, ring, part->count, unsure) &&
            !overlap_exactly(f, visible, part, f->parts.kinds.data[i]))
            continue;
        f->known[part->node] = node + 1;
        if (!array_push(&f->parts.v->alloc, &f->arcs, (graph_arc){part->node, node})) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static const print_point *arc_points(const void *user, size_t i, size_t *points) {
    const view_parts *p = user;
    *points = p->parts.data[i].count;
    return p->points.data + p->parts.data[i].first;
}

static froe_status find_some_arcs(void *user, unsigned worker, size_t job) {
    arc_search *s = user;
    finder *f = s->finders + worker;
    const view_parts *p = s->parts;
    const size_t first = job * NODES_A_JOB, left = p->nodes.count - first,
                 count = left < NODES_A_JOB ? left : NODES_A_JOB;
    froe_status status = FROE_OK;
    for (size_t k = first; k < first + count && !status; k++) {
        const uint32_t node = p->tour.data[k];
        uint64_t tests = 0;
        for (uint32_t i = p->nodes.data[node].first; i < p->v->piece_count && p->node_of[i] == node && !status; i++)
            status = compare_piece(s, f, i, &tests);
        if (atomic_fetch_add(&s->tests, tests) + tests > s->most) status = FROE_E_BUDGET;
    }
    return status;
}

/* Lines of sight along the borders of all parts, so that threads need not make any; and the facings of objects. */
static froe_status make_borders(const arc_search *s, view_sightlines *sights) {
    const froe_scene *scene = sights->tree->scene;
    for (size_t i = 0; i < s->parts->parts.count; i++) {
        const uint32_t object = s->parts->parts.data[i].source;
        if (s->parts->kinds.data[i] != PART_OBJECT) continue;
        (void)view_facing(sights, object);
        for (uint32_t c = 0; c < scene_corners(scene, object); c++)
            if (view_line_of_edge(sights, sights->surface->edge_of[scene_start(scene, object) + c]) == FROE_NONE)
                return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status begin_finder(const arc_search *s, finder *f, view_sightlines *sights) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    f->parts = view_parts_fork(s->parts);
    f->known = support_calloc(alloc, s->parts->nodes.count + 1, sizeof *f->known);
    if (!f->known || view_grid_fork(alloc, &s->grid, &f->grid)) return FROE_E_MEMORY;
    f->sights = sights;
    if (s->parts->clear) return FROE_OK; /* one thread, which makes lines */
    f->sights = &f->own_sights;
    return view_sightlines_fork(sights, &f->own_sights);
}

static void end_finder(const arc_search *s, finder *f, view_sightlines *sights) {
    const froe_allocator *alloc = &s->parts->v->alloc;
    if (f->own_sights.tree) num_stats_add(&sights->context.stats, &f->own_sights.context.stats);
    view_sightlines_close(&f->own_sights);
    view_parts_close(&f->parts);
    view_grid_close(alloc, &f->grid);
    support_free(alloc, f->known, (s->parts->nodes.count + 1) * sizeof *f->known);
    array_free(alloc, &f->arcs);
    array_free(alloc, &f->piece);
    array_free(alloc, &f->own);
    array_free(alloc, &f->ring);
}

static froe_status begin_search(arc_search *s, view_sightlines *sights) {
    view_parts *parts = s->parts;
    const froe_allocator *alloc = &parts->v->alloc;
    const double unsure = 1e-9 * (parts->view->width + parts->view->height);
    const size_t part_count = parts->parts.count;
    s->boxes = support_calloc(alloc, part_count + 1, sizeof *s->boxes);
    s->finders = support_calloc(alloc, s->finder_count, sizeof *s->finders);
    if (!s->boxes || !s->finders) return FROE_E_MEMORY;
    for (size_t i = 0; i < part_count; i++)
        s->boxes[i] = box_of_arc(parts->points.data + parts->parts.data[i].first, parts->parts.data[i].count, unsure);
    froe_status status = view_grid_new(alloc, parts->view, part_count, arc_points, parts, &s->grid);
    if (!status && !parts->clear) status = make_borders(s, sights);
    for (unsigned i = 0; i < s->finder_count && !status; i++) status = begin_finder(s, s->finders + i, sights);
    return status;
}

froe_status view_find_arcs(view_parts *parts, view_sightlines *sights, base_task *task, uint64_t most, view_arcs *arcs,
                           uint64_t *tests) {
    const froe_allocator *alloc = &parts->v->alloc;
    const size_t jobs = (parts->nodes.count + NODES_A_JOB - 1) / NODES_A_JOB;
    const unsigned threads = task->threads;
    if (parts->clear) task->threads = 1;
    arc_search s = {
        .parts = parts, .most = most > *tests ? most - *tests : 0, .finder_count = base_workers(task, jobs)};
    atomic_init(&s.tests, 0);
    froe_status status = begin_search(&s, sights);
    if (!status) status = base_run(task, VIEW_PLANNED - VIEW_LOOKED, jobs, find_some_arcs, &s);
    task->threads = threads;
    arcs->count = 0;
    for (unsigned i = 0; s.finders && i < s.finder_count; i++) {
        const view_arcs *found = &s.finders[i].arcs;
        if (!status && !array_append(alloc, arcs, found->data, found->count)) status = FROE_E_MEMORY;
        end_finder(&s, s.finders + i, sights);
    }
    *tests = status == FROE_E_BUDGET ? most + 1 : *tests + atomic_load(&s.tests);
    support_free(alloc, s.finders, s.finder_count * sizeof *s.finders);
    support_free(alloc, s.boxes, (parts->parts.count + 1) * sizeof *s.boxes);
    view_grid_free(alloc, &s.grid);
    return status;
}
