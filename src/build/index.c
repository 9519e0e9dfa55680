/* index.c: trees to be queried: middle cuts, packed leaves. In space: build/index/space.c.
 *
 *     +-------+---+---+    Cells are halved across their longer side until they hold at most `leaf` fragments: the
 *     |       | \ |   |    octree rule, with binary cuts. Large cells are halved many times at once
 *     |   /   +-\-+---+    (build/index/grid.h), small ones one by one (build/index/halve.h). The objects are segments
 *     |  /    |  \| / |    and points of the plane, which become fragments of their cells; a leaf is written as a
 *     +-------+---+---+    block as soon as it is reached (tree/packed/packer.h).
 *
 * The root box is the bounds of the scene, widened by odd shares of its size, so that cuts do not fall on the round
 * numbers of which maps are made; a cut that meets a corner all the same is moved to the next double.
 *
 * Where middle cuts do not pay: cells that the cuts before have multiplied into `growth` fragments for each are left as
 * they are, and so are those that two cuts in a row have left nearly whole on both sides (a star, parallels). growth is
 * the product of (fragments after / fragments before) over the cuts above; the sum over leaves of fragments / growth
 * never exceeds n, so there are at most 2 growth n fragments on any scene. A cell whose siblings have been empty
 * several times in a row is shrunk to its contents; where halving has gone beyond `height` log2 n levels, cuts go
 * through medians. */
#include "base/log2.h"
#include "base/radix.h"
#include "build/index/grid.h"
#include "build/index/halve.h"
#include "build/index/space.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "tree/packed/packer.h"
#include <float.h>
#include <math.h>

enum { GROWTH, HEIGHT, TUNING, LOAD, LEAST };
enum { BARREN = 2, LONELY = 3, AHEAD = 16 };

static const froe_option_info options[] = {
    [GROWTH] = {"growth", "fragments per fragment at which a cell is left as it is", 4, 1, 1000, NULL, false},
    [HEIGHT] = {"height", "medians beyond this many times log2 n levels, plus 16; 0: no rule", 2, 0, 1e9, NULL, false},
    [TUNING] = {0},
    [LOAD] = {"load", "objects in a cell of a grid of middle cuts, at most", 20, 1, 1e6, NULL, true},
    [LEAST] = {"grid", "fragments from which a cell is cut by a grid", 256, 2, 1e9, NULL, true},
    {0},
};

/* A cell waiting for its turn: a node of the uppermost grid, or fragments on top of all others. */
typedef struct index_cell {
    uint32_t node, depth;
    packed_box box;
    double growth;
    uint32_t barren, lonely; /* cuts in a row that divided nearly all; that left the sibling empty */
    uint32_t heap;           /* of the grid; 0: fragments; GRID_END: the grid is done */
    uint32_t line[2];        /* of the grid: where the cell begins */
    uint32_t first, count;   /* fragments */
} index_cell;
#define GRID_END UINT32_MAX

typedef struct index_work {
    build_job *job;
    axis_work axis;
    num_context context;
    tree_packer packer;
    ARRAY(index_cell) cells;
    ARRAY(packed_fragment) items, spare;
    ARRAY(split_grid) grids;
    ARRAY(uint8_t) classes[2];
    ARRAY(base_pair) middles;
    double height; /* levels from which on medians are taken */
} index_work;

static double widened(double x, double by) {
    double y = x + by;
    return y < -DBL_MAX ? -DBL_MAX : y > DBL_MAX ? DBL_MAX : y;
}

/* --------------------------------------------------------------- fragments -- */

/* Has a cell got this object already? Only those in several cells of the grid can come twice. */
static bool taken(const index_work *w, size_t from, uint32_t object) {
    for (size_t i = from; i < w->items.count; i++)
        if ((w->items.data[i].id & PACKED_OBJECT) == object) return true;
    return false;
}

static froe_status end_packed_leaf(index_work *w, const index_cell *cell) {
    uint64_t most = w->job->max_fragments;
    uint8_t flags = cell->count > w->job->leaf ? TREE_CROWDED : 0;
    const packed_fragment *fragments = w->items.data + cell->first;
    if (most && (uint64_t)w->packer.piece_count + cell->count > most) return FROE_E_BUDGET;
    w->items.count = cell->first;
    return packer_leaf(&w->packer, cell->node, &cell->box, fragments, cell->count, flags);
}

/* --------------------------------------------------------------- one cut -- */

/* Splits the node; the cells of both sides, without contents. */
static froe_status split_index_node(index_work *w, const index_cell *cell, int axis, double value, index_cell side[2]) {
    uint32_t child;
    froe_status status = packer_split(&w->packer, cell->node, axis, value, &child);
    for (uint32_t i = 0; i < 2 && !status; i++) {
        side[i] = *cell;
        side[i].node = child + i;
        side[i].depth++;
        (i ? side[i].box.lo : side[i].box.hi)[axis] = value;
    }
    return status;
}

/* The negative child last, so that it comes first. */
static froe_status push_index_cells(index_work *w, const index_cell side[2]) {
    bool room = array_push(&w->job->alloc, &w->cells, side[1]) && array_push(&w->job->alloc, &w->cells, side[0]);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------ cells of grids -- */

static froe_status cut_grid_node(index_work *w, const index_cell *cell) {
    const split_grid *g = w->grids.data + w->grids.count - 1;
    uint32_t level = grid_level(cell->heap), axis = g->axis[level];
    uint32_t middle = cell->line[axis] + (1u << g->rest[level][axis] >> 1);
    index_cell side[2];
    froe_status status = split_index_node(w, cell, (int)axis, g->lines[axis][middle], side);
    if (status) return status;
    for (uint32_t i = 0; i < 2; i++) {
        side[i].heap = 2 * cell->heap + i;
        side[i].line[axis] = i ? middle : cell->line[axis];
    }
    double sum = (double)g->count[2 * cell->heap] + g->count[2 * cell->heap + 1];
    side[0].growth = side[1].growth = cell->growth * sum / g->count[cell->heap];
    return push_index_cells(w, side);
}

/* Lays a grid over a cell, of fragments or, fragments NULL, of all objects. */
static froe_status begin_grid(index_work *w, const index_cell *cell, const packed_fragment *fragments, bool *made) {
    const double *option = w->job->option;
    double growth = option[GROWTH] / cell->growth;
    grid_source source = {.fragments = fragments,
                          .count = cell->count,
                          .box = cell->box,
                          .load = (uint32_t)option[LOAD],
                          .growth = growth < 2 ? growth : 2};
    split_grid grid;
    *made = false;
    if (!array_reserve(&w->job->alloc, &w->grids, 1) || !array_reserve(&w->job->alloc, &w->cells, 2))
        return FROE_E_MEMORY;
    froe_status status = grid_new(&w->axis, w->job->task, &w->job->alloc, &source, &grid, made);
    if (status || !*made) return status;
    w->grids.data[w->grids.count++] = grid;
    index_cell end = *cell, root = *cell;
    end.heap = GRID_END;
    root.heap = 1;
    root.line[0] = root.line[1] = root.barren = root.lonely = 0;
    w->cells.data[w->cells.count++] = end;
    w->cells.data[w->cells.count++] = root;
    return FROE_OK;
}

/* -------------------------------------------------------- cells of fragments -- */

/* Bounds of the fragments' images. */
static packed_box contents(const packed_fragment *f, uint32_t count) {
    packed_box box = {{f->p[0], f->p[1]}, {f->p[0], f->p[1]}};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            double a = f[i].p[k], b = f[i].q[k];
            box.lo[k] = fmin(box.lo[k], fmin(a, b));
            box.hi[k] = fmax(box.hi[k], fmax(a, b));
        }
    return box;
}

/* A cut beside the contents, where the cell has more room than they are large; false: nowhere. */
static bool shrink_cut(const index_cell *cell, const packed_fragment *f, halve_cut *cut) {
    packed_box box = contents(f, cell->count);
    double size = fmax(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]), most = 2 * size;
    if (!(size > 0)) return false;
    for (int k = 0; k < 2; k++) {
        double below = box.lo[k] - cell->box.lo[k], above = cell->box.hi[k] - box.hi[k];
        if (below > most) *cut = (halve_cut){.axis = k, .value = box.lo[k] - 0.173 * size}, most = below;
        if (above > most) *cut = (halve_cut){.axis = k, .value = box.hi[k] + 0.191 * size}, most = above;
    }
    return most > 2 * size;
}

/* The middle of the middles of fragments along the longer side of their box. */
static bool median_cut(index_work *w, const index_cell *cell, const packed_fragment *f, halve_cut *cut) {
    packed_box box = contents(f, cell->count);
    size_t n = cell->count;
    w->middles.count = 0;
    if (!array_reserve(&w->job->alloc, &w->middles, 2 * n)) return false;
    cut->axis = box.hi[1] - box.lo[1] > box.hi[0] - box.lo[0];
    for (uint32_t i = 0; i < n; i++)
        w->middles.data[i] = (base_pair){base_double_key(0.5 * f[i].p[cut->axis] + 0.5 * f[i].q[cut->axis]), i};
    base_radix_sort(w->middles.data, w->middles.data + n, n);
    const packed_fragment *middle = f + w->middles.data[n / 2].value;
    cut->value = 0.5 * middle->p[cut->axis] + 0.5 * middle->q[cut->axis];
    return true;
}

static halve_cut middle_cut(const packed_box *box, int axis) {
    return (halve_cut){.axis = axis, .value = 0.5 * box->lo[axis] + 0.5 * box->hi[axis]};
}

static bool count_sides(index_work *w, const index_cell *cell, halve_cut *cut, int which) {
    return halve_count(&w->axis, &cell->box, w->items.data + cell->first, cell->count, cut, w->classes[which].data);
}

/* Is it time for medians? */
static bool is_deep(const index_work *w, const index_cell *cell) {
    return w->height > 0 && cell->depth > w->height;
}

/* Names the cut of a cell; false: it is to be a leaf. */
static bool choose_halving(index_work *w, const index_cell *cell, halve_cut *cut, int *which) {
    const packed_fragment *f = w->items.data + cell->first;
    *which = 0;
    if (cell->growth >= w->job->option[GROWTH] || cell->barren >= BARREN) return false;
    if (cell->lonely >= LONELY && shrink_cut(cell, f, cut) && count_sides(w, cell, cut, 0)) return true;
    if (is_deep(w, cell) && median_cut(w, cell, f, cut) && count_sides(w, cell, cut, 0)) return true;
    /* The middle cut across the longer side, or the other one where that divides most fragments; false where both
     * divide all. *which: whose classes. */
    const double *lo = cell->box.lo, *hi = cell->box.hi;
    int axis = 0.5 * hi[1] - 0.5 * lo[1] > 0.5 * hi[0] - 0.5 * lo[0];
    halve_cut other = middle_cut(&cell->box, 1 - axis);
    *cut = middle_cut(&cell->box, axis);
    *which = 0;
    bool found = count_sides(w, cell, cut, 0);
    if (found && 2 * (uint64_t)cut->both <= cell->count) return true;
    if (count_sides(w, cell, &other, 1) && (!found || other.both < cut->both)) *cut = other, *which = 1, found = true;
    return found && cut->both < cell->count;
}

/* One cut of a cell of fragments; a leaf, where none pays. */
static froe_status halve_cell(index_work *w, const index_cell *cell) {
    const froe_allocator *alloc = &w->job->alloc;
    halve_cut cut = {0};
    index_cell side[2];
    int which;
    for (int i = 0; i < 2; i++) {
        w->classes[i].count = 0;
        if (!array_reserve(alloc, &w->classes[i], cell->count)) return FROE_E_MEMORY;
    }
    if (!choose_halving(w, cell, &cut, &which)) return end_packed_leaf(w, cell);
    froe_status status = split_index_node(w, cell, cut.axis, cut.value, side);
    if (status) return status;
    /* deals the fragments: the positive ones take the place of all, the negative ones lie on top */
    uint32_t negative = cut.sides[0], positive = cut.sides[1];
    w->items.count = cell->first + cell->count;
    w->spare.count = 0;
    if (!array_reserve(alloc, &w->items, cut.both + 1) || !array_reserve(alloc, &w->spare, negative + 1))
        return FROE_E_MEMORY;
    packed_fragment *items = w->items.data + cell->first;
    halve_deal(w->axis.ends, items, cell->count, &cut, w->classes[which].data, w->spare.data, items);
    if (negative) memcpy(items + positive, w->spare.data, negative * sizeof *items);
    w->items.count = cell->first + positive + negative;
    bool lonely = !negative || !positive, barren = 5 * (uint64_t)cut.both > 4 * (uint64_t)cell->count;
    for (int i = 0; i < 2; i++) {
        side[i].first = i ? cell->first : cell->first + positive;
        side[i].count = cut.sides[i];
        side[i].growth = cell->growth * (1 + (double)cut.both / cell->count);
        side[i].lonely = lonely ? cell->lonely + 1 : 0;
        side[i].barren = barren ? cell->barren + 1 : 0;
    }
    return push_index_cells(w, side);
}

/* -------------------------------------------------------------------- loop -- */

static froe_status do_index_cell(index_work *w, index_cell *cell) {
    froe_status status = FROE_OK;
    const bool grown = cell->growth >= w->job->option[GROWTH];
    if (cell->heap == GRID_END) {
        grid_free(&w->job->alloc, w->grids.data + --w->grids.count);
        w->items.count = cell->first;
        return FROE_OK;
    }
    if (cell->heap) {
        const split_grid *g = w->grids.data + w->grids.count - 1;
        const bool inner = grid_level(cell->heap) < g->levels && !grown;
        if (inner && g->count[cell->heap] > w->job->leaf) return cut_grid_node(w, cell);
        /* the fragments of a node of the grid */
        const uint32_t from = grid_first(g, cell->heap), to = grid_end(g, cell->heap);
        const bool many = grid_level(cell->heap) < g->levels;
        if (!array_reserve(&w->job->alloc, &w->items, to - from)) return FROE_E_MEMORY;
        cell->first = (uint32_t)w->items.count;
        for (uint32_t i = from; i < to; i++) {
            const uint32_t object = g->ids[i] & PACKED_OBJECT;
            if (i + AHEAD < g->id_room) __builtin_prefetch(w->axis.ends + (g->ids[i + AHEAD] & PACKED_OBJECT));
            if (many && g->ids[i] & GRID_SHARED && taken(w, cell->first, object)) continue;
            axis_clip(&w->axis, object, &cell->box, w->items.data + w->items.count++);
        }
        cell->count = (uint32_t)w->items.count - cell->first;
        cell->heap = 0;
    }
    w->items.count = cell->first + cell->count;
    bool made = false;
    if (cell->count <= w->job->leaf) return end_packed_leaf(w, cell);
    if (cell->count >= w->job->option[LEAST] && !is_deep(w, cell) && !grown)
        status = begin_grid(w, cell, w->items.data + cell->first, &made);
    return status || made ? status : halve_cell(w, cell);
}

/* The ends of all objects, and the root box with all of them in it, or a grid over it. */
static froe_status begin_index(index_work *w) {
    static const double odd[2][2] = {{0.00217339, 0.00293507}, {0.00251103, 0.00197911}};
    const froe_scene *s = w->job->scene;
    const double *ends[2];
    index_cell root = {.box = {{0, 0}, {0, 0}}, .growth = 1, .count = s->object_count};
    bool made = false;
    froe_status status = FROE_OK;
    w->axis.ends = support_calloc(&w->job->alloc, s->object_count, sizeof *w->axis.ends);
    if (!w->axis.ends) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < s->object_count; i++) {
        packed_ends(s, i, ends);
        w->axis.ends[i] = (axis_ends){{ends[0][0], ends[0][1]}, {ends[1][0], ends[1][1]}};
    }
    double x = 0.5 * s->hi[0] - 0.5 * s->lo[0], y = 0.5 * s->hi[1] - 0.5 * s->lo[1], side = 2 * (x > y ? x : y);
    for (int k = 0; s->object_count && k < 2; k++) {
        root.box.lo[k] = widened(s->lo[k], -side * odd[k][0]);
        root.box.hi[k] = widened(s->hi[k], side * odd[k][1]);
    }
    memcpy(w->job->meta.root_lo, root.box.lo, sizeof root.box.lo);
    memcpy(w->job->meta.root_hi, root.box.hi, sizeof root.box.hi);
    if (root.count >= w->job->option[LEAST]) status = begin_grid(w, &root, NULL, &made);
    if (status || made) return status;
    /* all objects as fragments, where no grid can be laid over them */
    if (!array_reserve(&w->job->alloc, &w->items, root.count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < root.count; i++) axis_clip(&w->axis, i, &root.box, w->items.data + w->items.count++);
    return array_push(&w->job->alloc, &w->cells, root) ? FROE_OK : FROE_E_MEMORY;
}

/* -------------------------------------------------------------------- whole -- */

static froe_status build_in_plane(build_job *job, froe_tree **out) {
    index_work w = {.job = job, .axis = {.context = &w.context}};
    froe_status status = geom_context_new(&job->alloc, &w.context);
    if (status) return status;
    if (job->first > w.context.first) w.context.first = job->first;
    const size_t objects = job->scene->object_count;
    w.height = job->option[HEIGHT] > 0 ? job->option[HEIGHT] * base_log2((double)objects + 2.0) + 16 : 0;
    status = packer_new(&job->alloc, job->scene->dim, job->scene->object_count, job->leaf, &w.packer);
    if (!status) {
        status = begin_index(&w);
        while (w.cells.count && !status) {
            index_cell cell = w.cells.data[--w.cells.count];
            status = do_index_cell(&w, &cell);
            const double share = (double)w.packer.owners.count / ((double)objects + 1.0);
            if (!status && !base_progress(job->task, 0.1 + 0.8 * share)) status = FROE_E_CANCELLED;
        }
        if (!status) status = packer_seal(&w.packer, job->scene, &job->meta, out);
        if (!status) (*out)->predicates = (*out)->report.predicates = w.context.stats;
        packer_free(&w.packer);
    }
    const froe_allocator *alloc = &job->alloc;
    while (w.grids.count) grid_free(alloc, w.grids.data + --w.grids.count);
    support_free(alloc, w.axis.ends, (objects ? objects : 1) * sizeof *w.axis.ends);
    array_free(alloc, &w.grids);
    array_free(alloc, &w.cells);
    array_free(alloc, &w.items);
    array_free(alloc, &w.spare);
    array_free(alloc, &w.middles);
    for (int i = 0; i < 2; i++) array_free(alloc, &w.classes[i]);
    num_context_free(&w.context);
    return status;
}

static froe_status build_index(build_job *job, froe_tree **out) {
    const froe_scene *s = job->scene;
    if (s->object_count > PACKED_OBJECT)
        return support_fail(job->diag, FROE_E_LIMIT, "Method 'index' serves at most 2^30 objects.");
    build_promise(job, "fragments", 2 * job->option[GROWTH] * s->object_count, 0);
    froe_status status = s->dim == 3 ? build_in_space(job, job->option[GROWTH], out) : build_in_plane(job, out);
    return split_explain(job->diag, job->max_fragments, status);
}

const build_method build_method_index = {
    .info = {.name = "index",
             .summary = "made to be queried: middle cuts or, in space, cuts by surface area; packed leaves",
             .source = "the octree rule, in binary cuts; MacDonald and Booth 1990; layout and queries are froe's own",
             .guarantee = "at most 2 growth n fragments; leaves over capacity where more cuts do not pay",
             .kinds = {[2] = 1u << FROE_POINT | 1u << FROE_SEGMENT, [3] = BUILD_KINDS_ALL},
             .leaf = 24,
             .least_leaf = 1,
             .options = options},
    .tunable = true,
    .build = build_index,
};
