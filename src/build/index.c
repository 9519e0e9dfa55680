/* index.c: trees to be queried: middle cuts, packed leaves. In space: build/index/space.c.
 *
 *     +-------+---+---+    Cells are halved across their longer side until they hold at most `leaf` fragments: the
 *     |       | \ |   |    octree rule, with binary cuts. Large cells are halved many times at once
 *     |   /   +-\-+---+    (build/index/grid.h), small ones one by one (build/index/halve.h). The objects are segments
 *     |  /    |  \| / |    and points of the plane, which become fragments of their cells; a leaf is written as a
 *     +-------+---+---+    block as soon as it is reached (tree/packed/packer.h). */
#include "base/log2.h"
#include "build/index/plane.h"
#include "build/index/space.h"
#include "support/fail.h"

enum { GROWTH, HEIGHT, TUNING, LOAD, LEAST, PARTS };

static const froe_option_info options[] = {
    [GROWTH] = {"growth", "fragments per fragment at which a cell is left as it is", 4, 1, 1000, NULL, false},
    [HEIGHT] = {"height", "medians beyond this many times log2 n levels, plus 16; 0: no rule", 2, 0, 1e9, NULL, false},
    [TUNING] = {0},
    [LOAD] = {"load", "objects in a cell of a grid of middle cuts, at most", 20, 1, 1e6, NULL, true},
    [LEAST] = {"grid", "fragments from which a cell is cut by a grid", 256, 2, 1e9, NULL, true},
    [PARTS] = {"parts", "objects from which subtrees are jobs of their own", 8192, 2, 1e9, NULL, true},
    {0},
};

static froe_status build_index(build_job *job, froe_tree **out) {
    const froe_scene *s = job->scene;
    const double *option = job->option, objects = s->object_count;
    if (s->object_count > PACKED_OBJECT)
        return support_fail(job->diag, FROE_E_LIMIT, "Method 'index' serves at most 2^30 objects.");
    build_promise(job, "fragments", 2 * option[GROWTH] * objects, 0);
    index_plan plan = {.job = job,
                       .growth = option[GROWTH],
                       .height = option[HEIGHT] > 0 ? option[HEIGHT] * base_log2(objects + 2.0) + 16 : 0,
                       .load = (uint32_t)option[LOAD],
                       .grid = (uint32_t)option[LEAST],
                       .parts = (uint32_t)option[PARTS]};
    froe_status status =
        s->dim == 3 ? build_in_space(job, option[GROWTH], plan.parts, out) : build_in_plane(&plan, out);
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
