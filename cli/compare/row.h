/* row.h: one method on one scene: its tree, the cost of queries, its growth; or the reason why there is none. */
#ifndef FROE_CLI_COMPARE_ROW_H
#define FROE_CLI_COMPARE_ROW_H
#include "args/options.h"
#include "compare/meter.h"
#include "compare/workload.h"

/** What all rows share. */
typedef struct compare_plan {
    const cli_common *common;
    uint32_t leaf;     /**< as in froe_build_options */
    double seconds;    /**< for a build, and for each kind of query; beyond: given up */
    double pieces;     /**< per object; beyond: given up */
    uint64_t queries;  /**< of each kind */
    uint64_t halvings; /**< parts of the scene built besides: n / 2, n / 4, ... */
    bool times;        /**< report times and memory */
    bool pictures;     /**< draw cells */
} compare_plan;

/** A scene and its objects from the middle outwards (part.h). */
typedef struct compare_scene {
    froe_scene *scene;
    uint32_t *order;
    meter *memory; /**< of the scene and of what is built on it */
} compare_scene;

/** {"method", "status": "ok"} and the tree's report with "seconds", "queries" (workload.h), "peak_bytes", "leaf_loads",
 * "growth" and, for pages, "picture" (PNG, base64); or "status": "failed" and a "note" that says why. NULL:
 * interrupted, or no memory. */
json_t *compare_row(const compare_plan *plan, const compare_scene *scene, const char *method);
#endif
