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

typedef struct clutter_survey {
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
} clutter_survey;

static double draw_share(clutter_survey *s) {
    return (double)(base_hash(s->key, 1, s->draws++) >> 11) * 0x1p-53;
}

/* ------------------------------------------------------------------ growing -- */

/* Moves the corner between the free sides outwards, until the next guard is in one of them. */
static void grow_away(clutter_survey *s, cube *c) {
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
        const double *guard = s->points + (size_t)g * (size_t)s->dim;
        int axis = 0;
        double far = 0; /* how far the cube may grow until the guard is in its side */
        bool met = true;
        for (int k = 0; k < s->dim; k++) {
            double away = up >> k & 1 ? guard[k] - corner[k] : corner[k] - guard[k];
            met = met && away > 0;
            if (away > far) far = away, axis = k;
        }
        if (!met || far >= side) continue;
        side = far;
        blocking = axis;
        for (int k = 0; k < s->dim; k++)
            *(up >> k & 1 ? c->hi + k : c->lo + k) = corner[k] + (up >> k & 1 ? side : -side);
    }
    c->blocked = blocking < 0 ? 0 : c->blocked | 1u << (2 * blocking + (int)(up >> blocking & 1));
}

static cube grow_cube(clutter_survey *s, const double *centre) {
    cube c = {.blocked = 0};
    double half = s->limit / 2; /* of the largest cube around the point without a guard inside */
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
    for (int turn = 0; turn <= s->dim; turn++) {
        bool locked = !c.blocked; /* between opposite sides */
        for (int k = 0; k < s->dim; k++) locked |= (c.blocked >> 2 * k & 3) == 3;
        if (locked) break;
        grow_away(s, &c);
    }
    return c;
}

/* ----------------------------------------------------------------- counting -- */

/* Of an object whose bounding box meets the box. */
static bool object_meets(clutter_survey *s, uint32_t object, const double *points) {
    const froe_scene *scene = s->sample.scene;
    int form = scene_form(scene, object);
    if (form == FROE_BOX || form == FROE_POINT) return true;
    for (uint32_t i = 0; i < scene_corners(scene, object) && form != FROE_BALL; i++) {
        const double *p = scene_point(scene, object, i);
        bool inside = true;
        for (int k = 0; k < s->dim && inside; k++) inside = points[k] <= p[k] && p[k] <= points[s->dim + k];
        if (inside) return true;
    }
    if (s->dim <= 3 || form != FROE_BALL) {
        geom_convex a = {.core = GEOM_CORE_BOX, .dim = s->dim, .count = 1u << s->dim, .coords = points};
        geom_convex b = scene_convex(scene, object);
        return geom_meet(&s->context, &a, &b);
    }
    const double *p = scene_point(scene, object, 0); /* a ball */
    return geom_meet_boxes(&s->context, s->dim, points, points + s->dim, 0, p, p, scene_radius(scene, object));
}

/* Objects that meet the open cube: that meet the largest closed one of doubles inside. */
static uint32_t count(clutter_survey *s, const cube *c) {
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

/* Cubes around places near objects, at a distance of any order of magnitude. The best ones are kept, in order. */
static froe_status look_everywhere(clutter_survey *s) {
    for (uint32_t i = 0; i < s->sample.count; i++) {
        double centre[FROE_MAX_DIM], away = s->limit;
        uint32_t object = measure_sample_object(&s->sample, i);
        if (!measure_sample_go_on(&s->sample, i)) return FROE_E_CANCELLED;
        s->key = measure_sample_key(&s->sample, object);
        s->draws = 0;
        for (uint32_t steps = base_below(base_hash(s->key, 2, s->draws++), 40); steps; steps--) away *= 0.5;
        for (int k = 0; k < s->dim; k++) {
            size_t at = (size_t)object * (size_t)s->dim + (size_t)k;
            double share = draw_share(s), place = s->bounds.lo[at] * (1 - share) + s->bounds.hi[at] * share;
            centre[k] = place + away * (2 * draw_share(s) - 1);
        }
        cube c = grow_cube(s, centre);
        uint32_t met = count(s, &c);
        if (!array_push(&s->sample.alloc, &s->sample.values[0], met)) return FROE_E_MEMORY;
        int at = BEST; /* the place of the cube: of those that meet as many objects, that of the lower key is better */
        while (at && (met > s->met[at - 1] || (met == s->met[at - 1] && s->key < s->keys[at - 1]))) at--;
        if (at == BEST) continue;
        size_t more = (size_t)(BEST - 1 - at);
        memmove(s->cubes + at + 1, s->cubes + at, more * sizeof *s->cubes);
        memmove(s->met + at + 1, s->met + at, more * sizeof *s->met);
        memmove(s->keys + at + 1, s->keys + at, more * sizeof *s->keys);
        s->cubes[at] = c;
        s->met[at] = met;
        s->keys[at] = s->key;
    }
    return FROE_OK;
}

/* -------------------------------------------------------------------- making -- */

static froe_status begin_clutter(clutter_survey *s) {
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
    double *to = s->points;
    for (size_t i = 0; i < n * corners; i++)
        for (size_t k = 0; k < (size_t)s->dim; k++)
            *to++ = (i % corners >> k & 1 ? s->bounds.hi : s->bounds.lo)[i / corners * (size_t)s->dim + k];
    for (int k = 0; k < s->dim && n; k++) s->limit = fmax(s->limit, 3 * (scene->hi[k] - scene->lo[k]));
    if (s->limit > 0x1p1000) s->limit = 0x1p1000;
    status = measure_hierarchy_new(alloc, s->dim, (uint32_t)(n * corners), s->points, s->points, NULL, &s->guards);
    return status ? status
                  : measure_hierarchy_new(alloc, s->dim, (uint32_t)n, s->bounds.lo, s->bounds.hi, NULL, &s->objects);
}

froe_status froe_measure_clutter(const froe_scene *scene, const froe_measure_options *options, froe_clutter *out,
                                 froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    clutter_survey s = {.dim = 0};
    froe_status status = measure_sample_begin(scene, options, out, &s.sample, diag);
    if (status) return status;
    s.dim = scene->dim;
    status = begin_clutter(&s);
    if (status == FROE_E_LIMIT) support_fail(diag, status, "There are more than 2^31 corners of bounding boxes.");
    if (!status) status = look_everywhere(&s);
    uint32_t best = 0;
    for (uint32_t i = 0; i < BEST && !status; i++) {
        s.key = s.keys[i];
        for (int try = 0; try < CLIMB; try++) { /* cubes around places within it, until CLIMB in a row meet no more */
            double centre[FROE_MAX_DIM];
            for (int k = 0; k < s.dim; k++) {
                double share = try % 2 ? draw_share(&s) : 0.35 + 0.3 * draw_share(&s);
                centre[k] = s.cubes[i].lo[k] * (1 - share) + s.cubes[i].hi[k] * share;
            }
            cube c = grow_cube(&s, centre);
            uint32_t met = count(&s, &c);
            if (met <= s.met[i]) continue;
            s.met[i] = met;
            s.cubes[i] = c;
            try = -1;
        }
        if (s.met[i] > s.met[best]) best = i;
    }
    if (!status) {
        *out = (froe_clutter){.lower = s.met[best], .count = s.sample.count};
        memcpy(out->lo, s.cubes[best].lo, sizeof out->lo);
        memcpy(out->hi, s.cubes[best].hi, sizeof out->hi);
        status = measure_sample_spread(&s.sample, 0, &out->load);
    }
    if (s.context.alloc.fn) num_context_free(&s.context);
    measure_bounds_free(&s.sample, &s.bounds);
    support_free(&s.sample.alloc, s.points, s.guard_numbers ? s.guard_numbers * sizeof *s.points : 1);
    measure_hierarchy_free(&s.guards);
    measure_hierarchy_free(&s.objects);
    return measure_sample_end(&s.sample, status, diag);
}
