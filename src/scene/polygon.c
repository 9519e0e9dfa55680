/* polygon.c: is a ring of vertices exactly planar, convex and simple?
 *
 *            c                  1. equal neighbours become one corner
 *          /   \                2. the first corner c not collinear with the first two spans the plane
 *     a - - - b  d              3. every other corner lies on it
 *          \   /                4. projected along an axis where abc keeps its area, every turn goes
 *            e                     one way or straight on, and lexicographic order descends once
 *
 * Point 4 is enough: with all turns one way the direction of the edges rotates
 * monotonically, so the ring is simple iff it rotates once, and every rotation passes
 * from descending to ascending edges once. (A pentagram passes twice.) A spike
 * does so without a turn, which is looked for as well. */
#include "scene/polygon.h"
#include "geom/predicates.h"
#include "geom/turn.h"

typedef struct ring_view {
    num_context *context;
    const double *coords;
    const uint32_t *ring;
    uint32_t count;
    int axis; /**< along which it is projected */
} ring_view;

static const double *at(const ring_view *r, uint32_t i) {
    return r->coords + (size_t)(r->ring ? r->ring[i] : i) * 3;
}

/** Ends a check that failed. */
static bool fails(const ring_view *r, uint32_t i, const char *reason, scene_fault *fault) {
    *fault = (scene_fault){reason, r->ring ? r->ring[i] : i};
    return false;
}

/* ---------------------------------------------------------------- the plane -- */

/** Turn of the projected corners i, j, k. */
static int turn_at(const ring_view *r, uint32_t i, uint32_t j, uint32_t k) {
    return geom_projected_turn(r->context, r->axis, at(r, i), at(r, j), at(r, k));
}

/** Projects along an axis that keeps corners 0, 1, k apart from a line; false if they are collinear. */
static bool project(ring_view *r, uint32_t k) {
    r->axis = geom_projection_axis(r->context, at(r, 0), at(r, 1), at(r, k));
    return r->axis >= 0;
}

/** The first corner not collinear with the first two, and the projection that shows it; 0: there is none. */
static uint32_t third_corner(ring_view *r) {
    for (uint32_t k = 2; k < r->count; k++)
        if (project(r, k)) return k;
    return 0;
}

static bool planar(const ring_view *r, uint32_t third, scene_fault *fault) {
    geom_plane plane = geom_plane_points(3, (const double *const[]){at(r, 0), at(r, 1), at(r, third)});
    for (uint32_t i = third + 1; i < r->count; i++)
        if (geom_side_vertex(r->context, &plane, at(r, i)) != 0) return fails(r, i, "is not planar", fault);
    return true;
}

/* ---------------------------------------------------------------- the shape -- */

static bool less(const double *a, const double *b, int u, int v) {
    return a[u] < b[u] || (a[u] == b[u] && a[v] < b[v]);
}

static bool ascends(const ring_view *r, uint32_t i, uint32_t j) {
    return less(at(r, i), at(r, j), (r->axis + 1) % 3, (r->axis + 2) % 3);
}

static bool convex(const ring_view *r, scene_fault *fault) {
    if (r->count == 3) return true;
    uint32_t n = r->count, minima = 0, least = 0;
    for (uint32_t i = 1; i < n; i++)
        if (ascends(r, i, least)) least = i;
    /* at the least corner the ring turns as the whole does, if it is simple */
    const int way = turn_at(r, least ? least - 1 : n - 1, least, least + 1 < n ? least + 1 : 0);
    for (uint32_t i = n - 1, j = 0, k = 1; j < n; i = j++, k = k + 1 < n ? k + 1 : 0) {
        bool before = ascends(r, i, j), after = ascends(r, j, k);
        int t = turn_at(r, i, j, k);
        if (t == 0 && before != after) return fails(r, j, "folds back on itself", fault);
        if (t != 0 && t != way) return fails(r, j, "is not convex", fault);
        minima += !before && after;
    }
    if (minima == 1) return true;
    return fails(r, n - 1, "intersects itself", fault);
}

/* ----------------------------------------------------------------- the ring -- */

static bool less_3d(const double *a, const double *b) {
    return a[0] < b[0] || (a[0] == b[0] && less(a, b, 1, 2));
}

/** All corners on one line: the two extreme ones, or one. */
static void flatten(const ring_view *r, uint32_t *ring, uint32_t *count, froe_kind *form) {
    uint32_t least = 0, most = 0;
    for (uint32_t i = 1; i < r->count; i++) {
        if (less_3d(at(r, i), at(r, least))) least = i;
        if (less_3d(at(r, most), at(r, i))) most = i;
    }
    uint32_t ends[2] = {ring[least], ring[most]};
    *count = ends[0] == ends[1] ? 1 : 2;
    *form = *count == 1 ? FROE_POINT : FROE_SEGMENT;
    for (uint32_t i = 0; i < *count; i++) ring[i] = ends[i];
}

static void reverse(uint32_t *ring, uint32_t count) {
    for (uint32_t i = 0; i < count / 2; i++) {
        uint32_t other = ring[count - 1 - i];
        ring[count - 1 - i] = ring[i];
        ring[i] = other;
    }
}

bool scene_polygon_form(num_context *context, const double *coords, uint32_t *ring, uint32_t *count, froe_kind *form,
                        scene_fault *fault) {
    uint32_t kept = 1; /* drops corners equal to the one before, around the ring */
    for (uint32_t i = 1; i < *count; i++)
        if (ring[i] != ring[kept - 1]) ring[kept++] = ring[i];
    while (kept > 1 && ring[kept - 1] == ring[0]) kept--;
    ring_view view = {.context = context, .coords = coords, .ring = ring, .count = kept};
    uint32_t third = third_corner(&view);
    if (!third) {
        flatten(&view, ring, count, form);
        return true;
    }
    if (!planar(&view, third, fault) || !convex(&view, fault)) return false;
    reverse(ring, third - 2); /* rotates to the left: corners 0 .. third-1 lie on one edge */
    reverse(ring + third - 2, view.count - (third - 2));
    reverse(ring, view.count);
    *count = view.count;
    *form = FROE_POLYGON;
    return true;
}

bool scene_polygon_valid(num_context *context, const double *coords, const uint32_t *ring, uint32_t count) {
    ring_view view = {.context = context, .coords = coords, .ring = ring, .count = count};
    scene_fault fault;
    for (uint32_t i = 0; ring && i < count; i++)
        if (ring[i] == ring[i + 1 < count ? i + 1 : 0]) return false;
    return count >= 3 && project(&view, 2) && planar(&view, 2, &fault) && convex(&view, &fault);
}
