/* test_plot.c: figures: numbers land where the axes say, odd numbers are left out, and lines break there. */
#include "report/axis.h"
#include "report/plot.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct sheet {
    char text[60000];
} sheet;

static void put(sheet *s, const plot_series *series, size_t count, const plot_options *o) {
    FILE *out = fmemopen(s->text, sizeof s->text, "w");
    assert_non_null(out);
    plot_put(out, series, count, o);
    assert_int_equal(fclose(out), 0);
}

static int count_of(const char *text, const char *word) {
    int count = 0;
    for (; (text = strstr(text, word)) != NULL; text += strlen(word)) count++;
    return count;
}

static void axes_place_numbers_and_ticks(void **state) {
    (void)state;
    double ticks[PLOT_TICKS];
    for (int log = 0; log < 2; log++)
        for (int e = -12; e <= 12; e++) {
            plot_axis axis = plot_axis_new(log);
            for (int i = 1; i <= 7; i++) plot_axis_add(&axis, i * pow(10, e));
            plot_axis_round(&axis);
            axis.from = 50, axis.to = 450;
            const size_t count = plot_axis_ticks(&axis, ticks);
            assert_in_range(count, 2, 10);
            double before = 0;
            for (size_t i = 0; i < count; i++) {
                const double at = plot_axis_at(&axis, ticks[i]);
                assert_true(at > before && at >= 49.999 && at <= 450.001);
                before = at;
            }
        }
    plot_axis wide = plot_axis_new(true);
    plot_axis_add(&wide, 1e-14), plot_axis_add(&wide, 1e14), plot_axis_add(&wide, -1), plot_axis_add(&wide, NAN);
    plot_axis_round(&wide);
    assert_true(wide.lo < 1e-14 && wide.lo > 1e-15);
    assert_in_range(plot_axis_ticks(&wide, ticks), 5, PLOT_TICKS);
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
        plot_axis_label(cases[i].value, text);
        assert_string_equal(text, cases[i].text);
    }
}

static const double xs[] = {1, 10, 100, 1000}, ys[] = {2, NAN, 0, 3};
static const plot_series two[] = {{"a<b", xs, xs, 4}, {"c", xs, ys, 4}};

static void what_cannot_be_shown_is_left_out(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    plot_options o = plot_defaults();
    o.title = "\"T\" & co", o.log_x = o.log_y = true;
    put(s, two, 2, &o);
    assert_non_null(strstr(s->text, "a&lt;b</text>"));
    assert_non_null(strstr(s->text, "&quot;T&quot; &amp; co"));
    assert_null(strstr(s->text, "nan"));
    assert_null(strstr(s->text, "inf"));
    assert_int_equal(count_of(s->text, "Z"), 4 + 2 + 2); /* markers: of the series, and of the key */
    o.log_y = false;                                     /* now 0 can be shown, and NaN still cannot */
    put(s, two, 2, &o);
    assert_int_equal(count_of(s->text, "Z"), 4 + 3 + 2);
    assert_int_equal(count_of(s->text, "fill=\"none\""), 2 + 2); /* lines: of the series, and of the key */
    o.kind = PLOT_POINTS;
    put(s, two, 2, &o);
    assert_int_equal(count_of(s->text, "Z"), 4 + 3 + 2);
    assert_int_equal(count_of(s->text, "fill=\"none\""), 0);
    o.kind = PLOT_COLUMNS, o.log_x = false;
    put(s, two, 1, &o);
    assert_int_equal(count_of(s->text, "Z"), 4);
    const plot_options standard = plot_defaults();
    put(s, NULL, 0, &standard);
    assert_non_null(strstr(s->text, "nothing to show"));
    const plot_series gap[] = {two[0], {"without points", NULL, NULL, 0}, two[1]};
    put(s, gap, 3, &standard);
    assert_null(strstr(s->text, "without points"));
    free(s);
}

/* Each of twelve differs from the others by its colour, or else by a dashed line and a hollow marker. */
static void series_differ_by_colour_or_by_dash_and_shape(void **state) {
    (void)state;
    sheet *s = calloc(1, sizeof *s);
    plot_series series[12];
    const plot_options o = plot_defaults();
    for (size_t i = 0; i < 12; i++) series[i] = (plot_series){"s", xs, xs, 4};
    put(s, series, 12, &o);
    assert_int_equal(count_of(s->text, "stroke-dasharray"), 4 + 4);     /* lines, and samples in the key */
    assert_int_equal(count_of(s->text, "stroke-width=\"1.5\""), 4 + 4); /* hollow markers */
    const char *first = strstr(s->text, "stroke-width=\"1.8\" stroke=\"");
    char colour[8][8];
    for (int i = 0; i < 8; i++) {
        assert_non_null(first);
        snprintf(colour[i], sizeof colour[i], "%s", first + strlen("stroke-width=\"1.8\" stroke=\""));
        for (int k = 0; k < i; k++) assert_string_not_equal(colour[i], colour[k]);
        first = strstr(first + 1, "stroke-width=\"1.8\" stroke=\"");
    }
    free(s);
}

static void lines_break_where_a_number_is_left_out(void **state) {
    (void)state;
    static const double gap[] = {1, 2, NAN, 3, 4}, level[] = {5, 5, 5, 5, 5};
    const plot_series one = {NULL, gap, level, 5};
    sheet *s = calloc(1, sizeof *s);
    const plot_options standard = plot_defaults();
    put(s, &one, 1, &standard);
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
    plot_options o = plot_defaults();
    o.log_x = o.log_y = true;
    put(s, two, 1, &o);
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

/* Axes without numbers, of one number and of huge ones; names that are empty, of other letters, or very long. */
static void odd_series_have_figures_too(void **state) {
    (void)state;
    static const double five[] = {5, 5}, huge[] = {1e16, 5}, below[] = {-5, -7}, zeros[] = {0, 0};
    char wide[200] = "";
    memset(wide, 'w', sizeof wide - 1);
    sheet *s = calloc(1, sizeof *s);
    plot_options o = plot_defaults();
    o.log_x = o.log_y = true, o.title = "";
    put(s, NULL, 0, &o);
    assert_non_null(strstr(s->text, "nothing to show"));
    put(s, &(plot_series){"below", below, below, 2}, 1, &o); /* no logarithm */
    assert_non_null(strstr(s->text, "nothing to show"));
    o.log_x = o.log_y = false;
    put(s, &(plot_series){"one", five, five, 1}, 1, &o);
    assert_null(strstr(s->text, "nothing to show"));
    put(s, &(plot_series){"huge", five, huge, 2}, 1, &o);
    assert_int_equal(count_of(s->text, "Z"), 1); /* 5 alone */
    put(s, &(plot_series){"zeros", five, zeros, 2}, 1, &o);
    assert_int_equal(count_of(s->text, "Z"), 2);
    assert_null(strstr(s->text, "nan"));
    const plot_series unnamed[] = {{NULL, five, below, 2}, {"", below, five, 2}}, empty[] = {unnamed[1], unnamed[0]};
    put(s, unnamed, 2, &o);
    const int without = count_of(s->text, "<text");
    put(s, empty, 2, &o);
    assert_int_equal(count_of(s->text, "<text"), without);
    const plot_series named[] = {{wide, five, below, 2}, {"\xC3\xA9t\xC3\xA9", below, five, 2}};
    put(s, named, 2, &o);
    assert_int_equal(count_of(s->text, "<text"), without + 2);
    plot_series columns[9];
    for (size_t i = 0; i < 9; i++) columns[i] = (plot_series){"c", five, five, 1};
    o.kind = PLOT_COLUMNS;
    put(s, columns, 9, &o);
    assert_int_equal(count_of(s->text, "stroke-width=\"1.5\""), 0); /* none is hollow */
    put(s, NULL, 0, &o);
    assert_non_null(strstr(s->text, "nothing to show"));
    o.log_x = true;
    put(s, columns, 1, &o);
    assert_null(strstr(s->text, "nan"));
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_place_numbers_and_ticks),
        cmocka_unit_test(labels_are_short_and_right),
        cmocka_unit_test(what_cannot_be_shown_is_left_out),
        cmocka_unit_test(equal_factors_are_equal_distances),
        cmocka_unit_test(series_differ_by_colour_or_by_dash_and_shape),
        cmocka_unit_test(odd_series_have_figures_too),
        cmocka_unit_test(lines_break_where_a_number_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
