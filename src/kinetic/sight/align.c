/* align.c: see align.h. */
#include "kinetic/sight/align.h"
#include <math.h>

#include "num/ball_terms.inc"
#define POLY num_ball_poly
#define GAZE gaze_ball
#define PLACE align_ball_place
#define LINE align_ball_line
#define PAIR align_ball_pair
#define CURVE motion_ball_curve
#define SPAN(m, piece, from, to, out) motion_span_ball(m, piece, from, to, out)
#include "kinetic/sight/align_body.inc"

#include "num/dyadic_terms.inc"
#define POLY num_poly
#define GAZE gaze_exact
#define PLACE align_exact_place
#define LINE align_exact_line
#define PAIR align_exact_pair
#define CURVE motion_dyadic_curve
#define SPAN(m, piece, from, to, out) motion_span_dyadic(arena, m, piece, from, to, out)
#include "kinetic/sight/align_body.inc"

/* ---------------------------------------------------------------------- room -- */

/* Widens the range of bits from *unit up to *top so that it holds numbers. */
static void widen_bits(const double *x, size_t count, int *unit, int *top) {
    for (size_t i = 0; i < count; i++) {
        int e;
        if (x[i] == 0) continue;
        frexp(x[i], &e);
        *top = e > *top ? e : *top;
        *unit = e - 53 < *unit ? e - 53 : *unit;
    }
}

/* A coefficient is a product of six places and three of the eye. A place has a coordinate, and times up to five times:
 * three times for itself and twice for the centre of the eye; one where triangles cross has four coordinates. Of the
 * eye there are two quaternions, each with a time, and a place. */
froe_status align_begin(align_room *room, const froe_motion *motion, const double *rest, size_t count, bool crossings) {
    enum { NUMBERS = 2500, CHAINS = 3, SPARE_BITS = 128 };
    const froe_motion *rig = room->gaze.rig;
    const double ends[2] = {motion->begin, motion->end};
    int top = motion->top, unit = motion->unit, time_top = motion->time_top, time_unit = motion->time_unit;
    room->motion = motion;
    widen_bits(room->gaze.at, 3, &unit, &top);
    widen_bits(rest, count, &unit, &top);
    widen_bits(ends, 2, &time_unit, &time_top);
    if (rig) {
        top = rig->top > top ? rig->top : top, unit = rig->unit < unit ? rig->unit : unit;
        time_top = rig->time_top > time_top ? rig->time_top : time_top;
        time_unit = rig->time_unit < time_unit ? rig->time_unit : time_unit;
    }
    const size_t place = (size_t)(top > unit ? top - unit : 1), time = (size_t)(time_top - time_unit) + 64;
    const size_t corner = (crossings ? 4 : 1) * place + 5 * time + SPARE_BITS, eye = 3 * place + 2 * time + SPARE_BITS;
    const size_t limbs = (6 * corner + (rig ? 3 * eye : 0)) / 64 + 8;
    return num_arena_reserve(&motion->alloc, &room->arena,
                             NUMBERS * limbs + CHAINS * num_poly_arena(NUM_DEGREE, limbs, NUM_FRACTION_LIMBS));
}

void align_end(align_room *room) {
    if (room->motion) num_arena_free(&room->motion->alloc, &room->arena);
    gaze_end(&room->gaze);
}

void align_go(align_room *room, double from, double to) {
    room->from = from, room->to = to;
    gaze_near(&room->gaze, from, to, &room->near);
}

void align_place(const align_room *room, align_point *point) {
    seen_place_ball(NULL, room, &room->near, point, &point->near);
}

void align_line(const align_room *room, align_edge *edge) {
    if (edge->end[0]->carried)
        carried_line_ball(NULL, room, &room->near, edge->end, &edge->near);
    else
        line_of_ball(NULL, &room->near, &edge->end[0]->near, &edge->end[1]->near, &edge->near);
}

void align_two(const align_room *room, align_pair *pair) {
    pair_of_ball(NULL, &room->near, &pair->edge[0]->near, &pair->edge[1]->near, &pair->near);
}

static void exact_line(align_room *room, const align_edge *edge, align_exact_line *out) {
    if (edge->end[0]->carried) {
        carried_line_dyadic(&room->arena, room, &room->exactly, edge->end, out);
        return;
    }
    for (int i = 0; i < 2; i++) seen_place_dyadic(&room->arena, room, &room->exactly, edge->end[i], room->places + i);
    line_of_dyadic(&room->arena, &room->exactly, room->places, room->places + 1, out);
}

/* ------------------------------------------------------------------------ rays -- */

/* |q|^2 a W - R^-1 X  or, parallel, (Y_i a_k - Y_k a_i, Y_j a_k - Y_k a_j, |q|^2 a_k W) with Y = R^-1 X, a_k the
 * largest of a. An eye without a body is the centre itself, or sees in the direction a. */
void align_ray(const align_room *room, const align_point *point, num_ball_poly ray[3]) {
    const gaze *g = &room->gaze;
    num_ball_poly back[3][3], turned[3], scale, a[3];
    int k = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) back[i][j] = room->near.turn[j][i];
        a[i] = constant_ball(num_ball_from(g->rig || g->parallel ? g->at[i] : 0));
        if (fabs(g->at[i]) > fabs(g->at[k])) k = i;
    }
    for (int i = 0; i < 3; i++) scalar_product_ball(NULL, back[i], point->near.x, &turned[i]);
    product_ball(NULL, &room->near.square, &point->near.w, &scale);
    const num_ball_poly one = constant_ball(num_ball_from(1));
    for (int i = 0; i < 3 && !g->parallel; i++) {
        const term_ball term[] = {{&scale, &a[i], false}, {&turned[i], &one, true}};
        sum_products_ball(NULL, term, 2, &ray[i]);
    }
    for (int i = 0; i < 2 && g->parallel; i++) {
        const int at = (k + 1 + i) % 3;
        const term_ball term[] = {{&turned[at], &a[k], false}, {&turned[k], &a[at], true}};
        sum_products_ball(NULL, term, 2, &ray[i]);
    }
    if (g->parallel) product_ball(NULL, &scale, &a[k], &ray[2]);
}

/* The eye at an instant. */
typedef struct align_now {
    num_ball share, at[3], w;
    int axis; /* parallel: the largest of its direction */
} align_now;

static align_now eye_at(const align_room *room, num_ball share) {
    align_now out = {.share = share, .w = num_ball_poly_at(&room->near.w, share)};
    for (int k = 0; k < 3; k++) {
        out.at[k] = num_ball_poly_at(&room->near.at[k], share);
        if (fabs(out.at[k].x) > fabs(out.at[out.axis].x)) out.axis = k;
    }
    return out;
}

/* The ray of a point then, in any coordinates of the page, and for all points the same. */
static void ray_at(const align_room *room, const align_now *eye, const align_point *point, num_ball ray[3]) {
    num_ball x[3];
    const num_ball w = num_ball_poly_at(&point->near.w, eye->share);
    for (int k = 0; k < 3; k++) x[k] = num_ball_poly_at(&point->near.x[k], eye->share);
    for (int k = 0; k < 3 && !room->gaze.parallel; k++)
        ray[k] = num_ball_sub(num_ball_mul(eye->at[k], w), num_ball_mul(x[k], eye->w));
    if (!room->gaze.parallel) return;
    const int k = eye->axis;
    for (int i = 0; i < 2; i++) {
        const int at = (k + 1 + i) % 3;
        ray[i] = num_ball_sub(num_ball_mul(x[at], eye->at[k]), num_ball_mul(x[k], eye->at[at]));
    }
    ray[2] = num_ball_mul(eye->at[k], w);
}

static void cross_at(const num_ball a[3], const num_ball b[3], num_ball out[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = num_ball_sub(num_ball_mul(a[i], b[j]), num_ball_mul(a[j], b[i]));
    }
}

static int sign_of_dot(const num_ball a[3], const num_ball b[3]) {
    num_ball sum = num_ball_mul(a[0], b[0]);
    for (int k = 1; k < 3; k++) sum = num_ball_add(sum, num_ball_mul(a[k], b[k]));
    return num_ball_sign(sum);
}

/* For which of +x (bit 0) and -x (bit 1) may it be a sum of positive multiples of the rays a and b? x is in their
 * plane, whose normal is n. */
static unsigned between(const num_ball x[3], const num_ball a[3], const num_ball b[3], const num_ball n[3]) {
    num_ball first[3], last[3];
    cross_at(x, b, first);
    cross_at(a, x, last);
    unsigned ways = 3;
    const int signs[2] = {sign_of_dot(first, n), sign_of_dot(last, n)};
    for (int i = 0; i < 2; i++)
        if (signs[i] != NUM_UNSURE && signs[i]) ways &= signs[i] < 0 ? 2u : 1u;
    return ways;
}

/* What is looked for: a point and an edge, or three edges. */
typedef struct align_case {
    const align_point *point; /* NULL: three edges */
    const align_edge *const *edge;
} align_case;

/* May it be seen, as far as the ends of the edges tell, at that share of the time? */
static bool counts(const align_room *room, align_case c, num_ball share) {
    const align_now eye = eye_at(room, share);
    num_ball ray[3][2][3], n[3][3], x[3];
    for (int i = 0; i < (c.point ? 1 : 3); i++) {
        for (int k = 0; k < 2; k++) ray_at(room, &eye, c.edge[i]->end[k], ray[i][k]);
        cross_at(ray[i][0], ray[i][1], n[i]);
    }
    unsigned ways = 3;
    if (c.point) {
        ray_at(room, &eye, c.point, x);
        return between(x, ray[0][0], ray[0][1], n[0]) & 1;
    }
    cross_at(n[0], n[1], x);
    for (int i = 0; i < 3; i++) ways &= between(x, ray[i][0], ray[i][1], n[i]);
    return ways != 0;
}

/* ---------------------------------------------------------------------- roots -- */

static bool surely_none(const num_ball_poly *near) {
    return near->degree < 1 || num_ball_poly_sign_throughout(near) != NUM_UNSURE;
}

static void begin_exact(align_room *room) {
    room->exact++;
    room->arena.top = 0;
    gaze_exactly(&room->arena, &room->gaze, room->from, room->to, &room->exactly);
}

static bool find_roots(align_room *room, num_poly *f, align_case c, meet_time *out, int *found) {
    num_poly_trim(f, f->degree);
    if (f->degree < 1) return true; /* it stays as it is */
    if (!f->c[0].sign && counts(room, c, num_ball_from(0))) out[(*found)++] = (meet_time){room->from, room->from};
    num_isolate(&room->arena, f, &room->roots);
    if (room->roots.count < 0) return false;
    for (int i = 0; i < room->roots.count; i++) {
        num_isolated *root = &room->roots.root[i];
        if (!walk_time(&room->arena, room->from, room->to, root, &out[*found])) return false;
        *found += counts(room, c, num_isolated_ball(root));
    }
    /* at the end: from then on it may be 0 for as long as the next pieces last */
    if (!num_poly_sign(&room->arena, f, num_dyadic_scaled(&room->arena, 1, 1, 0)) && counts(room, c, num_ball_from(1)))
        out[(*found)++] = (meet_time){room->to, room->to};
    return true;
}

bool align_pass(align_room *room, const align_point *point, const align_edge *edge, meet_time *out, int *found) {
    num_ball_poly near;
    num_poly f;
    *found = 0;
    pass_plane_ball(NULL, &point->near, &edge->near, &near);
    if (surely_none(&near)) return true;
    begin_exact(room);
    exact_line(room, edge, room->lines);
    seen_place_dyadic(&room->arena, room, &room->exactly, point, room->places);
    pass_plane_dyadic(&room->arena, room->places, room->lines, &f);
    return find_roots(room, &f, (align_case){point, &edge}, out, found);
}

/* The polynomial of three edges; apart, so that what it needs on the stack is gone when roots are looked for. */
__attribute__((noinline)) static void exact_meet(align_room *room, const align_edge *const edge[3], num_poly *f) {
    begin_exact(room);
    for (int i = 0; i < 3; i++) exact_line(room, edge[i], room->lines + i);
    pair_of_dyadic(&room->arena, &room->exactly, room->lines, room->lines + 1, &room->pair);
    pass_pair_dyadic(&room->arena, &room->pair, room->lines + 2, f);
}

bool align_meet(align_room *room, const align_pair *pair, const align_edge *third, meet_time *out, int *found) {
    const align_edge *const edge[3] = {pair->edge[0], pair->edge[1], third};
    num_ball_poly near;
    num_poly f;
    *found = 0;
    pass_pair_ball(NULL, &pair->near, &third->near, &near);
    if (surely_none(&near)) return true;
    exact_meet(room, edge, &f);
    return find_roots(room, &f, (align_case){NULL, edge}, out, found);
}
