/* cuts.c: planes of all tabled cuts, laid out for filters. */
#include "query/cuts.h"
#include "support/fail.h"
#include <string.h>

static void free_planes(const froe_allocator *alloc, query_part *part) {
    query_planes *p = (query_planes *)part;
    support_free(alloc, p->planes, p->count * sizeof *p->planes);
    if (p->numbers) support_free(alloc, p->numbers, p->cut_count * sizeof *p->numbers);
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

/* The plane of a node's cut, ready for filters. */
static query_plane plane_of_cut(const froe_tree *t, uint32_t node) {
    const geom_plane plane = tree_plane_at(t, node);
    query_plane h = {.c = plane.c, .n_err = plane.n_err};
    if (plane.form == GEOM_AT_CROSSING) {
        /* x[0] = c, where c is known up to c_err only: as (x - (c - k)) - k, for which 8 u k is charged. That covers
         * c_err, and the roundings of c - k, at most u (|c| + k), and of the last difference, at most u k beyond the
         * 8 u |x - (c - k)| that are charged, too. */
        const double k = (plane.c_err / FILTER_U + fabs(plane.c)) / 6;
        return (query_plane){.n = {1}, .o = {plane.c - k}, .c = k, .n_err = k < 0x1p1000 ? 0 : INFINITY};
    }
    /* rounding is charged for with 2 u |c| to spare, as FINE cuts need it that are in lowest terms */
    if (plane.form == GEOM_FINE && !(plane.c_err <= 2 * FILTER_U * fabs(plane.c))) h.n_err = INFINITY;
    if (plane.dim > 3) {
        h.far = t->normals + t->cuts[t->nodes[node].u.cut].a;
        return h;
    }
    memcpy(h.n, plane.n, sizeof h.n);
    if (plane.form == GEOM_POINTS || plane.form == GEOM_VERTICAL) memcpy(h.o, plane.p[0], sizeof h.o);
    return h;
}

static bool is_oblique(const froe_tree *t, const tree_node *node) {
    return node->type == TREE_TABLED && t->cuts[node->u.cut].kind != FROE_CUT_AXIS;
}

/* Numbers the planes of all oblique cuts in the order of the nodes; *count: so many. `known`: number + 1 of the plane
 * of each object, and of the wall of each vertex. */
static void number_planes(const froe_tree *t, uint32_t *known, uint32_t *numbers, uint32_t *count) {
    *count = 0;
    for (uint32_t v = 0; v < t->node_count; v++) {
        const tree_node *node = t->nodes + v;
        if (!is_oblique(t, node)) continue;
        const tree_cut *cut = t->cuts + node->u.cut;
        uint32_t *at = cut->kind == FROE_CUT_OBJECT   ? known + cut->a
                       : cut->kind == FROE_CUT_VERTEX ? known + t->scene->object_count + cut->a
                                                      : NULL;
        if (!at || !*at) ++*count;
        if (at && !*at) *at = *count;
        numbers[node->u.cut] = (at ? *at : *count) - 1;
    }
}

/* Lets cuts share planes, where there are at least twice as many cuts as planes. False: no memory. */
static bool share_planes(froe_query *q, query_planes *p) {
    const froe_tree *t = q->tree;
    const size_t names = 1 + (size_t)t->scene->object_count + t->scene->vertex_count; /* there may be none */
    uint32_t *known = support_calloc(&q->alloc, names, sizeof *known);
    uint32_t *numbers = support_calloc(&q->alloc, t->cut_count, sizeof *numbers);
    const bool room = known && numbers;
    p->count = t->cut_count;
    if (room) number_planes(t, known, numbers, &p->count);
    support_free(&q->alloc, known, names * sizeof *known);
    if (room && p->count <= t->cut_count / 2) {
        p->numbers = numbers;
    } else {
        support_free(&q->alloc, numbers, t->cut_count * sizeof *numbers);
        p->count = t->cut_count;
    }
    return room;
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
    p->cut_count = t->cut_count;
    if (share_planes(q, p)) p->planes = support_calloc(&q->alloc, p->count, sizeof *p->planes);
    if (!p->planes) return support_fail_memory(diag);
    uint32_t next = 0; /* of the planes that are shared: numbers ascend where they first come */
    for (uint32_t v = 0; v < t->node_count; v++) {
        if (!is_oblique(t, t->nodes + v)) continue;
        const uint32_t cut = t->nodes[v].u.cut, number = p->numbers ? p->numbers[cut] : cut;
        if (p->numbers && number < next) continue;
        p->planes[number] = plane_of_cut(t, v);
        next = number + 1;
    }
    return FROE_OK;
}

froe_status query_planes_of(froe_query *query, const query_planes **out, froe_diagnostic *diag) {
    const query_part *part;
    froe_status status = query_prepare(query, QUERY_PLANES, make_cuts, &part, diag);
    if (status == FROE_OK) *out = (const query_planes *)part;
    return status;
}
