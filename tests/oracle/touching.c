/* touching.c: see touching.h. */
#include "oracle/touching.h"
#include <math.h>

/* --------------------------------------------------------------------- places -- */

int oracle_compare_time(const mpq_t time, double x) {
    mpq_t other;
    mpq_init(other);
    mpq_set_d(other, x);
    const int order = mpq_cmp(time, other);
    mpq_clear(other);
    return order;
}

/* to = from + s (to - from) */
static void go_between(const mpq_t from, mpq_t to, const mpq_t s) {
    mpq_sub(to, to, from);
    mpq_mul(to, to, s);
    mpq_add(to, to, from);
}

/* The share of the time between two knots that has passed. */
static void share_between(mpq_t out, double from, double to, const mpq_t time) {
    mpq_t length;
    mpq_init(length);
    mpq_set_d(out, from);
    mpq_set_d(length, to);
    mpq_sub(length, length, out);
    mpq_sub(out, time, out);
    mpq_div(out, out, length);
    mpq_clear(length);
}

/* De Casteljau. */
static void on_piece(const froe_moving_knot *p, const froe_moving_knot *q, const mpq_t s, mpq_t out[3]) {
    const int degree = isnan(p->control[0]) ? 1 : isnan(p->second[0]) ? 2 : 3;
    mpq_t c[4], next;
    mpq_inits(c[0], c[1], c[2], c[3], next, NULL);
    for (int k = 0; k < 3; k++) {
        mpq_set_d(c[0], p->at[k]);
        if (degree > 1) mpq_set_d(c[1], p->control[k]);
        if (degree > 2) mpq_set_d(c[2], p->second[k]);
        mpq_set_d(c[degree], q->at[k]);
        for (int n = degree; n > 0; n--)
            for (int i = 0; i < n; i++) {
                mpq_set(next, c[i + 1]);
                go_between(c[i], next, s);
                mpq_set(c[i], next);
            }
        mpq_set(out[k], c[0]);
    }
    mpq_clears(c[0], c[1], c[2], c[3], next, NULL);
}

/* v + 2 r x (r x v + w v) / |q|^2, with q = (r, w). */
static void turn(mpq_t q[4], mpq_t v[3]) {
    mpq_t cross[3], square, product;
    mpq_inits(cross[0], cross[1], cross[2], square, product, NULL);
    for (int k = 0; k < 3; k++) {
        mpq_mul(cross[k], q[(k + 1) % 3], v[(k + 2) % 3]);
        mpq_mul(product, q[(k + 2) % 3], v[(k + 1) % 3]);
        mpq_sub(cross[k], cross[k], product);
        mpq_mul(product, q[3], v[k]);
        mpq_add(cross[k], cross[k], product);
    }
    for (int k = 0; k < 4; k++) {
        mpq_mul(product, q[k], q[k]);
        mpq_add(square, square, product);
    }
    mpq_div_2exp(square, square, 1);
    mpq_t once;
    mpq_init(once);
    for (int k = 0; k < 3; k++) {
        mpq_mul(once, q[(k + 1) % 3], cross[(k + 2) % 3]);
        mpq_mul(product, q[(k + 2) % 3], cross[(k + 1) % 3]);
        mpq_sub(once, once, product);
        mpq_div(once, once, square);
        mpq_add(v[k], v[k], once);
    }
    mpq_clears(cross[0], cross[1], cross[2], square, product, once, NULL);
}

/* Where a place in a body is. */
static void in_body(const froe_motion *m, uint32_t body, const mpq_t time, mpq_t v[3]) {
    const size_t count = froe_motion_body_knot_count(m, body);
    size_t i = 0;
    while (i + 2 < count && oracle_compare_time(time, froe_motion_body_knot(m, body, i + 1).time) > 0) i++;
    const froe_body_knot a = froe_motion_body_knot(m, body, i), b = froe_motion_body_knot(m, body, i + (count > 1));
    froe_moving_knot p = {.time = a.time, .second = {NAN}}, q = {.time = b.time};
    mpq_t share, from, to[4], centre[3];
    mpq_inits(share, from, to[0], to[1], to[2], to[3], centre[0], centre[1], centre[2], NULL);
    for (int k = 0; k < 3; k++) p.at[k] = a.at[k], q.at[k] = b.at[k], p.control[k] = a.control[k];
    if (count > 1) share_between(share, a.time, b.time, time);
    on_piece(&p, &q, share, centre);
    for (int k = 0; k < 4; k++) {
        mpq_set_d(from, a.turn[k]);
        mpq_set_d(to[k], b.turn[k]);
        go_between(from, to[k], share);
    }
    turn(to, v);
    for (int k = 0; k < 3; k++) mpq_add(v[k], v[k], centre[k]);
    mpq_clears(share, from, to[0], to[1], to[2], to[3], centre[0], centre[1], centre[2], NULL);
}

void oracle_corner(const froe_motion *m, uint32_t vertex, const mpq_t time, mpq_t out[3]) {
    const size_t count = froe_motion_knot_count(m, vertex);
    size_t i = 0;
    while (i + 2 < count && oracle_compare_time(time, froe_motion_knot(m, vertex, i + 1).time) > 0) i++;
    const froe_moving_knot p = froe_motion_knot(m, vertex, i);
    for (int k = 0; k < 3; k++) mpq_set_d(out[k], p.at[k]);
    const uint32_t body = froe_motion_vertex_body(m, vertex);
    if (body != FROE_NONE) in_body(m, body, time, out);
    if (count == 1) return;
    const froe_moving_knot q = froe_motion_knot(m, vertex, i + 1);
    mpq_t share;
    mpq_init(share);
    share_between(share, p.time, q.time, time);
    on_piece(&p, &q, share, out);
    mpq_clear(share);
}

/* ------------------------------------------------------------- linear programs -- */

enum { ROWS = 8, COLUMNS = 12, WIDTH = COLUMNS + ROWS + 1 /* artificial variables, and the right side */ };

/* Rows 0 .. ROWS-1: equations with right sides >= 0, and each an artificial variable; the last: minus their sum, which
 * is to become 0. */
typedef struct program {
    mpq_t cell[ROWS + 1][WIDTH];
    int basis[ROWS];
} program;

static void add_multiple(mpq_t *row, const mpq_t *other, const mpq_t factor) {
    mpq_t product;
    mpq_init(product);
    for (int j = 0; j < WIDTH; j++) {
        if (!mpq_sgn(other[j])) continue;
        mpq_mul(product, other[j], factor);
        mpq_sub(row[j], row[j], product);
    }
    mpq_clear(product);
}

/* The row that leaves for a column; of equal quotients, that of the least variable (Bland). -1: none. */
static int leaving(const program *p, int column) {
    int best = -1;
    mpq_t least, quotient;
    mpq_inits(least, quotient, NULL);
    for (int i = 0; i < ROWS; i++) {
        if (mpq_sgn(p->cell[i][column]) <= 0) continue;
        mpq_div(quotient, p->cell[i][WIDTH - 1], p->cell[i][column]);
        const int order = best < 0 ? -1 : mpq_cmp(quotient, least);
        if (order < 0 || (!order && p->basis[i] < p->basis[best])) best = i, mpq_set(least, quotient);
    }
    mpq_clears(least, quotient, NULL);
    return best;
}

static void pivot(program *p, int row, int column) {
    mpq_t factor;
    mpq_init(factor);
    mpq_set(factor, p->cell[row][column]);
    for (int j = 0; j < WIDTH; j++) mpq_div(p->cell[row][j], p->cell[row][j], factor);
    for (int i = 0; i <= ROWS; i++) {
        mpq_set(factor, p->cell[i][column]);
        if (i != row && mpq_sgn(factor)) add_multiple(p->cell[i], p->cell[row], factor);
    }
    p->basis[row] = column;
    mpq_clear(factor);
}

/* Has it a solution? */
static bool solve(program *p) {
    for (int i = 0; i < ROWS; i++) {
        if (mpq_sgn(p->cell[i][WIDTH - 1]) < 0)
            for (int j = 0; j < WIDTH; j++) mpq_neg(p->cell[i][j], p->cell[i][j]);
        for (int j = 0; j < WIDTH; j++) mpq_sub(p->cell[ROWS][j], p->cell[ROWS][j], p->cell[i][j]);
        p->basis[i] = COLUMNS + i;
        mpq_set_ui(p->cell[i][COLUMNS + i], 1, 1);
    }
    for (;;) {
        int column = 0;
        while (column < COLUMNS && mpq_sgn(p->cell[ROWS][column]) >= 0) column++;
        if (column == COLUMNS) return mpq_sgn(p->cell[ROWS][WIDTH - 1]) == 0;
        const int row = leaving(p, column);
        if (row < 0) return false; /* unbounded: not of a sum that is at least 0 */
        pivot(p, row, column);
    }
}

/* ------------------------------------------------------------------ triangles -- */

static bool boxes_meet(mpq_t v[6][3], const mpq_t slack) {
    mpq_t low, high;
    bool meet = true;
    mpq_inits(low, high, NULL);
    for (int k = 0; k < 3 && meet; k++)
        for (int t = 0; t < 2 && meet; t++) { /* is all of triangle t below all of the other? */
            mpq_set(high, v[3 * t][k]);
            mpq_set(low, v[3 * !t][k]);
            for (int i = 1; i < 3; i++) {
                if (mpq_cmp(v[3 * t + i][k], high) > 0) mpq_set(high, v[3 * t + i][k]);
                if (mpq_cmp(v[3 * !t + i][k], low) < 0) mpq_set(low, v[3 * !t + i][k]);
            }
            mpq_add(high, high, slack);
            meet = mpq_cmp(high, low) >= 0;
        }
    mpq_clears(low, high, NULL);
    return meet;
}

/* Means  sum x_i a_i  and  sum x_(3+j) b_j,  x >= 0, sums 1; in each coordinate  a - b + x_(6+k) = slack,
 * x_(6+k) + x_(9+k) = 2 slack. */
static bool means_meet(mpq_t v[6][3], const mpq_t slack) {
    program p;
    for (int i = 0; i <= ROWS; i++)
        for (int j = 0; j < WIDTH; j++) mpq_init(p.cell[i][j]);
    for (int t = 0; t < 2; t++) {
        for (int i = 0; i < 3; i++) {
            mpq_set_ui(p.cell[6 + t][3 * t + i], 1, 1);
            for (int k = 0; k < 3; k++)
                if (t)
                    mpq_neg(p.cell[k][3 + i], v[3 + i][k]);
                else
                    mpq_set(p.cell[k][i], v[i][k]);
        }
        mpq_set_ui(p.cell[6 + t][WIDTH - 1], 1, 1);
    }
    for (int k = 0; k < 3; k++) {
        mpq_set_ui(p.cell[k][6 + k], 1, 1);
        mpq_set(p.cell[k][WIDTH - 1], slack);
        mpq_set_ui(p.cell[3 + k][6 + k], 1, 1);
        mpq_set_ui(p.cell[3 + k][9 + k], 1, 1);
        mpq_add(p.cell[3 + k][WIDTH - 1], slack, slack);
    }
    const bool meet = solve(&p);
    for (int i = 0; i <= ROWS; i++)
        for (int j = 0; j < WIDTH; j++) mpq_clear(p.cell[i][j]);
    return meet;
}

bool oracle_triangles_meet(const froe_motion *m, uint32_t a, uint32_t b, const mpq_t time, const mpq_t slack) {
    mpq_t v[6][3];
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) mpq_init(v[i][k]);
        oracle_corner(m, froe_motion_object(m, i < 3 ? a : b).vertices[i % 3], time, v[i]);
    }
    const bool meet = boxes_meet(v, slack) && means_meet(v, slack);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) mpq_clear(v[i][k]);
    return meet;
}

/* ------------------------------------------------------------------ neighbours -- */

enum { EQUATIONS = 5, UNKNOWNS = 6 };

typedef struct system {
    mpq_t cell[EQUATIONS][UNKNOWNS + 1], at[3], t[3];
    int rows, pivot[EQUATIONS]; /* the column of each row */
} system;

static void each_number(system *s, void (*what)(mpq_t)) {
    for (int i = 0; i < EQUATIONS; i++)
        for (int j = 0; j <= UNKNOWNS; j++) what(s->cell[i][j]);
    for (int k = 0; k < 3; k++) what(s->at[k]), what(s->t[k]);
}

/* sum x_i a_i = sum x_(3+j) b_j, and both sums of x are 1; x is 0 but for the columns of a set. */
static void set_up(system *s, mpq_t v[6][3], unsigned set) {
    for (int i = 0; i < EQUATIONS; i++)
        for (int j = 0; j <= UNKNOWNS; j++) mpq_set_si(s->cell[i][j], i >= 3 && (j == UNKNOWNS || j / 3 == i - 3), 1);
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < UNKNOWNS; j++) {
            mpq_set(s->cell[k][j], v[j][k]);
            if (j >= 3) mpq_neg(s->cell[k][j], s->cell[k][j]);
        }
    for (int i = 0; i < EQUATIONS; i++)
        for (int j = 0; j < UNKNOWNS; j++)
            if (!(set >> j & 1)) mpq_set_ui(s->cell[i][j], 0, 1);
}

static void swap_rows(system *s, int i, int k) {
    for (int j = 0; j <= UNKNOWNS && i != k; j++) mpq_swap(s->cell[i][j], s->cell[k][j]);
}

/* Gauss and Jordan. False: the columns of the set depend on one another. */
static bool reduce(system *s, unsigned set) {
    s->rows = 0;
    for (int column = 0; column < UNKNOWNS; column++) {
        if (!(set >> column & 1)) continue;
        int row = s->rows;
        while (row < EQUATIONS && !mpq_sgn(s->cell[row][column])) row++;
        if (row == EQUATIONS) return false;
        swap_rows(s, row, s->rows);
        mpq_t *pivot = s->cell[s->rows];
        mpq_set(s->t[0], pivot[column]);
        for (int j = 0; j <= UNKNOWNS; j++) mpq_div(pivot[j], pivot[j], s->t[0]);
        for (int i = 0; i < EQUATIONS; i++) {
            if (i == s->rows || !mpq_sgn(s->cell[i][column])) continue;
            mpq_set(s->t[0], s->cell[i][column]);
            for (int j = 0; j <= UNKNOWNS; j++) {
                mpq_mul(s->t[1], s->t[0], pivot[j]);
                mpq_sub(s->cell[i][j], s->cell[i][j], s->t[1]);
            }
        }
        s->pivot[s->rows++] = column;
    }
    return true;
}

/* The basic solution of a set of columns, as a point of the first triangle. False: there is none. */
static bool basic_point(system *s, mpq_t v[6][3], unsigned set) {
    set_up(s, v, set);
    if (!reduce(s, set)) return false;
    for (int i = s->rows; i < EQUATIONS; i++)
        if (mpq_sgn(s->cell[i][UNKNOWNS])) return false;
    for (int k = 0; k < 3; k++) mpq_set_ui(s->at[k], 0, 1);
    for (int i = 0; i < s->rows; i++) {
        if (mpq_sgn(s->cell[i][UNKNOWNS]) < 0) return false;
        for (int k = 0; k < 3 && s->pivot[i] < 3; k++) {
            mpq_mul(s->t[0], s->cell[i][UNKNOWNS], v[s->pivot[i]][k]);
            mpq_add(s->at[k], s->at[k], s->t[0]);
        }
    }
    return true;
}

/* Is the point at p, or between p and q? */
static bool is_between(system *s, mpq_t p[3], mpq_t q[3]) {
    int axis = 0;
    while (axis < 3 && mpq_equal(p[axis], q[axis])) axis++;
    mpq_set_ui(s->t[0], 0, 1);
    if (axis < 3) {
        mpq_sub(s->t[0], s->at[axis], p[axis]);
        mpq_sub(s->t[1], q[axis], p[axis]);
        mpq_div(s->t[0], s->t[0], s->t[1]);
    }
    if (mpq_sgn(s->t[0]) < 0 || mpq_cmp_ui(s->t[0], 1, 1) > 0) return false;
    for (int k = 0; k < 3; k++) {
        mpq_set(s->t[1], q[k]);
        go_between(p[k], s->t[1], s->t[0]);
        if (!mpq_equal(s->t[1], s->at[k])) return false;
    }
    return true;
}

bool oracle_neighbours_meet(const froe_motion *m, uint32_t a, uint32_t b, const mpq_t time) {
    mpq_t v[6][3];
    system s;
    uint32_t name[6];
    int shared[3], count = 0;
    bool meet = false;
    each_number(&s, mpq_init);
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) mpq_init(v[i][k]);
        name[i] = froe_motion_object(m, i < 3 ? a : b).vertices[i % 3];
        oracle_corner(m, name[i], time, v[i]);
    }
    for (int i = 0; i < 9; i++)
        if (name[i / 3] == name[3 + i % 3]) shared[count++] = i / 3;
    for (unsigned set = 0; set < 1u << UNKNOWNS && count < 3 && !meet; set++)
        meet = basic_point(&s, v, set) && !is_between(&s, v[shared[0]], v[shared[count - 1]]);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++) mpq_clear(v[i][k]);
    each_number(&s, mpq_clear);
    return meet;
}
