/* converted.c: BSPs of segments from BSPs of their endpoints.
 *
 *     of points, with v cells met by a range    ->    of disjoint segments, O((v + k) height) nodes visited,
 *                                                     O(n height) large, O(height) high
 *
 * de Berg and Streppel: Approximate range searching using binary space partitions (2004), theorem 1; see
 * build/conversion/convert.h. What is promised is the number of fragments: n (1 + 2 height of the BSP of points), and
 * those that segments make where they cross. */
#include "build/conversion/endpoints.h"

enum { FROM, TUNING, PRUNE };

/* The rules by which endpoints are partitioned, and the methods of the registry that do it. */
static const char *const rules[] = {"kd", "bar", "quad", "median", "hamsandwich", NULL};
static const convert_plan plans[] = {
    {"kd", NULL, true}, {"bar", NULL, true}, {"quad", NULL, true}, {"kd", "axes=first", true}, {NULL, NULL, true}};
static const char *const no_yes[] = {"no", "yes", NULL};
static const froe_option_info options[] = {
    [FROM] = {"from", "the BSP of the endpoints to begin with; median: of x", 0, 0, 4, rules, true},
    [TUNING] = {0},
    [PRUNE] = {"prune", "leave out cuts with nothing on one side where no other cut ends", 1, 0, 1, no_yes, true},
    {0},
};

static froe_status build_by_conversion(build_job *job, froe_tree **out) {
    convert_plan plan = plans[(int)job->option[FROM]];
    plan.prune = job->option[PRUNE] != 0;
    return build_converted(job, &plan, out);
}

const build_method build_method_converted = {
    .info = {.name = "converted",
             .summary = "follows a BSP of the endpoints, and cuts along what crosses a cell",
             .source = "de Berg and Streppel 2004, theorem 1; Paterson and Yao 1990",
             .guarantee = "n (1 + 2 height of the BSP of endpoints) fragments of disjoint segments",
             .kinds = BUILD_SERVES(1u << 2, 1u << FROE_POINT | 1u << FROE_SEGMENT),
             .options = options},
    .tunable = true,
    .build = build_by_conversion,
};
