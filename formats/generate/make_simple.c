/* make_simple.c: points, boxes, balls, segments and hulls in any dimension. All but points are as
 * wide as their even distances, so that the density does not depend on n. */
#include "formats/generate/maker.h"
#include <math.h>

/* About n^(-1/dim). */
static double spacing(const formats_maker *m) {
    if (m->sink.dim == 2) return 1 / sqrt((double)m->n);
    if (m->sink.dim == 3) return 1 / formats_cube_root((double)m->n);
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        double middle = 0.5 * (low + high), power = (double)m->n;
        for (int k = 0; k < m->sink.dim; ++k) power *= middle;
        *(power < 1 ? &low : &high) = middle;
    }
    return low;
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

void formats_make_needles(formats_maker *m) {
    double from[FROE_MAX_DIM], to[FROE_MAX_DIM], size = 0.5 * spacing(m);
    while (!formats_done(m)) {
        for (int k = 0; k < m->sink.dim; ++k) {
            from[k] = formats_unit(m);
            to[k] = from[k] + size * formats_between(m, -1, 1);
        }
        m->status = formats_sink_segment(&m->sink, from, to);
    }
}

/* Of corners in a cube: `more` at most beyond those of a simplex. */
static void make_hulls(formats_maker *m, uint32_t more) {
    double corners[2 * (FROE_MAX_DIM + 1) * FROE_MAX_DIM], lo[FROE_MAX_DIM], size = 0.5 * spacing(m);
    const size_t dim = (size_t)m->sink.dim;
    while (!formats_done(m)) {
        const size_t count = dim + 1 + (more ? formats_below(m, more + 1) : 0);
        for (size_t k = 0; k < dim; ++k) lo[k] = formats_unit(m);
        for (size_t i = 0; i < count * dim; ++i) corners[i] = lo[i % dim] + size * formats_unit(m);
        m->status = formats_sink_hull(&m->sink, corners, count);
    }
}

void formats_make_simplices(formats_maker *m) {
    make_hulls(m, 0);
}

void formats_make_hulls(formats_maker *m) {
    make_hulls(m, (uint32_t)m->sink.dim);
}
