/* scenes.c: the worst scenes that are known for methods, or for methods that lack something. */
#include "claims.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static froe_scene *scene_of(int dim, froe_kind kind, const double *coords, size_t n) {
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.kind = kind, o.count = n, o.coords = coords;
    bench_must(froe_scene_new(dim, NULL, &scene), &diag);
    bench_must(froe_scene_add(scene, &o, &diag), &diag);
    return scene;
}

static froe_scene *taken(int dim, froe_kind kind, double *coords, size_t n) {
    froe_scene *scene = scene_of(dim, kind, coords, n);
    free(coords);
    return scene;
}

static void put(double *out, size_t count, const double *numbers) {
    memcpy(out, numbers, count * sizeof *out);
}
#define PUT(out, ...) put(out, sizeof((double[]){__VA_ARGS__}) / sizeof(double), (double[]){__VA_ARGS__})

/* Objects of groups come in turn, the first of each, the second of each. */

/** Where the cell of a group begins, in a grid of cells 2 wide. */
static void group_at(size_t group, size_t groups, double at[2]) {
    const size_t side = (size_t)ceil(sqrt((double)groups)), row = group / side;
    at[0] = 2 * (double)(group % side), at[1] = 2 * (double)row;
}

/* ----------------------------------------------------------------- triangles -- */

/* Groups of thin triangles along the lines of two saddles z = x y, one just above the other: between each two lines of
 * one kind and each two of the other no plane has room (after Chazelle). The gap shrinks with n; a fixed one lets few
 * planes separate many. */
static froe_scene *saddles_of(size_t n, size_t each, bool apart) {
    const double lines = (double)each / 2, narrow = 1 / (lines * lines), above = apart ? 4 : 0.25 * narrow;
    double *coords = bench_take(9 * n, sizeof *coords);
    for (size_t i = 0; i < n; i++) {
        const size_t line = i % each / 2, group = i / each;
        const double t = ((double)line + 0.5) / lines, shift = 2 * (double)group, width = 0.05 * narrow;
        if (i % 2)
            PUT(coords + 9 * i, shift, t, above, shift + 1, t, t + above, shift + 0.5, t + width, 0.5 * t + above);
        else
            PUT(coords + 9 * i, shift + t, 0, 0, shift + t, 1, t, shift + t + width, 0.5, 0.5 * t);
    }
    return taken(3, FROE_POLYGON, coords, n);
}
static froe_scene *saddles(size_t n, size_t lambda) {
    return saddles_of(n, lambda ? lambda : n, false);
}
static froe_scene *saddles_apart(size_t n, size_t lambda) {
    return saddles_of(n, lambda ? lambda : n, true);
}

/* Groups of a third small walls across x, a third long walls across y, and a third floors. The planes of the walls
 * cross all floors, which lie above them: cut in this order each floor falls into as many pieces as there are pairs of
 * walls. */
static froe_scene *house_of_cards(size_t n, size_t lambda) {
    const size_t each = lambda ? lambda : n, groups = (n + each - 1) / each, third = (each + 2) / 3;
    double *coords = bench_take(9 * n, sizeof *coords);
    for (size_t i = 0; i < n; i++) {
        double o[2];
        const size_t part = i / groups / third, within = i / groups % third;
        const double t = ((double)within + 0.5) / (double)third, e = 0.09 / (double)third;
        group_at(i % groups, groups, o);
        if (part == 0)
            PUT(coords + 9 * i, o[0] + t, o[1], 0, o[0] + t, o[1] + e, 0, o[0] + t, o[1], e);
        else if (part == 1)
            PUT(coords + 9 * i, o[0], o[1] + t, 0.1, o[0] + 1, o[1] + t, 0.1, o[0] + 0.5, o[1] + t, 0.1 + e);
        else
            PUT(coords + 9 * i, o[0] - 0.1, o[1] - 0.1, 1 + t, o[0] + 1.8, o[1] - 0.1, 1 + t, o[0] - 0.1, o[1] + 1.8,
                1 + t);
    }
    return taken(3, FROE_POLYGON, coords, n);
}

/* Small triangles below large ones, which lie one above the other: projected edges do not cross. `turned`: the square
 * root of n large ones are turned against one another, so that the edges of each two of these cross. */
static froe_scene *roofs_of(size_t n, bool turned) {
    double *coords = bench_take(9 * n, sizeof *coords);
    const size_t small = n / 2, side = (size_t)ceil(sqrt((double)small));
    const double step = 0.5 / (double)side, many = sqrt((double)n);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        if (i < small) {
            const size_t row = i / side;
            const double x = step * ((double)(i % side) + 0.1 * bench_unit(&state));
            const double y = step * ((double)row + 0.1 * bench_unit(&state)), z = 0.1 * bench_unit(&state);
            PUT(coords + 9 * i, x, y, z, x + 0.6 * step, y + 0.1 * step, z, x + 0.2 * step, y + 0.7 * step, z + 0.01);
            continue;
        }
        const double t = (double)(i - small + 1) / (double)n, size = 2 + t, z = 1 + t;
        const double turn = turned && (double)(i - small) < many ? bench_unit(&state) : 0;
        /* corners on a circle, by rational points of it */
        for (int k = 0; k < 3; k++) {
            const double third = 1.7320508075688772, p = turn + (k == 0 ? 0 : k == 1 ? third : -third);
            const double w = 1 + p * p;
            PUT(coords + 9 * i + 3 * k, 0.25 + size * (1 - p * p) / w, 0.25 + size * 2 * p / w, z);
        }
    }
    return taken(3, FROE_POLYGON, coords, n);
}
static froe_scene *roofs(size_t n, size_t lambda) {
    (void)lambda;
    return roofs_of(n, false);
}
static froe_scene *turned_roofs(size_t n, size_t lambda) {
    (void)lambda;
    return roofs_of(n, true);
}

/** The columns of a rotation by a quaternion of small numbers. */
static void turned(uint64_t *state, double out[3][3]) {
    double q[4], all = 0;
    for (int k = 0; k < 4; k++) q[k] = bench_unit(state) - 0.5, all += q[k] * q[k];
    const double w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / all;
    PUT(out[0], 1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w));
    PUT(out[1], s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w));
    PUT(out[2], s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y));
}

/* Groups of twenty cubes, one in the other, each group tilted its own way and far from the origin. The planes of each
 * cross all others. `off`: each cube is off the centre of the one around it. */
static froe_scene *nests_of(size_t n, double off) {
    const size_t groups = (n + 239) / 240;
    double *coords = bench_take(9 * n, sizeof *coords);
    uint64_t state = 1;
    for (size_t g = 0; g < groups; g++) {
        double o[3] = {0, 0, 0}, axes[3][3];
        group_at(g, groups, o);
        turned(&state, axes);
        for (size_t i = g; i < n; i += groups) {
            const size_t part = i / groups % 12, axis = part / 4;
            const double h = ldexp(0.5, -(int)(i / groups / 12)), gone = off * (1 - 2 * h);
            for (size_t corner = 0; corner < 3; corner++) {
                const size_t c = part & 1 ? (size_t[]){0, 2, 3}[corner] : corner; /* of 00 10 11 01 */
                double x[3];
                x[axis] = part & 2 ? h : -h;
                x[(axis + 1) % 3] = c == 1 || c == 2 ? h : -h;
                x[(axis + 2) % 3] = c >= 2 ? h : -h;
                for (int k = 0; k < 3; k++) {
                    double at = 1000.0 / 3 + o[k] + gone * (0.45 * axes[0][k] + 0.4 * axes[1][k] - 0.3 * axes[2][k]);
                    for (int a = 0; a < 3; a++) at += x[a] * axes[a][k];
                    coords[9 * i + 3 * corner + (size_t)k] = at;
                }
            }
        }
    }
    return taken(3, FROE_POLYGON, coords, n);
}
static froe_scene *nests(size_t n, size_t lambda) {
    (void)lambda;
    return nests_of(n, 0);
}
static froe_scene *shells_off_centre(size_t n, size_t lambda) {
    (void)lambda;
    return nests_of(n, 1);
}

/* ------------------------------------------------------------------ segments -- */

/* Bundles of long, nearly parallel segments, each bundle in a cell of its own of a grid. */
static froe_scene *bundles(size_t n, size_t lambda) {
    const size_t each = lambda ? lambda : n, groups = (n + each - 1) / each;
    double *xyxy = bench_take(4 * n, sizeof *xyxy);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        double o[2];
        const double gap = 0.8 / (double)each, y = gap * ((double)(i % each) + 0.5);
        group_at(i / each, groups, o);
        PUT(xyxy + 4 * i, o[0] + 0.1 * bench_unit(&state), o[1] + y + 0.4 * gap * (bench_unit(&state) - 0.5),
            o[0] + 0.8 - 0.1 * bench_unit(&state), o[1] + y + 0.4 * gap * (bench_unit(&state) - 0.5));
    }
    return taken(2, FROE_SEGMENT, xyxy, n);
}

/* Groups of short level segments, below one another, and of upright ones beside them: the line of a level one crosses
 * all upright ones. Cut in this order they fall into each^2 / 4 pieces. */
static froe_scene *combs(size_t n, size_t lambda) {
    const size_t each = lambda ? lambda : n, half = each / 2, groups = (n + each - 1) / each;
    double *xyxy = bench_take(4 * n, sizeof *xyxy);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        double o[2];
        const size_t within = i / groups;
        const double t = ((double)(within % half) + 0.5) / (double)half,
                     e = 0.1 * (bench_unit(&state) - 0.5) / (double)half;
        group_at(i % groups, groups, o);
        if (within < half)
            PUT(xyxy + 4 * i, o[0], o[1] + t + e, o[0] + 0.3, o[1] + t + e);
        else
            PUT(xyxy + 4 * i, o[0] + 0.4 + 0.6 * t, o[1] - 0.1, o[0] + 0.4 + 0.6 * t + e, o[1] + 1.1);
    }
    return taken(2, FROE_SEGMENT, xyxy, n);
}

/* Short segments beside one another below long ones above one another: walls upwards from the short ones, if those
 * come first, cross all long ones. `crossing`: besides, the square root of n segments cross as many others. */
static froe_scene *rungs_of(size_t n, bool crossing) {
    const size_t half = n / 2, few = crossing ? (size_t)sqrt((double)n) : 0;
    double *xyxy = bench_take(4 * n, sizeof *xyxy);
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        const double t = ((double)(i % half) + 0.5) / (double)half, e = 0.2 * (bench_unit(&state) - 0.5) / (double)half;
        if (i < half)
            PUT(xyxy + 4 * i, t, e, t + 0.4 / (double)half, 2 * e);
        else if (i >= n - few)
            PUT(xyxy + 4 * i, t, 3, t + e, 5);
        else if (i >= n - 2 * few)
            PUT(xyxy + 4 * i, -1, 3.5 + t, 2, 3.5 + t + e);
        else
            PUT(xyxy + 4 * i, -1 - t, 1 + t, 2 + t, 1 + t + e);
    }
    return taken(2, FROE_SEGMENT, xyxy, n);
}
static froe_scene *rungs(size_t n, size_t lambda) {
    (void)lambda;
    return rungs_of(n, false);
}
static froe_scene *crossed_rungs(size_t n, size_t lambda) {
    (void)lambda;
    return rungs_of(n, true);
}

/* -------------------------------------------------------------------- points -- */

/* Points that crowd around the origin, closer and closer: 2^-1 .. 2^-400 from it. */
static froe_scene *nested_points(size_t n, size_t lambda) {
    double *xy = bench_take(2 * n, sizeof *xy);
    (void)lambda;
    for (size_t i = 0; i < n; i++) {
        const double t = 1 + (double)i / (double)n, away = ldexp(1, -(int)(i % 400));
        PUT(xy + 2 * i, away * t, away * (3 - t));
    }
    return taken(2, FROE_POINT, xy, n);
}

/* The same beyond space, on both sides of 0. */
static froe_scene *nested_points_of(int dim, size_t n) {
    double *coords = bench_take(n * (size_t)dim, sizeof *coords);
    for (size_t i = 0; i < n; i++) {
        const double t = 1 + (double)i / (double)n, away = ldexp(1, -(int)(i % 400));
        for (int k = 0; k < dim; k++) coords[i * (size_t)dim + (size_t)k] = (k % 2 ? -away : away) * (t + 0.1 * k);
    }
    return taken(dim, FROE_POINT, coords, n);
}
static froe_scene *nested_points_4d(size_t n, size_t lambda) {
    (void)lambda;
    return nested_points_of(4, n);
}
static froe_scene *nested_points_8d(size_t n, size_t lambda) {
    (void)lambda;
    return nested_points_of(8, n);
}

/* Points in two narrow columns: cells that are halved in turn become wide and low. */
static froe_scene *columns(size_t n, size_t lambda) {
    double *xy = bench_take(2 * n, sizeof *xy);
    uint64_t state = 1;
    (void)lambda;
    for (size_t i = 0; i < n; i++) PUT(xy + 2 * i, (double)(i % 2) + 1e-9 * bench_unit(&state), bench_unit(&state));
    return taken(2, FROE_POINT, xy, n);
}

/* Tiny segments in two narrow columns, and tiny triangles in two thin walls. */
static froe_scene *twigs(size_t n, size_t lambda) {
    double *xyxy = bench_take(4 * n, sizeof *xyxy);
    uint64_t state = 1;
    (void)lambda;
    for (size_t i = 0; i < n; i++) {
        const double x = (double)(i % 2) + 1e-9 * bench_unit(&state),
                     y = ((double)i + 0.5 * bench_unit(&state)) / (double)n;
        PUT(xyxy + 4 * i, x, y, x + 1e-10 * bench_unit(&state), y + 0.3 / (double)n);
    }
    return taken(2, FROE_SEGMENT, xyxy, n);
}
static froe_scene *petals(size_t n, size_t lambda) {
    double *coords = bench_take(9 * n, sizeof *coords);
    const size_t side = (size_t)ceil(sqrt(0.5 * (double)n));
    const double step = 1 / (double)side;
    uint64_t state = 1;
    (void)lambda;
    for (size_t i = 0; i < n; i++) {
        const size_t layer = i / 2 / side;
        const double x = (double)(i % 2) + 1e-9 * bench_unit(&state), e = 0.3 * step;
        const double y = step * ((double)(i / 2 % side) + 0.5 * bench_unit(&state));
        const double z = step * ((double)layer + 0.5 * bench_unit(&state));
        PUT(coords + 9 * i, x, y, z, x + 1e-10, y + e, z, x, y, z + e);
    }
    return taken(3, FROE_POLYGON, coords, n);
}

/* Zigzags of `lambda` segments, each of one group, in cells of a grid: shapes of many parts. */
static froe_scene *zigzags(size_t n, size_t lambda) {
    const size_t groups = n / lambda;
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    double *coords = bench_take(4 * lambda, sizeof *coords);
    bench_must(froe_scene_new(2, NULL, &scene), &diag);
    for (size_t i = 0; i < groups; i++) {
        const froe_group group = {.name = "zigzag"};
        froe_objects o = froe_objects_defaults();
        double at[2];
        o.kind = FROE_SEGMENT, o.count = lambda, o.coords = coords;
        bench_must(froe_scene_add_group(scene, &group, &o.group), &diag);
        group_at(i, groups, at);
        for (size_t j = 0; j < lambda; j++) {
            const double high = j % 2 ? 0.75 : 0, step = 1 / (double)lambda, x = at[0] + step * (double)j;
            PUT(coords + 4 * j, x, at[1] + high, x + step, at[1] + 0.75 - high);
        }
        bench_must(froe_scene_add(scene, &o, &diag), &diag);
    }
    free(coords);
    return scene;
}

/* --------------------------------------------------------------------- boxes -- */

/* Rectangles 0.3 of a step wide, in three directions through one cube, near one another nowhere: the simple directional
 * density is low, and yet every partition is large (Tobola and Nechvile, lemma 3.1). `cut`: each is one step long. */
static froe_scene *rods_of(size_t n, bool cut) {
    const size_t m = (size_t)floor(sqrt((double)n / 3) + 1e-9);
    const double d = 1 / (double)m, t = 0.3 * d, length = cut ? 0.3 * d : 1;
    double *at = bench_take(18 * m * m, sizeof *at), *coords = at;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++, at += 18) {
            const double a = (double)i * d, b = (double)j * d, c = cut ? (double)((i * 7 + j * 3) % m) * d : 0;
            PUT(at, c, a, b, c + length, a + t, b);
            PUT(at + 6, a + 0.33 * d, c, b + 0.33 * d, a + 0.33 * d, c + length, b + 0.33 * d + t);
            PUT(at + 12, a + 0.66 * d, b + 0.66 * d, c, a + 0.66 * d + t, b + 0.66 * d, c + length);
        }
    return taken(3, FROE_BOX, coords, 3 * m * m);
}
static froe_scene *rods(size_t n, size_t lambda) {
    (void)lambda;
    return rods_of(n, false);
}
static froe_scene *cut_rods(size_t n, size_t lambda) {
    (void)lambda;
    return rods_of(n, true);
}

/* The six faces of cubes, one in the other, as flat boxes. */
static froe_scene *faces(size_t n, size_t lambda) {
    double *coords = bench_take(6 * n, sizeof *coords);
    (void)lambda;
    for (size_t i = 0; i < n; i++) {
        double *lo = coords + 6 * i, *hi = lo + 3;
        const double s = ldexp(1, (int)(i / 6));
        const size_t axis = i % 3;
        for (size_t k = 0; k < 3; k++) lo[k] = -s, hi[k] = s;
        lo[axis] = hi[axis] = i % 6 < 3 ? -s : s;
    }
    return taken(3, FROE_BOX, coords, n);
}

/* The bars of a generated scene, each family of one direction moved away from the others. */
static froe_scene *bars_apart(size_t n, size_t lambda) {
    froe_scene *bars = bench_generate("bars", n, 1);
    const size_t count = froe_scene_object_count(bars);
    double *coords = bench_take(6 * count, sizeof *coords), lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    (void)lambda;
    froe_scene_bounds(bars, lo, hi);
    for (size_t i = 0; i < count; i++) {
        const double *from = froe_scene_vertex(bars, froe_scene_corner(bars, (uint32_t)i, 0));
        const double *to = froe_scene_vertex(bars, froe_scene_corner(bars, (uint32_t)i, 1));
        int along = 0;
        for (int k = 1; k < 3; k++)
            if (to[k] - from[k] > to[along] - from[along]) along = k;
        for (int k = 0; k < 3; k++) {
            const double away = k ? 0 : 2 * along * (hi[0] - lo[0]);
            coords[6 * i + (size_t)k] = from[k] + away, coords[6 * i + 3 + (size_t)k] = to[k] + away;
        }
    }
    froe_scene_free(bars);
    return taken(3, FROE_BOX, coords, count);
}

/* Boxes of n sizes, one in each octave along the diagonal. */
static froe_scene *octaves(size_t n, size_t lambda) {
    double *coords = bench_take(4 * n, sizeof *coords);
    (void)lambda;
    for (size_t i = 0; i < n; i++) {
        const double s = ldexp(1, -(int)i);
        PUT(coords + 4 * i, s, s, 1.4 * s, 1.4 * s);
    }
    return taken(2, FROE_BOX, coords, n);
}

/* ------------------------------------------------- curved, and above dimension 3 -- */

/* Balls on every second place of a chess board: neighbours across a diagonal do not touch, but their boxes do. */
static froe_scene *chess_balls(int dim, size_t n) {
    const size_t side = (size_t)ceil(pow(2 * (double)n, 1.0 / dim));
    double *x = bench_take((size_t)dim * n, sizeof *x), *radii = bench_take(n, sizeof *radii);
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    size_t place[FROE_MAX_DIM] = {0}, count = 0;
    while (count < n && place[dim - 1] < side) {
        size_t sum = 0;
        for (int k = 0; k < dim; k++) sum += place[k];
        if (sum % 2 == 0) {
            for (int k = 0; k < dim; k++) x[count * (size_t)dim + (size_t)k] = (double)place[k];
            radii[count++] = 0.69;
        }
        place[0]++;
        for (int k = 0; k + 1 < dim && place[k] == side; k++) place[k] = 0, place[k + 1]++;
    }
    o.kind = FROE_BALL, o.count = count, o.coords = x, o.radii = radii;
    bench_must(froe_scene_new(dim, NULL, &scene), &diag);
    bench_must(froe_scene_add(scene, &o, &diag), &diag);
    free(x), free(radii);
    return scene;
}
static froe_scene *chess_balls_2d(size_t n, size_t lambda) {
    (void)lambda;
    return chess_balls(2, n);
}
static froe_scene *chess_balls_3d(size_t n, size_t lambda) {
    (void)lambda;
    return chess_balls(3, n);
}
static froe_scene *chess_balls_4d(size_t n, size_t lambda) {
    (void)lambda;
    return chess_balls(4, n);
}
static froe_scene *chess_balls_5d(size_t n, size_t lambda) {
    (void)lambda;
    return chess_balls(5, n);
}

/* ----------------------------------------------------------------------- all -- */

static const struct {
    const char *kind;
    froe_scene *(*make)(size_t n, size_t lambda);
} scenes[] = {{"saddles", saddles},
              {"saddles apart", saddles_apart},
              {"cards", house_of_cards},
              {"roofs", roofs},
              {"turned roofs", turned_roofs},
              {"nests", nests},
              {"shells off centre", shells_off_centre},
              {"bundles", bundles},
              {"combs", combs},
              {"zigzags", zigzags},
              {"rungs", rungs},
              {"crossed rungs", crossed_rungs},
              {"nested points", nested_points},
              {"nested points in R^4", nested_points_4d},
              {"nested points in R^8", nested_points_8d},
              {"columns", columns},
              {"twigs", twigs},
              {"petals", petals},
              {"rods", rods},
              {"cut rods", cut_rods},
              {"faces", faces},
              {"bars apart", bars_apart},
              {"octaves", octaves},
              {"chess balls", chess_balls_2d},
              {"chess balls 3d", chess_balls_3d},
              {"chess balls 4d", chess_balls_4d},
              {"chess balls 5d", chess_balls_5d}};

froe_scene *claims_scene(const char *kind, size_t n, size_t lambda) {
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        if (!strcmp(scenes[i].kind, kind)) return scenes[i].make(n, lambda);
    return bench_generate(kind, n, 1);
}
