/* cuts.c: planes of all tabled cuts, laid out for filters. */
#include "query/cuts.h"
#include "support/fail.h"
#include <string.h>

static void free_planes(const froe_allocator *alloc, query_part *part) {
    query_planes *p = (query_planes *)part;
    support_free(alloc, p->planes, p->count * sizeof *p->planes);
    support_free(alloc, p, sizeof *p);
}

double query_far_value(const query_plane *h, int dim, const double *x, double c, double *error) {
    double sum = 0, size = fabs(c), spread = 0;
    for (int k = 0; k < dim; k++) {
        const double product = h->far[k] * x[k];
        sum += product;
        size += fabs(product);
        spread += fabs(x[k]);
    }
    *error = ((2 * dim + 8) * FILTER_U * size + h->n_err * spread + dim * NUM_BALL_TINY) * FILTER_UP;
    return sum - c;
}

static froe_status make_cuts(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_tree *t = q->tree;
    query_planes *p = support_calloc(&q->alloc, 1, sizeof *p);
    if (!p) return support_fail_memory(diag);
    p->part.free = free_planes;
    *out = &p->part;
    bool oblique = false;
    for (uint32_t i = 0; i < t->cut_count; i++) oblique |= t->cuts[i].kind != FROE_CUT_AXIS;
    if (!oblique) return FROE_OK;
    p->planes = support_calloc(&q->alloc, t->cut_count, sizeof *p->planes);
    if (!p->planes) return support_fail_memory(diag);
    p->count = t->cut_count;
    for (uint32_t v = 0; v < t->node_count; v++) {
        const tree_node *node = t->nodes + v;
        if (node->type != TREE_TABLED || t->cuts[node->u.cut].kind == FROE_CUT_AXIS) continue;
        const geom_plane plane = tree_plane_at(t, v);
        query_plane *h = p->planes + node->u.cut;
        *h = (query_plane){.c = plane.c, .n_err = plane.n_err};
        if (plane.form == GEOM_AT_CROSSING) {
            /* x[0] = c, where c is known up to c_err only: as (x - (c - k)) - k with a k so large that what is charged
             * for its rounding covers the error. */
            const double k = plane.c_err / (4 * FILTER_U) + fabs(plane.c) / 2;
            *h = (query_plane){.n = {1}, .o = {plane.c - k}, .c = k, .n_err = k < 0x1p1000 ? 0 : INFINITY};
            continue;
        }
        /* rounding is charged for with 2 u |c| to spare, as FINE cuts need it that are in lowest terms */
        if (plane.form == GEOM_FINE && !(plane.c_err <= 2 * FILTER_U * fabs(plane.c))) h->n_err = INFINITY;
        if (plane.dim > 3) {
            h->far = t->normals + t->cuts[node->u.cut].a;
            continue;
        }
        memcpy(h->n, plane.n, sizeof h->n);
        if (plane.form == GEOM_POINTS || plane.form == GEOM_VERTICAL) memcpy(h->o, plane.p[0], sizeof h->o);
    }
    return FROE_OK;
}

froe_status query_planes_of(froe_query *query, const query_planes **out, froe_diagnostic *diag) {
    const query_part *part;
    froe_status status = query_prepare(query, QUERY_PLANES, make_cuts, &part, diag);
    if (status == FROE_OK) *out = (const query_planes *)part;
    return status;
}
