/* align.c: see align.h. */
#include "kinetic/sight/align.h"
#include <math.h>

#define T num_ball
#define POLY num_ball_poly
#define CURVE motion_ball_curve
#define FORMULA(f) f##_ball
#define FROM(x) num_ball_from(x)
#define ADD(a, b) num_ball_add(a, b)
#define SUB(a, b) num_ball_sub(a, b)
#define MUL(a, b) num_ball_mul(a, b)
#include "kinetic/sight/align_body.inc"

#define T num_dyadic
#define POLY num_poly
#define CURVE motion_dyadic_curve
#define FORMULA(f) f##_dyadic
#define FROM(x) num_dyadic_from(arena, x)
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#include "kinetic/sight/align_body.inc"

/* ---------------------------------------------------------------------- room -- */

/* The bits between the highest and the lowest of numbers, and of each. */
static int spread(const double *x, int count, int *top, int *unit) {
    for (int i = 0; i < count; i++) {
        int e;
        if (x[i] == 0) continue;
        frexp(x[i], &e);
        *top = e > *top ? e : *top;
        *unit = e - 53 < *unit ? e - 53 : *unit;
    }
    return *top > *unit ? *top - *unit : 1;
}

/* A coefficient is a product of six rays at most, and each has a coordinate, one of the eye, and times up to twice. */
froe_status align_begin(align_room *room, const froe_motion *motion, const align_eye *eye) {
    enum { NUMBERS = 4000, CHAINS = 3, SPARE_BITS = 128 };
    int top = motion->top, unit = motion->unit, time_top = motion->time_top, time_unit = motion->time_unit;
    *room = (align_room){.motion = motion, .eye = *eye};
    const size_t place = (size_t)spread(eye->at, 3, &top, &unit);
    const double ends[2] = {motion->begin, motion->end};
    const size_t time = (size_t)spread(ends, 2, &time_top, &time_unit) + 64;
    const size_t limbs = (6 * (2 * place + 2 * time + SPARE_BITS)) / 64 + 8;
    return num_arena_reserve(&motion->alloc, &room->arena,
                             NUMBERS * limbs + CHAINS * num_poly_arena(limbs, NUM_FRACTION_LIMBS));
}

void align_end(align_room *room) {
    num_arena_free(&room->motion->alloc, &room->arena);
}

void align_ray(const align_room *room, align_point *point) {
    motion_ball_curve at = {.w = num_ball_from(1)};
    num_ball *const x[3] = {at.x, at.y, at.z};
    for (int k = 0; k < 3 && point->rest; k++) x[k][0] = num_ball_from(point->rest[k]);
    if (!point->rest) motion_span_ball(room->motion, &point->piece, room->from, room->to, &at);
    ray_of_ball(NULL, &room->eye, &at, point->rest ? 0 : point->piece.degree, point->ray);
}

static void exact_ray(align_room *room, const align_point *point, num_poly ray[3]) {
    num_arena *arena = &room->arena;
    motion_dyadic_curve at = {.w = num_dyadic_from(arena, 1)};
    num_dyadic *const x[3] = {at.x, at.y, at.z};
    for (int k = 0; k < 3 && point->rest; k++) x[k][0] = num_dyadic_from(arena, point->rest[k]);
    if (!point->rest) motion_span_dyadic(arena, room->motion, &point->piece, room->from, room->to, &at);
    ray_of_dyadic(arena, &room->eye, &at, point->rest ? 0 : point->piece.degree, ray);
    for (int k = 0; k < 3; k++) num_poly_trim(&ray[k], ray[k].degree);
}

/* -------------------------------------------------------------------- between -- */

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
 * plane,
 * whose normal is n.
 */
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

/* May it be seen, as far as the ends of the edges tell, at that share of the time? */
static bool counts(const align_point *const points[], int count, num_ball share) {
    num_ball ray[6][3], n[3][3], x[3];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) ray[i][k] = num_ball_poly_at(&points[i]->ray[k], share);
    if (count == 3) {
        cross_at(ray[1], ray[2], n[0]);
        return between(ray[0], ray[1], ray[2], n[0]) & 1;
    }
    for (int i = 0; i < 3; i++) cross_at(ray[2 * i], ray[2 * i + 1], n[i]);
    unsigned ways = 3;
    cross_at(n[0], n[1], x);
    for (int i = 0; i < 3; i++) ways &= between(x, ray[2 * i], ray[2 * i + 1], n[i]);
    return ways != 0;
}

/* ---------------------------------------------------------------------- roots -- */

bool align_find(align_room *room, const align_point *const points[], int count, meet_time *out, int *found) {
    num_ball_poly near_ray[6][3], near;
    num_poly ray[6][3], f;
    *found = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) near_ray[i][k] = points[i]->ray[k];
    determinant_ball(NULL, (const num_ball_poly(*)[3])near_ray, count, &near);
    if (near.degree < 1 || (near.degree <= NUM_DEGREE && num_ball_poly_sign_throughout(&near) != NUM_UNSURE))
        return true;
    room->exact++;
    room->arena.top = 0;
    for (int i = 0; i < count; i++) exact_ray(room, points[i], ray[i]);
    determinant_dyadic(&room->arena, (const num_poly(*)[3])ray, count, &f);
    num_poly_trim(&f, f.degree);
    if (f.degree < 1) return true; /* it stays as it is */
    if (!f.c[0].sign && counts(points, count, num_ball_from(0))) out[(*found)++] = (meet_time){room->from, room->from};
    num_isolate(&room->arena, &f, &room->roots);
    if (room->roots.count < 0) return false;
    for (int i = 0; i < room->roots.count; i++) {
        num_isolated *root = &room->roots.root[i];
        if (!walk_time(&room->arena, room->from, room->to, root, &out[*found])) return false;
        *found += counts(points, count, num_isolated_ball(root));
    }
    return true;
}
