/* geos.c: the calls of GEOS that shapely 2 makes for arrays of questions (its src/strtree.c), for race.py where
 * shapely 2 is not installed: an STR-packed tree of the geometries' boxes, and the predicate of the question, prepared,
 * for each geometry found. Questions begin as doubles. Answers end as numbers of geometries, and where those of each
 * question end. */
#include <geos_c.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct index {
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    GEOSGeometry **lines;
    size_t count;
    struct {
        int64_t *ids;
        size_t used, room;
    } found;
} index;

static void *grown(void *memory, size_t bytes) {
    void *more = realloc(memory, bytes ? bytes : 1);
    if (!more) abort();
    return more;
}

static void put(void *item, void *user) {
    index *x = user;
    if (x->found.used == x->found.room) {
        x->found.room = 2 * x->found.room + 1024;
        x->found.ids = grown(x->found.ids, x->found.room * sizeof *x->found.ids);
    }
    x->found.ids[x->found.used++] = (int64_t)((size_t)item - 1);
}

/** segments: 4 doubles each. The first question packs the tree, so that one is asked here. */
index *geos_make(const double *segments, size_t count) {
    index *x = grown(NULL, sizeof *x);
    *x = (index){.context = GEOS_init_r(), .count = count};
    x->lines = grown(NULL, count * sizeof *x->lines);
    x->tree = GEOSSTRtree_create_r(x->context, 10);
    for (size_t i = 0; i < count; i++) {
        GEOSCoordSequence *ends = GEOSCoordSeq_copyFromBuffer_r(x->context, segments + 4 * i, 2, 0, 0);
        x->lines[i] = GEOSGeom_createLineString_r(x->context, ends);
        GEOSSTRtree_insert_r(x->context, x->tree, x->lines[i], (void *)(i + 1));
    }
    GEOSGeometry *first = GEOSGeom_createPointFromXY_r(x->context, 0, 0);
    GEOSSTRtree_query_r(x->context, x->tree, first, put, x);
    GEOSGeom_destroy_r(x->context, first);
    return x;
}

void geos_free(index *x) {
    GEOSSTRtree_destroy_r(x->context, x->tree);
    for (size_t i = 0; i < x->count; i++) GEOSGeom_destroy_r(x->context, x->lines[i]);
    GEOS_finish_r(x->context);
    free(x->lines);
    free(x->found.ids);
    free(x);
}

/** The answers since the last call of geos_windows() or geos_pairs(); they are valid until the next. */
const int64_t *geos_found(const index *x) {
    return x->found.ids;
}

static void ask(index *x, const GEOSGeometry *question, int exact) {
    size_t kept = x->found.used;
    GEOSSTRtree_query_r(x->context, x->tree, question, put, x);
    if (!exact) return;
    const GEOSPreparedGeometry *prepared = GEOSPrepare_r(x->context, question);
    for (size_t i = kept; i < x->found.used; i++) {
        const int64_t id = x->found.ids[i];
        if (GEOSPreparedIntersects_r(x->context, prepared, x->lines[id]) == 1) x->found.ids[kept++] = id;
    }
    GEOSPreparedGeom_destroy_r(x->context, prepared);
    x->found.used = kept;
}

/** windows: 4 doubles each; exact: 0 for those whose boxes meet. ends: count of them. */
void geos_windows(index *x, const double *windows, size_t count, int exact, int64_t *ends) {
    x->found.used = 0;
    for (size_t i = 0; i < count; i++) {
        const double *w = windows + 4 * i;
        GEOSGeometry *box = GEOSGeom_createRectangle_r(x->context, w[0], w[1], w[2], w[3]);
        ask(x, box, exact);
        ends[i] = (int64_t)x->found.used;
        GEOSGeom_destroy_r(x->context, box);
    }
}

/** Every line is a question. */
void geos_pairs(index *x, int64_t *ends) {
    x->found.used = 0;
    for (size_t i = 0; i < x->count; i++) {
        ask(x, x->lines[i], 1);
        ends[i] = (int64_t)x->found.used;
    }
}

typedef struct near {
    const index *x;
    const GEOSGeometry *point;
} near;

static int distance(const void *a, const void *b, double *out, void *user) {
    const near *n = user;
    (void)b;
    return GEOSDistance_r(n->x->context, n->x->lines[(size_t)a - 1], n->point, out);
}

/** points: 2 doubles each. nearest, distances: count of them. */
void geos_nearest(index *x, const double *points, size_t count, int64_t *nearest, double *distances) {
    for (size_t i = 0; i < count; i++) {
        GEOSGeometry *point = GEOSGeom_createPointFromXY_r(x->context, points[2 * i], points[2 * i + 1]);
        near n = {x, point};
        const void *item = GEOSSTRtree_nearest_generic_r(x->context, x->tree, point, point, distance, &n);
        nearest[i] = (int64_t)((size_t)item - 1);
        GEOSDistance_r(x->context, x->lines[nearest[i]], point, distances + i);
        GEOSGeom_destroy_r(x->context, point);
    }
}
