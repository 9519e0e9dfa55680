/* bounds.c: see bounds.h. */
#include "shards/ask/bounds.h"
#include <math.h>

/* The box of a range. It need not be the least. */
void shards_box_of_range(const shards_question *q, size_t i, double *lo, double *hi) {
    const froe_range *r = &q->ranges[i];
    const size_t dim = (size_t)q->dim;
    const size_t corners[FROE_SHAPE_COUNT] = {
        [FROE_SHAPE_BOX] = 2,     [FROE_SHAPE_BALL] = 1,        [FROE_SHAPE_SIMPLEX] = dim + 1,
        [FROE_SHAPE_CAPSULE] = 2, [FROE_SHAPE_HULL] = r->count, [FROE_SHAPE_SEGMENT] = 2};
    const size_t count = (unsigned)r->shape < FROE_SHAPE_COUNT && r->points ? corners[r->shape] : 0;
    const bool round = r->shape == FROE_SHAPE_BALL || r->shape == FROE_SHAPE_CAPSULE;
    for (size_t a = 0; a < dim; a++) {
        lo[a] = count ? INFINITY : -INFINITY;
        hi[a] = count ? -INFINITY : INFINITY;
        for (size_t c = 0; c < count; c++) {
            const double x = r->points[c * dim + a];
            if (!(x >= lo[a])) lo[a] = x;
            if (!(x <= hi[a])) hi[a] = x;
        }
        if (round) lo[a] = nextafter(lo[a] - r->radius, -INFINITY), hi[a] = nextafter(hi[a] + r->radius, INFINITY);
        if (r->shape != FROE_SHAPE_RAY || !r->points) continue;
        if (r->points[dim + a] >= 0) lo[a] = r->points[a];
        if (r->points[dim + a] <= 0) hi[a] = r->points[a];
    }
}

void shards_box_of_box(const shards_question *q, size_t i, double *lo, double *hi) {
    const size_t dim = (size_t)q->dim;
    memcpy(lo, q->points + 2 * i * dim, dim * sizeof *lo);
    memcpy(hi, q->points + (2 * i + 1) * dim, dim * sizeof *hi);
}

/* The same for all questions. */
void shards_box_of_all(const shards_question *q, size_t i, double *lo, double *hi) {
    (void)i;
    shards_box_of_box(q, 0, lo, hi);
}

void shards_box_of_point(const shards_question *q, size_t i, double *lo, double *hi) {
    for (int a = 0; a < q->dim; a++) lo[a] = hi[a] = q->points[i * (size_t)q->dim + (size_t)a];
    if (q->way > 0) hi[1] = INFINITY;
    if (q->way < 0) lo[1] = -INFINITY;
}

/* The largest distance along an axis. A rounded difference is at most the rounded distance, because rounding keeps the
 * order of the exact ones. */
double shards_bound_of_near(const shards_question *q, size_t i, const double *lo, const double *hi) {
    double most = 0;
    for (int a = 0; a < q->dim; a++) {
        const double x = q->points[i * (size_t)q->dim + (size_t)a];
        const double off = x < lo[a] ? lo[a] - x : x > hi[a] ? x - hi[a] : 0;
        if (off > most) most = off;
    }
    return most < INFINITY ? most : 0x1.fffffffffffffp1023;
}

/* (to - from) / by, rounded away from the exact number: downwards, or upwards. */
static double parameter(double from, double to, double by, bool up) {
    const double wide = nextafter(to - from, (by > 0) == up ? INFINITY : -INFINITY);
    return nextafter(wide / by, up ? INFINITY : -INFINITY);
}

/* The parameter at which a ray enters a box, from below; slabs (Kay and Kajiya 1986), rounded outwards. */
double shards_bound_of_ray(const shards_question *q, size_t i, const double *lo, const double *hi) {
    const double *from = q->points + i * (size_t)q->dim, *by = q->directions + i * (size_t)q->dim;
    double enter = 0, leave = q->most;
    for (int a = 0; a < q->dim; a++) {
        if (by[a] == 0) {
            if (from[a] < lo[a] || from[a] > hi[a]) return INFINITY;
            continue;
        }
        const double in = parameter(from[a], by[a] > 0 ? lo[a] : hi[a], by[a], false);
        const double out = parameter(from[a], by[a] > 0 ? hi[a] : lo[a], by[a], true);
        if (in > enter) enter = in;
        if (out < leave) leave = out;
    }
    return enter > leave ? INFINITY : enter < INFINITY ? enter : 0x1.fffffffffffffp1023;
}

double shards_bound_of_any(const shards_question *q, size_t i, const double *lo, const double *hi) {
    double box_lo[FROE_MAX_DIM], box_hi[FROE_MAX_DIM];
    shards_box_of_range(q, i, box_lo, box_hi);
    for (int a = 0; a < q->dim; a++)
        if (lo[a] > box_hi[a] || hi[a] < box_lo[a]) return INFINITY;
    return 0;
}
