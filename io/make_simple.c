/* make_simple.c: points, boxes and balls in any dimension. Boxes and balls are as
 * wide as their even distances, so that the density does not depend on n. */
#include "maker.h"
#include <math.h>

/* About n^(-1/dim), for dim 2 and 3. */
static double spacing(const io_maker *m) {
    return m->sink.dim == 2 ? 1 / sqrt((double)m->n) : 1 / io_cube_root((double)m->n);
}

void io_make_points(io_maker *m) {
    double p[FROE_MAX_DIM];
    while (!io_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) p[k] = io_unit(m);
        m->status = io_sink_point(&m->sink, p);
    }
}

void io_make_boxes(io_maker *m) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], side = 0.5 * spacing(m);
    while (!io_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) {
            lo[k] = io_unit(m);
            hi[k] = lo[k] + side * io_between(m, 0.3, 1);
        }
        m->status = io_sink_box(&m->sink, lo, hi);
    }
}

void io_make_balls(io_maker *m) {
    double centre[FROE_MAX_DIM], radius = 0.25 * spacing(m);
    while (!io_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) centre[k] = io_unit(m);
        m->status = io_sink_ball(&m->sink, centre, radius * io_between(m, 0.3, 1));
    }
}
