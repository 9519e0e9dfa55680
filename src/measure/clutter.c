/* clutter.c: the largest number of objects that a cube without guards meets: a lower bound on the clutter factor.
 *
 *     +-------x--+          Guards are the corners of bounding boxes. A cube without one inside grows around its centre
 *     |          |          until a guard is in one of its sides; then away from that side, and so on, until guards
 *     |   cube   x          are in opposite sides: only such cubes cannot grow any more, since otherwise each axis has
 *     x          |          a free side, and the cube grows by moving the corner where they meet.
 *     +----------+
 *
 * Cubes start at random places near guards and are counted when they cannot grow any more. From the best ones others
 * start near by. What a cube meets is decided exactly, for a slightly smaller closed cube in place of the open one. */
#include "base/floats.h"
#include "base/random.h"
#include "geom/meet/meet.h"
#include "geom/selftest.h"
#include "measure/hierarchy.h"
#include "measure/sample.h"
#include "scene/convex.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { BEST = 16, CLIMB = 32 }; /* cubes from which others start; tries in a row without gain */

typedef struct cube {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    unsigned blocked; /* bits 2 k, 2 k + 1: a guard is in the low, the high side of axis k */
} cube;

typedef struct survey {
    measure_sample sample;
    measure_hierarchy guards, objects;
    num_context context;
    int dim;
    measure_bounds bounds;
    size_t guard_numbers;
    double *points;      /* of the guards */
    double limit;        /* no side is longer */
    uint64_t key, draws; /* of random numbers: set anew for each place */
    cube cubes[BEST];    /* the best from different places, best first */
    uint32_t met[BEST];
    uint64_t keys[BEST];
} survey;

static double draw_share(survey *s) {
    return (double)(base_hash(s->key, 1, s->draws++) >> 11) * 0x1p-53;
}

/* ------------------------------------------------------------------ growing -- */

/* The largest cube around a point without a guard inside. */
static cube grow_around(survey *s, const double *centre) {
    cube c = {.blocked = 0};
    double half = s->limit / 2;
    for (int k = 0; k < s->dim; k++) c.lo[k] = centre[k] - half, c.hi[k] = centre[k] + half;
    measure_search search = measure_search_begin(&s->guards, c.lo, c.hi, 0);
    for (uint32_t g; (g = measure_search_next(&search)) != FROE_NONE;) {
        const double *p = s->points + (size_t)g * (size_t)s->dim;
        int axis = 0;
        for (int k = 1; k < s->dim; k++)
            if (fabs(p[k] - centre[k]) > fabs(p[axis] - centre[axis])) axis = k;
        double far = fabs(p[axis] - centre[axis]);
        if (far >= half) continue;
        half = far; /* the search goes on in the smaller cube */
        c.blocked = 1u << (2 * axis + (p[axis] > centre[axis]));
        for (int k = 0; k < s->dim; k++) c.lo[k] = centre[k] - half, c.hi[k] = centre[k] + half;
    }
    return c;
}

static bool locked(const survey *s, const cube *c) {
    bool opposite = !c->blocked;
    for (int k = 0; k < s->dim; k++) opposite |= (c->blocked >> 2 * k & 3) == 3;
    return opposite;
}

/* How far a cube that grows from a corner may grow until the guard is in its side; 0: it never is inside. */
static double reach(const survey *s, const double *corner, unsigned up, const double *guard, int *axis) {
    double most = 0;
    for (int k = 0; k < s->dim; k++) {
        double far = up >> k & 1 ? guard[k] - corner[k] : corner[k] - guard[k];
        if (!(far > 0)) return 0;
        if (far > most) most = far, *axis = k;
    }
    return most;
}

/* Moves the corner between the free sides outwards, until the next guard is in one of them. */
static void grow_away(survey *s, cube *c) {
    unsigned up = 0;
    double corner[FROE_MAX_DIM], side = s->limit;
    int blocking = -1;
    for (int k = 0; k < s->dim; k++) {
        unsigned low = c->blocked >> 2 * k & 1, high = c->blocked >> (2 * k + 1) & 1;
        bool upwards = low || (!high && draw_share(s) < 0.5);
        up |= (unsigned)upwards << k;
        corner[k] = upwards ? c->lo[k] : c->hi[k];
        c->lo[k] = upwards ? corner[k] : corner[k] - side;
        c->hi[k] = upwards ? corner[k] + side : corner[k];
    }
    measure_search search = measure_search_begin(&s->guards, c->lo, c->hi, 0);
    for (uint32_t g; (g = measure_search_next(&search)) != FROE_NONE;) {
        int axis = 0;
        double far = reach(s, corner, up, s->points + (size_t)g * (size_t)s->dim, &axis);
        if (!(far > 0) || far >= side) continue;
        side = far;
        blocking = axis;
        for (int k = 0; k < s->dim; k++)
            *(up >> k & 1 ? c->hi + k : c->lo + k) = corner[k] + (up >> k & 1 ? side : -side);
    }
    c->blocked = blocking < 0 ? 0 : c->blocked | 1u << (2 * blocking + (int)(up >> blocking & 1));
}

static cube grow_cube(survey *s, const double *centre) {
    cube c = grow_around(s, centre);
    for (int turn = 0; turn <= s->dim && !locked(s, &c); turn++) grow_away(s, &c);
    return c;
}

/* ----------------------------------------------------------------- counting -- */

/* Has the object a corner in the box? */
static bool corner_inside(const survey *s, uint32_t object, const double *points) {
    const froe_scene *scene = s->sample.scene;
    bool found = false;
    if (scene_form(scene, object) == FROE_BALL) return false;
    for (uint32_t i = 0; i < scene_corners(scene, object) && !found; i++) {
        const double *p = scene_point(scene, object, i);
        found = true;
        for (int k = 0; k < s->dim && found; k++) found = points[k] <= p[k] && p[k] <= points[s->dim + k];
    }
    return found;
}

/* Of an object whose bounding box meets the box. */
static bool object_meets(survey *s, uint32_t object, const double *points) {
    const froe_scene *scene = s->sample.scene;
    int form = scene_form(scene, object);
    if (form == FROE_BOX || form == FROE_POINT || corner_inside(s, object, points)) return true;
    if (s->dim <= 3) {
        geom_convex a = {.core = GEOM_CORE_BOX, .dim = s->dim, .count = 1u << s->dim, .coords = points};
        geom_convex b = scene_convex(scene, object);
        return geom_meet(&s->context, &a, &b);
    }
    const double *p = scene_point(scene, object, 0); /* a ball */
    return geom_meet_boxes(&s->context, s->dim, points, points + s->dim, 0, p, p, scene_radius(scene, object));
}

/* Objects that meet the open cube: that meet the largest closed one of doubles inside. */
static uint32_t count(survey *s, const cube *c) {
    double points[2 * FROE_MAX_DIM];
    uint32_t met = 0;
    for (int k = 0; k < s->dim; k++) {
        points[k] = nextafter(c->lo[k], INFINITY);
        points[s->dim + k] = nextafter(c->hi[k], -INFINITY);
        if (points[k] > points[s->dim + k]) return 0;
    }
    measure_search search = measure_search_begin(&s->objects, points, points + s->dim, 0);
    for (uint32_t i; (i = measure_search_next(&search)) != FROE_NONE;) met += object_meets(s, i, points);
    return met;
}

/* Keeps the best cubes in order; of those that meet as many objects, that of the lower key. */
static void keep_cube(survey *s, const cube *c, uint32_t met) {
    int at = BEST;
    while (at && (met > s->met[at - 1] || (met == s->met[at - 1] && s->key < s->keys[at - 1]))) at--;
    if (at == BEST) return;
    size_t more = (size_t)(BEST - 1 - at);
    memmove(s->cubes + at + 1, s->cubes + at, more * sizeof *s->cubes);
    memmove(s->met + at + 1, s->met + at, more * sizeof *s->met);
    memmove(s->keys + at + 1, s->keys + at, more * sizeof *s->keys);
    s->cubes[at] = *c;
    s->met[at] = met;
    s->keys[at] = s->key;
}

/* Tries cubes around places within a good one, until CLIMB in a row meet no more objects. */
static void climb_from(survey *s, cube *best, uint32_t *most) {
    for (int try = 0; try < CLIMB; try++) {
        double centre[FROE_MAX_DIM];
        for (int k = 0; k < s->dim; k++) {
            double share = try % 2 ? draw_share(s) : 0.35 + 0.3 * draw_share(s);
            centre[k] = best->lo[k] * (1 - share) + best->hi[k] * share;
        }
        cube c = grow_cube(s, centre);
        uint32_t met = count(s, &c);
        if (met <= *most) continue;
        *most = met;
        *best = c;
        try = -1;
    }
}

/* A place near an object, at a distance of any order of magnitude. */
static void place_cube(survey *s, uint32_t object, double *out) {
    const double *lo = s->bounds.lo + (size_t)object * (size_t)s->dim,
                 *hi = s->bounds.hi + (size_t)object * (size_t)s->dim;
    double away = s->limit;
    for (uint32_t steps = base_below(base_hash(s->key, 2, s->draws++), 40); steps; steps--) away *= 0.5;
    for (int k = 0; k < s->dim; k++) {
        double share = draw_share(s), at = lo[k] * (1 - share) + hi[k] * share;
        out[k] = at + away * (2 * draw_share(s) - 1);
    }
}

static froe_status look_everywhere(survey *s) {
    for (uint32_t i = 0; i < s->sample.count; i++) {
        double centre[FROE_MAX_DIM];
        uint32_t object = measure_sample_object(&s->sample, i);
        if (!measure_sample_go_on(&s->sample, i)) return FROE_E_CANCELLED;
        s->key = measure_sample_key(&s->sample, object);
        s->draws = 0;
        place_cube(s, object, centre);
        cube c = grow_cube(s, centre);
        uint32_t met = count(s, &c);
        keep_cube(s, &c, met);
        if (!array_push(&s->sample.alloc, &s->sample.values[0], met)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status look_for_clutter(survey *s, froe_clutter *out) {
    froe_status status = look_everywhere(s);
    uint32_t best = 0;
    for (uint32_t i = 0; i < BEST && !status; i++) {
        s->key = s->keys[i];
        climb_from(s, s->cubes + i, s->met + i);
        if (s->met[i] > s->met[best]) best = i;
    }
    if (status) return status;
    *out = (froe_clutter){.lower = s->met[best], .count = s->sample.count};
    memcpy(out->lo, s->cubes[best].lo, sizeof out->lo);
    memcpy(out->hi, s->cubes[best].hi, sizeof out->hi);
    return measure_sample_spread(&s->sample, 0, &out->load);
}

/* -------------------------------------------------------------------- making -- */

static void add_guards(survey *s, size_t object, size_t corners) {
    double *to = s->points + object * corners * (size_t)s->dim;
    size_t at = object * (size_t)s->dim;
    for (size_t c = 0; c < corners; c++)
        for (int k = 0; k < s->dim; k++) *to++ = (c >> k & 1 ? s->bounds.hi : s->bounds.lo)[at + (size_t)k];
}

static froe_status begin_clutter(survey *s) {
    const froe_scene *scene = s->sample.scene;
    const froe_allocator *alloc = &s->sample.alloc;
    size_t n = scene->object_count, corners = (size_t)1 << s->dim;
    froe_status status = geom_context_new(alloc, &s->context);
    if (!status) status = measure_bounds_new(&s->sample, &s->bounds);
    if (status) return status;
    if (n * corners > UINT32_MAX / 2) return FROE_E_LIMIT;
    s->guard_numbers = s->bounds.numbers * corners;
    s->points = support_calloc(alloc, s->guard_numbers, sizeof *s->points);
    if (!s->points) return FROE_E_MEMORY;
    for (size_t i = 0; i < n; i++) add_guards(s, i, corners);
    for (int k = 0; k < s->dim && n; k++) s->limit = fmax(s->limit, 3 * (scene->hi[k] - scene->lo[k]));
    if (s->limit > 0x1p1000) s->limit = 0x1p1000;
    status = measure_hierarchy_new(alloc, s->dim, (uint32_t)(n * corners), s->points, s->points, NULL, &s->guards);
    return status ? status
                  : measure_hierarchy_new(alloc, s->dim, (uint32_t)n, s->bounds.lo, s->bounds.hi, NULL, &s->objects);
}

static void end_clutter(survey *s) {
    const froe_allocator *alloc = &s->sample.alloc;
    if (s->context.alloc.fn) num_context_free(&s->context);
    measure_bounds_free(&s->sample, &s->bounds);
    support_free(alloc, s->points, s->guard_numbers ? s->guard_numbers * sizeof *s->points : 1);
    measure_hierarchy_free(&s->guards);
    measure_hierarchy_free(&s->objects);
}

froe_status froe_measure_clutter(const froe_scene *scene, const froe_measure_options *options, froe_clutter *out,
                                 froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    survey s = {.dim = 0};
    froe_status status = measure_sample_begin(scene, options, out, &s.sample, diag);
    if (status) return status;
    s.dim = scene->dim;
    status = begin_clutter(&s);
    if (status == FROE_E_LIMIT) support_fail(diag, status, "more than 2^31 corners of bounding boxes");
    if (!status) status = look_for_clutter(&s, out);
    end_clutter(&s);
    return measure_sample_end(&s.sample, status, diag);
}
