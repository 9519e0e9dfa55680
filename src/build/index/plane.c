/* plane.c: one grid over all objects, the subtrees of its parts as jobs, joined in their order.
 *
 *          *            The nodes above the parts are cut first, without looking at objects. What is left are subtrees
 *        /   \          that have nothing in common, about as many as a part has cells: jobs. One thread writes each at
 *       *     *         once to where it belongs. Several write them apart; then it is known where each belongs, and
 *      / \   / \        they are copied there, on all threads.
 *     j0 j1 j2 j3
 *
 * The root box is the bounds of the scene, widened by odd shares of its size, so that cuts do not fall on the round
 * numbers of which maps are made; a cut that meets a corner all the same is moved to the next double. */
#include "build/index/plane.h"
#include "geom/selftest.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { CHUNK = 1 << 15, LEAF_MOST = 64, FEW = 1 << 15, LEAST = 28, LEAST_OF_FEW = 9 };

/* A node above the parts that is to be cut, or a subtree: its place in the tree is found when all before are there. */
typedef struct plane_step {
    index_cell cell;
    bool cut;
    int axis;
    double value;
} plane_step;

typedef struct plane_job {
    size_t step;
    tree_packer packer; /* of several threads: the subtree */
    packer_place place;
} plane_job;

typedef struct plane_build {
    index_plan *plan;
    index_work *works;       /* of threads */
    axis_work *axes;         /* theirs */
    axis_ends *ends;         /* a copy, where they do not lie so in the scene */
    double *lengths;         /* chunk -> sums of the extents of its objects; in the end [0] has those of all */
    ARRAY(plane_step) steps; /* depth first */
    ARRAY(plane_job) jobs;
    ARRAY(uint32_t) open; /* nodes of the tree that wait for a step, the next on top */
    size_t next;          /* step */
    tree_packer tree;
} plane_build;

/* -------------------------------------------------------------------- start -- */

static double widened(double x, double by) {
    double y = x + by;
    return y < -DBL_MAX ? -DBL_MAX : y > DBL_MAX ? DBL_MAX : y;
}

static packed_box root_box(const froe_scene *s) {
    static const double odd[2][2] = {{0.00217339, 0.00293507}, {0.00251103, 0.00197911}};
    const double x = 0.5 * s->hi[0] - 0.5 * s->lo[0], y = 0.5 * s->hi[1] - 0.5 * s->lo[1], side = 2 * (x > y ? x : y);
    packed_box box = {{0, 0}, {0, 0}};
    for (int k = 0; s->object_count && k < 2; k++) {
        box.lo[k] = widened(s->lo[k], -side * odd[k][0]);
        box.hi[k] = widened(s->hi[k], side * odd[k][1]);
    }
    return box;
}

/* Copies the ends of a chunk of objects, where they do not lie side by side, and sums their extents. */
static froe_status find_ends(void *user, unsigned worker, size_t job) {
    plane_build *p = user;
    const froe_scene *s = p->plan->job->scene;
    const size_t from = job * CHUNK, to = s->object_count - from < CHUNK ? s->object_count : from + CHUNK;
    const axis_ends *ends = p->axes[worker].ends;
    double length[2] = {0, 0};
    for (size_t i = from; i < to; i++) {
        if (p->ends) {
            const uint32_t o = (uint32_t)i;
            const double *a = scene_point(s, o, 0), *b = scene_point(s, o, scene_corners(s, o) - 1);
            p->ends[i] = (axis_ends){{a[0], a[1]}, {b[0], b[1]}};
        }
        for (int k = 0; k < 2; k++) length[k] += fabs(ends[i].q[k] - ends[i].p[k]);
    }
    for (int k = 0; k < 2; k++) p->lengths[2 * job + (size_t)k] = length[k];
    return FROE_OK;
}

/* What threads have, as many as there is work for. */
static froe_status begin_plane(plane_build *p) {
    const build_job *job = p->plan->job;
    const uint32_t objects = job->scene->object_count, parts = p->plan->parts;
    const uint32_t most = objects < parts ? 1 : objects / (parts / 2 + 1) + 1;
    unsigned *threads = &job->task->threads;
    if (*threads > most) *threads = most;
    p->works = support_calloc(&job->alloc, *threads, sizeof *p->works);
    p->axes = support_calloc(&job->alloc, *threads, sizeof *p->axes);
    froe_status status = p->works && p->axes ? FROE_OK : FROE_E_MEMORY;
    for (unsigned i = 0; i < *threads && !status; i++) {
        p->works[i] = (index_work){.plan = p->plan, .worker = i, .axis = p->axes + i};
        status = geom_context_new(&job->alloc, &p->axes[i].context);
        if (job->first > p->axes[i].context.first) p->axes[i].context.first = job->first;
    }
    if (status) return status;
    /* the ends lie in the scene where nothing else does and none is shared */
    const froe_scene *s = job->scene;
    const bool there = scene_in_order(s) && s->each == 2;
    const size_t chunks = (objects + CHUNK - 1) / CHUNK;
    if (!there) p->ends = support_realloc(&job->alloc, NULL, 0, ((size_t)objects + 1) * sizeof *p->ends);
    p->lengths = support_calloc(&job->alloc, chunks, 2 * sizeof *p->lengths);
    if (!p->lengths || (!there && !p->ends)) return FROE_E_MEMORY;
    for (unsigned i = 0; i < *threads; i++)
        p->axes[i].ends = there ? (const axis_ends *)(const void *)s->coords : p->ends;
    status = base_run(job->task, 0.05, chunks, find_ends, p);
    for (size_t c = 1; c < chunks; c++)
        for (size_t k = 0; k < 2; k++) p->lengths[k] += p->lengths[2 * c + k];
    return status;
}

static void end_plane(plane_build *p) {
    const froe_allocator *alloc = &p->plan->job->alloc;
    const unsigned threads = p->plan->job->task->threads;
    for (size_t i = 0; i < p->jobs.count; i++) packer_free(&p->jobs.data[i].packer);
    for (unsigned i = 0; p->works && p->axes && i < threads && p->works[i].plan; i++) {
        subtree_work_free(p->works + i);
        num_context_free(&p->axes[i].context);
    }
    if (p->plan->whole) grid_free(alloc, p->plan->whole);
    support_free(alloc, p->works, threads * sizeof *p->works);
    support_free(alloc, p->axes, threads * sizeof *p->axes);
    const size_t objects = p->plan->job->scene->object_count;
    support_free(alloc, p->ends, (objects + 1) * sizeof *p->ends);
    support_free(alloc, p->lengths, (objects + CHUNK - 1) / CHUNK * 2 * sizeof *p->lengths);
    array_free(alloc, &p->steps);
    array_free(alloc, &p->jobs);
    array_free(alloc, &p->open);
    packer_free(&p->tree);
}

/* ----------------------------------------------------------------- capacity -- */

/* Leaves are full and of one depth where nearly all cells of one level of the grid fit into them: of the finest level
 * with enough fragments in a cell, the mean and a little more. (docs/design/index.md has what was measured.) */
static uint32_t own_capacity(const split_grid *g) {
    const double least = g->fragments[0] < FEW ? LEAST_OF_FEW : LEAST;
    uint32_t level = g->levels;
    while (level && (double)g->fragments[level] < least * g->cells[level]) level--;
    const double mean = (double)g->fragments[level] / g->cells[level], leaf = mean + 1.3 * sqrt(mean);
    return leaf < LEAF_MOST ? (uint32_t)leaf : LEAF_MOST;
}

/* ---------------------------------------------------------------- the steps -- */

static froe_status plan_steps(plane_build *p, const index_cell *root) {
    const froe_allocator *alloc = &p->plan->job->alloc;
    const split_grid *g = p->plan->whole;
    ARRAY(index_cell) waiting = {0};
    bool room = array_push(alloc, &waiting, *root);
    while (room && waiting.count) {
        plane_step step = {.cell = waiting.data[--waiting.count]};
        const index_cell *cell = &step.cell;
        const uint32_t level = g ? grid_level(cell->heap) : 0;
        step.cut = g && level < g->upper && cell->growth < p->plan->growth && g->count[cell->heap] > p->plan->job->leaf;
        if (step.cut) {
            index_cell side[2];
            step.axis = g->axis[level];
            step.value = subtree_halve(g, cell, level, g->count, side);
            room = array_push(alloc, &waiting, side[1]) && array_push(alloc, &waiting, side[0]);
        } else {
            room = array_push(alloc, &p->jobs, (plane_job){.step = p->steps.count});
        }
        room = room && array_push(alloc, &p->steps, step);
    }
    array_free(alloc, &waiting);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* Cuts the nodes before a step, which is a subtree; the node that it has. */
static froe_status walk_to(plane_build *p, size_t step, uint32_t *node) {
    for (; p->next <= step; p->next++) {
        const plane_step *s = p->steps.data + p->next;
        *node = p->open.data[--p->open.count];
        if (!s->cut) continue;
        uint32_t child;
        froe_status status = packer_split(&p->tree, *node, s->axis, s->value, &child);
        if (status) return status;
        p->open.data[p->open.count++] = child + 1;
        p->open.data[p->open.count++] = child;
    }
    return FROE_OK;
}

/* Room for a subtree or tree, about. Array pages that stay untouched cost nothing. */
static froe_status new_packer(const build_job *job, uint64_t fragments, uint64_t objects, tree_packer *out) {
    const uint64_t leaves = fragments / (job->leaf / 2 + 1) + 1;
    return packer_new(&job->alloc, 2 * leaves + 1, leaves + fragments / 5, objects, out);
}

static froe_status build_directly(void *user, unsigned worker, size_t job) {
    plane_build *p = user;
    const size_t step = p->jobs.data[job].step;
    index_cell cell = p->steps.data[step].cell;
    froe_status status = walk_to(p, step, &cell.node);
    p->works[worker].packer = &p->tree;
    return status ? status : subtree_build(p->works + worker, &cell);
}

static froe_status build_apart(void *user, unsigned worker, size_t job) {
    plane_build *p = user;
    plane_job *j = p->jobs.data + job;
    index_cell cell = p->steps.data[j->step].cell;
    const uint32_t count = p->plan->whole->count[cell.heap];
    cell.node = 0;
    froe_status status = new_packer(p->plan->job, count, count, &j->packer);
    p->works[worker].packer = &j->packer;
    return status ? status : subtree_build(p->works + worker, &cell);
}

static froe_status copy_subtree(void *user, unsigned worker, size_t job) {
    plane_build *p = user;
    plane_job *j = p->jobs.data + job;
    (void)worker;
    packer_put(&p->tree, &j->packer, &j->place);
    packer_free(&j->packer);
    return FROE_OK;
}

/* Takes exactly the room that all subtrees need, and gives each its place. */
static froe_status place_subtrees(plane_build *p) {
    const build_job *job = p->plan->job;
    uint64_t nodes = p->steps.count, blocks = 0, owners = 0;
    for (size_t i = 0; i < p->jobs.count; i++) {
        const tree_packer *part = &p->jobs.data[i].packer;
        nodes += part->nodes.count, blocks += part->block_count, owners += part->owners.count;
    }
    froe_status status = packer_new(&job->alloc, nodes, blocks, owners, &p->tree);
    for (size_t i = 0; i < p->jobs.count && !status; i++) {
        plane_job *j = p->jobs.data + i;
        uint32_t node;
        status = walk_to(p, j->step, &node);
        if (!status) status = packer_place_for(&p->tree, node, &j->packer, &j->place);
        if (!status && job->max_fragments && p->tree.piece_count > job->max_fragments) status = FROE_E_BUDGET;
    }
    return status;
}

static froe_status build_subtrees(plane_build *p) {
    build_job *job = p->plan->job;
    const split_grid *g = p->plan->whole;
    const uint64_t objects = job->scene->object_count;
    if (!array_reserve(&job->alloc, &p->open, GRID_LEVELS + 2)) return FROE_E_MEMORY;
    p->open.data[p->open.count++] = 0;
    if (job->task->threads == 1 || p->jobs.count == 1) {
        froe_status status = new_packer(job, g ? g->fragments[g->levels] : objects + objects / 4, objects, &p->tree);
        return status ? status : base_run(job->task, 0.75, p->jobs.count, build_directly, p);
    }
    froe_status status = base_run(job->task, 0.65, p->jobs.count, build_apart, p);
    if (!status) status = place_subtrees(p);
    return status ? status : base_run(job->task, 0.1, p->jobs.count, copy_subtree, p);
}

/* -------------------------------------------------------------------- whole -- */

froe_status build_in_plane(index_plan *plan, froe_tree **out) {
    build_job *job = plan->job;
    plane_build p = {.plan = plan};
    index_cell root = {.box = root_box(job->scene), .growth = 1, .heap = 1};
    memcpy(job->meta.root_lo, root.box.lo, sizeof root.box.lo);
    memcpy(job->meta.root_hi, root.box.hi, sizeof root.box.hi);
    froe_status status = begin_plane(&p);
    if (!status && job->scene->object_count >= plan->grid) {
        const grid_source source = {.count = job->scene->object_count,
                                    .box = root.box,
                                    .load = plan->load,
                                    .parts = job->scene->object_count >= plan->parts,
                                    .growth = plan->growth < 2 ? plan->growth : 2,
                                    .length = {p.lengths[0], p.lengths[1]},
                                    .task = job->task,
                                    .workers = p.axes};
        status = grid_new(&job->alloc, &source, &plan->whole);
    }
    if (!status && plan->whole && job->own_leaf) job->meta.leaf = job->leaf = own_capacity(plan->whole);
    if (!status) status = plan_steps(&p, &root);
    if (!status) status = build_subtrees(&p);
    if (!status) status = packer_seal(&p.tree, job->scene, &job->meta, out);
    froe_predicate_stats stats = {0};
    for (unsigned i = 0; !status && i < job->task->threads; i++) num_stats_add(&stats, &p.axes[i].context.stats);
    if (!status) (*out)->predicates = (*out)->report.predicates = stats;
    end_plane(&p);
    return status;
}
