/* workload.h: the same queries for every tree of a scene, and what they cost. */
#ifndef FROE_CLI_COMPARE_WORKLOAD_H
#define FROE_CLI_COMPARE_WORKLOAD_H
#include <froe/query.h>
#include <jansson.h>

typedef struct workload {
    uint64_t count; /**< queries of each kind */
    uint64_t seed;
    double seconds; /**< a kind that takes longer is cut short */
    bool times;     /**< report microseconds */
} workload;

/** Asks points, windows, rays (to dimension 3) and, for each eps, large windows. Returns
 * {"point": {"asked", "nodes", "nodes_p99", "leaves", "tests", "found", "microseconds"}, "window", "ray",
 * "approximate": the same at eps 1/8, "by_eps": [{"eps", ...}]}, means over queries but for the 99th percentile of the
 * nodes. NULL: the tree cannot be asked; `status` and `diag` say why. */
json_t *workload_run(const froe_tree *tree, const workload *load, froe_status *status, froe_diagnostic *diag);
#endif
