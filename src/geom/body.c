/* body.c: the dimension of a body. */
#include "geom/body.h"
#include "geom/predicates.h"
#include "geom/turn.h"

static int box_rank(const geom_body *b) {
    const double *lo = geom_body_point(b, 0), *hi = geom_body_point(b, 1);
    int rank = 0;
    for (int k = 0; k < b->dim; k++) rank += lo[k] < hi[k];
    return rank;
}

static bool equal(const double *p, const double *q, int dim) {
    for (int k = 0; k < dim; k++)
        if (p[k] != q[k]) return false;
    return true;
}

/* Are three points on one line? */
static bool collinear(num_context *context, int dim, const double *p, const double *q, const double *r) {
    if (dim == 3) return geom_projection_axis(context, p, q, r) < 0;
    geom_plane line = geom_plane_points(2, (const double *const[]){p, q});
    return geom_side_vertex(context, &line, r) == 0;
}

/* The first corner from `from` on that raises the rank beyond that of the `rank + 1` corners in span. */
static bool raises(num_context *context, const geom_body *b, int rank, const double *const span[3], const double *x) {
    if (rank == 0) return !equal(span[0], x, b->dim);
    if (rank == 1) return !collinear(context, b->dim, span[0], span[1], x);
    geom_plane plane = geom_plane_points(3, span);
    return geom_side_vertex(context, &plane, x) != 0;
}

static int hull_rank(num_context *context, const geom_body *b) {
    const double *span[4] = {geom_body_point(b, 0)};
    int rank = 0;
    for (uint32_t i = 1; i < b->count && rank < b->dim; i++) {
        const double *x = geom_body_point(b, i);
        if (raises(context, b, rank, span, x)) span[++rank] = x;
    }
    return rank;
}

int geom_body_rank(num_context *context, const geom_body *b) {
    switch (b->form) {
    case FROE_POINT:
        return 0;
    case FROE_SEGMENT:
        return 1;
    case FROE_POLYGON:
        return 2;
    case FROE_BOX:
        return box_rank(b);
    case FROE_BALL:
        return b->dim;
    default:
        return hull_rank(context, b);
    }
}
