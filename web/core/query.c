/* query.c: ranges of every shape; all other questions are functions of <froe/query.h> as they are */
#include "web.h"
#include <froe/query.h>
#include <stdlib.h>

static const char *shape_name(int value) {
    return froe_range_shape_name((froe_range_shape)value);
}

static const web_member members[] = {
    {"shape", WEB_NAMED, offsetof(froe_range, shape), shape_name},
    {"points", WEB_ADDRESS, offsetof(froe_range, points), NULL},
    {"count", WEB_INT, offsetof(froe_range, count), NULL},
    {"offsets", WEB_ADDRESS, offsetof(froe_range, offsets), NULL},
    {"radius", WEB_DOUBLE, offsetof(froe_range, radius), NULL},
    {"eps", WEB_DOUBLE, offsetof(froe_range, eps), NULL},
    {NULL, WEB_INT, 0, NULL},
};

WEB_EXPORT froe_range *web_range_new(void) {
    froe_range *range = malloc(sizeof *range);
    if (range) *range = froe_range_defaults();
    return range;
}
WEB_EXPORT froe_status web_range_number(froe_range *range, const char *name, double value, froe_diagnostic *diag) {
    return web_set_number(range, members, name, value, diag);
}
WEB_EXPORT froe_status web_range_name(froe_range *range, const char *name, const char *value, froe_diagnostic *diag) {
    return web_set_name(range, members, name, value, diag);
}

/** What the questions since the last call have cost: nodes, leaves, objects tested. */
WEB_EXPORT void web_statistics(froe_query *query, double out[3]) {
    const froe_query_stats stats = froe_query_statistics(query);
    out[0] = (double)stats.nodes;
    out[1] = (double)stats.leaves;
    out[2] = (double)stats.tests;
}
