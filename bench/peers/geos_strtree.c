/* geos_strtree.c: the STR-packed R-tree of GEOS, by its C interface. It reports boxes; the test of segments is ours. */
#include "index.h"
#include <geos_c.h>
#include <stdarg.h>
#include <stdlib.h>

typedef struct index2 {
    const peer_segment *s;
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    GEOSGeometry **boxes;
    size_t n;
} index2;

typedef struct search {
    const peer_segment *s;
    const double *lo, *hi;
    uint32_t *out;
    size_t count;
    double x, y, height;
    int64_t best;
} search;

static GEOSGeometry *box_of(GEOSContextHandle_t c, double x0, double y0, double x1, double y1) {
    GEOSCoordSequence *line = GEOSCoordSeq_create_r(c, 2, 2);
    GEOSCoordSeq_setXY_r(c, line, 0, x0, y0);
    GEOSCoordSeq_setXY_r(c, line, 1, x1, y1);
    return GEOSGeom_createLineString_r(c, line);
}

static void nothing(void *item, void *user) {
    (void)item, (void)user;
}

static void *build(const peer_segment *s, size_t n) {
    index2 *x = malloc(sizeof *x);
    *x = (index2){.s = s, .context = GEOS_init_r(), .boxes = malloc(n * sizeof(GEOSGeometry *)), .n = n};
    x->tree = GEOSSTRtree_create_r(x->context, 10);
    for (size_t i = 0; i < n; i++) {
        x->boxes[i] = box_of(x->context, s[i].ax, s[i].ay, s[i].bx, s[i].by);
        GEOSSTRtree_insert_r(x->context, x->tree, x->boxes[i], (void *)(uintptr_t)(i + 1));
    }
    GEOSGeometry *all = box_of(x->context, 0, 0, 0, 0); /* the first question packs it */
    GEOSSTRtree_query_r(x->context, x->tree, all, nothing, NULL);
    GEOSGeom_destroy_r(x->context, all);
    return x;
}

static void drop(void *index) {
    index2 *x = index;
    GEOSSTRtree_destroy_r(x->context, x->tree);
    for (size_t i = 0; i < x->n; i++) GEOSGeom_destroy_r(x->context, x->boxes[i]);
    free(x->boxes);
    GEOS_finish_r(x->context);
    free(x);
}

static void ask(index2 *x, const double lo[2], const double hi[2], GEOSQueryCallback fn, search *user) {
    GEOSGeometry *box = box_of(x->context, lo[0], lo[1], hi[0], hi[1]);
    GEOSSTRtree_query_r(x->context, x->tree, box, fn, user);
    GEOSGeom_destroy_r(x->context, box);
}

static void report(void *item, void *user) {
    search *q = user;
    uint32_t id = (uint32_t)((uintptr_t)item - 1);
    if (peer_meets_window(q->s + id, q->lo, q->hi)) q->out[q->count++] = id;
}

static size_t window(void *index, const double lo[2], const double hi[2], uint32_t *out) {
    index2 *x = index;
    search q = {.s = x->s, .lo = lo, .hi = hi, .out = out};
    ask(x, lo, hi, report, &q);
    return q.count;
}

const peer peer_geos = {"GEOS", build, drop, NULL, window, NULL, NULL, NULL};
