/* film_corners.c: see film_corners.h.
 *
 *          c          Between two instants of its plan a corner stays in the hull of control points: of a straight
 *        .   .        piece its ends, of a parabola three points, of the arc of a body five (Bernstein's form of degree
 *      .-"""-.        4, whose weights are positive; Farin 1983). A piece is cut into parts, so that these points are
 *     a       b       near the curve. A life may begin and end within a piece, which is cut there. */
#include "film_corners.h"
#include "support/array.h"
#include "support/fail.h"
#include <math.h>
#include <stdlib.h>

enum { PARTS = 8, MOST_POINTS = 1 << 20 };

/* A time in which a vertex is a corner of something that is there. */
typedef struct film_stay {
    uint32_t owner; /* a vertex, or, from there on up, a body with the box of all that it carries */
    double from, to;
} film_stay;

typedef struct film_box {
    double lo[3], hi[3];
    bool any;
} film_box;

typedef struct film_corners {
    const froe_motion *motion;
    froe_allocator alloc;
    bool coarse; /* bodies by their boxes, and straight pieces and parabolas in one part */
    bool room;
    film_box *boxes; /* of bodies */
    ARRAY(film_stay) stays;
    ARRAY(double) points;
} film_corners;

/* ------------------------------------------------------------------------- stays -- */

static int compare_stays(const void *a, const void *b) {
    const film_stay *p = a, *q = b;
    if (p->owner != q->owner) return p->owner < q->owner ? -1 : 1;
    return (p->from > q->from) - (p->from < q->from);
}

static void add_to_box(film_corners *w, uint32_t body, uint32_t vertex) {
    const froe_moving_knot corner = froe_motion_knot(w->motion, vertex, 0);
    film_box *box = w->boxes + body;
    for (int k = 0; k < 3; k++) {
        box->lo[k] = box->any ? fmin(box->lo[k], corner.at[k]) : corner.at[k];
        box->hi[k] = box->any ? fmax(box->hi[k], corner.at[k]) : corner.at[k];
    }
    box->any = true;
}

/* All stays, those of one owner that meet as one. */
static void list_stays(film_corners *w) {
    const uint32_t vertices = (uint32_t)froe_motion_vertex_count(w->motion);
    w->stays.count = 0;
    for (uint32_t i = 0; i < froe_motion_object_count(w->motion) && w->room; i++) {
        const froe_moving_object o = froe_motion_object(w->motion, i);
        for (int k = 0; k < 3 && w->room && o.birth <= o.death; k++) {
            const uint32_t v = o.vertices[k], body = froe_motion_vertex_body(w->motion, v);
            film_stay stay = {.owner = v, .from = o.birth, .to = o.death};
            if (w->coarse && body != FROE_NONE) stay.owner = vertices + body, add_to_box(w, body, v);
            w->room = array_push(&w->alloc, &w->stays, stay);
        }
    }
    if (!w->stays.count) return;
    qsort(w->stays.data, w->stays.count, sizeof *w->stays.data, compare_stays);
    size_t kept = 1;
    for (size_t i = 1; i < w->stays.count; i++) {
        film_stay *last = w->stays.data + kept - 1;
        const film_stay *stay = w->stays.data + i;
        if (stay->owner == last->owner && stay->from <= last->to)
            last->to = fmax(last->to, stay->to);
        else
            w->stays.data[kept++] = *stay;
    }
    w->stays.count = kept;
}

/* ------------------------------------------------------------------------ flights -- */

static void add_point(film_corners *w, const double at[3]) {
    w->room = w->room && array_append(&w->alloc, &w->points, at, 3);
}

static double mix(double p, double q, double share) {
    return p * (1 - share) + q * share;
}

/* Of a piece of a plan the point at share s = t, and for two shares the control point between these (the blossom). */
static void blossom_of(const double *p, const double *control, const double *q, double s, double t, double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = isnan(control[0]) ? mix(p[k], q[k], 0.5 * s + 0.5 * t)
                                   : mix(mix(p[k], control[k], s), mix(control[k], q[k], s), t);
}

/* The same of a vertex; of a cubic with as many shares as it has steps. */
static void blossom_at(const froe_moving_knot *p, const double *q, double s, double t, double u, double out[3]) {
    double from[3], to[3];
    if (isnan(p->second[0])) {
        blossom_of(p->at, p->control, q, s, u, out);
        return;
    }
    blossom_of(p->at, p->control, p->second, s, t, from);
    blossom_of(p->control, p->second, q, s, t, to);
    for (int k = 0; k < 3; k++) out[k] = mix(from[k], to[k], u);
}

/* The shares of a piece from one time to another, which are shares of the whole. */
static void shares_of(double begin, double end, const film_stay *stay, double out[2]) {
    const double times[2] = {fmax(begin, stay->from), fmin(end, stay->to)};
    for (int i = 0; i < 2; i++) {
        const double share = times[i] >= end ? 1 : (times[i] - begin) / (end - begin);
        out[i] = share >= 0 ? share : 0;
    }
}

/* The last instant at or before a time, or the first one: of a body, or, if that is FROE_NONE, of a vertex. */
static size_t knot_before(const film_corners *w, uint32_t body, uint32_t vertex, size_t count, double time) {
    size_t low = 0, high = count - 1;
    while (low < high) {
        const size_t middle = high - (high - low) / 2;
        const double at = body != FROE_NONE ? froe_motion_body_knot(w->motion, body, middle).time
                                            : froe_motion_knot(w->motion, vertex, middle).time;
        if (at <= time)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static void fly(film_corners *w, const film_stay *stay) {
    const size_t count = froe_motion_knot_count(w->motion, stay->owner);
    const size_t low = knot_before(w, FROE_NONE, stay->owner, count, stay->from);
    froe_moving_knot p = froe_motion_knot(w->motion, stay->owner, low);
    if (low + 1 >= count) add_point(w, p.at);
    for (size_t i = low; i + 1 < count && (i == low || p.time < stay->to) && w->room; i++) {
        const froe_moving_knot q = froe_motion_knot(w->motion, stay->owner, i + 1);
        const int parts = isnan(p.control[0]) || w->coarse ? 1 : PARTS;
        double shares[2], at[3];
        shares_of(p.time, q.time, stay, shares);
        blossom_at(&p, q.at, shares[0], shares[0], shares[0], at);
        if (i == low) add_point(w, at);
        for (int n = 0; n < parts && shares[0] < shares[1]; n++) {
            const double s = mix(shares[0], shares[1], (double)n / parts),
                         t = mix(shares[0], shares[1], (double)(n + 1) / parts);
            blossom_at(&p, q.at, s, s, t, at);
            if (!isnan(p.control[0])) add_point(w, at);
            blossom_at(&p, q.at, s, t, t, at);
            if (!isnan(p.second[0])) add_point(w, at);
            blossom_at(&p, q.at, t, t, t, at);
            add_point(w, at);
        }
        p = q;
    }
}

/* ------------------------------------------------------------------------- bodies -- */

/* The symmetric bilinear form whose square is a place turned by q, times |q|^2; divided by p . q, which is returned. */
static double turned(const double p[4], const double q[4], const double x[3], double out[3]) {
    const double weight = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3],
                 own = p[3] * q[3] - (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]),
                 px = p[0] * x[0] + p[1] * x[1] + p[2] * x[2], qx = q[0] * x[0] + q[1] * x[1] + q[2] * x[2];
    double axis[3];
    for (int k = 0; k < 3; k++) axis[k] = p[3] * q[k] + q[3] * p[k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = (own * x[k] + px * q[k] + qx * p[k] + axis[i] * x[j] - axis[j] * x[i]) / weight;
    }
    return weight;
}

/* The control points of degree 4 of a place in a body, from one share of a piece to another; the first one, which ends
 * the part before, only if `first`. */
static void add_arc(film_corners *w, const froe_body_knot *p, const froe_body_knot *q, double s, double t,
                    const double corner[3], bool first) {
    static const double binomial[3] = {1, 2, 1};
    double flight[3][3], arc[3][3], weight[3], ends[2][4];
    for (int i = 0; i < 4; i++)
        ends[0][i] = mix(p->turn[i], q->turn[i], s), ends[1][i] = mix(p->turn[i], q->turn[i], t);
    for (int i = 0; i < 3; i++) {
        blossom_of(p->at, p->control, q->at, i < 2 ? s : t, i ? t : s, flight[i]);
        weight[i] = turned(ends[i == 2], ends[i != 0], corner, arc[i]);
    }
    for (int n = first ? 0 : 1; n <= 4; n++) {
        double sum[3] = {0, 0, 0}, all = 0;
        for (int i = n > 2 ? n - 2 : 0; i <= 2 && i <= n; i++) {
            const double share = binomial[i] * binomial[n - i] * weight[i];
            all += share;
            for (int k = 0; k < 3; k++) sum[k] += share * (arc[i][k] + flight[n - i][k]);
        }
        for (int k = 0; k < 3; k++) sum[k] /= all;
        add_point(w, sum);
    }
}

/* A place in a body from one instant to another. */
static void turn_corner(film_corners *w, uint32_t body, const double corner[3], const film_stay *stay) {
    const size_t count = froe_motion_body_knot_count(w->motion, body);
    const size_t low = knot_before(w, body, FROE_NONE, count, stay->from);
    froe_body_knot p = froe_motion_body_knot(w->motion, body, low);
    if (low + 1 >= count) add_arc(w, &p, &p, 0, 0, corner, true);
    for (size_t i = low; i + 1 < count && (i == low || p.time < stay->to) && w->room; i++) {
        const froe_body_knot q = froe_motion_body_knot(w->motion, body, i + 1);
        double product = 0, shares[2];
        for (int k = 0; k < 4; k++) product += p.turn[k] * q.turn[k];
        const int parts = 1 + (int)(2 * PARTS * sqrt(fmax(1 - product, 0))); /* 10 degrees each */
        shares_of(p.time, q.time, stay, shares);
        for (int n = 0; n < parts; n++)
            add_arc(w, &p, &q, mix(shares[0], shares[1], (double)n / parts),
                    mix(shares[0], shares[1], (double)(n + 1) / parts), corner, i == low && !n);
        p = q;
    }
}

static void turn(film_corners *w, const film_stay *stay) {
    const uint32_t vertices = (uint32_t)froe_motion_vertex_count(w->motion);
    if (stay->owner < vertices) {
        const froe_moving_knot corner = froe_motion_knot(w->motion, stay->owner, 0);
        turn_corner(w, froe_motion_vertex_body(w->motion, stay->owner), corner.at, stay);
        return;
    }
    const film_box *box = w->boxes + (stay->owner - vertices);
    for (int i = 0; i < 8; i++) {
        double corner[3];
        for (int k = 0; k < 3; k++) corner[k] = i >> k & 1 ? box->hi[k] : box->lo[k];
        turn_corner(w, stay->owner - vertices, corner, stay);
    }
}

/* ------------------------------------------------------------------------- points -- */

/* All points; as soon as they are too many, and not yet coarse, none. */
static bool gather_points(film_corners *w) {
    const uint32_t vertices = (uint32_t)froe_motion_vertex_count(w->motion);
    w->points.count = 0;
    list_stays(w);
    for (size_t i = 0; i < w->stays.count && w->room; i++) {
        const film_stay *stay = w->stays.data + i;
        if (stay->owner < vertices && froe_motion_vertex_body(w->motion, stay->owner) == FROE_NONE)
            fly(w, stay);
        else
            turn(w, stay);
        if (!w->coarse && w->points.count > 3 * (size_t)MOST_POINTS) return false;
    }
    return true;
}

froe_status vector_film_corners(const froe_motion *motion, froe_scene **out, froe_diagnostic *diag) {
    film_corners w = {.motion = motion, .alloc = support_allocator(NULL), .room = true};
    const size_t bodies = froe_motion_body_count(motion);
    if (!gather_points(&w)) {
        w.coarse = true;
        w.boxes = support_calloc(&w.alloc, bodies + 1, sizeof *w.boxes);
        w.room = w.boxes != NULL;
        gather_points(&w);
    }
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT, batch.count = w.points.count / 3, batch.coords = w.points.data;
    froe_status status = w.room ? froe_scene_new(3, NULL, out) : FROE_E_MEMORY;
    if (!status && !batch.count) status = support_fail(diag, FROE_E_INPUT, "Nothing is ever there to be seen.");
    if (status == FROE_E_MEMORY) status = support_fail_memory(diag);
    if (!status) status = froe_scene_add(*out, &batch, diag);
    array_free(&w.alloc, &w.points), array_free(&w.alloc, &w.stays);
    if (w.boxes) support_free(&w.alloc, w.boxes, (bodies + 1) * sizeof *w.boxes);
    return status;
}
