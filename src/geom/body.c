/* body.c: the dimension of a body. */
#include "geom/body.h"
#include "geom/high/high.h"
#include "geom/predicates.h"
#include "geom/turn.h"

/* Does x raise the rank beyond that of the rank + 1 corners in span? */
static bool raises(num_context *context, const geom_body *b, int rank, const double *const span[3], const double *x) {
    if (rank == 0) return !geom_same_point(span[0], x, b->dim);
    if (rank == 1 && b->dim == 3) return geom_projection_axis(context, span[0], span[1], x) >= 0;
    if (rank == 1) return geom_turn(context, span[0], span[1], x) != 0;
    geom_plane plane = geom_plane_points(3, span);
    return geom_side_vertex(context, &plane, x) != 0;
}

int geom_body_rank(num_context *context, const geom_body *b) {
    const double *span[4] = {geom_body_point(b, 0)}, *hi;
    int rank = 0;
    switch (b->form) {
    case FROE_POINT:
        return 0;
    case FROE_SEGMENT:
        return 1;
    case FROE_POLYGON:
        return 2;
    case FROE_BOX:
        hi = geom_body_point(b, 1);
        for (int k = 0; k < b->dim; k++) rank += span[0][k] < hi[k];
        return rank;
    case FROE_BALL:
        return b->dim;
    default:
        if (b->dim > 3) return geom_high_rank(context, b);
        for (uint32_t i = 1; i < b->count && rank < b->dim; i++) {
            const double *x = geom_body_point(b, i);
            if (raises(context, b, rank, span, x)) span[++rank] = x;
        }
        return rank;
    }
}
