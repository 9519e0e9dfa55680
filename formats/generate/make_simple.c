/* make_simple.c: points, boxes and balls in any dimension. Boxes and balls are as
 * wide as their even distances, so that the density does not depend on n. */
#include "formats/generate/maker.h"
#include <math.h>

/* About n^(-1/dim), for dim 2 and 3. */
static double spacing(const formats_maker *m) {
    return m->sink.dim == 2 ? 1 / sqrt((double)m->n) : 1 / formats_cube_root((double)m->n);
}

void formats_make_points(formats_maker *m) {
    double p[FROE_MAX_DIM];
    while (!formats_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) p[k] = formats_unit(m);
        m->status = formats_sink_point(&m->sink, p);
    }
}

void formats_make_boxes(formats_maker *m) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], side = 0.5 * spacing(m);
    while (!formats_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) {
            lo[k] = formats_unit(m);
            hi[k] = lo[k] + side * formats_between(m, 0.3, 1);
        }
        m->status = formats_sink_box(&m->sink, lo, hi);
    }
}

void formats_make_balls(formats_maker *m) {
    double centre[FROE_MAX_DIM], radius = 0.25 * spacing(m);
    while (!formats_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) centre[k] = formats_unit(m);
        m->status = formats_sink_ball(&m->sink, centre, radius * formats_between(m, 0.3, 1));
    }
}
