/* geos.c: GEOS by its C interface: its STR-packed R-tree of the bounds of segments, with the exact test of segment.h,
 * and of polygons, with prepared polygons, as most programs find the area around a point. */
#include "peer.h"
#include "segment.h"
#include <geos_c.h>
#include <stdlib.h>

static void nothing(void *item, void *user) {
    (void)item, (void)user;
}

static void *take(size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (!memory) exit(1);
    return memory;
}

/* ----------------------------------------------------------------- segments -- */

typedef struct lines {
    const peer_segment *s;
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    GEOSGeometry **boxes;
    size_t n;
} lines;

static GEOSGeometry *box_of(GEOSContextHandle_t c, double x0, double y0, double x1, double y1) {
    GEOSCoordSequence *line = GEOSCoordSeq_create_r(c, 2, 2);
    GEOSCoordSeq_setXY_r(c, line, 0, x0, y0);
    GEOSCoordSeq_setXY_r(c, line, 1, x1, y1);
    return GEOSGeom_createLineString_r(c, line);
}

static void *make_lines(const peer_data *data, const peer *self) {
    lines *x = take(1, sizeof *x);
    (void)self;
    x->s = (const peer_segment *)data->coords, x->n = data->count;
    x->context = GEOS_init_r();
    x->boxes = take(x->n, sizeof *x->boxes);
    x->tree = GEOSSTRtree_create_r(x->context, 10);
    for (size_t i = 0; i < x->n; i++) {
        x->boxes[i] = box_of(x->context, x->s[i].ax, x->s[i].ay, x->s[i].bx, x->s[i].by);
        GEOSSTRtree_insert_r(x->context, x->tree, x->boxes[i], (void *)(i + 1));
    }
    GEOSGeometry *all = box_of(x->context, 0, 0, 0, 0); /* the first question packs it */
    GEOSSTRtree_query_r(x->context, x->tree, all, nothing, NULL);
    GEOSGeom_destroy_r(x->context, all);
    return x;
}

static void free_lines(void *index) {
    lines *x = index;
    GEOSSTRtree_destroy_r(x->context, x->tree);
    for (size_t i = 0; i < x->n; i++) GEOSGeom_destroy_r(x->context, x->boxes[i]);
    free(x->boxes);
    GEOS_finish_r(x->context);
    free(x);
}

typedef struct search {
    const peer_segment *s;
    const double *x; /* lo, hi; or a point */
    peer_answers *out;
} search;

static void report(void *item, void *user) {
    const search *q = user;
    const uint32_t id = (uint32_t)((size_t)item - 1);
    if (peer_meets_window(q->s + id, q->x, q->x + 2)) peer_put(q->out, id);
}

static double from_point(const peer_segment *s, const double *p) {
    const double dx = s->bx - s->ax, dy = s->by - s->ay, square = dx * dx + dy * dy;
    double t = square > 0 ? ((p[0] - s->ax) * dx + (p[1] - s->ay) * dy) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(s->ax + t * dx - p[0], s->ay + t * dy - p[1]);
}

/* Item 0 is the point itself. */
static int distance(const void *a, const void *b, double *out, void *user) {
    const search *q = user;
    const size_t i = a ? (size_t)a : (size_t)b;
    *out = i ? from_point(q->s + (i - 1), q->x) : 0;
    return 1;
}

static void ask_lines(void *index, const peer_questions *q, peer_answers *out) {
    lines *x = index;
    for (size_t i = 0; i < q->count; i++) {
        search one = {x->s, q->numbers + q->width * i, out};
        const double *hi = q->work == PEER_WINDOW ? one.x + 2 : one.x;
        GEOSGeometry *box = box_of(x->context, one.x[0], one.x[1], hi[0], hi[1]);
        if (q->work == PEER_WINDOW) {
            GEOSSTRtree_query_r(x->context, x->tree, box, report, &one);
            out->ends[i] = out->used;
        } else {
            const void *found = GEOSSTRtree_nearest_generic_r(x->context, x->tree, NULL, box, distance, &one);
            out->values[i] = from_point(x->s + ((size_t)found - 1), one.x);
        }
        GEOSGeom_destroy_r(x->context, box);
    }
}

static bool lines_serve(const peer_data *data, peer_work work) {
    return data->kind == PEER_SEGMENTS && data->dim == 2 && (work == PEER_WINDOW || work == PEER_NEAREST);
}

/* -------------------------------------------------------------------- areas -- */

typedef struct areas {
    GEOSContextHandle_t context;
    GEOSSTRtree *tree;
    const peer_map *map;
    GEOSGeometry **polygons;
    const GEOSPreparedGeometry **prepared;
    GEOSGeometry *point;
    double found;
} areas;

static GEOSGeometry *ring_of(const areas *a, size_t ring) {
    const size_t first = a->map->rings[ring], corners = a->map->rings[ring + 1] - first;
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(a->context, (unsigned)corners + 1, 2);
    for (size_t i = 0; i <= corners; i++) {
        const double *x = a->map->points + 2 * (first + i % corners);
        GEOSCoordSeq_setXY_r(a->context, s, (unsigned)i, x[0], x[1]);
    }
    return GEOSGeom_createLinearRing_r(a->context, s);
}

static GEOSGeometry *polygon_of(const areas *a, size_t polygon) {
    const size_t first = a->map->polygons[polygon], count = a->map->polygons[polygon + 1] - first;
    GEOSGeometry **rings = take(count, sizeof *rings);
    for (size_t i = 0; i < count; i++) rings[i] = ring_of(a, first + i);
    GEOSGeometry *out = GEOSGeom_createPolygon_r(a->context, rings[0], rings + 1, (unsigned)count - 1);
    free(rings);
    return out;
}

static void *make_areas(const peer_data *data, const peer *self) {
    areas *a = take(1, sizeof *a);
    const peer_map *map = a->map = data->map;
    (void)self;
    a->context = GEOS_init_r();
    a->tree = GEOSSTRtree_create_r(a->context, 10);
    a->polygons = take(map->polygon_count, sizeof *a->polygons);
    a->prepared = take(map->polygon_count, sizeof *a->prepared);
    for (size_t i = 0; i < map->polygon_count; i++) {
        a->polygons[i] = polygon_of(a, i);
        a->prepared[i] = GEOSPrepare_r(a->context, a->polygons[i]);
        GEOSSTRtree_insert_r(a->context, a->tree, a->polygons[i], (void *)(i + 1));
    }
    a->point = GEOSGeom_createPointFromXY_r(a->context, 0, 0);
    GEOSSTRtree_query_r(a->context, a->tree, a->point, nothing, NULL); /* the first question packs it */
    GEOSGeom_destroy_r(a->context, a->point);
    return a;
}

static void free_areas(void *index) {
    areas *a = index;
    for (size_t i = 0; i < a->map->polygon_count; i++) {
        GEOSPreparedGeom_destroy_r(a->context, a->prepared[i]);
        GEOSGeom_destroy_r(a->context, a->polygons[i]);
    }
    GEOSSTRtree_destroy_r(a->context, a->tree);
    GEOS_finish_r(a->context);
    free(a->polygons), free(a->prepared), free(a);
}

/* Where parts of one area overlap (Russia beyond the antimeridian) is none of it, as froe has it. */
static void look_at(void *item, void *user) {
    areas *a = user;
    const size_t i = (size_t)item - 1;
    const double area = a->map->areas[i];
    if (GEOSPreparedIntersects_r(a->context, a->prepared[i], a->point) == 1) a->found = a->found == area ? -1 : area;
}

static void ask_areas(void *index, const peer_questions *q, peer_answers *out) {
    areas *a = index;
    for (size_t i = 0; i < q->count; i++) {
        a->found = -1;
        a->point = GEOSGeom_createPointFromXY_r(a->context, q->numbers[2 * i], q->numbers[2 * i + 1]);
        GEOSSTRtree_query_r(a->context, a->tree, a->point, look_at, a);
        GEOSGeom_destroy_r(a->context, a->point);
        out->values[i] = a->found;
    }
}

static bool areas_serve(const peer_data *data, peer_work work) {
    return data->kind == PEER_AREAS && work == PEER_AREA;
}

static const peer all[] = {
    {.name = "GEOS",
     .what = "its STRtree of bounding boxes",
     .serves = lines_serve,
     .make = make_lines,
     .free = free_lines,
     .answer = ask_lines},
    {.name = "GEOS",
     .what = "its STRtree of bounding boxes, and prepared polygons",
     .serves = areas_serve,
     .make = make_areas,
     .free = free_areas,
     .answer = ask_areas},
};

const peer *peer_at(size_t i) {
    return i < 2 ? all + i : NULL;
}
