/* Records, fields, numbers and names of axes (support/text/csv.h): what is written by RFC 4180 is read back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/text/csv.h"
#include <stdio.h>
#include <string.h>

static void the_header_tells_what_separates(void **state) {
    (void)state;
    assert_int_equal(support_csv_separator("x,y\n1;2;3;4\n"), ',');
    assert_int_equal(support_csv_separator("x;y;note, and more\n"), ';');
    assert_int_equal(support_csv_separator("\"a;b;c;d\",x,y"), ',');
    assert_int_equal(support_csv_separator("\"a,\"\"b\"\",c\";x;y"), ';');
    assert_int_equal(support_csv_separator("\"two,\nlines,of,it\"\tx\ty\n,,,,"), '\t');
    assert_int_equal(support_csv_separator("x\ty\n,,,"), '\t');
    assert_int_equal(support_csv_separator("5\"\tx\ty,z\n"), '\t');
    assert_int_equal(support_csv_separator("one\n"), ',');
    assert_int_equal(support_csv_separator("a,b;c"), ',');
    assert_int_equal(support_csv_separator("\"never closed;;;"), ',');
    assert_int_equal(support_csv_separator(""), ',');
}

static void assert_fields(const char *text, char separator, const char *const *expected) {
    char copy[200], *at = copy;
    strcpy(copy, text);
    support_csv_field field = {.last = false};
    for (; *expected; expected++) {
        assert_false(field.last);
        field = support_csv_next(&at, separator);
        assert_string_equal(field.text, *expected);
    }
    assert_true(field.last);
}

static void fields_lose_blanks_and_quotation_marks(void **state) {
    (void)state;
    assert_fields(" a ,b\t, \" c \" ,\"\",d\r\nnext", ',', (const char *const[]){"a", "b", " c ", "", "d", NULL});
    assert_fields("a;b,c;\"d;e\"", ';', (const char *const[]){"a", "b,c", "d;e", NULL});
    assert_fields("a\t\t b\t", '\t', (const char *const[]){"a", "", "b", "", NULL});
    assert_fields("\"a\"b,5\" pipe,\"x\"\"y", ',', (const char *const[]){"\"a\"b", "5\" pipe", "x\"y", NULL});
    assert_fields("\"1\"5,\"1\" 5 , \"1\" \t,\"a,\nb\"c\n", ',',
                  (const char *const[]){"\"1\"5", "\"1\" 5", "1", "\"a,\nb\"c", NULL});
    assert_fields("", ',', (const char *const[]){"", NULL});
}

/* Writes a field by RFC 4180. */
static char *put_field(fuzz_source *r, char *to, const char *text, char separator) {
    const char special[] = {separator, '"', '\n', '\r', ' ', '\t', '\0'};
    const bool quoted = strpbrk(text, special) || fuzz_int(r, 0, 3) == 0;
    if (quoted) *to++ = '"';
    for (; *text; text++) {
        if (*text == '"') *to++ = '"';
        *to++ = *text;
    }
    if (quoted) *to++ = '"';
    return to;
}

static void records_are_read_as_they_were_written(void **state) {
    static const char letters[] = "ab,;\t\"\n\r ", separators[] = ",;\t";
    (void)state;
    for (uint64_t seed = 0; seed < 20000; seed++) {
        fuzz_source r = {seed};
        const char separator = separators[fuzz_int(&r, 0, 2)];
        const int count = fuzz_int(&r, 1, 5);
        char fields[5][8], text[200], *to = text;
        for (int i = 0; i < count; i++) {
            const int length = fuzz_int(&r, 0, 6);
            for (int k = 0; k < length; k++) fields[i][k] = letters[fuzz_int(&r, 0, (int)sizeof letters - 2)];
            fields[i][length] = '\0';
            if (i) *to++ = separator;
            to = put_field(&r, to, fields[i], separator);
        }
        *to = '\0';
        /* In its lines the record goes on until the last. */
        bool within = false;
        for (const char *line = text, *end; line; line = end) {
            char part[200];
            end = strchr(line, '\n');
            end = end ? end + 1 : NULL;
            snprintf(part, sizeof part, "%.*s", end ? (int)(end - line) : 199, line);
            within = support_csv_goes_on(part, separator, within);
            assert_int_equal(within, end != NULL);
        }
        strcpy(to, "\nnext record");
        char *at = text;
        for (int i = 0; i < count; i++) {
            const support_csv_field field = support_csv_next(&at, separator);
            assert_string_equal(field.text, fields[i]);
            assert_int_equal(field.last, i + 1 == count);
        }
        assert_string_equal(at, "next record");
    }
}

/* Numbers are passed with what ends them; everything else is left where it is. */
static void plain_numbers_are_passed(void **state) {
    (void)state;
    char text[64] = "1.5,-.5\r\n3;", *at = text;
    double x;
    bool last;
    assert_true(support_csv_plain(&at, ',', &x, &last) && x == 1.5 && !last);
    assert_true(support_csv_plain(&at, ',', &x, &last) && x == -0.5 && last && at == text + 9);
    assert_false(support_csv_plain(&at, ',', &x, &last));
    assert_true(support_csv_plain(&at, ';', &x, &last) && x == 3 && !last && !*at);
    char end[64] = "7";
    at = end;
    assert_true(support_csv_plain(&at, ',', &x, &last) && x == 7 && last && at == end + 1);
    static const char *const others[] = {"", ",1", "\n1", " 1,", "1 ,", "\"1\",", "1x,", "-,", "inf,", "1\t,"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        char other[64] = "";
        strcpy(other, others[i]);
        at = other;
        assert_false(support_csv_plain(&at, ',', &x, &last));
        assert_ptr_equal(at, other);
    }
}

static void numbers_fill_their_fields(void **state) {
    (void)state;
    double x;
    assert_true(support_csv_number((char[32]){"0.1"}, ',', &x) && x == 0.1);
    assert_true(support_csv_number((char[32]){"-2.5e-3 \t"}, ',', &x) && x == -0.0025);
    assert_true(support_csv_number((char[32]){"2,35"}, ';', &x) && x == 2.35);
    assert_true(support_csv_number((char[32]){"-inf"}, ',', &x) && x == -INFINITY);
    char text[32] = "1,5,";
    assert_false(support_csv_number(text, ';', &x));
    assert_string_equal(text, "1,5,");
    const char *const others[] = {"", " ", "1,5", "1 2", "one", "1.5.2", "--1"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        char copy[16];
        strcpy(copy, others[i]);
        assert_false(support_csv_number(copy, ',', &x));
    }
}

static void axes_are_of_one_family(void **state) {
    (void)state;
    assert_int_equal(support_csv_axis("Z", 0, false), 2);
    assert_int_equal(support_csv_axis("X8", 0, false), 7);
    assert_int_equal(support_csv_axis("8", 0, true), 7);
    assert_int_equal(support_csv_axis("8", 0, false), -1);
    assert_int_equal(support_csv_axis("x9", 0, false), 8);
    assert_int_equal(support_csv_axis("x0", 0, false), -1);
    assert_int_equal(support_csv_axis("x1a", 0, false), -1);
    assert_int_equal(support_csv_axis("x99999999999999999999", 0, false), 999);
    assert_int_equal(support_csv_axis("Longitude", 1, false), 0);
    assert_int_equal(support_csv_axis("LAT", 1, false), 1);
    assert_int_equal(support_csv_axis("lat", 0, false), -1);
    assert_int_equal(support_csv_axis("lat", 2, false), -1);
    assert_int_equal(support_csv_axis("Northing", 2, false), 1);
    assert_int_equal(support_csv_axis("z", 2, false), 2);
}

static void bounds_have_several_names(void **state) {
    (void)state;
    const struct {
        const char *name;
        int family, axis;
        bool high;
    } names[] = {{"minx", 0, 0, false},    {"min_y", 0, 1, false}, {"Xmax", 0, 0, true},
                 {"Z_MAX", 0, 2, true},    {"max_x8", 0, 7, true}, {"x8min", 0, 7, false},
                 {"lon_min", 1, 0, false}, {"MaxLat", 1, 1, true}, {"min_easting", 2, 0, false}};
    const char *const others[] = {"min",
                                  "max_",
                                  "_max",
                                  "x",
                                  "xmid",
                                  "min_xmax",
                                  "minlat",
                                  "x__max",
                                  "minute",
                                  "",
                                  "a name of more bytes than any axis has, xmin"};
    bool high;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_int_equal(support_csv_bound(names[i].name, names[i].family, &high), names[i].axis);
        assert_int_equal(high, names[i].high);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_int_equal(support_csv_bound(others[i], 0, &high), -1);
}

static void long_lists_of_names_are_cut(void **state) {
    (void)state;
    const char *const names[] = {"a", "", "a name of many letters", "b"};
    char text[64];
    support_csv_names(text, sizeof text, names, 2);
    assert_string_equal(text, "a, ''");
    support_csv_names(text, sizeof text, names, 4);
    assert_string_equal(text, "a, '', a name of many letters, b");
    support_csv_names(text, 48, names, 4);
    assert_string_equal(text, "a, '' and 2 more");
    support_csv_names(text, 48, names + 2, 2);
    assert_string_equal(text, "2 columns");
    support_csv_names(text, sizeof text, names, 0);
    assert_string_equal(text, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_header_tells_what_separates),
        cmocka_unit_test(fields_lose_blanks_and_quotation_marks),
        cmocka_unit_test(records_are_read_as_they_were_written),
        cmocka_unit_test(plain_numbers_are_passed),
        cmocka_unit_test(numbers_fill_their_fields),
        cmocka_unit_test(axes_are_of_one_family),
        cmocka_unit_test(bounds_have_several_names),
        cmocka_unit_test(long_lists_of_names_are_cut),
    };
    return cmocka_run_group_tests_name("formats/csv", tests, NULL, NULL);
}
