/* test_features.c: which features a motion becomes in a file, and which motions it cannot say. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <froe/formats.h>
#include <stdio.h>
#include <string.h>

static froe_motion *make_motion(unsigned dim) {
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.dim = dim, w.begin = 0, w.end = 9;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    return m;
}

/* Segments between vertices of 4, of which each has the instants 0 and 9. */
static froe_motion *make_segments(const uint32_t (*vertices)[2], const double *deaths, size_t count) {
    static const double times[] = {0, 9, 0, 9, 0, 9, 0, 9};
    static const double coords[] = {0, 0, 1, 0, 0, 5, 1, 5, 5, 5, 6, 5, 5, 0, 6, 1};
    static const size_t starts[] = {0, 2, 4, 6, 8};
    froe_moving b = froe_moving_defaults();
    froe_motion *m = make_motion(2);
    b.vertex_count = 4, b.starts = starts, b.times = times, b.coords = coords;
    b.count = count, b.vertices = &vertices[0][0], b.deaths = deaths;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

/* Which features chains become: by the number of each type. */
static void chains_are_lines_rings_and_points(void **state) {
    (void)state;
    static const struct {
        uint32_t vertices[4][2];
        size_t count;
        int lines, rings, points;
    } cases[] = {
        {{{0, 1}, {1, 2}, {2, 3}}, 3, 1, 0, 0},         /* one behind the other */
        {{{0, 1}, {1, 2}, {2, 0}, {0, 3}}, 4, 1, 1, 0}, /* a ring ends, although what follows begins at its end */
        {{{0, 1}, {1, 0}}, 2, 1, 0, 0},                 /* there and back is no ring */
        {{{0, 1}, {2, 3}}, 2, 2, 0, 0},                 /* apart */
        {{{0, 0}, {1, 1}}, 2, 0, 0, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_motion *m = make_segments(cases[i].vertices, NULL, cases[i].count), *read = NULL;
        assert_int_equal(froe_write_motion(m, "chains.mfjson", NULL), FROE_OK);
        assert_int_equal(froe_read_motion("chains.mfjson", NULL, &read, NULL, NULL), FROE_OK);
        assert_int_equal(froe_motion_object_count(read), cases[i].count);
        for (uint32_t o = 0; o < cases[i].count; o++)
            for (int e = 0; e < 2; e++) {
                double p[2], q[2];
                assert_true(froe_motion_position(m, froe_motion_object(m, o).vertices[e], 4.5, p));
                assert_true(froe_motion_position(read, froe_motion_object(read, o).vertices[e], 4.5, q));
                assert_memory_equal(p, q, sizeof p);
            }
        char text[8192];
        FILE *file = fopen("chains.mfjson", "r");
        assert_non_null(file);
        text[fread(text, 1, sizeof text - 1, file)] = 0;
        fclose(file);
        static const char *const types[] = {"MovingLineString", "MovingPolygon", "MovingPoint"};
        int found[3] = {0};
        for (int k = 0; k < 3; k++)
            for (const char *at = text; (at = strstr(at, types[k])); at++) found[k]++;
        assert_true(found[0] == cases[i].lines && found[1] == cases[i].rings && found[2] == cases[i].points);
        froe_motion_free(m), froe_motion_free(read);
    }
}

/* An object with a vertex for each dimension; times end by -1. With a body, that has the times of the first vertex. */
static void add_one(froe_motion *m, const double (*times)[3], double birth, double death, bool carried) {
    const unsigned dim = froe_motion_window(m).dim;
    froe_moving b = froe_moving_defaults();
    froe_diagnostic why;
    size_t starts[4] = {0}, count = 0;
    double at[9], coords[27] = {0}, knots[9] = {0};
    uint32_t bodies[3] = {FROE_NONE};
    for (unsigned v = 0; v < dim; v++) {
        for (unsigned i = 0; i < 3 && times[v][i] >= 0 && !(carried && i); i++, count++) {
            at[count] = times[v][i];
            coords[dim * count + v] = 1;
        }
        starts[v + 1] = count;
    }
    if (carried) {
        froe_body body = froe_body_defaults();
        while (body.count < 3 && times[0][body.count] >= 0) body.count++;
        body.times = times[0], body.coords = knots;
        if (froe_motion_add_body(m, &body, bodies, &why)) fail_msg("%s", why.message);
        bodies[2] = bodies[1] = bodies[0];
        b.bodies = bodies;
    }
    b.vertex_count = dim, b.count = 1, b.births = &birth, b.deaths = &death;
    b.starts = starts, b.times = at, b.coords = coords;
    if (froe_motion_add(m, &b, &why)) fail_msg("%s", why.message);
}

static void instants_have_to_be_those_of_a_life(void **state) {
    (void)state;
#define NOT_THOSE " are not the same, or not those of its life, which MF-JSON cannot say."
    static const struct {
        unsigned dim;
        double times[3][3], birth, death;
        bool carried;
        const char *words; /* NULL: it is written */
    } cases[] = {
        {2, {{0, 9, -1}, {0, 9, -1}}, 0, 9, false, NULL},
        {2, {{0, 9, -1}, {0, 9, -1}}, 1, 9, false, "segment 0: The instants of its vertices" NOT_THOSE},
        {2, {{0, 9, -1}, {0, 9, -1}}, 0, 8, false, "segment 0: The instants of its vertices" NOT_THOSE},
        {2, {{0, 9, -1}, {0, 5, 9}}, 0, 9, false, "segment 0: The instants of its vertices" NOT_THOSE},
        {2, {{0, 5, 9}, {0, 6, 9}}, 0, 9, false, "segment 0: The instants of its vertices" NOT_THOSE},
        {2, {{0, -1, -1}, {0, -1, -1}}, 0, 9, false, "segment 0: The instants of its vertices" NOT_THOSE},
        {2, {{0, 9, -1}, {0, 9, -1}}, 0, 9, true, NULL},
        {2, {{0, 9, -1}, {0, 9, -1}}, 1, 9, true, "segment 0: The instants of its body" NOT_THOSE},
        {2, {{0, 9, -1}, {0, 9, -1}}, 0, 8, true, "segment 0: The instants of its body" NOT_THOSE},
        {2, {{0, -1, -1}, {0, -1, -1}}, 2, 8, true, NULL}, /* it rests */
        {3, {{0, 9, -1}, {0, 9, -1}, {0, 9, -1}}, 0, 9, false, NULL},
        {3, {{0, 9, -1}, {0, 9, -1}, {0, 9, -1}}, 1, 9, false, "triangle 0: The instants of its corners" NOT_THOSE},
        {3, {{0, 9, -1}, {0, 9, -1}, {0, 9, -1}}, 0, 8, false, "triangle 0: The instants of its corners" NOT_THOSE},
        {3, {{0, 5, 9}, {0, 6, 9}, {0, 6, 9}}, 0, 9, false, "triangle 0: The instants of its corners" NOT_THOSE},
        {3, {{0, 9, -1}, {0, 5, 9}, {0, 9, -1}}, 0, 9, false, "triangle 0: The instants of its corners" NOT_THOSE},
        {3, {{0, -1, -1}, {0, 9, -1}, {0, 9, -1}}, 0, 9, false, "triangle 0: The instants of its corners" NOT_THOSE},
        {3, {{0, -1, -1}, {0, -1, -1}, {0, -1, -1}}, 2, 8, false, NULL}, /* they rest */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_diagnostic why = {.message = ""};
        froe_motion *read = NULL, *m = make_motion(cases[i].dim);
        add_one(m, cases[i].times, cases[i].birth, cases[i].death, cases[i].carried);
        const froe_status status = froe_write_motion(m, "one.mfjson", &why);
        assert_string_equal(why.message, cases[i].words ? cases[i].words : "");
        assert_int_equal(status, cases[i].words ? FROE_E_UNSUPPORTED : FROE_OK);
        if (!status) {
            assert_int_equal(froe_read_motion("one.mfjson", NULL, &read, NULL, NULL), FROE_OK);
            const froe_moving_object o = froe_motion_object(read, 0);
            assert_true(o.birth == cases[i].birth && o.death == cases[i].death);
        }
        froe_motion_free(m), froe_motion_free(read);
    }
}

/* Triangles that rest, of which no two live as long or have one body: each is a feature, with its own life. */
static void features_end_where_lives_do(void **state) {
    (void)state;
    static const double times[3][3] = {{0, -1, -1}, {0, -1, -1}, {0, -1, -1}};
    static const double births[] = {0, 0, 1, 1}, deaths[] = {9, 8, 8, 8};
    froe_motion *read = NULL, *m = make_motion(3);
    for (int i = 0; i < 4; i++) add_one(m, times, births[i], deaths[i], i == 3);
    assert_int_equal(froe_write_motion(m, "lives.mfjson", NULL), FROE_OK);
    assert_int_equal(froe_read_motion("lives.mfjson", NULL, &read, NULL, NULL), FROE_OK);
    assert_int_equal(froe_motion_object_count(read), 4);
    for (uint32_t i = 0; i < 4; i++) {
        const froe_moving_object o = froe_motion_object(read, i);
        assert_true(o.birth == births[i] && o.death == deaths[i]);
    }
    assert_int_equal(froe_motion_body_count(read), 1);
    froe_motion_free(m), froe_motion_free(read);
    const uint32_t pair[2][2] = {{0, 1}, {1, 2}};
    froe_diagnostic why = {.message = ""};
    m = make_segments(pair, (const double[]){9, 8}, 2); /* a chain has one life */
    assert_int_equal(froe_write_motion(m, "lives.mfjson", &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "segment 1: "));
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_are_lines_rings_and_points),
        cmocka_unit_test(instants_have_to_be_those_of_a_life),
        cmocka_unit_test(features_end_where_lives_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
