/* lines.c: rows of the table for lines of the plane. */
#include "split/finish/table.h"

static void stretch(table_lines *t, int axis, double x) {
    t->lo[axis] = x < t->lo[axis] ? x : t->lo[axis];
    t->hi[axis] = x > t->hi[axis] ? x : t->hi[axis];
}

void table_begin_lines(finish *f) {
    for (int k = 0; k < 2; k++) f->t->lines.lo[k] = INFINITY, f->t->lines.hi[k] = -INFINITY;
}

void table_load_line(finish *f, uint32_t column, const split_fragment *piece) {
    split_table *t = f->t;
    const split_corner *ring = f->set->corners.data + piece->first;
    t->lines.bits[column] = table_bit(column);
    t->lines.error[column] = piece->count ? filter_greater(ring[0].error, ring[1].error) : 0;
    for (uint32_t i = 0; i < 2; i++) {
        const double *x = split_image(f->set, piece, i);
        stretch(&t->lines, 0, t->lines.x[i][column] = x[0]);
        stretch(&t->lines, 1, t->lines.y[i][column] = x[1]);
    }
}

void table_begin_line(finish *f, uint32_t row, uint32_t object) {
    const double *p = scene_point(f->set->scene, object, 0), *q = scene_point(f->set->scene, object, 1);
    f->t->lines.line[row] = filter_line_through(p, q, f->trusted);
}

/** The greater distance of x from the ends of an interval. */
static double farthest(double lo, double hi, double x) {
    return filter_greater(fabs(lo - x), fabs(hi - x));
}

/* With one bound on all errors of values. Two pieces go at a time, or more, where the machine can. */
void table_fill_line(const split_table *t, const filter_line *line, table_row *row) {
    const filter_line h = *line;
    const table_lines *all = &t->lines;
    const double reach = filter_line_reach(&h);
    const double bound =
        filter_line_bound(&h, farthest(all->lo[0], all->hi[0], h.o[0]), farthest(all->lo[1], all->hi[1], h.o[1]));
    table_mask below[2] = {0, 0}, above[2] = {0, 0};
    for (uint32_t i = 0; i < t->columns; i++) {
        double u = filter_line_value(&h, all->x[0][i], all->y[0][i]);
        double v = filter_line_value(&h, all->x[1][i], all->y[1][i]);
        double e = bound + reach * all->error[i];
        table_mask here = all->bits[i];
        below[0] |= u < -e ? here : 0;
        below[1] |= v < -e ? here : 0;
        above[0] |= u > e ? here : 0;
        above[1] |= v > e ? here : 0;
    }
    row->below = below[0] | below[1];
    row->above = above[0] | above[1];
    row->sure = (below[0] | above[0]) & (below[1] | above[1]);
}

void table_place_line(const split_table *t, const filter_line *h, table_row *row, uint32_t column) {
    bool below = false, above = false, sure = true;
    for (int i = 0; i < 2; i++) {
        double x = t->lines.x[i][column], y = t->lines.y[i][column], value = filter_line_value(h, x, y);
        double e =
            filter_line_bound(h, fabs(x - h->o[0]), fabs(y - h->o[1])) + filter_line_reach(h) * t->lines.error[column];
        below |= value < -e;
        above |= value > e;
        sure &= (value < -e) | (value > e);
    }
    table_put(&row->below, table_bit(column), below);
    table_put(&row->above, table_bit(column), above);
    table_put(&row->sure, table_bit(column), sure);
}
