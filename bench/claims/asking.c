/* asking.c: what queries cost, in nodes, leaves, steps and tests. */
#include "claims.h"
#include <math.h>

claims_asker claims_ask(const claims_tree *t) {
    claims_asker a = {.scene = t->scene, .dim = froe_scene_dim(t->scene), .state = 1};
    froe_diagnostic diag = {0};
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bench_must(froe_query_new(t->tree, &a.query, &diag), &diag);
    froe_scene_bounds(t->scene, lo, hi);
    for (int k = 0; k < a.dim; k++) a.side = fmax(a.side, hi[k] - lo[k]);
    return a;
}

double claims_asked(claims_asker *a) {
    const froe_query_stats s = froe_query_statistics(a->query);
    return (double)(s.nodes + s.leaves + s.steps + s.tests);
}

void claims_place(claims_asker *a, double away, double *out) {
    const uint32_t object = (uint32_t)(bench_unit(&a->state) * (double)froe_scene_object_count(a->scene));
    const double *p = froe_scene_vertex(a->scene, froe_scene_corner(a->scene, object, 0));
    for (int k = 0; k < a->dim; k++) out[k] = p[k] + away * a->side * (2 * bench_unit(&a->state) - 1);
}

double claims_location(const claims_tree *t) {
    claims_asker a = claims_ask(t);
    froe_diagnostic diag = {0};
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double points[2 * FROE_MAX_DIM];
        froe_range point = froe_range_defaults();
        froe_list list;
        claims_place(&a, 0, points);
        for (int k = 0; k < a.dim; k++) { /* half-way to the origin: in a cell, not on a corner */
            points[k] *= 0.75;
            points[a.dim + k] = points[k];
        }
        point.points = points, point.walk = FROE_WALK_PLAIN;
        bench_must(t->way.bare ? froe_query_range(a.query, &point, &list, &diag)
                               : froe_query_locate(a.query, points, &list, &diag),
                   &diag);
    }
    const double cost = claims_asked(&a) / CLAIMS_QUERIES;
    froe_query_free(a.query);
    return cost;
}
