/* plane.c: one grid over all objects; the subtrees of its parts (build/index/grid.h) are jobs (build/index/join.h). A
 * node above the parts that has few objects is a subtree, too.
 *
 * The root box is the bounds of the scene, widened by odd shares of its size, so that cuts do not fall on the round
 * numbers of which maps are made; a cut that meets a corner all the same is moved to the next double. */
#include "build/index/plane.h"
#include "build/index/join.h"
#include "geom/selftest.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { CHUNK = 1 << 15, LEAF_MOST = 64, FEW = 1 << 15, LEAST = 28, LEAST_OF_FEW = 9 };

typedef struct plane_build {
    index_plan *plan;
    index_work *works;       /* of threads */
    axis_work *axes;         /* theirs */
    axis_ends *ends;         /* a copy, where they do not lie so in the scene */
    double *lengths;         /* chunk -> sums of the extents of its objects; in the end [0] has those of all */
    ARRAY(index_cell) roots; /* of subtrees */
    tree_join join;
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
    array_free(alloc, &p->roots);
    join_free(&p->join);
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

/* ------------------------------------------------------------- the subtrees -- */

/* Cuts the nodes above the parts of the grid; what is left are subtrees. */
static froe_status plan_subtrees(plane_build *p, const index_cell *root) {
    const build_job *job = p->plan->job;
    const froe_allocator *alloc = &job->alloc;
    const split_grid *g = p->plan->whole;
    ARRAY(index_cell) waiting = {0};
    bool room = array_push(alloc, &waiting, *root);
    while (room && waiting.count) {
        const index_cell cell = waiting.data[--waiting.count];
        const uint32_t level = g ? grid_level(cell.heap) : 0;
        const uint64_t objects = g ? g->count[cell.heap] : job->scene->object_count;
        if (g && level < g->upper && cell.growth < p->plan->growth && objects > job->leaf) {
            index_cell side[2];
            const double value = subtree_halve(g, &cell, level, g->count, side);
            room = array_push(alloc, &waiting, side[1]) && array_push(alloc, &waiting, side[0]) &&
                   join_cut(&p->join, g->axis[level], value);
        } else {
            const uint32_t below = g ? g->upper - level : 0, first = g ? (cell.heap - (1u << level)) << below : 0;
            const uint64_t entries = g ? g->starts[first + (1u << below)] - g->starts[first] : objects;
            const uint64_t fragments = entries + entries / 8, leaves = fragments / (job->leaf / 2 + 1) + 1;
            const join_room about = {2 * leaves + 1, leaves + fragments / 5, objects};
            room = join_subtree(&p->join, &about) && array_push(alloc, &p->roots, cell);
        }
    }
    array_free(alloc, &waiting);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static froe_status build_part(void *user, unsigned worker, size_t part, tree_packer *packer, uint32_t node) {
    plane_build *p = user;
    index_cell cell = p->roots.data[part];
    cell.node = node;
    p->works[worker].packer = packer;
    return subtree_build(p->works + worker, &cell);
}

/* -------------------------------------------------------------------- whole -- */

froe_status build_in_plane(index_plan *plan, froe_tree **out) {
    build_job *job = plan->job;
    plane_build p = {.plan = plan};
    p.join = (tree_join){.job = job, .fn = build_part, .user = &p};
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
    if (!status) status = plan_subtrees(&p, &root);
    if (!status) status = join_run(&p.join, 0.7);
    if (!status) status = packer_seal(&p.join.tree, job->scene, &job->meta, out);
    froe_predicate_stats stats = {0};
    for (unsigned i = 0; !status && i < job->task->threads; i++) num_stats_add(&stats, &p.axes[i].context.stats);
    if (!status) (*out)->predicates = (*out)->report.predicates = stats;
    end_plane(&p);
    return status;
}
