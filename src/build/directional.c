/* directional.c: boxes, cut where the room beside them pays for what is divided.
 *
 *      +----+ ......         Beside each side of a box lies a room, delta times as wide as the box. A cut may divide
 *      |    | :    :         boxes if it goes through enough rooms that no cut has touched so far; those die. Each box
 *      +----+ :....:         has 2 d rooms, so that happens a bounded number of times: size linear in n, as long as
 *         :  |               few boxes reach across the neighbourhood of another (low directional density).
 *         cut
 *
 * Tobola and Nechvile, "Linear size BSP trees for scenes with low directional density", with their cuts weighted, so
 * that the bound on fragments can be proved (build/directional/boxes.h), and cuts that divide nothing first. The stages
 * are those of build/directional/boxes_sweep.c. A cell is swept in time linear in its events; where a cut leaves one
 * side with less than 1/8, the cell goes on in trees that pay for the smaller side alone
 * (build/directional/boxes_carve.c): O(N log^2 N) for N fragments however unbalanced. Both choose the same cuts. */
#include "base/curve.h"
#include "base/log2.h"
#include "build/directional/boxes.h"
#include "build/method.h"
#include "support/fail.h"
#include <math.h>

enum { BOXES, TRADE, BALANCE, SLACK, TUNING, DELTA, STRUCTURE };
enum { AUTO, SWEEP, TREES };
enum {
    CARVE_LEAST = 256,
    CARVE_SHARE = 8
}; /* trees are for cells of so many, where a side gets less than this share */

static const char *const kinds[] = {"solid", "faces", NULL};
static const char *const structures[] = {"auto", "sweep", "trees", NULL};
static const froe_option_info options[] = {
    [BOXES] = {"boxes", "solid: cells end when no cut separates boxes; faces: when no face is left inside", 0, 0, 1,
               kinds, true},
    [TRADE] = {"trade", "boxes that may be divided for one room: more: better balanced", 2, 1, 64, NULL, true},
    [BALANCE] = {"balance",
                 "cuts that divide nothing come first if at least so balanced, as a share of the balance of others", 0,
                 0, 1, NULL, false},
    [SLACK] = {"slack", "share of the balance that is given up to divide less", 0.25, 0, 1, NULL, false},
    [TUNING] = {0},
    [DELTA] = {"delta", "room beside a box, in sides of the box", 0.5, 0, 1e6, NULL, false},
    [STRUCTURE] = {"structure", "how cuts are found; all find the same", AUTO, 0, 2, structures, true},
    {0},
};

/** The root cell: all objects along a curve, so that fragments that meet in cells lie near each other in memory. */
static froe_status prepare_boxes(build_job *job, boxes *b) {
    const froe_scene *scene = job->scene;
    uint32_t n = scene->object_count;
    boxes_cell root = {.cover = FROE_NONE};
    for (int k = 0; k < b->dim; k++) root.lo[k] = -INFINITY, root.hi[k] = INFINITY;
    uint32_t *objects = support_calloc(&job->alloc, n, sizeof *objects);
    base_pair *pairs = support_calloc(&job->alloc, 2 * (size_t)n, sizeof *pairs);
    froe_status status = objects && pairs ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; i < n && !status; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(scene, i, lo, hi);
        pairs[i] = (base_pair){base_curve_place(scene->dim, lo, hi, scene->lo, scene->hi), i};
    }
    if (n && !status) base_radix_sort(pairs, pairs + n, n);
    for (uint32_t i = 0; i < n && !status; i++) objects[i] = pairs[i].value;
    support_free(&job->alloc, pairs, n ? 2 * (size_t)n * sizeof *pairs : 1);
    if (!status) status = boxes_open(b, root, objects, n);
    support_free(&job->alloc, objects, n ? n * sizeof *objects : 1);
    return status;
}

static froe_status check_budget(const build_job *job, const boxes *b, uint64_t more) {
    uint64_t pieces = b->draft.pieces.count + b->fragments.count + more;
    return job->max_fragments && pieces > job->max_fragments ? FROE_E_BUDGET : FROE_OK;
}

/** Lists what is in the cell: the boxes that cover it, and its fragments. */
static froe_status end_box_leaf(const build_job *job, boxes *b, boxes_cell *cell, bool crowded) {
    const bool begun = cell->covers;
    froe_status status = check_budget(job, b, cell->covers);
    const uint8_t full = crowded ? TREE_CROWDED : TREE_INSEPARABLE;
    draft_leaf(&b->draft, cell->node, cell->count > job->leaf ? full : 0);
    if (!status) status = boxes_list_covers(b, cell);
    if (cell->count && !begun && !status) status = draft_list(&b->draft, cell->node);
    for (uint32_t i = 0; i < cell->count && !status; i++)
        status = draft_piece(&b->draft, cell->node, b->fragments.data[cell->first + i].object, NULL, 0);
    boxes_drop(b, cell);
    return status;
}

/** All cells; the progress shown is the share of boxes that are in leaves. */
static froe_status do_box_cells(const build_job *job, boxes *b) {
    double n = job->scene->object_count, from = job->task->done, left;
    froe_status status = FROE_OK;
    for (uint32_t turn = 0; b->cells.count && !status; turn++) {
        boxes_cell cell = b->cells.data[--b->cells.count];
        bool small = !cell.count || (!b->options.faces && cell.count <= job->leaf);
        b->taken += small ? 0 : cell.count;
        boxes_cut cut = small ? (boxes_cut){.found = false} : boxes_sweep(b, &cell);
        if (!cut.found) {
            status = end_box_leaf(job, b, &cell, cut.crowded);
        } else {
            /* is the cut so far off balance that the cell is worth trees? */
            const uint32_t less = cut.below < cut.above ? cut.below : cut.above;
            bool trees = cell.count >= CARVE_LEAST && less + cut.divided < cell.count / CARVE_SHARE;
            if (job->option[STRUCTURE] != AUTO) trees = job->option[STRUCTURE] == TREES && cell.count > 1;
            b->taken += trees ? 2 * (uint64_t)cell.count : 0; /* into trees, and what is left out of them */
            status = trees ? boxes_carve(b, &cell, job->task) : boxes_divide(b, &cell, &cut);
            if (!status) status = check_budget(job, b, 0);
        }
        if (status || turn % 256) continue;
        left = (double)b->fragments.count < n ? (double)b->fragments.count / n : 1;
        if (!base_progress(job->task, from + 0.9 * (1 - left) * (1 - from))) status = FROE_E_CANCELLED;
    }
    return status;
}

/** Boxes taken up, for N fragments and C cuts in the end: 4 N (log2 N + 4) + 256 C.
 *
 * A cut by which neither side gets less than 1/8 of the m boxes of its cell is found in a sweep, of m. Of other cells
 * those of 256 boxes and more are swept once and cut in trees until half is gone: 3 m, at most 6 for each box that is
 * gone. So what a cut costs is at most 8 times what its smaller side has of the N in the end, and 8 for each box in the
 * cut, or 256 in a small cell. The smaller sides add up to N / 2 log2 N over a tree, the boxes in cuts to N. Where no
 * cut is found, at most 7 for each box that is left. */
static void promise_work(build_job *job, const boxes *b) {
    const double n = (double)b->draft.pieces.count, cuts = 0.5 * (double)b->draft.nodes.count;
    if (job->option[STRUCTURE] != AUTO) return;
    build_promise(job, "boxes_taken", 4 * n * (base_log2(n + 1) + 4) + CARVE_LEAST * cuts, (double)b->taken);
}

static froe_status build_directional(build_job *job, froe_tree **out) {
    boxes b = {.dim = 0};
    uint32_t trade = (uint32_t)job->option[TRADE], n = job->scene->object_count;
    boxes_options how = {.delta = job->option[DELTA],
                         .trade = trade,
                         .balance = job->option[BALANCE],
                         .slack = job->option[SLACK],
                         .faces = job->option[BOXES] != 0,
                         .leaf = job->leaf};
    froe_status status = boxes_new(job->scene, &job->alloc, &how, &b);
    double bound = boxes_bound(&b, n);
    if (!status && n && bound == 0)
        status =
            support_fail(job->diag, FROE_E_OPTIONS, "option 'trade': '%u' is too large in dimension %d.", trade, b.dim);
    else {
        if (!status) status = prepare_boxes(job, &b);
        if (!status) status = do_box_cells(job, &b);
        build_promise(job, "fragments", bound + (double)b.paid, 0);
        promise_work(job, &b);
        if (!status) status = draft_seal(&b.draft, NULL, 0, job->scene, &job->meta, out);
        status = split_explain(job->diag, job->max_fragments, status);
    }
    boxes_free(&b);
    return status;
}

const build_method build_method_directional = {
    .info = {.name = "directional",
             .summary = "boxes, cut where the room beside them pays for what is divided",
             .source = "Tobola and Nechvile: BSP for scenes with low directional density",
             .guarantee = "O(n) fragments at low directional density; O(N log^2 N) time for N",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, 1u << FROE_POINT | 1u << FROE_BOX),
             .options = options},
    .tunable = true,
    .build = build_directional,
};
