/* space.c: trees of space to be queried: cuts by surface area, whole objects in packed leaves.
 *
 * Cells are cut where that saves a search most (build/index/surface.h), one by one, depth first; a leaf is written as a
 * block as soon as it is reached. Objects are listed whole in all leaves they reach; while cells are cut each has the
 * bounds of its part, so that none comes into a cell it does not meet, and boxes of leaves are tight.
 *
 * Where cuts do not pay, leaves stay over capacity: below cells that the cuts above have multiplied into `growth`
 * listings for each, and where three cuts in a row would save less than a fiftieth, or divide nearly all. As in the
 * plane there are at most 2 growth n listings.
 *
 * Of many objects, a sample is cut in the same way first, down to nodes of some thousand objects
 * (build/index/sketch.h): these are the jobs. Where the sample misled, so that the nodes of its cuts have too many
 * listings, it is dropped, and all objects are one job. */
#include "build/index/space.h"
#include "base/apart.h"
#include "base/random.h"
#include "build/index/join.h"
#include "build/index/sketch.h"
#include <math.h>
#include <string.h>

enum { BARREN = 3, THOROUGH = 256, SAMPLE = 16 };

/* Its items are on top of all others when its turn comes. */
typedef struct index_space_cell {
    uint32_t node, first, count, barren;
    double growth;
} index_space_cell;

/* What a thread has. */
typedef struct index_space_work {
    build_job *job;
    unsigned worker;
    double growth;
    uint32_t leaf;
    bool sample; /* leaves are left without contents */
    tree_packer *packer;
    ARRAY(index_space_cell) cells;
    ARRAY(space_item) items, spare;
    ARRAY(uint8_t) classes;
    base_apart apart;
} index_space_work;

typedef struct space_build {
    build_job *job;
    index_space_work *works;       /* of threads */
    space_sketch sketch;           /* count 0: there is none */
    ARRAY(index_space_cell) roots; /* of subtrees; their nodes are those of the sketch */
    tree_join join;
} space_build;

/* -------------------------------------------------------------------- cells -- */

static froe_status end_space_leaf(index_space_work *w, const index_space_cell *cell) {
    const uint64_t most = w->job->max_fragments;
    const uint8_t flags = cell->count > w->job->leaf ? TREE_CROWDED : 0;
    space_item *items = w->items.data + cell->first;
    w->items.count = cell->first;
    if (w->sample) return FROE_OK;
    if (most && (uint64_t)w->packer->piece_count + cell->count > most) return FROE_E_BUDGET;
    return packer_space_leaf(w->packer, cell->node, w->job->scene, items, cell->count, flags);
}

static froe_status cut_cell(index_space_work *w, const index_space_cell *cell) {
    surface_cut cut;
    index_space_cell side[2] = {*cell, *cell};
    uint32_t child;
    w->classes.count = 0;
    if (!array_reserve(&w->job->alloc, &w->classes, cell->count)) return FROE_E_MEMORY;
    /* names the cut, and tells on which sides the items are */
    space_item *items = w->items.data + cell->first;
    const bool may_cut = cell->count > w->leaf && cell->growth < w->growth && cell->barren < BARREN;
    if (!may_cut || !surface_choose(items, cell->count, &cut) ||
        !surface_count(items, cell->count, &cut, w->classes.data) || cut.both >= cell->count)
        return end_space_leaf(w, cell); /* nothing separates them, or it does not pay */
    froe_status status = packer_split(w->packer, cell->node, cut.axis, cut.value, &child);
    if (status) return status;
    /* the positive items take the place of all, the negative ones lie on top */
    const froe_allocator *alloc = &w->job->alloc;
    w->items.count = cell->first + cell->count;
    w->spare.count = 0;
    if (!array_reserve(alloc, &w->items, cut.sides[0] + cut.sides[1] - cell->count) ||
        !array_reserve(alloc, &w->spare, cut.sides[0]))
        return FROE_E_MEMORY;
    items = w->items.data + cell->first;
    const bool thorough = cell->count <= THOROUGH && !w->sample;
    surface_deal(w->job->scene, items, cell->count, &cut, w->classes.data, thorough, w->spare.data, items);
    if (cut.sides[0]) memcpy(items + cut.sides[1], w->spare.data, cut.sides[0] * sizeof *items);
    w->items.count = cell->first + cut.sides[0] + cut.sides[1];
    side[0].first = cell->first + cut.sides[1];
    const uint64_t listed = (uint64_t)cut.sides[0] + cut.sides[1];
    const bool barren = cut.cost > 0.98 || 5 * (listed - cell->count) > 4 * (uint64_t)cell->count;
    for (uint32_t i = 0; i < 2; i++) {
        side[i].node = child + i;
        side[i].count = cut.sides[i];
        side[i].growth = listed > cell->count ? cell->growth * (double)listed / cell->count : cell->growth;
        side[i].barren = barren ? cell->barren + 1 : 0;
    }
    /* the negative child last, so that it comes first */
    return array_push(alloc, &w->cells, side[1]) && array_push(alloc, &w->cells, side[0]) ? FROE_OK : FROE_E_MEMORY;
}

/* Cuts a cell of all items that there are, and the cells that come of it. */
static froe_status cut_cells(index_space_work *w, uint32_t node, double growth) {
    base_task *task = w->job->task;
    const index_space_cell root = {.node = node, .count = (uint32_t)w->items.count, .growth = growth};
    w->cells.count = 0;
    froe_status status = array_push(&w->job->alloc, &w->cells, root) ? FROE_OK : FROE_E_MEMORY;
    while (w->cells.count && !status) {
        const index_space_cell cell = w->cells.data[--w->cells.count];
        status = cut_cell(w, &cell);
        /* the calling thread asks; progress is that of jobs */
        const bool go_on = w->worker ? !base_cancelled(task) : base_progress(task, task->done);
        if (!status && !go_on) status = FROE_E_CANCELLED;
    }
    return status;
}

/* ------------------------------------------------------------------- sketch -- */

/* Cuts a sample: one object, chosen by chance, of as many in a row as it stands for. */
static froe_status cut_sample(space_build *b, uint32_t parts, tree_packer *packer) {
    const build_job *job = b->job;
    const uint32_t objects = job->scene->object_count;
    index_space_work *w = b->works;
    if (!array_reserve(&job->alloc, &w->items, objects / SAMPLE + 1)) return FROE_E_MEMORY;
    for (uint32_t from = 0; from < objects; from += SAMPLE) {
        const uint32_t among = objects - from < SAMPLE ? objects - from : SAMPLE;
        const uint32_t object = from + base_below(base_hash(1, 0, from), among);
        w->items.data[w->items.count++] = sketch_item(job->scene, object);
    }
    w->sample = true;
    w->leaf = parts / 2 / SAMPLE + 1;
    w->packer = packer;
    froe_status status = cut_cells(w, 0, 1);
    w->sample = false;
    w->leaf = job->leaf;
    return status;
}

/* The upper cuts, and what is below them. *kept false: the listings are too many for that. */
static froe_status plan_by_sketch(space_build *b, double growth, bool *kept) {
    const froe_allocator *alloc = &b->job->alloc;
    const space_sketch *s = &b->sketch;
    const index_space_cell root = {.growth = 1};
    ARRAY(index_space_cell) waiting = {0};
    bool room = array_push(alloc, &waiting, root);
    *kept = true;
    while (room && *kept && waiting.count) {
        const index_space_cell cell = waiting.data[--waiting.count];
        const tree_node *n = s->nodes + cell.node;
        if (n->child) {
            const double listed = (double)s->listed[n->child] + s->listed[n->child + 1];
            index_space_cell side[2] = {cell, cell};
            *kept = cell.growth < growth;
            for (uint32_t i = 0; i < 2; i++) {
                side[i].node = n->child + i;
                side[i].growth = cell.growth * fmax(1, listed / s->listed[cell.node]);
            }
            room = array_push(alloc, &waiting, side[1]) && array_push(alloc, &waiting, side[0]) &&
                   join_cut(&b->join, n->axis, n->u.value);
        } else {
            const uint64_t count = s->listed[cell.node], leaves = count / (b->job->leaf / 2 + 1) + 1;
            const join_room about = {2 * leaves, leaves + count, 0};
            room = array_push(alloc, &b->roots, cell) && join_subtree(&b->join, &about);
        }
    }
    array_free(alloc, &waiting);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* One subtree of all objects. */
static froe_status plan_whole(space_build *b) {
    const froe_allocator *alloc = &b->job->alloc;
    const uint64_t objects = b->job->scene->object_count, leaves = objects / (b->job->leaf / 2 + 1) + 1;
    const join_room about = {2 * leaves, leaves + objects, 0};
    const index_space_cell root = {.growth = 1};
    sketch_free(b->job, &b->sketch);
    b->roots.count = 0;
    join_clear(&b->join);
    return array_push(alloc, &b->roots, root) && join_subtree(&b->join, &about) ? FROE_OK : FROE_E_MEMORY;
}

static froe_status build_space_part(void *user, unsigned worker, size_t part, tree_packer *packer, uint32_t node) {
    space_build *b = user;
    index_space_work *w = b->works + worker;
    const index_space_cell *root = b->roots.data + part;
    const uint32_t objects = w->job->scene->object_count;
    const uint32_t count = b->sketch.count ? b->sketch.listed[root->node] : objects;
    w->items.count = 0;
    w->packer = packer;
    if (!array_reserve(&w->job->alloc, &w->items, count + count / 2)) return FROE_E_MEMORY;
    froe_status status = FROE_OK;
    if (b->sketch.count) status = sketch_fill(w->job, &b->sketch, root->node, w->items.data);
    for (uint32_t i = 0; !b->sketch.count && i < objects; i++) w->items.data[i] = sketch_item(w->job->scene, i);
    w->items.count = count;
    return status ? status : cut_cells(w, node, root->growth);
}

/* -------------------------------------------------------------------- whole -- */

static froe_status plan_space(space_build *b, double growth, uint32_t parts, tree_packer *sample) {
    bool kept = false;
    froe_status status = FROE_OK;
    if (b->job->scene->object_count >= parts) {
        status = packer_new(&b->job->alloc, 1024, 0, 0, sample);
        if (!status) status = cut_sample(b, parts, sample);
        if (!status && sample->nodes.count > 1)
            status = sketch_new(b->job, sample->nodes.data, (uint32_t)sample->nodes.count, &b->sketch);
        if (!status && b->sketch.count) status = plan_by_sketch(b, growth, &kept);
    }
    return status || kept ? status : plan_whole(b);
}

froe_status build_in_space(build_job *job, double growth, uint32_t parts, froe_tree **out) {
    const froe_allocator *alloc = &job->alloc;
    const froe_scene *s = job->scene;
    const uint32_t most = s->object_count < parts ? 1 : s->object_count / (parts / 2 + 1) + 1;
    unsigned *threads = &job->task->threads;
    if (*threads > most) *threads = most;
    space_build b = {.job = job};
    tree_packer sample = {.alloc = *alloc};
    b.join = (tree_join){.job = job, .fn = build_space_part, .user = &b};
    b.works = support_calloc(alloc, *threads, sizeof *b.works);
    for (unsigned i = 0; b.works && i < *threads; i++)
        b.works[i] = (index_space_work){.job = job, .worker = i, .growth = growth, .leaf = job->leaf};
    for (int k = 0; s->object_count && k < 3; k++) {
        job->meta.root_lo[k] = s->lo[k] + 0.0;
        job->meta.root_hi[k] = s->hi[k] + 0.0;
    }
    froe_status status = b.works ? plan_space(&b, growth, parts, &sample) : FROE_E_MEMORY;
    if (!status) status = join_run(&b.join, 0.7);
    for (unsigned i = 0; b.works && i < *threads; i++) {
        array_free(alloc, &b.works[i].cells);
        array_free(alloc, &b.works[i].items);
        array_free(alloc, &b.works[i].spare);
        array_free(alloc, &b.works[i].classes);
    }
    sketch_free(job, &b.sketch);
    packer_free(&sample);
    support_free(alloc, b.works, *threads * sizeof *b.works);
    array_free(alloc, &b.roots);
    if (!status) status = packer_seal(&b.join.tree, job->scene, &job->meta, out);
    join_free(&b.join);
    return status;
}
