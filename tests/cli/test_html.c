/* test_html.c: values of reports as they stand on pages: digits in groups, signs, numbers that are large, small or
 * broken; and how much of a promise was used. */
#include "embedded.h"
#include "report/html.h"
#include "version.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h> /* needs setjmp.h and stdarg.h before it */

/* What the build puts into the program; these tables have neither styles nor a foot. */
const support_embedded cli_embedded_files[] = {{NULL, NULL, 0}};
const char *cli_commit(void) {
    return "";
}

typedef void write_fn(FILE *out, const json_t *value);

static const char *written(write_fn *write, json_t *value) {
    static char text[4000];
    FILE *out = fmemopen(text, sizeof text, "w");
    assert_non_null(out);
    write(out, value);
    assert_int_equal(fclose(out), 0);
    json_decref(value);
    return text;
}

static void digits_stand_in_groups(void **state) {
    (void)state;
    static const struct {
        json_int_t value;
        const char *text;
    } wholes[] = {{0, "0"},
                  {999, "999"},
                  {1000, "1&#8239;000"},
                  {1234567, "1&#8239;234&#8239;567"},
                  {-999, "-999"},
                  {-10000, "-10&#8239;000"},
                  {-123456, "-123&#8239;456"}};
    static const struct {
        double value;
        const char *text;
    } reals[] = {{3, "3"},
                 {0.5, "0.5"},
                 {-0.125, "-0.125"},
                 {1234.75, "1&#8239;234"},
                 {-1e6, "-1&#8239;000&#8239;000"},
                 {2.5e15, "2.5e+15"},
                 {1e300, "1e+300"}};
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++)
        assert_string_equal(written(html_value, json_integer(wholes[i].value)), wholes[i].text);
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
        assert_string_equal(written(html_value, json_real(reals[i].value)), reals[i].text);
    assert_string_equal(written(html_value, json_string("a<b")), "a&lt;b");
    assert_string_equal(written(html_value, json_null()), "&ndash;");
}

/* A bar is as long as the share of the promise, and never longer than its cell: a promise may be 0, or broken. */
static void bars_show_shares_of_promises(void **state) {
    (void)state;
    static const struct {
        double promised, measured;
        const char *bar;
    } bounds[] = {{200, 50, "width:25.0%"}, {0, 0, "width:0.0%"}, {0, 3, "width:100.0%"}, {2, 6, "width:100.0%"}};
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
        const char *table = written(html_bounds, json_pack("{s:{s:f, s:f}}", "guard_leaves", "promised",
                                                           bounds[i].promised, "measured", bounds[i].measured));
        assert_non_null(strstr(table, ">guard leaves</th>"));
        assert_non_null(strstr(table, bounds[i].bar));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digits_stand_in_groups),
        cmocka_unit_test(bars_show_shares_of_promises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
