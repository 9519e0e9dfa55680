/* program.c: see program.h. */
#include "geom/high/program.h"
#include <math.h>
#include <string.h>

enum { PLAIN_STEPS = 200, NO_ROW = -1 };
#define NEAR 0x1p-36 /* in doubles, less than this counts as 0 */

typedef struct program_search {
    num_arena *arena;
    const geom_program *p;
    bool first_phase; /* the weight of unit vectors is the goal */
    uint32_t basis[NUM_TABLE_ROWS];
} program_search;

static bool is_basic(const program_search *s, uint32_t j) {
    for (int i = 0; i < s->p->rows; i++)
        if (s->basis[i] == j) return true;
    return false;
}

static int cost_of(const program_search *s, uint32_t j) {
    return s->first_phase ? j >= GEOM_UNIT : j == s->p->goal ? s->p->sense : 0;
}

/* ------------------------------------------------------------------- exact -- */

/* Unit vectors have the signs of the right side, so that they can have weight. */
static void exact_column(const program_search *s, uint32_t j, num_dyadic *out) {
    if (j < GEOM_UNIT) {
        s->p->column(s->p->user, s->arena, j, out);
        return;
    }
    num_dyadic right[NUM_TABLE_ROWS];
    const uint32_t row = j - GEOM_UNIT;
    s->p->column(s->p->user, s->arena, GEOM_RIGHT_SIDE, right);
    for (int i = 0; i < s->p->rows; i++) out[i] = (num_dyadic){0};
    out[row] = num_dyadic_scaled(s->arena, right[row].sign < 0 ? -1 : 1, 1, 0);
}

/* The basis, and two columns more, eliminated: what stands in the columns, over the scale, are their weights. False:
 * the basis is none. */
static bool exact_weights(program_search *s, uint32_t j, num_table *t) {
    const int m = s->p->rows;
    num_dyadic column[NUM_TABLE_ROWS];
    *t = (num_table){.rows = m, .columns = m + 2};
    s->arena->top = 0;
    for (int c = 0; c < m + 2; c++) {
        exact_column(s, c < m ? s->basis[c] : c == m ? GEOM_RIGHT_SIDE : j, column);
        for (int i = 0; i < m; i++) t->at[i][c] = column[i];
    }
    num_table_solve(s->arena, 0, t, m);
    return t->rank == m;
}

/* The first column that makes the goal better; GEOM_RIGHT_SIDE: none does. */
static uint32_t exact_enter(program_search *s) {
    const int m = s->p->rows;
    num_table t = {.rows = m, .columns = m + 1};
    num_dyadic column[NUM_TABLE_ROWS];
    s->arena->top = 0;
    for (int i = 0; i < m; i++) {
        exact_column(s, s->basis[i], t.at[i]);
        const int cost = cost_of(s, s->basis[i]);
        t.at[i][m] = cost ? num_dyadic_scaled(s->arena, cost, 1, 0) : (num_dyadic){0};
    }
    num_table_solve(s->arena, 0, &t, m);
    const size_t top = s->arena->top;
    for (uint32_t j = 0; j < s->p->columns; j++) {
        s->arena->top = top;
        if (is_basic(s, j)) continue;
        const int cost = cost_of(s, j);
        num_dyadic rest = {0};
        if (cost) rest = t.scale, rest.sign *= cost;
        exact_column(s, j, column);
        for (int i = 0; i < m; i++)
            rest = num_dyadic_sub(s->arena, rest, num_dyadic_mul(s->arena, t.at[i][m], column[i]));
        if (rest.sign * t.scale.sign < 0) return j;
    }
    return GEOM_RIGHT_SIDE;
}

/* The row of the basis that leaves for column j. A unit vector without weight leaves first: it must get none. */
static int exact_leave(program_search *s, uint32_t j) {
    const int m = s->p->rows;
    num_table t;
    int best = NO_ROW;
    exact_weights(s, j, &t);
    for (int i = 0; i < m; i++) {
        const int step = t.at[i][m + 1].sign * t.scale.sign;
        if (!s->first_phase && s->basis[i] >= GEOM_UNIT && step) return i;
        if (step <= 0) continue;
        int order = -1;
        if (best != NO_ROW) { /* of the quotients of weights and steps, by cross products */
            num_dyadic x = num_dyadic_mul(s->arena, t.at[i][m], t.at[best][m + 1]),
                       y = num_dyadic_mul(s->arena, t.at[best][m], t.at[i][m + 1]);
            order = num_dyadic_compare(x, y);
        }
        if (order < 0 || (order == 0 && s->basis[i] < s->basis[best])) best = i;
    }
    return best;
}

/* ------------------------------------------------------------------- plain -- */

static void plain_column(const program_search *s, uint32_t j, double *out) {
    if (j < GEOM_UNIT) {
        s->p->image(s->p->user, j, out);
        return;
    }
    double right[NUM_TABLE_ROWS];
    s->p->image(s->p->user, GEOM_RIGHT_SIDE, right);
    for (int i = 0; i < s->p->rows; i++) out[i] = 0;
    out[j - GEOM_UNIT] = right[j - GEOM_UNIT] < 0 ? -1 : 1;
}

/* NO_ROW - 1: doubles do not tell. */
static int plain_leave(program_search *s, uint32_t j) {
    const int m = s->p->rows;
    double t[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS], column[NUM_TABLE_ROWS], least = INFINITY;
    int best = NO_ROW;
    for (int c = 0; c < m + 2; c++) {
        plain_column(s, c < m ? s->basis[c] : c == m ? GEOM_RIGHT_SIDE : j, column);
        for (int i = 0; i < m; i++) t[i][c] = column[i];
    }
    /* one way: plain_enter() has solved the transposed equations */
    if (!num_plain_solve(m, m + 2, t)) return NO_ROW - 1;
    for (int i = 0; i < m; i++) {
        const double step = t[i][m + 1];
        if (!s->first_phase && s->basis[i] >= GEOM_UNIT && fabs(step) > NEAR) return i;
        if (step <= NEAR) continue;
        const double share = fmax(0, t[i][m]) / step;
        if (share < least - NEAR || (share < least + NEAR && s->basis[i] < s->basis[best]))
            best = i, least = share; /* the first share is less than the infinite one */
    }
    return best;
}

static uint32_t plain_enter(program_search *s) {
    const int m = s->p->rows;
    double t[NUM_TABLE_ROWS][NUM_TABLE_COLUMNS], column[NUM_TABLE_ROWS];
    for (int i = 0; i < m; i++) {
        plain_column(s, s->basis[i], t[i]);
        t[i][m] = cost_of(s, s->basis[i]);
    }
    if (!num_plain_solve(m, m + 1, t)) return GEOM_RIGHT_SIDE;
    for (uint32_t j = 0; j < s->p->columns; j++) {
        if (is_basic(s, j)) continue;
        double rest = cost_of(s, j);
        plain_column(s, j, column);
        for (int i = 0; i < m; i++) rest -= t[i][m] * column[i];
        if (rest < -NEAR) return j;
    }
    return GEOM_RIGHT_SIDE;
}

/* ------------------------------------------------------------------ solving -- */

static void improve(program_search *s, bool plain, int steps) {
    /* one way: rows of so few columns take fewer steps; a limit for doubles that go round */
    for (int i = 0; i != steps; i++) {
        const uint32_t j = plain ? plain_enter(s) : exact_enter(s);
        if (j == GEOM_RIGHT_SIDE) return;
        const int row = plain ? plain_leave(s, j) : exact_leave(s, j);
        if (row < 0) return; /* one way: the programs are bounded; doubles that say otherwise are not trusted */
        s->basis[row] = j;
    }
}

static void begin(program_search *s) {
    for (int i = 0; i < s->p->rows; i++) s->basis[i] = GEOM_UNIT + (uint32_t)i;
}

/* Is the basis one, and no weight negative, nor that of a unit vector positive? */
static bool is_feasible(program_search *s) {
    const int m = s->p->rows;
    num_table t;
    if (!exact_weights(s, GEOM_RIGHT_SIDE, &t)) return false;
    for (int i = 0; i < m; i++) {
        const int sign = t.at[i][m].sign * t.scale.sign;
        if (sign < 0 || (sign && s->basis[i] >= GEOM_UNIT)) return false;
    }
    return true;
}

geom_solution geom_program_solve(num_context *context, const geom_program *program) {
    enum { NEVER = -1 };
    program_search s = {.arena = &context->arena, .p = program};
    geom_solution out = {.feasible = true};
    bool known = false;
    context->stats.calls++;
    context->stats.exact++;
    if (context->first != NUM_EXACT) {
        begin(&s);
        for (int phase = 0; phase < 2; phase++) {
            s.first_phase = !phase;
            improve(&s, true, PLAIN_STEPS);
        }
        known = is_feasible(&s);
    }
    if (!known) {
        begin(&s);
        s.first_phase = true;
        improve(&s, false, NEVER);
        out.feasible = is_feasible(&s);
    }
    s.first_phase = false;
    if (out.feasible && program->goal != GEOM_RIGHT_SIDE) improve(&s, false, NEVER);
    memcpy(out.basis, s.basis, sizeof out.basis);
    num_table t;
    exact_weights(&s, GEOM_RIGHT_SIDE, &t);
    for (int i = 0; i < program->rows; i++)
        if (s.basis[i] == program->goal) out.sign = t.at[i][program->rows].sign * t.scale.sign;
    return out;
}
