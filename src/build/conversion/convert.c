/* convert.c: the plan is followed cell by cell, depth first, negative child first. */
#include "build/conversion/convert.h"
#include "build/conversion/chord.h"
#include "split/axial.h"
#include "split/cell.h"
#include <string.h>

/** What the conversion keeps of a cell besides its split_cell. */
typedef struct convert_cell {
    uint32_t at;      /**< node of the plan; FROE_NONE: a star, or what rounding left over */
    uint32_t corners; /**< of the region, on top of all others when its turn comes; 0: unknown */
} convert_cell;

typedef struct convert {
    const convert_job *job;
    split_work work;
    split_refine refine; /**< for stars */
    tree_draft draft;
    chord_search chords;
    ARRAY(convert_cell) cells; /**< beside work.cells */
    ARRAY(region_corner) corners;
    uint64_t crossings; /**< splits by cuts along segments */
} convert;

/* ------------------------------------------------------------ what is long? -- */

/** Does an own end of the fragment lie in the open region of the node? */
static bool is_short(const convert *c, const split_fragment *f, uint32_t at) {
    const split_set *set = &c->work.set;
    for (uint32_t i = 0; i < split_corner_count(set, f); i++) {
        split_corner k = split_corner_of(set, f, i);
        if (k.type == SPLIT_VERTEX && point_tree_holds(c->job->plan, at, k.a)) return true;
    }
    return false;
}

/* ------------------------------------------------------------------ regions -- */

static bool push_cell(convert *c, uint32_t at, const region *r) {
    if (!array_reserve(&c->job->alloc, &c->corners, r->count)) return false;
    if (r->count) memcpy(c->corners.data + c->corners.count, r->corner, r->count * sizeof *r->corner);
    c->corners.count += r->count;
    return array_push(&c->job->alloc, &c->cells, (convert_cell){at, r->count});
}

/** The children of a cell that its cut has just made, positive first. */
static froe_status push_planned_cells(convert *c, uint32_t node, const region *r, uint32_t negative,
                                      uint32_t positive) {
    geom_plane line = split_plane_at(&c->work.set, node);
    region part;
    region_clip(r, &line, 1, 0, &part);
    if (!push_cell(c, positive, &part)) return FROE_E_MEMORY;
    region_clip(r, &line, -1, 0, &part);
    return push_cell(c, negative, &part) ? FROE_OK : FROE_E_MEMORY;
}

/* --------------------------------------------------------------------- cuts -- */

/** Fragments on the stack and in lists. */
static uint64_t pieces(const convert *c) {
    return c->work.set.items.count + c->draft.pieces.count;
}

static split_verdict choose_in_star(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    return split_refine_choose(config, work, cell, cut);
}

/** One turn of the shared loop, along the objects. */
static froe_status do_star(convert *c, split_cell *cell) {
    const split_method method = {.config = &c->refine, .choose = choose_in_star};
    const region unknown = {.count = 0};
    uint64_t before = pieces(c);
    size_t cells = c->work.cells.count;
    froe_status status = split_step(&method, &c->work, cell);
    if (status) return status;
    c->crossings += pieces(c) - before;
    if (c->work.cells.count == cells) return FROE_OK;
    bool room = true;
    for (int i = 0; i < 2 && room; i++) room = push_cell(c, FROE_NONE, &unknown);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------ pruning -- */

/** May the cut of a node be left out, where everything lies on one side of it? A cut that misses the region may. */
static bool may_prune(const convert *c, uint32_t at, int side, const region *r) {
    geom_plane line = scene_cut_plane(c->job->scene, &c->job->plan->nodes.data[at].cut);
    region_corner end[2];
    int along = region_along(&line);
    if (!c->job->prune || side < 0 || !r->count) return false;
    if (!region_section(r, &line, end)) return true;
    double a = end[0].x[along], b = end[1].x[along];
    return !point_tree_junction(c->job->plan, at, side, a < b ? a : b, a < b ? b : a);
}

/* -------------------------------------------------------------------- cells -- */

/** Follows the plan from a node down to the first that cuts the cell. */
static froe_status follow_plan(convert *c, split_cell *cell, uint32_t at, const region *r) {
    for (;;) {
        const point_node *n = c->job->plan->nodes.data + at;
        int side;
        /* sorts the fragments of a cell into chords and others */
        const split_set *set = &c->work.set;
        if (!chord_begin(&c->chords, set, cell)) return FROE_E_MEMORY;
        for (uint32_t i = 0; i < cell->count; i++)
            chord_add(&c->chords, set, cell, i, !is_short(c, set->items.data + cell->first + i, at));
        if (c->chords.chords.count) {
            uint32_t item = chord_choose(&c->chords, set, cell, c->job->seed);
            froe_cut cut = scene_support_cut(set->scene, set->items.data[cell->first + item].object);
            uint64_t before = pieces(c);
            froe_status status = cell_cut(&c->work, cell, &cut, 0, NULL);
            if (status) return status;
            c->crossings += pieces(c) - before;
            return push_planned_cells(c, cell->node, r, at, at);
        }
        if (n->cut.kind == FROE_CUT_NONE) return do_star(c, cell);
        /* The only side of the cut on which there is anything: 0, 1, or -1 where it is not so simple. Exact. */
        split_tally t;
        froe_status status = cell_tally(&c->work, cell, &n->cut, &t);
        side = t.on || t.both || (t.negative && t.positive) ? -1 : t.positive > 0;
        if (status) return status;
        if (!may_prune(c, at, side, r)) {
            status = cell_cut(&c->work, cell, &n->cut, 0, NULL);
            return status ? status : push_planned_cells(c, cell->node, r, n->child, n->child + 1);
        }
        at = n->child + (uint32_t)side;
    }
}

/* -------------------------------------------------------------------- whole -- */

static froe_status begin_conversion(convert *c) {
    const convert_job *job = c->job;
    uint32_t n = job->scene->object_count;
    region all = {.count = 0};
    split_cell root = {.path = 1, .guard = FROE_NONE, .growth = 1, .count = n};
    froe_status status = split_set_new(job->scene, &job->alloc, &c->work.set);
    if (status) return status;
    c->work.set.draft = &c->draft;
    c->work.task = job->task;
    c->work.calling = true;
    if (job->first > c->work.set.context.first) c->work.set.context.first = job->first;
    status = split_scratch_new(NULL, &c->work);
    if (status || !array_reserve(&job->alloc, &c->work.set.items, n)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) c->work.set.items.data[i] = (split_fragment){.object = i};
    c->work.set.items.count = n;
    if (n) region_around(job->scene->lo, job->scene->hi, 0, &all);
    return push_cell(c, 0, &all) && array_push(&job->alloc, &c->work.cells, root) ? FROE_OK : FROE_E_MEMORY;
}

froe_status split_convert(const convert_job *job, froe_tree **out) {
    convert c = {.job = job, .work.set.alloc = job->alloc};
    c.refine = split_axial_of(job->scene, job->leaf, job->seed, 1).refine;
    froe_status status = draft_new(&job->alloc, job->scene->dim, 0, &c.draft);
    if (status) return status;
    status = begin_conversion(&c);
    while (c.work.cells.count && !status) {
        split_cell cell = c.work.cells.data[--c.work.cells.count];
        convert_cell own = c.cells.data[--c.cells.count];
        region r = {.count = own.corners};
        c.work.set.corners.count = cell.corner_top;
        c.corners.count -= own.corners;
        if (own.corners) memcpy(r.corner, c.corners.data + c.corners.count, own.corners * sizeof *r.corner);
        if (cell.count <= job->leaf)
            status = cell_leaf(&c.work, &cell, 0);
        else
            status = own.at == FROE_NONE ? do_star(&c, &cell) : follow_plan(&c, &cell, own.at, &r);
        if (!status && job->max_fragments && pieces(&c) > job->max_fragments) status = FROE_E_BUDGET;
        if (!status && !split_go_on(&c.work)) status = FROE_E_CANCELLED;
    }
    if (!status) {
        *job->fragments += (double)c.crossings;
        num_stats_add(&c.draft.predicates, &c.work.set.context.stats);
        status = draft_seal(&c.draft, NULL, 0, job->scene, job->meta, out);
    }
    const froe_allocator *alloc = &c.job->alloc;
    split_scratch_free(&c.work);
    split_set_free(&c.work.set);
    array_free(alloc, &c.work.cells);
    array_free(alloc, &c.cells);
    array_free(alloc, &c.corners);
    chord_free(alloc, &c.chords);
    draft_free(&c.draft);
    return status;
}
