/* selftest.c: hard cases of the formulas that decide: answers by filters and balls must be right, or "unsure".
 *
 * The selftest of src/num tests single operations. A compiler may compile those right and a formula wrong: clang 14
 * once took error terms apart while it vectorised predicates.c, and error bounds came out too small. Here the functions
 * themselves are tested, as they are compiled in place, on points for which every bit of a computation matters.
 *
 * Coordinates are tenths: n times 0.1, rounded. The points lie on common lines and planes but for that rounding. Each
 * case was found by a search among 20,000 such of its formula: with all error bounds taken for 0, the filter and the
 * images that go with it, and then the running errors as well, give one and the same wrong answer. The right
 * answers are those of dyadic numbers, which other tests compare with exact rationals (GMP). */
#include "geom/selftest.h"
#include "geom/eye.h"
#include "geom/predicates.h"
#include "geom/ray/ray.h"

typedef enum formula {
    VERTEX_2,   /* h0 h1, x */
    VERTEX_3,   /* h0 h1 h2, x */
    CROSSING_2, /* h0 h1, a0 a1, u v */
    CROSSING_3, /* h0 h1 h2, a0 a1 a2, u v */
    CORNER,     /* h, s, a, b: three points each */
    BALL_2,     /* h0 h1, centre, (radius, -): right is "cuts", which has the number of "unsure" */
    BALL_3,     /* h0 h1 h2, centre, (radius, -, -): likewise */
    EYE_AFAR,   /* h0 h1 h2, direction */
    EDGE_POINT, /* eye, u v, x */
    EDGE_AFAR,  /* direction, u v, x, origin */
    CUT_POINT,  /* eye, s0 s1 s2, a0 a1 a2, x */
    MEETING,    /* eye, h0 h1, a0 a1, b0 b1 */
    RAY,        /* origin, direction, three corners: met (1) or not (0) */
    FORMULAS
} formula;

enum { HARD_POINTS = 12 };

typedef struct hard_case {
    formula formula;
    signed char right, tenths[3 * HARD_POINTS];
} hard_case;

static const char *const names[FORMULAS] = {
    "vertex 2D", "vertex 3D",   "crossing 2D",           "crossing 3D", "corner",  "ball 2D",       "ball 3D",
    "eye afar",  "edge, point", "edge, point, parallel", "cut, point",  "meeting", "ray, triangle",
};

static const hard_case cases[] = {
    {VERTEX_2, -1, {-5, 1, 1, 5, -11, -3}},
    {VERTEX_3, 1, {1, -4, -5, 7, -9, -2, 1, -9, 3, -5, -9, 8}},
    {CROSSING_2, -1, {-2, -4, -2, 1, -5, -8, 1, 4, 6, 2, -6, -4}},
    {CROSSING_3, 1, {4, 8, 10, 5, -3, 0, 9, 13, 5, 4, 8, 13, 10, 10, -3, 6, -2, -3, 7, 11, 6, 3, -9, 2}},
    {CORNER, 1, {-7, -2, 10, -6, -2, 1,  -5,  4,  -5, -4, -9, 9, -9,  9, 0, -1, -9, -6,
                 -4, -8, 0,  0,  4,  -4, -16, 12, 12, 1,  -7, 1, -15, 4, 1, -9, 13, 7}},
    {BALL_2, 2, {-2, -2, 2, -5, 9, -4, 5, 0}},
    {BALL_3, 2, {-6, -2, -2, 2, -4, -4, -4, -1, -4, -1, 1, -3, 3}},
    {EYE_AFAR, -1, {-2, 5, -5, -1, 3, 4, -3, 4, -1, -5, 1, -6}},
    {EDGE_POINT, 1, {-4, -8, -4, 8, 3, 5, 5, -1, -7, 1, -3, 3}},
    {EDGE_AFAR, -1, {-3, 8, 5, -1, 10, 9, -1, -6, -3, 2, 10, 10, -10, 5, -6}},
    {CUT_POINT, -1, {1, -6, -2, 8, -2, -5, -2, 6, 3, -3, -1, 14, 10, 8, -4, -3, 0, 6, 4, -3, 6, 1, 8, 10}},
    {MEETING, 1, {3, -2, -4, 11, -10, 3, -12, 13, -13, -2, 4, -1, 9, -9, -2, -6, -6, -13, 13, 1, 10}},
    {RAY, 0, {-7, 10, 11, 7, 0, -7, 3, 11, 1, -6, 8, 10, 3, -1, -2}},
};

static geom_plane plane_of(int dim, const double *p) {
    return geom_plane_points(dim, (const double *const[]){p, p + dim, p + 2 * dim});
}

/* NUM_UNSURE, or the answer if all that is known of it agrees; another number if not. */
static int agreed(int a, int b) {
    /* one way: builds that compute as written; scripts/check-selftest makes others */
    return a == NUM_UNSURE ? b : b == NUM_UNSURE || a == b ? a : 3;
}

/* The images of a crossing or corner are another way to the same answer. */
static int case_crossing(num_context *context, int dim, const double *p) {
    const geom_plane h = plane_of(dim, p), a = plane_of(dim, p + dim * dim);
    const double *u = p + 2 * dim * dim, *v = u + dim;
    double x[3];
    const double error = geom_image_crossing(u, v, &a, x);
    return agreed(geom_side_image(&h, x, error), geom_side_crossing(context, &h, u, v, &a));
}

static int corner(num_context *context, const double *p) {
    const geom_plane h = plane_of(3, p), s = plane_of(3, p + 9), a = plane_of(3, p + 18), b = plane_of(3, p + 27);
    double x[3];
    const double error = geom_image_corner(&s, &a, &b, x);
    return agreed(geom_side_image(&h, x, error), geom_side_corner(context, &h, &s, &a, &b));
}

static int edge(num_context *context, const geom_eye *eye, const double *p) {
    const geom_line line = {.kind = GEOM_SIGHT_EDGE, .u = p, .v = p + 3};
    const filter_vector image = geom_line_image(eye, &line), ray = geom_ray_image(eye, p + 6);
    return agreed(geom_line_image_side(&image, &ray), geom_line_side_point(context, eye, &line, p + 6));
}

static int cut(num_context *context, const double *p) {
    const geom_eye eye = geom_eye_make(false, p, NULL);
    const geom_plane s = plane_of(3, p + 3), a = plane_of(3, p + 12);
    const geom_line line = {.kind = GEOM_SIGHT_CUT, .s = &s, .a = &a};
    const filter_vector image = geom_line_image(&eye, &line), ray = geom_ray_image(&eye, p + 21);
    return agreed(geom_line_image_side(&image, &ray), geom_line_side_point(context, &eye, &line, p + 21));
}

static int case_meeting(num_context *context, const double *p) {
    const geom_eye eye = geom_eye_make(false, p, NULL);
    geom_line lines[3];
    for (int i = 0; i < 3; i++) lines[i] = (geom_line){.kind = GEOM_SIGHT_EDGE, .u = p + 3 + 6 * i, .v = p + 6 + 6 * i};
    return geom_line_side_meeting(context, &eye, lines, lines + 1, lines + 2);
}

static int meets(num_context *context, const double *p) {
    const geom_body triangle = {.form = FROE_POLYGON, .dim = 3, .count = 3, .coords = p + 6};
    const geom_ray ray = {3, {p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
    geom_hit hit;
    return geom_ray_meets(context, &ray, &triangle, &hit);
}

static int answer_case(num_context *context, formula f, const double *p) {
    const int dim = f == VERTEX_2 || f == CROSSING_2 || f == BALL_2 ? 2 : 3;
    geom_plane h = f <= EYE_AFAR ? plane_of(dim, p) : (geom_plane){.dim = 3};
    geom_eye eye;
    switch (f) { /* one way: every formula has a case */
    case VERTEX_2:
    case VERTEX_3:
        return agreed(dim == 3 ? geom_side_of_eye_filter(p, p + 3, p + 6, &(geom_eye){.at = {p[9], p[10], p[11]}})
                               : NUM_UNSURE,
                      geom_side_vertex(context, &h, p + dim * dim));
    case CROSSING_2:
    case CROSSING_3:
        return case_crossing(context, dim, p);
    case CORNER:
        return corner(context, p);
    case BALL_2:
    case BALL_3:
        return geom_side_ball(context, &h, p + dim * dim, fabs(p[dim * dim + dim]));
    case EYE_AFAR:
        eye = geom_eye_make(true, p + 9, NULL);
        return agreed(geom_side_of_eye_filter(p, p + 3, p + 6, &eye), geom_side_of_eye(context, &h, &eye));
    case EDGE_POINT:
        eye = geom_eye_make(false, p, NULL);
        return edge(context, &eye, p + 3);
    case EDGE_AFAR:
        eye = geom_eye_make(true, p, p + 12);
        return edge(context, &eye, p + 3);
    case CUT_POINT:
        return cut(context, p);
    case MEETING:
        return case_meeting(context, p);
    case RAY:
        return meets(context, p);
    case FORMULAS: /* one way: that is their number */
        break;
    }
    return NUM_UNSURE;
}

const char *geom_formula_at_fault(num_context *context) {
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double points[3 * HARD_POINTS];
        for (int k = 0; k < 3 * HARD_POINTS; k++) points[k] = cases[i].tenths[k] * 0.1;
        const int found = answer_case(context, cases[i].formula, points);
        /* one way: builds that compute as written; scripts/check-selftest makes others */
        if (found != NUM_UNSURE && found != cases[i].right) return names[cases[i].formula];
    }
    return NULL;
}

froe_status geom_context_new(const froe_allocator *alloc, num_context *out) {
    num_context context;
    const froe_status status = num_context_new(alloc, &context);
    if (status) return status;
    /* one way: builds that compute as written; scripts/check-selftest makes others */
    if (context.first != NUM_EXACT && geom_formula_at_fault(&context)) context.first = NUM_EXACT;
    context.stats = (froe_predicate_stats){0};
    *out = context;
    return FROE_OK;
}
