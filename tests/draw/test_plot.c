/* test_plot.c: figures: numbers land where the axes say, odd numbers are left out, bad options are refused. */
#include "axis.h"
#include <froe/plot.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/memory.h"

typedef struct sheet {
    char text[60000];
    size_t used;
} sheet;

static bool take(void *user, const void *bytes, size_t count) {
    sheet *s = user;
    assert_true(s->used + count < sizeof s->text);
    memcpy(s->text + s->used, bytes, count);
    s->used += count;
    s->text[s->used] = '\0';
    return true;
}

static bool refuse(void *user, const void *bytes, size_t count) {
    (void)user, (void)bytes, (void)count;
    return false;
}

static int count_of(const char *text, const char *word) {
    int count = 0;
    for (; (text = strstr(text, word)) != NULL; text += strlen(word)) count++;
    return count;
}

static void axes_place_numbers_and_ticks(void **state) {
    (void)state;
    double ticks[DRAW_TICKS];
    for (int log = 0; log < 2; log++)
        for (int e = -12; e <= 12; e++) {
            draw_axis axis = draw_axis_new(log);
            for (int i = 1; i <= 7; i++) draw_axis_add(&axis, i * pow(10, e));
            draw_axis_round(&axis);
            axis.from = 50, axis.to = 450;
            const size_t count = draw_axis_ticks(&axis, ticks);
            assert_in_range(count, 2, 10);
            double before = 0;
            for (size_t i = 0; i < count; i++) {
                const double at = draw_axis_at(&axis, ticks[i]);
                assert_true(at > before && at >= 49.999 && at <= 450.001);
                before = at;
            }
        }
    draw_axis wide = draw_axis_new(true);
    draw_axis_add(&wide, 1e-14), draw_axis_add(&wide, 1e14), draw_axis_add(&wide, -1), draw_axis_add(&wide, NAN);
    draw_axis_round(&wide);
    assert_true(wide.lo < 1e-14 && wide.lo > 1e-15);
    assert_in_range(draw_axis_ticks(&wide, ticks), 5, DRAW_TICKS);
}

static void labels_are_short_and_right(void **state) {
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},         {0.05, "0.05"},   {-2.5, "-2.5"}, {20, "20"},     {999, "999"},
                 {1000, "1k"},     {5e4, "50k"},     {2e6, "2M"},    {1e9, "1G"},    {1e-5, "1e-5"},
                 {2e-14, "2e-14"}, {0.001, "0.001"}, {1e12, "1T"},   {1500, "1.5k"}, {1, "1"}};
    char text[24];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        draw_axis_label(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

static const double xs[] = {1, 10, 100, 1000}, ys[] = {2, NAN, 0, 3};
static const froe_plot_series two[] = {{"a<b", xs, xs, 4}, {"c", xs, ys, 4}};

static void what_cannot_be_shown_is_left_out(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    froe_plot_options o = froe_plot_defaults();
    o.title = "\"T\" & co", o.log_x = o.log_y = true;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, NULL), FROE_OK);
    assert_non_null(strstr(s->text, "a&lt;b</text>"));
    assert_non_null(strstr(s->text, "&quot;T&quot; &amp; co"));
    assert_null(strstr(s->text, "nan"));
    assert_null(strstr(s->text, "inf"));
    assert_int_equal(count_of(s->text, "Z"), 4 + 2 + 2); /* markers: of the series, and of the key */
    s->used = 0;
    o.log_y = false; /* now 0 can be shown, and NaN still cannot */
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, NULL), FROE_OK);
    assert_int_equal(count_of(s->text, "Z"), 4 + 3 + 2);
    assert_int_equal(count_of(s->text, "fill=\"none\""), 2); /* lines */
    s->used = 0;
    o.kind = FROE_PLOT_POINTS;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, NULL), FROE_OK);
    assert_int_equal(count_of(s->text, "Z"), 4 + 3 + 2);
    assert_int_equal(count_of(s->text, "fill=\"none\""), 0);
    s->used = 0;
    o.kind = FROE_PLOT_COLUMNS, o.log_x = false;
    assert_int_equal(froe_plot_write(two, 1, take, s, &o, NULL), FROE_OK);
    assert_int_equal(count_of(s->text, "Z"), 4);
    s->used = 0;
    assert_int_equal(froe_plot_write(NULL, 0, take, s, NULL, NULL), FROE_OK);
    assert_non_null(strstr(s->text, "nothing to show"));
    s->used = 0;
    const froe_plot_series gap[] = {two[0], {"without points", NULL, NULL, 0}, two[1]};
    assert_int_equal(froe_plot_write(gap, 3, take, s, NULL, NULL), FROE_OK);
    assert_null(strstr(s->text, "without points"));
    free(s);
}

static void lines_break_where_a_number_is_left_out(void **state) {
    (void)state;
    static const double gap[] = {1, 2, NAN, 3, 4}, level[] = {5, 5, 5, 5, 5};
    const froe_plot_series one = {NULL, gap, level, 5};
    sheet *s = calloc(1, sizeof *s);
    assert_int_equal(froe_plot_write(&one, 1, take, s, NULL, NULL), FROE_OK);
    char *end = strstr(s->text, "\" fill=\"none\"");
    assert_non_null(end);
    *end = '\0';
    const char *path = end;
    while (strncmp(path, "d=\"", 3) != 0) path--;
    assert_int_equal(count_of(path, "M"), 2);
    assert_int_equal(count_of(path, "L"), 2);
    free(s);
}

/* A straight line on paper stays straight: equal factors are equal distances on a logarithmic axis. */
static void equal_factors_are_equal_distances(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    froe_plot_options o = froe_plot_defaults();
    o.log_x = o.log_y = true;
    assert_int_equal(froe_plot_write(two, 1, take, s, &o, NULL), FROE_OK);
    const char *path = strstr(s->text, "<path d=\"M");
    double x[4], y[4];
    for (; path; path = strstr(path + 1, "<path d=\"M")) {
        if (sscanf(path, "<path d=\"M%lf %lfL%lf %lfL%lf %lfL%lf %lf\" fill", x, y, x + 1, y + 1, x + 2, y + 2, x + 3,
                   y + 3) == 8)
            break;
    }
    assert_non_null(path);
    for (int i = 2; i < 4; i++) {
        assert_true(fabs(x[i] - 2 * x[i - 1] + x[i - 2]) < 0.21 && x[i] > x[i - 1]);
        assert_true(fabs(y[i] - 2 * y[i - 1] + y[i - 2]) < 0.21 && y[i] < y[i - 1]);
    }
    free(s);
}

static void bad_options_are_refused(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    froe_diagnostic diag;
    froe_plot_options o = froe_plot_defaults();
    o.width = NAN;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, &diag), FROE_E_OPTIONS);
    assert_non_null(strstr(diag.message, "width"));
    o = froe_plot_defaults(), o.height = 5;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, &diag), FROE_E_OPTIONS);
    o = froe_plot_defaults(), o.column = 0;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, &diag), FROE_E_OPTIONS);
    o = froe_plot_defaults(), o.kind = (froe_plot_kind)7;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, &diag), FROE_E_OPTIONS);
    o = froe_plot_defaults(), o.size = 0;
    assert_int_equal(froe_plot_write(two, 2, take, s, &o, &diag), FROE_E_OPTIONS);
    assert_int_equal(froe_plot_write(two, 2, NULL, s, NULL, &diag), FROE_E_ARG);
    assert_int_equal(froe_plot_write(NULL, 2, take, s, NULL, &diag), FROE_E_ARG);
    assert_int_equal(froe_plot_write(two, 2, refuse, s, NULL, &diag), FROE_E_IO);
    assert_int_equal(s->used, 0);
    free(s);
}

static froe_status plot_in(void *user, const froe_allocator *alloc) {
    froe_plot_options o = froe_plot_defaults();
    sheet *s = user;
    o.alloc = alloc;
    s->used = 0;
    return froe_plot_write(two, 2, take, s, &o, NULL);
}

static void figures_survive_every_failing_allocation(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    test_memory_each(plot_in, s);
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_place_numbers_and_ticks),
        cmocka_unit_test(labels_are_short_and_right),
        cmocka_unit_test(what_cannot_be_shown_is_left_out),
        cmocka_unit_test(equal_factors_are_equal_distances),
        cmocka_unit_test(lines_break_where_a_number_is_left_out),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(figures_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
