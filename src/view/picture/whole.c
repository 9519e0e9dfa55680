/* whole.c: whole patches, and those that are clipped, as shapes in their order.
 *
 * Shapes do not depend on each other, so that threads make them: along a tour of the page, some nodes a job, each job
 * on a sheet of its own. Sheets are then read in the order of painting. */
#include "base/apart.h"
#include "view/picture/picture.h"

enum { NODES_A_JOB = 512 };

/* The shapes of some nodes. */
typedef struct whole_sheet {
    print_ring points;
    print_ends ends;
    print_ends starts; /* per node, and 1 more: into ends */
} whole_sheet;

/* One thread. */
typedef struct whole_worker {
    view_sightlines sights;
    view_parts parts;
    view_outliner outliner;
    view_seams seams;
    base_apart apart;
} whole_worker;

typedef struct whole_painter {
    view_painter *p;
    uint32_t *at;            /* per node: its place in the tour */
    print_ring points;       /* of regions */
    print_ends ends, starts; /* of their rings; per node, and 1 more: into ends */
    whole_sheet *sheets;
    size_t jobs;
    whole_worker *workers;
    unsigned worker_count;
} whole_painter;

static bool is_clear(const view_painter *p, uint32_t patch) {
    return p->options->clear && p->options->clear[patch];
}

/* Are the visible parts of a patch all that is painted of it? */
static bool is_clipped(const view_painter *p, uint32_t node) {
    return p->graph.late[node] || p->parts.split[p->parts.nodes.data[node].patch] == PARTS_REGION;
}

/* ------------------------------------------------------------------------ sheets -- */

/* Finds seams along the sides of the last ring, which begins at `first`; strips come after all rings of a shape. */
static bool look_along(whole_worker *w, const whole_sheet *sheet, uint32_t node, size_t first) {
    const print_point *ring = sheet->points.data + first;
    const size_t n = sheet->points.count - first;
    bool beside;
    for (size_t i = 0; w->seams.parts && i < n; i++)
        if (!view_seams_look(&w->seams, node, ring[i], ring[i + 1 < n ? i + 1 : 0], &beside)) return false;
    return true;
}

/* Ends the ring whose points are those from `first` on; rings of less than three points are dropped. */
static bool end_ring(const froe_allocator *alloc, whole_sheet *sheet, size_t first) {
    if (sheet->points.count - first >= 3) return array_push(alloc, &sheet->ends, (uint32_t)sheet->points.count);
    sheet->points.count = first;
    return true;
}

/* The visible parts of one piece of the tree. */
static bool put_parts_of_piece(const view_painter *p, whole_worker *w, uint32_t node, whole_sheet *sheet) {
    const bool opaque = !is_clear(p, p->parts.nodes.data[node].patch);
    for (uint32_t i = p->parts.nodes.data[node].first; i < p->v->piece_count && p->parts.node_of[i] == node; i++) {
        const size_t first = sheet->points.count;
        if (!view_print_visible(&w->parts, i, &sheet->points) || !end_ring(&p->picture->alloc, sheet, first) ||
            (opaque && !look_along(w, sheet, node, first)))
            return false;
    }
    return true;
}

/* The region of a clipped node. */
static bool put_clipped(const whole_painter *g, whole_worker *w, uint32_t node, whole_sheet *sheet) {
    const froe_allocator *alloc = &g->p->picture->alloc;
    const bool strips = !is_clear(g->p, g->p->parts.nodes.data[node].patch);
    for (uint32_t ring = g->starts.data[node]; ring < g->starts.data[node + 1]; ring++) {
        const uint32_t begin = ring ? g->ends.data[ring - 1] : 0;
        const size_t first = sheet->points.count;
        if (!array_append(alloc, &sheet->points, g->points.data + begin, g->ends.data[ring] - begin) ||
            !array_push(alloc, &sheet->ends, (uint32_t)sheet->points.count) ||
            (strips && !look_along(w, sheet, node, first)))
            return false;
    }
    return true;
}

static bool put_whole_patch(const view_painter *p, whole_worker *w, uint32_t node, whole_sheet *sheet) {
    const uint32_t patch = p->parts.nodes.data[node].patch;
    w->outliner.node = node;
    w->outliner.seams = w->seams.parts && !is_clear(p, patch) ? &w->seams : NULL;
    return view_outline(&w->outliner, patch, &sheet->points, &sheet->ends);
}

static froe_status paint_some(void *user, unsigned worker, size_t job) {
    whole_painter *g = user;
    const view_painter *p = g->p;
    const froe_allocator *alloc = &p->picture->alloc;
    whole_worker *w = g->workers + worker;
    whole_sheet *sheet = g->sheets + job;
    bool ok = array_push(alloc, &sheet->starts, 0);
    for (size_t k = job * NODES_A_JOB; ok && k < p->graph.count && k < (job + 1) * NODES_A_JOB; k++) {
        const uint32_t node = p->parts.tour.data[k];
        const paint_node *n = p->parts.nodes.data + node;
        if (!view_is_left_out(p, n->patch))
            ok = n->piece != FROE_NONE ? put_parts_of_piece(p, w, node, sheet)
                 : is_clipped(p, node) ? put_clipped(g, w, node, sheet)
                                       : put_whole_patch(p, w, node, sheet);
        ok = ok && (!w->seams.parts || view_seams_flush(&w->seams, &sheet->points, &sheet->ends)) &&
             array_push(alloc, &sheet->starts, (uint32_t)sheet->ends.count);
    }
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* ----------------------------------------------------------------------- shapes -- */

/* Appends the shape of a node. */
static bool put_shape(const whole_painter *g, uint32_t node) {
    const view_painter *p = g->p;
    froe_picture *picture = p->picture;
    const paint_node *n = p->parts.nodes.data + node;
    const whole_sheet *sheet = g->sheets + g->at[node] / NODES_A_JOB;
    const uint32_t *starts = sheet->starts.data + g->at[node] % NODES_A_JOB;
    if (view_is_left_out(p, n->patch)) return true;
    if (!view_begin_shape(picture, n->patch, n->piece == FROE_NONE && !is_clipped(p, node))) return false;
    for (uint32_t ring = starts[0]; ring < starts[1]; ring++) {
        const uint32_t begin = ring ? sheet->ends.data[ring - 1] : 0, count = sheet->ends.data[ring] - begin;
        if (!array_append(&picture->alloc, &picture->points, sheet->points.data + begin, count) ||
            !array_push(&picture->alloc, &picture->ring_ends, (uint32_t)picture->points.count))
            return false;
    }
    view_end_shape(picture);
    return true;
}

static froe_status put_shapes(const whole_painter *g) {
    view_painter *p = g->p;
    for (uint32_t i = 0; i < p->graph.count; i++) {
        p->painted[i] = (uint32_t)p->picture->shapes.count;
        if (!put_shape(g, p->order[i])) return FROE_E_MEMORY;
        if (p->picture->points.count > INT32_MAX) return FROE_E_LIMIT;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------------- begin -- */

/* Runs of patches of one style without lines between; patches painted whole and opaque get the number of theirs. */
static bool number_runs(view_painter *p) {
    const size_t patches = p->v->surface->patch_count;
    uint32_t run = 0, last = FROE_NONE;
    p->runs = support_calloc(&p->picture->alloc, patches + 1, sizeof *p->runs);
    if (!p->runs) return false;
    for (uint32_t i = 0; i < patches; i++) p->runs[i] = FROE_NONE;
    for (uint32_t i = 0; i < p->graph.count; i++) {
        const uint32_t v = p->order[i];
        const paint_node *node = p->parts.nodes.data + v;
        const uint32_t style = p->options->styles ? p->options->styles[node->patch] : 0;
        run += style != last || (p->breaks && p->breaks[i]);
        last = style;
        if (node->piece == FROE_NONE && !is_clipped(p, v) && !is_clear(p, node->patch)) p->runs[node->patch] = run;
    }
    return true;
}

/* Makes the rings of clipped nodes. *pieces: some nodes are pieces of the tree. */
static bool make_regions(whole_painter *g, bool *pieces) {
    view_painter *p = g->p;
    const froe_allocator *alloc = &p->picture->alloc;
    *pieces = false;
    for (uint32_t v = 0; v < p->graph.count; v++) {
        const paint_node *node = p->parts.nodes.data + v;
        const bool piece = node->piece != FROE_NONE, region = !piece && is_clipped(p, v);
        *pieces = *pieces || piece;
        if (!array_push(alloc, &g->starts, (uint32_t)g->ends.count)) return false;
        if (region && !view_is_left_out(p, node->patch) && !view_append_region(p, node->patch, &g->points, &g->ends))
            return false;
    }
    view_region_free(alloc, &p->region);
    p->region = (view_region){.corners = {0}};
    return array_push(alloc, &g->starts, (uint32_t)g->ends.count);
}

static froe_status begin_worker(const whole_painter *g, whole_worker *w) {
    view_painter *p = g->p;
    const froe_picture_options *o = p->options;
    froe_status status = view_sightlines_fork(p->sights, &w->sights);
    w->parts = view_parts_fork(&p->parts);
    if (!status) status = view_outliner_new(&w->outliner, &w->sights, o->view, o->cull_back);
    if (!status && p->seams.parts) status = view_seams_fork(&p->seams, &w->seams);
    w->outliner.underlap = o->underlap;
    w->outliner.runs = p->runs;
    return status;
}

static void end_worker(whole_worker *w) {
    view_outliner_free(&w->outliner);
    view_seams_close(&w->seams);
    view_parts_close(&w->parts);
    view_sightlines_close(&w->sights);
}

static froe_status begin_painting(whole_painter *g) {
    view_painter *p = g->p;
    const froe_allocator *alloc = &p->picture->alloc;
    const froe_picture_options *o = p->options;
    const size_t n = p->parts.nodes.count;
    const froe_surface *surface = p->v->surface;
    bool pieces;
    p->painted = support_calloc(alloc, n + 1, sizeof *p->painted);
    g->at = support_calloc(alloc, n + 1, sizeof *g->at);
    g->sheets = support_calloc(alloc, g->jobs, sizeof *g->sheets);
    g->workers = support_calloc(alloc, g->worker_count, sizeof *g->workers);
    if (!p->painted || !g->at || !g->sheets || !g->workers || !number_runs(p) || !make_regions(g, &pieces))
        return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) g->at[p->parts.tour.data[i]] = i;
    froe_status status = FROE_OK;
    if (o->underlap > 0 && o->paint == FROE_PAINT_WHOLE)
        status = view_seams_new(&p->seams, &p->parts, p->order, p->breaks, o->styles, o->clear, o->underlap);
    if (status) return status;
    if (!pieces) view_drop_pieces(p->v); /* visible pieces are on the page now */
    if (p->seams.parts) status = view_seams_spread(&p->seams);
    for (uint32_t i = 0; i < surface->scene->object_count; i++) /* threads only read them */
        if (surface_has(surface, i)) (void)view_facing(p->sights, i);
    for (unsigned i = 0; i < g->worker_count && !status; i++) status = begin_worker(g, g->workers + i);
    return status;
}

froe_status view_paint_whole(view_painter *p) {
    const froe_allocator *alloc = &p->picture->alloc;
    const size_t n = p->parts.nodes.count, jobs = (n + NODES_A_JOB - 1) / NODES_A_JOB;
    whole_painter g = {.p = p, .jobs = jobs, .worker_count = base_workers(&p->task, jobs)};
    froe_status status = begin_painting(&g);
    if (!status) status = base_run(&p->task, VIEW_PAINTED - VIEW_PLANNED, jobs, paint_some, &g);
    for (unsigned i = 0; g.workers && i < g.worker_count; i++) end_worker(g.workers + i);
    view_seams_free(&p->seams);
    if (!status) status = put_shapes(&g);
    for (size_t i = 0; g.sheets && i < jobs; i++) {
        array_free(alloc, &g.sheets[i].points);
        array_free(alloc, &g.sheets[i].ends);
        array_free(alloc, &g.sheets[i].starts);
    }
    support_free(alloc, g.sheets, jobs * sizeof *g.sheets);
    support_free(alloc, g.workers, g.worker_count * sizeof *g.workers);
    support_free(alloc, g.at, (n + 1) * sizeof *g.at);
    array_free(alloc, &g.points);
    array_free(alloc, &g.ends);
    array_free(alloc, &g.starts);
    return status;
}
