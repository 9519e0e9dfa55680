/* guard_tree.c: the guard tree as a whole: root cube, jobs for threads, and their splicing.
 *
 * One worker splits items that are large, which makes the upper part of the tree; the others become jobs. The nodes of
 * a job belong behind the nodes that the upper part has when the job's item is taken off its stack:
 *
 *     upper part   [ root's split ][ split of A ]  ^  [ split of C ]         ^: job B, job D
 *     tree         [ root's split ][ split of A ][ subtree of B ][ split of C ][ subtree of D ]
 *
 * With one thread the jobs write there directly. Either way the array is the same. */
#include "base/apart.h"
#include "split/guard/guard_work.h"
#include "split/guard/guards.h"
#include <string.h>

typedef struct job {
    guard_item item;
    guard_cube cube;
    uint32_t place;         /* nodes of the upper part before it */
    uint32_t worker, first; /* the worker that did it; its nodes there, the first stands for the item's own node */
    uint32_t count;         /* nodes, without the first */
    uint32_t final;         /* number of its nodes[1] in the tree */
} job;

typedef struct tree_worker { /* of a thread */
    guard_worker work;
    guard_nodes nodes;
    double *room; /* other side of the guards of a job */
    size_t capacity;
    base_apart apart;
} tree_worker;

typedef struct building {
    guard_plan plan;
    guard_worker upper;   /* builds the upper part */
    guard_nodes nodes;    /* of the upper part */
    double *main, *spare; /* count guards; spare only if the upper part needs it */
    size_t bytes;         /* of each */
    split_guards guards;  /* of a scene, where they had to be written down */
    uint32_t count;       /* guards in all, without those on the border */
    uint32_t job_count;   /* items with at most so many guards are jobs */
    ARRAY(job) jobs;
    tree_worker *workers;
    unsigned worker_count;
    double start, share; /* of progress: before, and per guard */
    split_guard_tree *out;
} building;

/* ---- root */

static double promised_leaves(const guard_plan *plan, double guards) {
    double cells = (double)((1u << plan->dim) - 1);
    if (guards <= plan->k) return 1;
    return cells * (plan->k ? 2 * guards / plan->k - 1 : 2 * guards - 1) + 1;
}

static froe_status start_guard_tree(building *b, const guard_cube *root) {
    memcpy(b->out->lo, root->lo, sizeof root->lo);
    memcpy(b->out->hi, root->hi, sizeof root->hi);
    return array_push(b->plan.alloc, &b->nodes, (split_guard_node){0}) ? FROE_OK : FROE_E_MEMORY;
}

static froe_status plant(building *b, const double *guards, size_t count) {
    guard_cube box, root = {.lo = {0}};
    if (count > GUARD_LIMIT) return FROE_E_LIMIT;
    b->bytes = (count ? count : 1) * (size_t)b->plan.dim * sizeof(double);
    b->main = support_realloc(b->plan.alloc, NULL, 0, b->bytes);
    if (!b->main) return FROE_E_MEMORY;
    b->upper.side[GUARD_MAIN] = b->main;
    b->upper.input = guards;
    /* the bounding box of the guards */
    for (int i = 0; i < b->plan.dim; i++) box.lo[i] = box.hi[i] = count ? guards[i] : 0;
    for (size_t p = 1; p < count; p++) {
        const double *x = guards + p * (size_t)b->plan.dim;
        for (int i = 0; i < b->plan.dim; i++) {
            box.lo[i] = x[i] < box.lo[i] ? x[i] : box.lo[i];
            box.hi[i] = x[i] > box.hi[i] ? x[i] : box.hi[i];
        }
    }
    guard_root(&box, b->plan.dim, &root);
    froe_status status = start_guard_tree(b, &root);
    bool all = guard_strictly_inside(box.lo, box.hi, &root, b->plan.dim);
    size_t dim = (size_t)b->plan.dim, kept = all ? count : 0;
    /* Rounding may put the border on guards, at 1e308 or where the scene is tiny and far from the origin: then the
     * others are copied. */
    for (size_t p = 0; p < count && !all; p++, guards += dim)
        if (guard_strictly_inside(guards, guards, &root, b->plan.dim))
            memcpy(b->main + kept++ * dim, guards, dim * sizeof *guards);
    guard_item item = {.side = all ? GUARD_INPUT : GUARD_MAIN};
    item.count = b->count = (uint32_t)kept;
    return status ? status : guard_push(&b->upper, NULL, &item, &root);
}

/* The same, for the guards of a scene: most of them, as a rule, need not be written down. */
static froe_status plant_scene(building *b, const split_grid_boxes *grid_boxes) {
    const froe_scene *scene = grid_boxes->scene;
    if (grid_boxes->grid.levels && (uint64_t)scene->object_count << b->plan.dim <= GUARD_LIMIT) {
        froe_status status = start_guard_tree(b, &grid_boxes->root);
        if (!status) status = guard_bucket_scene(&b->upper, grid_boxes, &b->main, &b->bytes, &b->count);
        b->upper.side[GUARD_MAIN] = b->main;
        if (status || b->count) return status;
        b->nodes.count = 0;
    }
    froe_status status = split_guards_of(b->plan.alloc, b->plan.task, 0, scene, NULL, scene->object_count, &b->guards);
    return status ? status : plant(b, b->guards.points, b->guards.count);
}

/* ---- jobs */

/* Does a job with the worker's nodes from `origin` on. */
static froe_status do_job(building *b, tree_worker *own, guard_nodes *nodes, uint32_t origin, guard_item item,
                          const guard_cube *cube) {
    size_t offset = (size_t)item.begin * (size_t)b->plan.dim;
    size_t need = item.count * (size_t)b->plan.dim * sizeof(double);
    guard_worker *w = &own->work;
    if (item.side == GUARD_MAIN && need > own->capacity) {
        support_free(b->plan.alloc, own->room, own->capacity);
        own->room = support_realloc(b->plan.alloc, NULL, 0, need);
        own->capacity = own->room ? need : 0;
        if (!own->room) return FROE_E_MEMORY;
    }
    w->side[GUARD_MAIN] = b->main + offset;
    w->side[GUARD_SPARE] = item.side == GUARD_MAIN ? own->room : b->spare + offset;
    w->nodes = nodes;
    w->origin = origin;
    item.begin = 0;
    froe_status status = guard_stack(w, &item, cube);
    return status ? status : guard_run(w);
}

static froe_status run_job(void *user, unsigned worker, size_t number) {
    building *b = user;
    job *j = &b->jobs.data[number];
    tree_worker *own = &b->workers[worker];
    guard_item item = j->item;
    j->worker = worker;
    j->first = (uint32_t)own->nodes.count;
    if (!array_push(b->plan.alloc, &own->nodes, (split_guard_node){0})) return FROE_E_MEMORY;
    item.node = 0;
    froe_status status = do_job(b, own, &own->nodes, j->first, item, &j->cube);
    j->count = (uint32_t)own->nodes.count - j->first - 1;
    return status;
}

/* A small item becomes a job, which a single thread does at once. */
static froe_status take_job(building *b, const guard_item *item, const guard_cube *cube) {
    if (b->plan.task->threads == 1) {
        froe_status status = do_job(b, b->workers, &b->nodes, 0, *item, cube);
        b->start += b->share * item->count;
        return status || base_progress(b->plan.task, b->start) ? status : FROE_E_CANCELLED;
    }
    job j = {.item = *item, .cube = *cube, .place = (uint32_t)b->nodes.count};
    return array_push(b->plan.alloc, &b->jobs, j) ? FROE_OK : FROE_E_MEMORY;
}

static froe_status build_upper_part(building *b) {
    while (b->upper.items.count) {
        guard_item item;
        guard_cube cube;
        guard_pop(&b->upper, &item, &cube);
        froe_status status;
        if (item.side != GUARD_INPUT && item.count <= b->job_count) {
            status = take_job(b, &item, &cube);
        } else {
            if (item.side == GUARD_MAIN && !b->spare) b->spare = support_realloc(b->plan.alloc, NULL, 0, b->bytes);
            if (item.side == GUARD_MAIN && !b->spare) return FROE_E_MEMORY;
            b->upper.side[GUARD_SPARE] = b->spare;
            status = guard_step(&b->upper, &item, &cube);
        }
        if (status) return status;
        if (base_cancelled(b->plan.task)) return FROE_E_CANCELLED;
    }
    return FROE_OK;
}

/* ---- splicing */

/* Number in the tree of a node of the upper part: later by the nodes of all jobs placed before it. */
static uint32_t final_number(const building *b, uint32_t node) {
    size_t low = 0, high = b->jobs.count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (b->jobs.data[middle].place <= node)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? node + (b->jobs.data[low - 1].final + b->jobs.data[low - 1].count - b->jobs.data[low - 1].place)
               : node;
}

static split_guard_node moved(split_guard_node node, const job *j) {
    if (node.child) node.child += j->final - 1;
    return node;
}

static froe_status splice_job(void *user, unsigned worker, size_t number) {
    (void)worker;
    building *b = user;
    const job *j = &b->jobs.data[number];
    const split_guard_node *from = b->workers[j->worker].nodes.data + j->first;
    for (uint32_t i = 1; i <= j->count; i++) b->out->nodes.data[j->final + i - 1] = moved(from[i], j);
    return FROE_OK;
}

static froe_status splice_in(building *b) {
    size_t count = b->nodes.count;
    for (size_t i = 0, before = 0; i < b->jobs.count; i++) {
        job *j = &b->jobs.data[i];
        j->final = (uint32_t)(j->place + before);
        before += j->count;
        count += j->count;
        if (count > GUARD_LIMIT) return FROE_E_LIMIT;
    }
    if (!array_reserve(b->plan.alloc, &b->out->nodes, count)) return FROE_E_MEMORY;
    b->out->nodes.count = count;
    /* the nodes of the upper part get their final numbers, and the roots of jobs what the jobs made of them */
    for (uint32_t node = 0, next = 0, shift = 0; node < b->nodes.count; node++) {
        for (; next < b->jobs.count && b->jobs.data[next].place <= node; next++) shift += b->jobs.data[next].count;
        split_guard_node copy = b->nodes.data[node];
        if (copy.child) copy.child = final_number(b, copy.child);
        b->out->nodes.data[node + shift] = copy;
    }
    for (size_t i = 0; i < b->jobs.count; i++) {
        const job *j = &b->jobs.data[i];
        b->out->nodes.data[final_number(b, j->item.node)] = moved(b->workers[j->worker].nodes.data[j->first], j);
    }
    return base_run(b->plan.task, 0, b->jobs.count, splice_job, b);
}

/* ---- building */

static void add_up(split_guard_tree *out, const guard_worker *w) {
    out->octree_steps += w->octree_steps;
    out->shrinks += w->shrinks;
    out->phases += w->phases;
    if (w->height > out->height) out->height = w->height;
}

static froe_status build_guard_tree(building *b, double span, const split_grid_boxes *grid_boxes, const double *guards,
                                    size_t count) {
    const base_task *task = b->plan.task;
    b->workers = support_calloc(b->plan.alloc, task->threads, sizeof *b->workers);
    if (!b->workers) return FROE_E_MEMORY;
    b->worker_count = task->threads;
    for (unsigned i = 0; i < b->worker_count; i++) b->workers[i].work.plan = &b->plan;
    froe_status status = grid_boxes ? plant_scene(b, grid_boxes) : plant(b, guards, count);
    if (status) return status;
    b->job_count = task->threads == 1 ? UINT32_MAX : b->count / task->threads / 8 + (1 << 12);
    b->share = span * task->scale / (b->count ? b->count : 1);
    b->out->promised = promised_leaves(&b->plan, b->count);
    status = build_upper_part(b);
    if (!status) status = base_run(b->plan.task, b->jobs.count ? span : 0, b->jobs.count, run_job, b);
    if (status) return status;
    status = FROE_OK;
    add_up(b->out, &b->upper);
    for (unsigned i = 0; i < b->worker_count; i++) add_up(b->out, &b->workers[i].work);
    if (b->jobs.count) {
        status = splice_in(b);
    } else {
        memcpy(&b->out->nodes, &b->nodes, sizeof b->nodes);
        b->nodes = (guard_nodes){0};
    }
    b->out->leaves = (b->out->nodes.count + 1) / 2;
    return status;
}

static uint32_t cell_load(int dim) { /* ceil(sqrt dim)^dim */
    uint32_t root = 1, load = 1;
    while (root * root < (uint32_t)dim) root++;
    for (int i = 0; i < dim; i++) load *= root;
    return load;
}

static froe_status build_tree(const froe_allocator *alloc, base_task *task, double span,
                              const split_guard_options *options, const split_grid_boxes *grid_boxes,
                              const double *guards, size_t count, split_guard_tree *out) {
    int dim = options->dim;
    split_form form = options->form != SPLIT_FORM_DEFAULT ? options->form : options->k ? SPLIT_FORM_S : SPLIT_FORM_U;
    split_guard_tree tree = {.dim = dim, .k = options->k, .form = form, .cell_load = cell_load(dim)};
    building b = {.plan = {.alloc = alloc,
                           .task = task,
                           .dim = dim,
                           .k = options->k,
                           .kill = options->k ? options->k : 1,
                           .form = form,
                           .way = options->way},
                  .start = task->done,
                  .out = &tree};
    b.upper.plan = &b.plan;
    b.upper.nodes = &b.nodes;
    b.upper.parallel = task->threads > 1;
    double done = task->done + span * task->scale;
    froe_status status = build_guard_tree(&b, span, grid_boxes, guards, count);
    if (!status && !base_progress(task, done)) status = FROE_E_CANCELLED;
    for (unsigned i = 0; i < b.worker_count; i++) {
        guard_worker_free(&b.workers[i].work);
        array_free(alloc, &b.workers[i].nodes);
        support_free(alloc, b.workers[i].room, b.workers[i].capacity);
    }
    support_free(alloc, b.workers, task->threads * sizeof *b.workers);
    guard_worker_free(&b.upper);
    array_free(alloc, &b.nodes);
    array_free(alloc, &b.jobs);
    support_free(alloc, b.main, b.bytes);
    support_free(alloc, b.spare, b.bytes);
    split_guards_free(alloc, &b.guards);
    if (status)
        array_free(alloc, &tree.nodes);
    else
        *out = tree;
    return status;
}

froe_status split_guard_tree_build(const froe_allocator *alloc, base_task *task, double span,
                                   const split_guard_options *options, const double *guards, size_t count,
                                   split_guard_tree *out) {
    return build_tree(alloc, task, span, options, NULL, guards, count, out);
}

froe_status split_guard_tree_of(const froe_allocator *alloc, base_task *task, double span,
                                const split_guard_options *options, const split_grid_boxes *grid_boxes,
                                split_guard_tree *out) {
    return build_tree(alloc, task, span, options, grid_boxes, NULL, 0, out);
}

void split_guard_tree_free(const froe_allocator *alloc, split_guard_tree *tree) {
    array_free(alloc, &tree->nodes);
}
