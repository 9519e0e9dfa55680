/* test_animation.c: pictures of motions without an extent, or beyond what doubles hold, and of any length. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <froe/formats.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A segment that stands between two points, from 0 to the end of the window; NULL: nothing is there. */
static froe_motion *standing(const double *points, double end) {
    static const size_t starts[] = {0, 1, 2};
    static const double times[] = {0, 0};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m = NULL;
    w.begin = 0, w.end = end;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    b.vertex_count = 2, b.count = 1, b.starts = starts, b.times = times, b.coords = points;
    if (points) assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

/* The picture as a text, valid until the next call. */
static const char *drawn(const froe_motion *m, const froe_contact *contacts, const froe_animation_options *options) {
    static char text[1 << 19];
    assert_int_equal(froe_animate(m, contacts, contacts ? 1 : 0, options, "drawn.svg", NULL), FROE_OK);
    FILE *file = fopen("drawn.svg", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    assert_int_equal(fclose(file), 0);
    assert_false(strstr(text, "nan") || strstr(text, "inf\""));
    return text;
}

/* There is a clock where scripts have one. */
static void windows_have_any_length(void **state) {
    (void)state;
    static const struct {
        double end;
        const char *time; /* of the last tick; NULL: a number */
    } cases[] = {{1, NULL}, {1e-13, NULL}, {4000, "00:00:04.000"}, {720000, "00:12:00"}, {9e15, NULL}, {1e300, NULL}};
    static const double points[] = {1, 0, 0, 1};
    const froe_contact contact = {.a = 0, .b = 0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int there = 0; there < 2; there++) {
            froe_motion *m = standing(there ? points : NULL, cases[i].end);
            froe_animation_options o = froe_animation_defaults();
            for (int numbers = 0; numbers < 2; numbers++) {
                o.numbers = numbers;
                const char *text = drawn(m, there ? &contact : NULL, &o);
                if (cases[i].time) assert_int_equal(strstr(text, cases[i].time) != NULL, !numbers);
                assert_int_equal(froe_animate(m, &contact, there, &o, "drawn.html", NULL), FROE_OK);
            }
            assert_int_equal(froe_write_contacts(m, &contact, there, "contacts.csv", NULL), FROE_OK);
            froe_motion_free(m);
        }
}

/* On the page the ends of the segment are two numbers each, and within it. */
static void motions_have_any_extent(void **state) {
    (void)state;
    static const double points[][4] = {
        {1, 2, 1, 5},
        {1, 2, 4, 2},
        {3, 3, 3, 3},
        {-1.7e308, -1.7e308, 1.7e308, 1.7e308},
        {0, -1.7e308, 1, 1.7e308},
        {0, 0, 1e-320, 2e-320},
        {1e17, 0, 1e17 + 16, 1},
        {1e308, -1e308, 1.7e308, 1.7e308},
    };
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        froe_motion *m = standing(points[i], 9);
        double at[4] = {-1, -1, -1, -1};
        const char *path = strstr(drawn(m, NULL, NULL), "class=\"still\" d=\"");
        assert_non_null(path);
        assert_int_equal(sscanf(path, "class=\"still\" d=\"M%lf %lfL%lf %lf\"", at, at + 1, at + 2, at + 3), 4);
        for (int k = 0; k < 4; k++) assert_true(at[k] >= 0 && at[k] <= 1200);
        froe_motion_free(m);
    }
}

static void pictures_and_tables_refuse_what_they_cannot_show(void **state) {
    (void)state;
    froe_motion *m = NULL;
    froe_diagnostic diag;
    assert_int_equal(froe_generate_motion("moving", 3, 1, NULL, &m, NULL), FROE_OK);
    const froe_contact strange = {.a = 1, .b = 7};
    froe_animation_options o = froe_animation_defaults();
    assert_int_equal(froe_animate(m, NULL, 0, NULL, "a.svg", NULL), FROE_OK);
    assert_int_equal(froe_animate(m, NULL, 0, &o, "a.html", NULL), FROE_OK);
    assert_int_equal(froe_animate(m, NULL, 1, &o, "a.html", NULL), FROE_E_ARG);
    assert_int_equal(froe_animate(m, &strange, 1, &o, "a.html", &diag), FROE_E_ARG);
    assert_string_equal(diag.message, "contact 0: Its objects do not exist.");
    assert_int_equal(froe_animate(m, NULL, 0, &o, "a.png", NULL), FROE_E_UNSUPPORTED);
    o.seconds = NAN;
    assert_int_equal(froe_animate(m, NULL, 0, &o, "a.svg", NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_write_contacts(m, NULL, 0, "a.csv", NULL), FROE_OK);
    assert_int_equal(froe_write_contacts(m, NULL, 0, "a.txt", NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_write_contacts(m, NULL, 1, "a.csv", NULL), FROE_E_ARG);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_have_any_length),
        cmocka_unit_test(motions_have_any_extent),
        cmocka_unit_test(pictures_and_tables_refuse_what_they_cannot_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
