/* halfspaces.c: the simple cases first; then linear programs for polytopes, and choices of planes for balls. */
#include "geom/high/halfspaces.h"
#include "geom/high/program.h"
#include "geom/predicates.h"
#include "support/array.h"
#include <math.h>

enum { ROWS = NUM_TABLE_ROWS };

/* A set, and the halfspaces that cut it: some of it is beyond their planes, not all. */
typedef struct halfspace_meet {
    num_context *context;
    const geom_halfspaces *of;
    const geom_convex *set;
    const uint32_t *cut; /* these; NULL: all */
    uint32_t count;
    int axis, sign; /* for bounds: of this axis */
} halfspace_meet;

static const double *halfspace_normal(const halfspace_meet *m, uint32_t i) {
    return m->of->normals + (m->cut ? m->cut[i] : i) * (size_t)m->of->dim;
}

static double halfspace_offset(const halfspace_meet *m, uint32_t i) {
    return m->of->offsets[m->cut ? m->cut[i] : i];
}

static num_dyadic product_of(num_arena *arena, int dim, const double *a, const double *b) {
    num_dyadic sum = {0};
    for (int k = 0; k < dim; k++)
        sum = num_dyadic_add(arena, sum,
                             num_dyadic_mul(arena, num_dyadic_from(arena, a[k]), num_dyadic_from(arena, b[k])));
    return sum;
}

/** n . x - c. */
static num_dyadic value_at(num_arena *arena, const halfspace_meet *m, uint32_t i, const double *x) {
    return num_dyadic_sub(arena, product_of(arena, m->of->dim, halfspace_normal(m, i), x),
                          num_dyadic_from(arena, halfspace_offset(m, i)));
}

static double image_at(const halfspace_meet *m, uint32_t i, const double *x) {
    double sum = -halfspace_offset(m, i);
    for (int k = 0; k < m->of->dim; k++) sum += halfspace_normal(m, i)[k] * x[k];
    return sum;
}

static void place_corner(const geom_convex *set, uint32_t i, double *x) {
    for (int k = 0; k < set->dim; k++) x[k] = geom_convex_coordinate(set, i, k);
}

static bool is_feasible(const halfspace_meet *m, int rows, uint32_t columns,
                        void (*column)(const void *, num_arena *, uint32_t, num_dyadic *),
                        void (*image)(const void *, uint32_t, double *)) {
    const geom_program program = {.rows = rows,
                                  .columns = columns,
                                  .goal = GEOM_RIGHT_SIDE,
                                  .sense = 1,
                                  .user = m,
                                  .column = column,
                                  .image = image};
    return geom_program_solve(m->context, &program).feasible;
}

/* -------------------------------------------------- contradictions about x -- */

/* Column i: n and c of halfspace i; then of the sides of the box, if there is one. The right side: 0 x <= -1. */
static void image_about_x(const void *user, uint32_t i, double *out) {
    const halfspace_meet *m = user;
    const int dim = m->of->dim;
    const uint32_t side = i - m->count, axis = side / 2;
    for (int k = 0; k <= dim; k++) out[k] = 0;
    if (i == GEOM_RIGHT_SIDE) {
        out[dim] = -1;
    } else if (i < m->count) {
        for (int k = 0; k < dim; k++) out[k] = halfspace_normal(m, i)[k];
        out[dim] = halfspace_offset(m, i);
    } else {
        const double at = geom_convex_point(m->set, !(side % 2))[axis];
        out[axis] = side % 2 ? -1 : 1;
        out[dim] = side % 2 ? -at : at;
    }
}

static void column_about_x(const void *user, num_arena *arena, uint32_t i, num_dyadic *out) {
    const halfspace_meet *m = user;
    double x[ROWS];
    image_about_x(user, i, x);
    for (int k = 0; k <= m->of->dim; k++) out[k] = num_dyadic_from(arena, x[k]);
}

static bool box_meets_cuts(const halfspace_meet *m) {
    return !is_feasible(m, m->of->dim + 1, m->count + 2 * (uint32_t)m->of->dim, column_about_x, image_about_x);
}

/* -------------------------------------------- contradictions about weights -- */

/* Column i: values of halfspace i at all corners; then of each corner less than that. The right side: 1 at each. */
static void column_about_weights(const void *user, num_arena *arena, uint32_t i, num_dyadic *out) {
    const halfspace_meet *m = user;
    double x[FROE_MAX_DIM];
    for (uint32_t j = 0; j < m->set->count; j++) {
        place_corner(m->set, j, x);
        out[j] = i < m->count           ? value_at(arena, m, i, x)
                 : i == GEOM_RIGHT_SIDE ? num_dyadic_from(arena, 1)
                                        : num_dyadic_from(arena, i - m->count == j ? -1 : 0);
    }
}

static void image_about_weights(const void *user, uint32_t i, double *out) {
    const halfspace_meet *m = user;
    double x[FROE_MAX_DIM];
    for (uint32_t j = 0; j < m->set->count; j++) {
        place_corner(m->set, j, x);
        out[j] = i < m->count ? image_at(m, i, x) : i == GEOM_RIGHT_SIDE ? 1 : i - m->count == j ? -1 : 0;
    }
}

static bool few_corners_meet_cuts(const halfspace_meet *m) {
    return !is_feasible(m, (int)m->set->count, m->count + m->set->count, column_about_weights, image_about_weights);
}

/* ----------------------------------------------------------------- weights -- */

/* Column j: values at corner j, and 1; then of each halfspace what it lacks. The right side: 0, and 1. */
static void column_of_corner(const void *user, num_arena *arena, uint32_t j, num_dyadic *out) {
    const halfspace_meet *m = user;
    double x[FROE_MAX_DIM] = {0};
    const bool corner = j < m->set->count;
    if (corner) place_corner(m->set, j, x);
    for (uint32_t i = 0; i < m->count; i++)
        out[i] = corner ? value_at(arena, m, i, x)
                        : num_dyadic_from(arena, j != GEOM_RIGHT_SIDE && j - m->set->count == i ? 1 : 0);
    out[m->count] = num_dyadic_from(arena, corner || j == GEOM_RIGHT_SIDE ? 1 : 0);
}

static void image_of_corner(const void *user, uint32_t j, double *out) {
    const halfspace_meet *m = user;
    double x[FROE_MAX_DIM] = {0};
    const bool corner = j < m->set->count;
    if (corner) place_corner(m->set, j, x);
    for (uint32_t i = 0; i < m->count; i++)
        out[i] = corner ? image_at(m, i, x) : j != GEOM_RIGHT_SIDE && j - m->set->count == i ? 1 : 0;
    out[m->count] = corner || j == GEOM_RIGHT_SIDE;
}

static bool corners_meet_few_cuts(const halfspace_meet *m) {
    return is_feasible(m, (int)m->count + 1, m->set->count + m->count, column_of_corner, image_of_corner);
}

/* ----------------------------------------------------------------- choices -- */

/** The next choice of so many numbers below `of`, ascending; false: that was the last. */
static bool choose_next(uint32_t *choice, uint32_t size, uint32_t of) {
    uint32_t at = size;
    while (at > 0 && choice[at - 1] == of - size + at - 1) at--;
    if (!at) return false;
    choice[at - 1]++;
    for (; at < size; at++) choice[at] = choice[at - 1] + 1;
    return true;
}

static bool every_choice_meets(const halfspace_meet *m) {
    const uint32_t size = (uint32_t)m->of->dim + 1;
    uint32_t choice[ROWS], cut[ROWS];
    halfspace_meet some = *m;
    some.cut = cut;
    some.count = size;
    for (uint32_t i = 0; i < size; i++) choice[i] = i;
    do {
        for (uint32_t i = 0; i < size; i++) cut[i] = m->cut[choice[i]];
        if (!corners_meet_few_cuts(&some)) return false;
    } while (choose_next(choice, size, m->count));
    return true;
}

/* ------------------------------------------------------------------- balls -- */

/** Where the chosen planes meet, nearest to the centre: 1 that is the point of the intersection nearest to it, and the
 * ball has it; 0: the ball has not; NUM_UNSURE: it is not that point. */
static int look_at_choice(const halfspace_meet *m, const uint32_t *choice, uint32_t size) {
    num_arena *arena = num_fresh(m->context);
    const double *centre = geom_convex_point(m->set, 0);
    const int dim = m->of->dim, n = (int)size;
    num_table t = {.rows = n, .columns = n + 1};
    num_dyadic square = {0};
    /* the way is - sum of weight_i n_i, which takes n_j . x down to c_j */
    for (int i = 0; i < n; i++) {
        t.at[i][n] = value_at(arena, m, choice[i], centre);
        for (int j = 0; j < n; j++)
            t.at[i][j] = product_of(arena, dim, halfspace_normal(m, choice[i]), halfspace_normal(m, choice[j]));
    }
    num_table_solve(arena, 0, &t, n);
    if (t.rank < n) return NUM_UNSURE;
    for (int i = 0; i < n; i++)
        if (t.at[i][n].sign * t.scale.sign < 0) return NUM_UNSURE;
    const size_t top = arena->top;
    for (uint32_t j = 0; j < m->count; j++) {
        arena->top = top;
        num_dyadic value = num_dyadic_mul(arena, value_at(arena, m, j, centre), t.scale);
        for (int i = 0; i < n; i++)
            value = num_dyadic_sub(
                arena, value,
                num_dyadic_mul(arena, t.at[i][n],
                               product_of(arena, dim, halfspace_normal(m, choice[i]), halfspace_normal(m, j))));
        if (value.sign * t.scale.sign > 0) return NUM_UNSURE;
    }
    arena->top = top;
    for (int i = 0; i < n; i++)
        square =
            num_dyadic_add(arena, square, num_dyadic_mul(arena, t.at[i][n], value_at(arena, m, choice[i], centre)));
    const num_dyadic radius = num_dyadic_from(arena, m->set->radius);
    const num_dyadic most = num_dyadic_mul(arena, num_dyadic_mul(arena, radius, radius), t.scale);
    return num_dyadic_sub(arena, most, square).sign * t.scale.sign >= 0;
}

static bool ball_meets_cuts(const halfspace_meet *m) {
    for (uint32_t size = 1; size <= (uint32_t)m->of->dim && size <= m->count; size++) {
        uint32_t choice[FROE_MAX_DIM];
        for (uint32_t i = 0; i < size; i++) choice[i] = i;
        do {
            const int has = look_at_choice(m, choice, size);
            if (has != NUM_UNSURE) return has;
        } while (choose_next(choice, size, m->count));
    }
    return false; /* there is no point in all of them */
}

/* ------------------------------------------------------------ simple cases -- */

/** Is the ball beyond the plane of halfspace i, without touching it? Its centre is beyond. */
static bool is_ball_beyond(const halfspace_meet *m, uint32_t i) {
    num_arena *arena = num_fresh(m->context);
    const num_dyadic value = value_at(arena, m, i, geom_convex_point(m->set, 0));
    const num_dyadic radius = num_dyadic_from(arena, m->set->radius);
    const num_dyadic square = product_of(arena, m->of->dim, halfspace_normal(m, i), halfspace_normal(m, i));
    const num_dyadic reach = num_dyadic_mul(arena, num_dyadic_mul(arena, radius, radius), square);
    return num_dyadic_compare(num_dyadic_mul(arena, value, value), reach) > 0;
}

/** How many corners, or the centre, are beyond a plane; those are not in all halfspaces. */
static uint32_t count_beyond(const halfspace_meet *m, const geom_plane *plane, uint64_t *in_all) {
    uint32_t beyond = 0;
    for (uint32_t c = 0; c < m->set->count; c++) {
        double x[FROE_MAX_DIM];
        place_corner(m->set, c, x);
        if (geom_side_vertex(m->context, plane, x) <= 0) continue;
        beyond++;
        if (c < 64) *in_all &= ~((uint64_t)1 << c);
    }
    return beyond;
}

bool geom_halfspaces_meet(num_context *context, const froe_allocator *alloc, const geom_halfspaces *of,
                          const geom_convex *set, bool *memory) {
    halfspace_meet m = {.context = context, .of = of, .set = set};
    ARRAY(uint32_t) cut = {0};
    uint64_t in_all = set->count < 64 ? ((uint64_t)1 << set->count) - 1 : UINT64_MAX;
    const bool ball = set->radius > 0;
    bool none = false;
    for (uint32_t i = 0; i < of->count && !none && !*memory; i++) {
        const geom_plane plane = geom_plane_vector(of->dim, halfspace_normal(&m, i), of->offsets[i]);
        if (plane.n_max == 0) { /* holds everything, or nothing */
            none = of->offsets[i] < 0;
            continue;
        }
        const uint32_t beyond = count_beyond(&m, &plane, &in_all);
        none = ball ? beyond && is_ball_beyond(&m, i) : beyond == set->count;
        const bool cuts =
            beyond || (ball && geom_side_ball(context, &plane, geom_convex_point(set, 0), set->radius) != -1);
        if (cuts && !array_push(alloc, &cut, i)) *memory = true;
    }
    m.cut = cut.data;
    m.count = (uint32_t)cut.count;
    bool meets = !none && !*memory;
    if (meets && !in_all)
        meets = ball                         ? ball_meets_cuts(&m)
                : set->core == GEOM_CORE_BOX ? box_meets_cuts(&m)
                : set->count <= ROWS         ? few_corners_meet_cuts(&m)
                : m.count < ROWS             ? corners_meet_few_cuts(&m)
                                             : every_choice_meets(&m);
    array_free(alloc, &cut);
    return meets;
}

/* ------------------------------------------------------------------ bounds -- */

bool geom_halfspaces_any(num_context *context, const geom_halfspaces *of) {
    const halfspace_meet m = {.context = context, .of = of, .count = (uint32_t)of->count};
    return !is_feasible(&m, of->dim + 1, m.count, column_about_x, image_about_x);
}

/* Column i: n of halfspace i. The right side: a direction along an axis. */
static void image_of_direction(const void *user, uint32_t i, double *out) {
    const halfspace_meet *m = user;
    for (int k = 0; k < m->of->dim; k++)
        out[k] = i != GEOM_RIGHT_SIDE ? halfspace_normal(m, i)[k] : k == m->axis ? m->sign : 0;
}

static void column_of_direction(const void *user, num_arena *arena, uint32_t i, num_dyadic *out) {
    const halfspace_meet *m = user;
    double x[ROWS];
    image_of_direction(user, i, x);
    for (int k = 0; k < m->of->dim; k++) out[k] = num_dyadic_from(arena, x[k]);
}

bool geom_halfspaces_bounded(num_context *context, const geom_halfspaces *of) {
    halfspace_meet m = {.context = context, .of = of, .count = (uint32_t)of->count};
    for (m.axis = 0; m.axis < of->dim; m.axis++)
        for (m.sign = -1; m.sign <= 1; m.sign += 2)
            if (!is_feasible(&m, of->dim, m.count, column_of_direction, image_of_direction)) return false;
    return true;
}

/* ------------------------------------------------------------------- inside -- */

enum { PULLS = 1000, ROUNDS = 4 };

/** How far x is from the plane of halfspace i, on its inner side, at least; not normed: times *norm. */
static double slack_of(const geom_halfspaces *h, size_t i, const double *x, double *norm) {
    const double *n = h->normals + i * (size_t)h->dim;
    double value = h->offsets[i], size = fabs(value);
    for (int k = 0; k < h->dim; k++) {
        value -= n[k] * x[k];
        size += fabs(n[k] * x[k]);
    }
    *norm = filter_length_in(h->dim, n);
    return value - 16 * FILTER_U * size - NUM_BALL_TINY;
}

/** The radius of the ball around x that is in all; or, negative, the distance of the furthest, whose number is *at. */
static double radius_at(const geom_halfspaces *h, const double *x, size_t *at) {
    double radius = INFINITY, norm;
    for (size_t i = 0; i < h->count; i++) {
        const double slack = slack_of(h, i, x, &norm);
        if (!(norm > 0)) continue; /* holds everything, or nothing */
        if (!(slack / norm >= radius)) radius = slack / norm, *at = i;
    }
    return radius;
}

/** Pulls x across the plane from which it is furthest, and half as far beyond it, until it is inside (Agmon, "The
 * relaxation method for linear inequalities", 1954). */
static double pull_inside(const geom_halfspaces *h, double *x) {
    size_t at = 0;
    double radius = radius_at(h, x, &at), norm;
    for (int n = 0; n < PULLS && radius <= 0; n++) {
        const double slack = slack_of(h, at, x, &norm);
        const double step = (1.5 * slack - 0x1p-40 * fabs(h->offsets[at])) / norm / norm;
        for (int k = 0; k < h->dim; k++) x[k] += step * h->normals[at * (size_t)h->dim + (size_t)k];
        radius = radius_at(h, x, &at);
    }
    return radius;
}

double geom_halfspaces_ball(const geom_halfspaces *h, double *x) {
    size_t at;
    double radius = pull_inside(h, x);
    /* to the middle of what is left along each axis, where that is better */
    for (int round = 0; round < ROUNDS && radius > 0; round++)
        for (int k = 0; k < h->dim; k++) {
            double ahead = INFINITY, back = INFINITY, norm;
            const double before = x[k];
            for (size_t i = 0; i < h->count; i++) {
                const double n = h->normals[i * (size_t)h->dim + (size_t)k], slack = slack_of(h, i, x, &norm);
                if (n > 0) ahead = fmin(ahead, slack / n);
                if (n < 0) back = fmin(back, slack / -n);
            }
            x[k] += 0.5 * ahead - 0.5 * back;
            const double moved = radius_at(h, x, &at);
            if (moved > radius) /* not where x is infinite: it is no number there */
                radius = moved;
            else
                x[k] = before;
        }
    return radius > 0 && radius < INFINITY ? radius * (1 - 0x1p-40) : 0;
}
