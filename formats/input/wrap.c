/* wrap.c: see wrap.h. */
#include "formats/input/wrap.h"
#include "formats/input/triangulate.h"
#include <math.h>
#include <stdlib.h>

static const double half = 180, whole = 360, pole = 90;

froe_status formats_wrap_point(formats_sink *sink, const double *point, double *out) {
    const double x = point[0], y = point[1];
    if (fabs(x) > whole || fabs(y) > pole)
        return formats_sink_fail(
            sink, FROE_E_INPUT,
            "The numbers %.9g and %.9g are no longitude and latitude, and nothing can be cut at 180.", x, y);
    out[0] = x > half ? x - whole : x < -half ? x + whole : x;
    out[1] = y;
    return FROE_OK;
}

/* Edges along a pole are points of the Earth. */
static bool crosses(const double *a, const double *b) {
    return fabs(b[0] - a[0]) > half && !(a[1] == b[1] && fabs(a[1]) == pole);
}

/* The latitude where an edge crosses. Ends in 180 and -180 are crossings themselves. */
static double crossing(const double *a, const double *b) {
    const double *east = a[0] > b[0] ? a : b, *west = a[0] > b[0] ? b : a;
    const double to_east = half - east[0], to_west = half + west[0];
    if (to_east == 0) return east[1];
    if (to_west == 0) return west[1];
    const double y = (east[1] * to_west + west[1] * to_east) / (to_east + to_west);
    return fmin(fmax(y, fmin(a[1], b[1])), fmax(a[1], b[1]));
}

static froe_status add_edge(formats_sink *sink, const double *a, const double *b, formats_wrap_cuts *cuts) {
    if (!crosses(a, b)) return formats_sink_segment(sink, a, b);
    const double y = crossing(a, b), at_a[2] = {copysign(half, a[0]), y}, at_b[2] = {copysign(half, b[0]), y};
    froe_status status = FROE_OK;
    if (!array_push(&sink->alloc, cuts, y)) return support_fail_memory(sink->diag);
    if (a[0] != at_a[0] || a[1] != at_a[1]) status = formats_sink_segment(sink, a, at_a);
    if (!status && (b[0] != at_b[0] || b[1] != at_b[1])) status = formats_sink_segment(sink, at_b, b);
    return status;
}

/* A ring of which no corner lies beside the antimeridian is the frame of a whole map. */
static bool is_frame(const double *xy, size_t count) {
    size_t i = 0;
    while (i < count && fabs(xy[2 * i]) == half) i++;
    return i == count;
}

froe_status formats_wrap_line(formats_sink *sink, const double *xy, size_t count, formats_wrap_cuts *cuts) {
    const bool frame = is_frame(xy, count);
    double a[2], b[2];
    froe_status status = formats_wrap_point(sink, xy, a);
    for (size_t i = 1; i < count && !status; i++, a[0] = b[0], a[1] = b[1]) {
        status = formats_wrap_point(sink, xy + 2 * i, b);
        if (!status) status = frame ? formats_sink_segment(sink, a, b) : add_edge(sink, a, b, cuts);
    }
    return status;
}

static int by_latitude(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A segment that is no point, in the one direction or the other. */
static froe_status add_side(formats_sink *sink, bool turned, double x0, double y0, double x1, double y1) {
    const double a[2] = {x0, y0}, b[2] = {x1, y1};
    if (x0 == x1 && y0 == y1) return FROE_OK;
    return turned ? formats_sink_segment(sink, b, a) : formats_sink_segment(sink, a, b);
}

froe_status formats_wrap_close(formats_sink *sink, formats_wrap_cuts *cuts, bool right) {
    double *y = cuts->data;
    size_t count = cuts->count;
    froe_status status = FROE_OK;
    cuts->count = 0;
    if (count > 1) qsort(y, count, sizeof *y, by_latitude);
    if (count % 2) { /* around a pole: its edge, and the first or the last cut is by itself */
        const bool south = y[0] + y[count - 1] < 0;
        const double alone = y[south ? 0 : count - 1], at = south ? -pole : pole;
        status = add_side(sink, right != south, half, at, -half, at);
        if (!status) status = add_side(sink, right != south, half, alone, half, at);
        if (!status) status = add_side(sink, right != south, -half, at, -half, alone);
        y += south;
        count--;
    }
    for (size_t i = 0; i < count && !status; i += 2) {
        status = add_side(sink, right, half, y[i], half, y[i + 1]);
        if (!status) status = add_side(sink, right, -half, y[i + 1], -half, y[i]);
    }
    return status;
}

/* Sums are rounded: a ring thinner than that, some 10 nanometres, may seem to turn the other way. */
int formats_wrap_ring_side(double *xy, size_t count) {
    double turned = 0, low = pole, high = -pole; /* degrees; latitudes of crossings */
    const bool frame = is_frame(xy, count);
    for (size_t i = 1; i <= count && !frame; i++) {
        double *at = xy + 2 * (i % count);
        const double *before = xy + 2 * i - 2, from[2] = {before[0] - turned, before[1]};
        if (crosses(from, at)) {
            const double y = crossing(from, at);
            low = fmin(low, y), high = fmax(high, y);
            turned += copysign(whole, from[0] - at[0]);
        }
        if (i < count) at[0] += turned;
    }
    if (turned == 0) return formats_ring_side(xy, count);
    return (turned > 0) == (low + high < 0) ? -1 : 1; /* it goes east around the south pole, or west around the north */
}
