/* parabolas.c: a motion without bodies: their vertices fly along parabolas of their own.
 *
 *          c          Between two cuts of a piece a vertex of a body is at  F(u) + N(u) / W(u)  (motion.h). The
 *        .   .        parabola that replaces it meets it at both cuts and halfway. With  D = parabola - F  it is off by
 *      .-"""-.             (N - W D) / W,
 *     a       b       whose numerator has degree 4 and vanishes at 0, 1/2 and 1: the error falls with the third power
 *                     of the length. No more than its greatest coefficient in Bernstein's form, by the least of W.
 *
 * All of it is computed with error bounds, so what rounding adds is a part of the bound. For each u it is linear in the
 * place of the vertex in the body: where the bound holds for the corners of a box, it holds for all in it. Places are
 * rounded to multiples of a power of 2 far below the deviation, and cuts to even ticks, as whole numbers with few bits
 * decide quickly later. */
#include "base/floats.h"
#include "base/sort.h"
#include "kinetic/motion/motion.h"
#include "support/fail.h"
#include <string.h>

enum { SPARE = 20, MOST_PARTS = 1 << 20 };

typedef struct cut {
    double time;
    uint32_t knot; /* of the body: the piece that goes on from here */
} cut;

typedef struct body_cuts {
    uint32_t vertex; /* any of it; FROE_NONE: there is none */
    double lo[3], hi[3];
    size_t first, count;
} body_cuts;

typedef struct replacement {
    const froe_motion *from;
    double deviation, reached;
    int grid; /* places are multiples of 2^grid */
    const froe_allocator *alloc;
    froe_diagnostic *diag;
    ARRAY(body_cuts) bodies;
    ARRAY(cut) cuts;
    ARRAY(size_t) starts; /* and the batch that is made */
    ARRAY(double) times;
    ARRAY(double) coords;
    ARRAY(double) controls;
    ARRAY(double) second_controls;
    ARRAY(double) lives;    /* all births, then all deaths */
    ARRAY(uint32_t) sorted; /* vertices by bodies and places, and as many for sorting */
    ARRAY(uint32_t) first;  /* of those of its body in the place of a vertex */
    ARRAY(uint32_t) corners;
    ARRAY(uint32_t) groups;
    ARRAY(uint64_t) tags;
} replacement;

static bool is_straight(const motion_piece *piece) {
    const double *p = piece->turn->q, *q = piece->turn[piece->from != piece->to].q;
    return piece->degree < 2 && p[0] == q[0] && p[1] == q[1] && p[2] == q[2] && p[3] == q[3];
}

/* ------------------------------------------------------------------- one parabola -- */

/* The nearest multiple of 2^grid. */
static double on_grid(const replacement *r, double x) {
    const double steps = ldexp(x, -r->grid);
    return fabs(steps) < 0x1p51 ? ldexp(floor(steps + 0.5), r->grid) : x;
}

static num_ball times_of(double a, num_ball b) {
    return num_ball_mul(num_ball_from(a), b);
}

/* Where the arc begins (end 0) or ends (2). */
static void arc_end(const replacement *r, const motion_arc *arc, int end, double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = on_grid(r, arc->flight[end][k].x + arc->turned[end][k].x);
}

/* The control point with which a parabola meets the arc halfway. */
static double control_of(const replacement *r, const motion_arc *arc, int k) {
    double top = 0, bottom = 0, ends = 0;
    for (int i = 0; i < 3; i++) {
        const double w = (i == 1 ? 2 : 1) * arc->weight[i].x;
        top += w * arc->turned[i][k].x;
        bottom += w;
        if (i != 1) ends += arc->turned[i][k].x;
    }
    return on_grid(r, arc->flight[1][k].x + (2 * (top / bottom) - 0.5 * ends));
}

/* How far coordinate k of a parabola with control points p is off, times W: coefficients in Bernstein's form. */
static void miss(const motion_arc *arc, const double p[3], int k, double out[5]) {
    const num_ball *w = arc->weight;
    num_ball d[3], m[3][3]; /* m[i][j] = w[i] (turned - D)[j] */
    for (int j = 0; j < 3; j++) d[j] = num_ball_sub(num_ball_from(p[j]), arc->flight[j][k]);
    /* N - W D: of N, control point i has the weight w[i] alone, raised to degree 4 */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) m[i][j] = num_ball_mul(w[i], num_ball_sub(arc->turned[i][k], d[j]));
    const num_ball mixed = num_ball_add(num_ball_add(m[0][2], m[2][0]), times_of(4, m[1][1]));
    const num_ball all[5] = {m[0][0], times_of(0.5, num_ball_add(m[0][1], m[1][0])), times_of(1.0 / 6, mixed),
                             times_of(0.5, num_ball_add(m[1][2], m[2][1])), m[2][2]};
    for (int i = 0; i < 5; i++) out[i] = fabs(all[i].x) + all[i].e;
    out[2] *= NUM_BALL_UP; /* a sixth is no double */
}

/* A bound of the distance between an arc and the parabola with the control points p; infinite: there is no telling. */
static double distance(const motion_arc *arc, const double p[3][3]) {
    double off[3][5], largest = 0, most = 0, least = (double)INFINITY;
    bool known = true;
    int exponent = 0; /* of a power of 2 near the largest, by which all are divided, so that no square overflows */
    for (int k = 0; k < 3; k++) {
        const double points[3] = {p[0][k], p[1][k], p[2][k]};
        miss(arc, points, k, off[k]);
        for (int i = 0; i < 5; i++) known &= off[k][i] < (double)INFINITY, largest = fmax(largest, off[k][i]);
    }
    if (known) frexp(largest, &exponent);
    for (int i = 0; i < 5; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) square += ldexp(off[k][i], -exponent) * ldexp(off[k][i], -exponent);
        most = fmax(most, square);
    }
    for (int i = 0; i < 3; i++) {
        const double weight = arc->weight[i].x - arc->weight[i].e;
        known &= weight > 0;
        least = fmin(least, weight);
    }
    return known ? ldexp(sqrt(most), exponent) / least * (1 + 0x1p-40) + NUM_BALL_TINY : (double)INFINITY;
}

/* The control point of the parabola between p[0] and p[2], as p[1]. Returns the distance. */
static double bend(const replacement *r, const motion_piece *piece, const motion_arc *arc, double p[3][3]) {
    const bool straight = is_straight(piece);
    for (int k = 0; k < 3; k++) p[1][k] = straight ? 0.5 * p[0][k] + 0.5 * p[2][k] : control_of(r, arc, k);
    return distance(arc, (const double(*)[3])p);
}

/* ------------------------------------------------------------------------ cuts -- */

/* The time from which part i of n lasts, an even tick where there is one. */
static double cut_time(const froe_motion *m, double from, double to, uint32_t i, uint32_t n) {
    if (!i || i == n) return i ? to : from;
    const double time = from + (to - from) * ((double)i / n);
    const int64_t tick = motion_tick_before(m, time) & ~(int64_t)1;
    const double rounded = m->begin + ldexp((double)tick, m->power);
    return rounded > from && rounded < to ? rounded : time;
}

/* How far the corners of a body's box are off when a piece has n parts; infinite: instants are too far apart. */
static double worst_of(const replacement *r, const body_cuts *b, motion_piece piece, double from, double to,
                       uint32_t n) {
    double worst = 0, p[3][3], corner[3];
    motion_arc arc;
    for (uint32_t i = 0; i < n && worst <= r->deviation; i++) {
        const double begin = cut_time(r->from, from, to, i, n), end = cut_time(r->from, from, to, i + 1, n);
        if (!(begin < end)) return (double)INFINITY;
        for (int c = 0; c < 8; c++) {
            for (int k = 0; k < 3; k++) corner[k] = c >> k & 1 ? b->hi[k] : b->lo[k];
            piece.corner = corner;
            motion_arc_of(r->from, &piece, begin, end, &arc);
            arc_end(r, &arc, 0, p[0]), arc_end(r, &arc, 2, p[2]);
            worst = fmax(worst, bend(r, &piece, &arc, p));
        }
    }
    return worst;
}

static froe_status fail_limit(const replacement *r, size_t body) {
    return support_fail_at(r->diag, FROE_E_LIMIT, FROE_NONE, FROE_NONE, FROE_NONE,
                           "body %zu: Doubles near it, or instants, are too far apart for a deviation of %g.", body,
                           r->deviation);
}

static froe_status cut_piece(replacement *r, size_t body, uint32_t knot) {
    const body_cuts *b = r->bodies.data + body;
    const motion_piece piece = motion_piece_after(r->from, b->vertex, knot);
    const double from = piece.from->time, to = piece.to->time;
    uint32_t n = 1;
    while (n <= MOST_PARTS && !(worst_of(r, b, piece, from, to, n) <= r->deviation))
        n = is_straight(&piece) ? MOST_PARTS + 1 : n + n / 2 + 1;
    if (n > MOST_PARTS) return fail_limit(r, body);
    if (!array_reserve(r->alloc, &r->cuts, n)) return support_fail_memory(r->diag);
    for (uint32_t i = 0; i < n; i++) r->cuts.data[r->cuts.count++] = (cut){cut_time(r->from, from, to, i, n), knot};
    return FROE_OK;
}

/* The cuts of one body, those of its own plan included, as far as the window goes. */
static froe_status cut_body(replacement *r, size_t body) {
    const froe_motion *m = r->from;
    body_cuts *b = r->bodies.data + body;
    const motion_plan *plan = &m->bodies.data[body].plan;
    const motion_knot *knots = m->knots.data + plan->first;
    uint32_t first = 0, last = plan->count - 1; /* knots */
    froe_status status = FROE_OK;
    b->first = r->cuts.count;
    if (b->vertex == FROE_NONE) return FROE_OK;
    while (first + 1 < last && knots[first + 1].time <= m->begin) first++;
    while (last > first + 1 && knots[last - 1].time >= m->end) last--;
    for (uint32_t i = first; i < last && !status; i++) status = cut_piece(r, body, i);
    if (!status && !array_push(r->alloc, &r->cuts, (cut){knots[last].time, last ? last - 1 : 0}))
        status = support_fail_memory(r->diag);
    b->count = r->cuts.count - b->first;
    return status;
}

static froe_status cut_bodies(replacement *r) {
    const froe_motion *m = r->from;
    const body_cuts none = {FROE_NONE,
                            {(double)INFINITY, (double)INFINITY, (double)INFINITY},
                            {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY},
                            0,
                            0};
    if (!array_reserve(r->alloc, &r->bodies, m->bodies.count)) return support_fail_memory(r->diag);
    while (r->bodies.count < m->bodies.count) r->bodies.data[r->bodies.count++] = none;
    for (uint32_t v = 0; v < m->plans.count; v++) {
        const motion_plan *plan = m->plans.data + v;
        if (plan->body == FROE_NONE) continue;
        body_cuts *b = r->bodies.data + plan->body;
        b->vertex = v;
        for (int k = 0; k < 3; k++) {
            const double x = m->knots.data[plan->first].at[k];
            if (x < b->lo[k]) b->lo[k] = x;
            if (x > b->hi[k]) b->hi[k] = x;
        }
    }
    froe_status status = FROE_OK;
    for (size_t i = 0; i < m->bodies.count && !status; i++) status = cut_body(r, i);
    return status;
}

/* ------------------------------------------------------------------------ plans -- */

static void put_knot(replacement *r, double time, const double at[3], const double control[3], const double second[3]) {
    const size_t n = r->times.count++;
    const size_t dim = (size_t)r->from->dim;
    r->times.data[n] = time;
    for (size_t k = 0; k < dim; k++) {
        r->coords.data[dim * n + k] = at[k];
        r->controls.data[dim * n + k] = control[k], r->second_controls.data[dim * n + k] = second[k];
    }
}

/* No control point. */
static const double straight[3] = {(double)NAN, (double)NAN, (double)NAN};

static void put_own(replacement *r, const motion_plan *plan) {
    for (size_t i = 0; i < plan->count; i++) {
        const motion_knot *knot = r->from->knots.data + plan->first + i;
        const bool cubic = knot->second != FROE_NONE;
        put_knot(r, knot->time, knot->at, knot->control, cubic ? r->from->seconds.data[knot->second].at : straight);
    }
}

/* Part i of a body's flight, as a vertex of it flies. A body of one knot stands still. */
static motion_piece part_arc(const replacement *r, uint32_t v, const body_cuts *b, size_t i, motion_arc *arc) {
    const cut *c = r->cuts.data + b->first + i;
    const motion_piece piece = motion_piece_after(r->from, v, c->knot);
    motion_arc_of(r->from, &piece, c->time, b->count > 1 ? c[1].time : c->time, arc);
    return piece;
}

/* A part ends where the next begins. Where that is another piece of the body, rounding may tell two places: the later
 * counts, and the part before is as far off as it then is. */
static double put_carried(replacement *r, uint32_t v, const body_cuts *b) {
    const cut *cuts = r->cuts.data + b->first;
    const size_t parts = b->count > 1 ? b->count - 1 : 1;
    double p[3][3], worst = 0;
    motion_arc arc, next;
    motion_piece piece = part_arc(r, v, b, 0, &arc), after = piece;
    arc_end(r, &arc, 0, p[0]);
    for (size_t i = 0; i < parts; i++, piece = after, arc = next) {
        const bool last = i + 1 == parts;
        next = arc;
        if (!last) after = part_arc(r, v, b, i + 1, &next);
        arc_end(r, &next, last ? 2 : 0, p[2]);
        worst = fmax(worst, bend(r, &piece, &arc, p));
        put_knot(r, cuts[i].time, p[0], is_straight(&piece) ? straight : p[1], straight);
        memcpy(p[0], p[2], sizeof p[0]);
    }
    if (b->count > 1) put_knot(r, cuts[parts].time, p[0], straight, straight);
    return worst;
}

static froe_status put_plans(replacement *r) {
    const froe_motion *m = r->from;
    for (uint32_t v = 0; v < m->plans.count; v++) {
        const motion_plan *plan = m->plans.data + v;
        r->starts.data[v] = r->times.count;
        if (plan->body == FROE_NONE) {
            put_own(r, plan);
            continue;
        }
        const double off = put_carried(r, v, r->bodies.data + plan->body);
        if (!(off <= r->deviation)) return fail_limit(r, plan->body);
        r->reached = fmax(r->reached, off);
    }
    r->starts.data[m->plans.count] = r->times.count;
    return FROE_OK;
}

static froe_status reserve_plans(replacement *r) {
    const froe_motion *m = r->from;
    const size_t n = m->objects.count;
    size_t all = 0;
    for (size_t v = 0; v < m->plans.count; v++) {
        const motion_plan *plan = m->plans.data + v;
        all += plan->body == FROE_NONE ? plan->count : r->bodies.data[plan->body].count;
    }
    const bool room =
        array_reserve(r->alloc, &r->starts, m->plans.count + 1) && array_reserve(r->alloc, &r->times, all) &&
        array_reserve(r->alloc, &r->coords, 3 * all) && array_reserve(r->alloc, &r->controls, 3 * all) &&
        array_reserve(r->alloc, &r->second_controls, 3 * all) && array_reserve(r->alloc, &r->lives, 2 * n + 1) &&
        array_reserve(r->alloc, &r->sorted, 2 * m->plans.count) && array_reserve(r->alloc, &r->first, m->plans.count) &&
        array_reserve(r->alloc, &r->corners, 3 * n) && array_reserve(r->alloc, &r->groups, n) &&
        array_reserve(r->alloc, &r->tags, n);
    return room ? FROE_OK : support_fail_memory(r->diag);
}

/* ------------------------------------------------------------------------ motion -- */

static int by_corner(void *user, uint32_t a, uint32_t b) {
    const froe_motion *m = user;
    const motion_plan *p = m->plans.data + a, *q = m->plans.data + b;
    if (p->body != q->body) return p->body < q->body ? -1 : 1;
    const double *x = m->knots.data[p->first].at, *y = m->knots.data[q->first].at;
    for (int k = 0; k < 3; k++)
        if (x[k] != y[k]) return x[k] < y[k] ? -1 : 1;
    return 0;
}

/* Faces that touch at corners of their own are neighbours, as those that share vertices are. */
static void weld(replacement *r) {
    froe_motion *m = (froe_motion *)r->from; /* only read */
    const size_t n = m->plans.count;
    uint32_t *sorted = r->sorted.data, *first = r->first.data;
    for (uint32_t v = 0; v < n; v++) sorted[v] = v;
    base_merge_sort(sorted, sorted + n, n, by_corner, m);
    for (size_t i = 0; i < n; i++) {
        const uint32_t v = sorted[i];
        const bool same = i && m->plans.data[v].body != FROE_NONE && by_corner(m, sorted[i - 1], v) == 0;
        first[v] = same ? first[sorted[i - 1]] : v;
    }
}

static void put_corners(const replacement *r, const motion_object *o, uint32_t *out) {
    const int dim = r->from->dim;
    for (int k = 0; k < dim; k++) out[k] = r->first.data[o->vertices[k]];
    if (dim == 2 || (out[0] != out[1] && out[1] != out[2] && out[2] != out[0])) return;
    for (int k = 0; k < 3; k++) out[k] = o->vertices[k]; /* it has no area */
}

static void put_objects(replacement *r) {
    const froe_motion *m = r->from;
    const size_t n = m->objects.count;
    for (size_t i = 0; i < n; i++) {
        const motion_object *o = m->objects.data + i;
        r->lives.data[i] = o->birth, r->lives.data[n + i] = o->death;
        if (o->birth > o->death) /* never there in the window */
            r->lives.data[i] = r->lives.data[n + i] = o->birth > m->end ? o->birth : o->death;
        put_corners(r, o, r->corners.data + (size_t)m->dim * i);
        r->groups.data[i] = o->group, r->tags.data[i] = o->tag;
    }
}

static froe_status fill_motion(replacement *r, froe_motion *out) {
    const froe_motion *m = r->from;
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = m->plans.count, batch.count = m->objects.count;
    batch.starts = r->starts.data, batch.times = r->times.data;
    batch.coords = r->coords.data, batch.controls = r->controls.data;
    batch.second_controls = r->second_controls.data;
    batch.births = r->lives.data, batch.deaths = r->lives.data + m->objects.count;
    batch.vertices = r->corners.data, batch.groups = r->groups.data, batch.tags = r->tags.data;
    for (uint32_t i = 0; i < froe_motion_group_count(m); i++) {
        const froe_group group = froe_motion_group(m, i);
        if (froe_motion_add_group(out, &group, NULL)) return support_fail_memory(r->diag);
    }
    return m->plans.count ? froe_motion_add(out, &batch, r->diag) : FROE_OK;
}

static froe_status make(replacement *r, froe_motion **out) {
    const froe_motion_options window = froe_motion_window(r->from);
    froe_status status = cut_bodies(r);
    if (!status) status = reserve_plans(r);
    if (!status) status = put_plans(r);
    if (status) return status;
    weld(r);
    put_objects(r);
    froe_motion *made = NULL;
    status = froe_motion_new(&window, r->alloc, &made, r->diag);
    if (!status) status = fill_motion(r, made);
    if (!status)
        *out = made;
    else
        froe_motion_free(made);
    return status;
}

froe_status froe_motion_without_bodies(const froe_motion *motion, double deviation, const froe_allocator *alloc,
                                       froe_motion **out, double *reached, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !out) return support_fail_null(diag, __func__);
    if (!(deviation > 0) || !isfinite(deviation))
        return support_fail(diag, FROE_E_ARG, "A deviation of %g is not a number above 0.", deviation);
    const froe_allocator memory = support_allocator(alloc);
    replacement r = {.from = motion, .deviation = deviation, .alloc = &memory, .diag = diag};
    frexp(deviation, &r.grid);
    r.grid -= SPARE;
    const froe_status status = make(&r, out);
    if (!status && reached) *reached = r.reached;
    array_free(&memory, &r.bodies);
    array_free(&memory, &r.cuts);
    array_free(&memory, &r.starts);
    array_free(&memory, &r.times);
    array_free(&memory, &r.coords);
    array_free(&memory, &r.controls);
    array_free(&memory, &r.second_controls);
    array_free(&memory, &r.lives);
    array_free(&memory, &r.sorted);
    array_free(&memory, &r.first);
    array_free(&memory, &r.corners);
    array_free(&memory, &r.groups);
    array_free(&memory, &r.tags);
    return status;
}
