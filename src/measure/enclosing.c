/* enclosing.c: smallest enclosing balls, by exchange of support points.
 *
 *        o-----.         the ball of at most dim + 1 points of support; the point furthest outside is added, and the
 *      .   .    o        next ball is the smallest that is held by it and some of the others, and holds them all. It
 *     o  ball    .  o    grows each time, so this ends (an LP-type problem: Matousek, Sharir and Welzl 1996).
 *
 * Squares of lengths, and products of those, leave the range of doubles long before coordinates do: all differences are
 * multiplied by a power of 2 that makes the object about as large as 1, and only radii are scaled back. */
#include "measure/enclosing.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { SUPPORT = FROE_MAX_DIM + 1, ROUNDS = 1000 };
#define SLACK (1 + 0x1p-40)

typedef struct support_points {
    const double *point[SUPPORT + 1];
    int count;
} support_points;

double measure_scale(const froe_scene *scene, uint32_t object) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], most = 0;
    int exponent;
    scene_object_bounds(scene, object, lo, hi);
    for (int k = 0; k < scene->dim; k++) most = fmax(most, hi[k] - lo[k]);
    most = fmin(most, DBL_MAX);
    if (most == 0) return 1;
    frexp(most, &exponent);
    return ldexp(1, exponent < -1020 ? 1020 : exponent > 1020 ? -1020 : -exponent);
}

static double square_distance(int dim, const double *a, const double *b, double scale) {
    double sum = 0;
    for (int k = 0; k < dim; k++) {
        const double x = a[k] * scale - b[k] * scale;
        sum += x * x;
    }
    return sum;
}

/* The ball with all these points on its surface and its centre among them: centre = p0 + sum t_i v_i, v_i = p_i - p0,
 * where 2 v_j . sum t_i v_i = |v_j|^2. */
static bool circumscribe(int dim, const support_points *s, double scale, measure_ball *out) {
    double v[SUPPORT][FROE_MAX_DIM], a[SUPPORT][SUPPORT + 1] = {{0}};
    int m = s->count - 1;
    for (int i = 0; i < m; i++)
        for (int k = 0; k < dim; k++) v[i][k] = s->point[i + 1][k] * scale - s->point[0][k] * scale;
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++)
            for (int k = 0; k < dim; k++) a[i][j] += 2 * v[i][k] * v[j][k];
        a[i][m] = a[i][i] / 2;
    }
    for (int i = 0; i < m; i++) { /* solves a t = b by elimination with pivots; a zero pivot: (nearly) singular */
        int pivot = i;
        for (int j = i + 1; j < m; j++)
            if (fabs(a[j][i]) > fabs(a[pivot][i])) pivot = j;
        if (!(fabs(a[pivot][i]) > 0)) return false;
        for (int k = 0; k <= m; k++) {
            double swap = a[i][k];
            a[i][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        for (int j = 0; j < m; j++) {
            double factor = j == i ? 0 : a[j][i] / a[i][i];
            for (int k = i; k <= m; k++) a[j][k] -= factor * a[i][k];
        }
    }
    for (int i = 0; i < m; i++) a[i][m] /= a[i][i];
    for (int k = 0; k < dim; k++) {
        out->centre[k] = s->point[0][k];
        for (int i = 0; i < m; i++) out->centre[k] += a[i][m] * v[i][k] / scale;
    }
    out->radius = sqrt(square_distance(dim, out->centre, s->point[0], scale));
    return isfinite(out->radius);
}

/* Of the balls held by the last point and some of the others, the smallest that holds all. */
static bool exchange(int dim, support_points *s, double scale, measure_ball *ball) {
    support_points best = {.count = 0};
    measure_ball least = {.radius = INFINITY};
    int others = s->count - 1;
    for (unsigned set = 0; set < 1u << others; set++) {
        support_points some = {{s->point[others]}, 1};
        for (int i = 0; i < others; i++)
            if (set >> i & 1) some.point[some.count++] = s->point[i];
        measure_ball b;
        if (some.count > dim + 1 || !circumscribe(dim, &some, scale, &b)) continue;
        bool holds = b.radius < least.radius;
        for (int i = 0; i < s->count; i++)
            holds = holds && sqrt(square_distance(dim, b.centre, s->point[i], scale)) <= b.radius * SLACK;
        if (holds) least = b, best = some;
    }
    if (!best.count || least.radius <= ball->radius) return false; /* no growth: doubles allow no better ball */
    *s = best;
    *ball = least;
    return true;
}

measure_ball measure_enclosing(const froe_scene *scene, uint32_t object) {
    const double scale = measure_scale(scene, object);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    measure_ball ball = {.radius = 0}; /* the radius times scale, until the end */
    support_points s = {.count = 0};
    switch (scene_form(scene, object)) {
    case FROE_BOX:
    case FROE_POINT:
        scene_object_bounds(scene, object, lo, hi);
        for (int k = 0; k < scene->dim; k++) ball.centre[k] = lo[k] + (0.5 * hi[k] - 0.5 * lo[k]);
        ball.radius = 0.5 * sqrt(square_distance(scene->dim, lo, hi, scale));
        break;
    case FROE_BALL:
        memcpy(ball.centre, scene_point(scene, object, 0), (size_t)scene->dim * sizeof(double));
        ball.radius = scene_radius(scene, object);
        return ball;
    default:
        s.point[s.count++] = scene_point(scene, object, 0);
        memcpy(ball.centre, s.point[0], (size_t)scene->dim * sizeof(double));
    }
    for (int round = 0; round < ROUNDS && s.count; round++) {
        double most = 0;
        for (uint32_t i = 0; i < scene_corners(scene, object); i++) {
            const double *p = scene_point(scene, object, i);
            double far = square_distance(scene->dim, ball.centre, p, scale);
            if (far > most) most = far, s.point[s.count] = p;
        }
        if (sqrt(most) <= ball.radius * SLACK) break;
        s.count++;
        if (exchange(scene->dim, &s, scale, &ball)) continue;
        ball.radius = sqrt(most);
        break;
    }
    ball.radius /= scale;
    return ball;
}

double measure_diameter(const froe_scene *scene, uint32_t object) {
    if (scene_form(scene, object) == FROE_BALL) return 2 * scene_radius(scene, object);
    const double scale = measure_scale(scene, object);
    double most = 0;
    for (uint32_t i = 1; i < scene_corners(scene, object); i++)
        for (uint32_t j = 0; j < i; j++) {
            double far =
                square_distance(scene->dim, scene_point(scene, object, i), scene_point(scene, object, j), scale);
            if (far > most) most = far;
        }
    return sqrt(most) / scale;
}
