/* test_eye.c: sides of eyes, and of points and meetings in pictures, against exact rationals, started at every stage.
 *
 * The oracle knows nothing of rays and covectors: a line of the picture is the plane through the eye
 * and two points of space, which it computes from the definition; a meeting is a point of space on both planes. */
#include "geom/eye.h"
#include "geom/sides.h"
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 60 };

typedef struct fixture {
    num_context context;
    geom_eye eye;
    double points[40];
    uint64_t compared, skipped;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    if (!f || num_context_new(NULL, &f->context) != FROE_OK) return 1;
    *state = f;
    return 0;
}

static int teardown(void **state) {
    fixture *f = *state;
    print_message("  %llu comparisons, %llu skipped\n", (unsigned long long)f->compared,
                  (unsigned long long)f->skipped);
    assert_true(f->compared > f->skipped);
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    num_context_free(&f->context);
    free(f);
    return 0;
}

static const double *point(const fixture *f, int i) {
    return f->points + 3 * i;
}

/* -------------------------------------------------------------------- oracle -- */

/* The eye as a homogeneous point. */
static void eye_point(const geom_eye *eye, rational_point *out) {
    rational_point_set(out, 3, eye->at);
    if (eye->parallel) mpq_set_ui(out->w, 0, 1);
}

/* The plane through the homogeneous points p, q, r (4 x 4 minors), positive where p, q, r turn left. */
static void plane_through(rational_plane *out, rational_point *p, rational_point *q, rational_point *r) {
    mpq_t a[3], b[3], t;
    for (int k = 0; k < 3; k++) mpq_inits(a[k], b[k], NULL);
    mpq_init(t);
    /* a = q w_p - p w_q, b = r w_p - p w_r spans the plane when p is finite */
    for (int k = 0; k < 3; k++) {
        mpq_mul(a[k], q->x[k], p->w);
        rational_add_product(a[k], -1, p->x[k], q->w);
        mpq_mul(b[k], r->x[k], p->w);
        rational_add_product(b[k], -1, p->x[k], r->w);
    }
    out->dim = 3;
    rational_cross(out->n, a, b);
    rational_dot(out->c, out->n, p->x);
    mpq_div(out->c, out->c, p->w);
    for (int k = 0; k < 3; k++) mpq_clears(a[k], b[k], NULL);
    mpq_clear(t);
}

/* A line of the picture: through the points u and v. Positive on the left of u -> v as the eye sees it. */
static void line_of_points(const geom_eye *eye, rational_plane *out, rational_point *u, rational_point *v) {
    rational_point e;
    rational_point_init(&e);
    eye_point(eye, &e);
    plane_through(out, v, u, &e); /* v, u, eye turn left as seen from x  <=>  u, v, x do as seen by the eye */
    rational_point_clear(&e);
}

/* Two points of the intersection of planes a and b. */
static bool points_of_cut(rational_plane *a, rational_plane *b, rational_point out[2]) {
    mpq_t d[3];
    rational_plane third;
    int axis = 0;
    for (int k = 0; k < 3; k++) mpq_init(d[k]);
    rational_plane_init(&third);
    rational_cross(d, a->n, b->n);
    while (axis < 3 && mpq_sgn(d[axis]) == 0) axis++;
    third.dim = 3;
    for (int k = 0; k < 3; k++) mpq_set_ui(third.n[k], k == axis, 1);
    for (int i = 0; i < 2 && axis < 3; i++) {
        mpq_set_ui(third.c, (unsigned)i, 1);
        rational_corner(&out[i], a, b, &third);
    }
    for (int k = 0; k < 3; k++) mpq_clear(d[k]);
    rational_plane_clear(&third);
    return axis < 3;
}

/* ------------------------------------------------------------------- questions -- */

static void expect(fixture *f, int expected, int got, const char *what, int kind) {
    f->compared++;
    if (got != expected) fail_msg("%s, class %s: %d expected, %d found", what, fuzz_names[kind], expected, got);
}

static void draw_case(fixture *f, fuzz_source *r, fuzz_class kind, bool parallel) {
    fuzz_points(r, kind, 3, f->points, 12);
    if (parallel && point(f, 0)[0] == 0 && point(f, 0)[1] == 0 && point(f, 0)[2] == 0) f->points[2] = 1;
    f->eye = geom_eye_make(parallel, point(f, 0), point(f, 11));
    geom_eye_set_extent(&f->eye, fabs(point(f, 10)[0])); /* any size will do */
}

static bool distinct(const fixture *f, rational_plane *line) {
    (void)f;
    return mpq_sgn(line->n[0]) || mpq_sgn(line->n[1]) || mpq_sgn(line->n[2]);
}

static void try_side_of_eye(fixture *f, int kind) {
    const double *const p[3] = {point(f, 1), point(f, 2), point(f, 3)};
    const geom_plane planes[3] = {geom_plane_points(3, p), geom_plane_axis(3, kind % 3, f->points[20]),
                                  geom_plane_vector(3, point(f, 4), f->points[21])};
    rational_plane h;
    rational_point e;
    rational_plane_init(&h);
    rational_point_init(&e);
    eye_point(&f->eye, &e);
    for (int i = 0; i < 3; i++) {
        rational_plane_set(&h, planes + i);
        int expected = rational_side(&h, &e);
        int sure = i ? NUM_UNSURE : geom_side_of_eye_filter(p[0], p[1], p[2], &f->eye);
        if (sure != NUM_UNSURE) expect(f, expected, sure, "filtered side of the eye", kind);
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            expect(f, expected, geom_side_of_eye(&f->context, planes + i, &f->eye), "side of the eye", kind);
        }
    }
    rational_plane_clear(&h);
    rational_point_clear(&e);
}

typedef struct lines {
    geom_plane s, a[3];
    geom_line line[3];
    rational_plane h[3]; /* the same in space */
    bool valid;
} lines;

/* Three lines: an edge, a cut, and by `mix` one of the two. */
static void make_lines(fixture *f, lines *l, int mix) {
    rational_plane s, a;
    rational_point x[2];
    const double *const p[3] = {point(f, 1), point(f, 2), point(f, 3)};
    rational_plane_init(&s), rational_plane_init(&a);
    rational_point_init(&x[0]), rational_point_init(&x[1]);
    l->s = geom_plane_points(3, p);
    rational_plane_set(&s, &l->s);
    l->valid = true;
    for (int i = 0; i < 3; i++) {
        rational_plane_init(&l->h[i]);
        bool cut = mix >> i & 1;
        if (cut) {
            const double *const q[3] = {point(f, 4 + i), point(f, 5 + i), point(f, 7 + i)};
            l->a[i] = i == 2 && mix & 8 ? geom_plane_axis(3, 1, f->points[13]) : geom_plane_points(3, q);
            rational_plane_set(&a, &l->a[i]);
            l->line[i] = (geom_line){.kind = GEOM_SIGHT_CUT, .s = &l->s, .a = &l->a[i]};
            l->valid = l->valid && points_of_cut(&s, &a, x);
        } else {
            const double *u = point(f, 4 + i), *v = point(f, 6 + 2 * i);
            rational_point_set(&x[0], 3, u), rational_point_set(&x[1], 3, v);
            l->line[i] = (geom_line){.kind = GEOM_SIGHT_EDGE, .u = u, .v = v};
        }
        if (l->valid) line_of_points(&f->eye, &l->h[i], &x[0], &x[1]);
        l->valid = l->valid && distinct(f, &l->h[i]);
    }
    rational_point e;
    rational_point_init(&e);
    eye_point(&f->eye, &e);
    l->valid = l->valid && rational_side(&s, &e) != 0;
    rational_point_clear(&e);
    rational_point_clear(&x[0]), rational_point_clear(&x[1]);
    rational_plane_clear(&s), rational_plane_clear(&a);
}

static void free_lines(lines *l) {
    for (int i = 0; i < 3; i++) rational_plane_clear(&l->h[i]);
}

/* The sign of h(x) of a cut is that of a(E) s(x) - s(E) a(x); of an edge that of the oracle's plane. */
static int orientation(fixture *f, lines *l, int i) {
    if (l->line[i].kind == GEOM_SIGHT_EDGE) return 1;
    rational_plane s, a, h;
    rational_point e;
    rational_plane_init(&s), rational_plane_init(&a), rational_plane_init(&h);
    rational_point_init(&e);
    rational_plane_set(&s, &l->s), rational_plane_set(&a, &l->a[i]);
    eye_point(&f->eye, &e);
    mpq_t at_s, at_a, n, t;
    mpq_inits(at_s, at_a, n, t, NULL);
    rational_value(at_s, &s, &e), rational_value(at_a, &a, &e);
    int sign = 0;
    for (int k = 0; k < 3 && !sign; k++) { /* the normals are parallel: compare one component */
        mpq_mul(n, at_a, s.n[k]);
        rational_add_product(n, -1, at_s, a.n[k]);
        sign = mpq_sgn(n) * mpq_sgn(l->h[i].n[k]);
    }
    mpq_clears(at_s, at_a, n, t, NULL);
    rational_plane_clear(&s), rational_plane_clear(&a), rational_plane_clear(&h);
    rational_point_clear(&e);
    return sign;
}

static void try_point(fixture *f, int kind, int mix) {
    lines l;
    rational_point x;
    make_lines(f, &l, mix);
    rational_point_init(&x);
    rational_point_set(&x, 3, point(f, 10));
    if (l.valid) {
        int expected = rational_side(&l.h[0], &x) * orientation(f, &l, 0);
        filter_vector line = geom_line_image(&f->eye, &l.line[0]), ray = geom_ray_image(&f->eye, point(f, 10));
        int sure = geom_line_image_side(&line, &ray);
        if (sure != NUM_UNSURE) expect(f, expected, sure, "image of a point", kind);
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            expect(f, expected, geom_line_side_point(&f->context, &f->eye, &l.line[0], point(f, 10)), "point", kind);
        }
    } else {
        f->skipped++;
    }
    rational_point_clear(&x);
    free_lines(&l);
}

/* The meeting of lines 0 and 1 as a homogeneous point of space other than the eye: a direction n0 x n1 from an eye at a
 * point; for a parallel eye any point of both planes. */
static bool meeting(fixture *f, lines *l, rational_point *out) {
    rational_plane third;
    if (!f->eye.parallel) {
        rational_cross(out->x, l->h[0].n, l->h[1].n);
        mpq_set_ui(out->w, 0, 1);
        out->dim = 3;
        return mpq_sgn(out->x[0]) || mpq_sgn(out->x[1]) || mpq_sgn(out->x[2]);
    }
    rational_plane_init(&third);
    third.dim = 3;
    for (int k = 0; k < 3; k++) mpq_set_ui(third.n[k], k == f->eye.axis, 1);
    mpq_set_ui(third.c, 0, 1);
    bool one = rational_corner(out, &l->h[0], &l->h[1], &third);
    rational_plane_clear(&third);
    return one;
}

static void try_meeting(fixture *f, int kind, int mix) {
    lines l;
    rational_point x;
    make_lines(f, &l, mix);
    rational_point_init(&x);
    if (l.valid && meeting(f, &l, &x)) {
        /* Which of the two opposite rays is a x b is settled by one sign of the meeting, as det is antisymmetric. */
        int expected = rational_side(&l.h[2], &x) == 0, signs[3];
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            signs[stage] = geom_line_side_meeting(&f->context, &f->eye, &l.line[2], &l.line[0], &l.line[1]);
            expect(f, expected, signs[stage] == 0, "meeting on the line", kind);
            expect(f, signs[0], signs[stage], "stages agree", kind);
            expect(f, -signs[stage], geom_line_side_meeting(&f->context, &f->eye, &l.line[2], &l.line[1], &l.line[0]),
                   "swapped lines", kind);
            expect(f, signs[stage], geom_line_side_meeting(&f->context, &f->eye, &l.line[0], &l.line[1], &l.line[2]),
                   "rotated lines", kind);
        }
        filter_vector a = geom_line_image(&f->eye, &l.line[0]), b = geom_line_image(&f->eye, &l.line[1]);
        filter_vector h = geom_line_image(&f->eye, &l.line[2]), ray = filter_cross(&a, &b);
        int sure = geom_line_image_side(&h, &ray);
        if (sure != NUM_UNSURE) expect(f, signs[0], sure, "image of a meeting", kind);
    } else {
        f->skipped++;
    }
    rational_point_clear(&x);
    free_lines(&l);
}

/* Where a plane stops an edge uv: the meeting of the edge's line with the STOP is that point, on the side of any other
 * line where the point is. */
static void try_stop(fixture *f, int kind) {
    const double *const q[3] = {point(f, 5), point(f, 7), point(f, 9)}, *u = point(f, 4), *v = point(f, 6);
    const geom_plane plane = kind % 2 ? geom_plane_axis(3, kind % 3, f->points[20]) : geom_plane_points(3, q);
    const geom_line edge = {.u = u, .v = v}, other = {.u = point(f, 8), .v = point(f, 10)};
    rational_plane a, h, own;
    rational_point x[2], stop;
    double key[3];
    rational_plane_init(&a), rational_plane_init(&h), rational_plane_init(&own);
    rational_point_init(&x[0]), rational_point_init(&x[1]), rational_point_init(&stop);
    rational_plane_set(&a, &plane);
    rational_point_set(&x[0], 3, other.u), rational_point_set(&x[1], 3, other.v);
    line_of_points(&f->eye, &h, &x[0], &x[1]);
    rational_point_set(&x[0], 3, u), rational_point_set(&x[1], 3, v);
    line_of_points(&f->eye, &own, &x[0], &x[1]);
    const int at_v = rational_side(&a, &x[1]), parted = at_v * rational_side(&a, &x[0]) < 0;
    expect(f, distinct(f, &own), geom_line_round(&f->context, &f->eye, &edge, key), "an edge makes a line", kind);
    if (parted && distinct(f, &own) && distinct(f, &h) && rational_meet(&stop, &a, &x[0], &x[1])) {
        const int k = fabs(key[0]) == 1 ? 0 : fabs(key[1]) == 1 ? 1 : 2;
        const geom_line line = {.kind = GEOM_SIGHT_STOP, .u = u, .v = v, .a = &plane, .axis = k};
        const int expected = rational_side(&h, &stop) * at_v * (key[k] < 0 ? -1 : 1);
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            expect(f, expected, geom_line_side_meeting(&f->context, &f->eye, &other, &edge, &line), "a stop", kind);
        }
        filter_vector l = geom_line_image(&f->eye, &edge), s = geom_line_image(&f->eye, &line),
                      n = geom_line_image(&f->eye, &other), ray = filter_cross(&l, &s);
        const int sure = geom_line_image_side(&n, &ray);
        if (sure != NUM_UNSURE) expect(f, expected, sure, "image of a stop", kind);
    }
    rational_plane_clear(&a), rational_plane_clear(&h), rational_plane_clear(&own);
    rational_point_clear(&x[0]), rational_point_clear(&x[1]), rational_point_clear(&stop);
}

/* The middle of two points, if it is a double. */
static bool middle(const double *u, const double *v, double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = u[k] + (v[k] - u[k]) / 2;
        if (out[k] - u[k] != v[k] - out[k] || fabs(u[k]) > 0x1p50 || fabs(v[k]) > 0x1p50 || out[k] != floor(out[k]))
            return false;
    }
    return true;
}

/* Two edges of one line are equal, whichever way they run, and have one key; the order along it is that of the points;
 * other lines are not equal, and before or after. */
static void try_lines(fixture *f, int kind) {
    const double *u = point(f, 4), *v = point(f, 6);
    double m[3], key[3], turned[3], half[3];
    const geom_line line = {.u = u, .v = v}, back = {.u = v, .v = u}, short_one = {.u = u, .v = m};
    lines l;
    make_lines(f, &l, 0);
    if (geom_line_round(&f->context, &f->eye, &line, key)) {
        const bool between = middle(u, v, m);
        const int k = fabs(key[0]) == 1 ? 0 : fabs(key[1]) == 1 ? 1 : 2;
        assert_true(geom_line_round(&f->context, &f->eye, &back, turned));
        for (int c = 0; c < 3; c++) assert_true(key[c] == -turned[c]);
        expect(f, 0, geom_line_compare(&f->context, &f->eye, &line, &back, k), "the same line back", kind);
        if (between) {
            assert_true(geom_line_round(&f->context, &f->eye, &short_one, half));
            assert_memory_equal(key, half, sizeof half);
            expect(f, 0, geom_line_compare(&f->context, &f->eye, &back, &short_one, k), "half a line", kind);
        }
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            expect(f, 1, geom_line_order(&f->context, &f->eye, &line, u, v), "from u to v", kind);
            expect(f, 1, geom_line_order(&f->context, &f->eye, &back, v, u), "from v to u", kind);
            expect(f, 0, geom_line_order(&f->context, &f->eye, &line, u, u), "from u to u", kind);
            if (between) expect(f, -1, geom_line_order(&f->context, &f->eye, &line, v, m), "back to the middle", kind);
        }
    }
    if (l.valid && geom_line_round(&f->context, &f->eye, &l.line[0], key) &&
        geom_line_round(&f->context, &f->eye, &l.line[1], turned)) {
        mpq_t across[3];
        for (int c = 0; c < 3; c++) mpq_init(across[c]);
        rational_cross(across, l.h[0].n, l.h[1].n);
        const bool equal = !mpq_sgn(across[0]) && !mpq_sgn(across[1]) && !mpq_sgn(across[2]);
        for (int k = 0; k < 3; k++) {
            if (key[k] == 0 || turned[k] == 0) continue;
            const int order = geom_line_compare(&f->context, &f->eye, &l.line[0], &l.line[1], k);
            if (!equal) expect(f, 1, order * order, "lines that differ", kind);
            expect(f, -order, geom_line_compare(&f->context, &f->eye, &l.line[1], &l.line[0], k), "swapped", kind);
        }
        for (int c = 0; c < 3; c++) mpq_clear(across[c]);
    }
    free_lines(&l);
}

/* The share at which a line meets a segment is the same, to the last bit, from pairs of doubles as from exact numbers.
 */
static void try_share(fixture *f, int kind) {
    const double *u = point(f, 8), *v = point(f, 10);
    const geom_line line = {.u = point(f, 4), .v = point(f, 6)};
    f->context.first = NUM_EXACT;
    if (geom_line_side_point(&f->context, &f->eye, &line, u) * geom_line_side_point(&f->context, &f->eye, &line, v) >=
        0)
        return;
    const double exact = geom_share_round(&f->context, &f->eye, &line, u, v);
    f->context.first = NUM_FILTER;
    const double quick = geom_share_round(&f->context, &f->eye, &line, u, v);
    expect(f, 0, memcmp(&exact, &quick, sizeof exact), "a share", kind);
}

static void run(fixture *f, bool parallel) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(2 * kind + parallel)};
        for (int i = 0; i < TRIALS; i++) {
            draw_case(f, &r, (fuzz_class)kind, parallel);
            try_side_of_eye(f, kind);
            try_point(f, kind, i % 2);
            try_meeting(f, kind, i % 16);
            try_stop(f, kind);
            try_lines(f, kind);
            try_share(f, kind);
        }
    }
}

static void sides_seen_from_a_point_are_exact(void **state) {
    run(*state, false);
}

static void sides_seen_from_infinity_are_exact(void **state) {
    run(*state, true);
}

/* Three points that turn left as the eye sees them: each is on the positive side of the line of the other two, and
 * meetings of neighbouring lines are the points themselves. */
static void points_that_turn_left_are_left_of_their_lines(void **state) {
    fixture *f = *state;
    static const double p[3] = {0, 0, 0}, q[3] = {4, 1, 0}, r[3] = {1, 3, 0}, inside[3] = {1, 1, 0};
    static const double from[4][3] = {{1, 1, 9}, {1, 1, -9}, {0.5, 0.25, 1}, {-0.5, 0.25, -1}};
    const geom_line edges[3] = {{.u = p, .v = q}, {.u = q, .v = r}, {.u = r, .v = p}};
    for (int i = 0; i < 4; i++) {
        geom_eye eye = geom_eye_make(i >= 2, from[i], NULL);
        int left = from[i][2] > 0 ? 1 : -1;
        for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
            f->context.first = (num_stage)stage;
            for (int e = 0; e < 3; e++) {
                assert_int_equal(geom_line_side_point(&f->context, &eye, edges + e, inside), left);
                /* det(q x r, r x p, p x q) = det(p, q, r)^2 */
                assert_int_equal(
                    geom_line_side_meeting(&f->context, &eye, edges + (e + 2) % 3, edges + e, edges + (e + 1) % 3), 1);
            }
        }
        f->compared += 1;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sides_seen_from_a_point_are_exact, setup, teardown),
        cmocka_unit_test_setup_teardown(sides_seen_from_infinity_are_exact, setup, teardown),
        cmocka_unit_test_setup_teardown(points_that_turn_left_are_left_of_their_lines, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
