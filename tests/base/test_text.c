/* test_text.c: bytes that are no text, names, and sentences of failures: what stands in their place is always text. */
#include "support/axes.h"
#include "support/embedded.h"
#include "support/escape.h"
#include "support/fail.h"
#include "support/path.h"
#include "support/text/csv.h"
#include "support/text/geojson.h"
#include "support/utf8.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* How many bytes the code point has that these bytes are, by its number; 0: they are none. */
static size_t length_by_number(const unsigned char *c) {
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const size_t n = c[0] < 0x80 ? 1 : c[0] < 0xC0 ? 0 : c[0] < 0xE0 ? 2 : c[0] < 0xF0 ? 3 : c[0] < 0xF8 ? 4 : 0;
    uint32_t code = n < 2 ? c[0] : c[0] & (0x7Fu >> n);
    for (size_t i = 1; i < n; i++) {
        if (c[i] >> 6 != 2) return 0;
        code = code << 6 | (c[i] & 0x3Fu);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return n && code >= least[n] && code <= 0x10FFFF && !surrogate ? n : 0;
}

/* Every first byte, with second and later bytes at the ends of their ranges. */
static void characters_are_those_of_unicode(void **state) {
    static const unsigned char others[] = {0, 'a', 0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0, 0xFF};
    (void)state;
    for (unsigned first = 0; first < 256; first++)
        for (size_t second = 0; second < sizeof others; second++)
            for (size_t later = 0; later < sizeof others; later++) {
                const unsigned char text[5] = {(unsigned char)first, others[second], others[later], 0x80};
                assert_int_equal(support_utf8_length((const char *)text), length_by_number(text));
            }
    assert_true(support_is_utf8("\xE2\x82\xAC"));
    assert_false(support_is_utf8("\xE2\x82"));
}

static void escape(size_t (*next)(const char **, char[8]), const char *text, char *out) {
    char part[8];
    for (size_t n; (n = next(&text, part)) > 0; out += n) memcpy(out, part, n);
    *out = 0;
}

static void text_in_utf16_is_told_from_numbers(void **state) {
    (void)state;
    assert_true(support_is_utf16("x\0,\0", 4));
    assert_true(support_is_utf16("\0x\0\n", 4));
    assert_true(support_is_utf16("\xE9\0\t\0", 4));    /* e with an acute accent */
    assert_true(support_is_utf16("\xFF\xFE\1\2", 4));  /* with a mark, whatever follows */
    assert_false(support_is_utf16("\1\0\2\0\3\0", 6)); /* numbers of 16 bits */
    assert_false(support_is_utf16("\0\1\0x", 4));
    assert_false(support_is_utf16("x\0\x7F\0", 4));
    assert_false(support_is_utf16("x,y\n", 4));
    assert_true(support_is_utf16("\r\0\n\0", 4));     /* an empty line of Windows */
    assert_true(support_is_utf16("\xFE\xFF\2\1", 4)); /* with the mark of the other order */
    assert_true(support_is_utf16("\xFF\xFE\0\1", 4));
    assert_false(support_is_utf16("\xFF\xFE\0\0", 4)); /* the mark of UTF-32 */
    assert_false(support_is_utf16("\xFF\1\2\3", 4));
    assert_false(support_is_utf16("\xFE\1\2\3", 4));
    assert_false(support_is_utf16("x\0y\1", 4)); /* Latin letters are followed by one of another alphabet */
    assert_false(support_is_utf16("\0x\1y", 4));
    assert_false(support_is_utf16("\xFF\xFE\1", 3));
}

/* Folders, and names of the virtual file systems of GDAL, whether anything is there or not. */
static void folders_and_virtual_files_are_no_files(void **state) {
    static const struct {
        const char *path;
        bool beyond;
    } cases[] = {
        {"/vsizip/a.zip/b.shp", true}, {"/vsimem/x", true},     {".", true}, {"/", true}, {"vsizip/a.zip", false},
        {"/dev/null", false},          {"no-such-file", false}, {"", false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(support_path_is_beyond(cases[i].path), cases[i].beyond);
}

/* An up that is none, or all but along the line of view, is replaced by an axis. What is found is always a frame. */
static void a_page_has_axes_whatever_is_up(void **state) {
    static const struct {
        double back[3], up[3];
        int axis;
    } cases[] = {
        {{0, 0, 1}, {0, 1, 0}, -1},
        {{0, 0, 1}, {0, 1e308, -1e308}, -1},
        {{0, 0, 1}, {0, 0, 5}, 0},
        {{1, 0, 0}, {-1, 0, 0}, 1},
        {{1, 0, 0}, {0, 0, 0}, 1},
        {{0, 1, 0}, {0, 0, 0}, 0},
        {{0, 1, 0}, {1, INFINITY, 0}, 0},
        {{0, 0, 1}, {NAN, 1, 0}, 0},
        {{0.6, 0.8, 0}, {-0.6, -0.8, 1e-9}, 0},
        {{0.6, 0, 0.8}, {0, 1e-300, 0}, -1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double *back = cases[i].back;
        double right[3], up[3], turned[3];
        assert_int_equal(support_page_axes(back, cases[i].up, right, up), cases[i].axis);
        support_cross(right, up, turned);
        for (int k = 0; k < 3; k++) assert_true(fabs(turned[k] - back[k]) < 1e-12);
        assert_true(fabs(support_dot(right, right) - 1) < 1e-12 && fabs(support_dot(up, up) - 1) < 1e-12);
        if (cases[i].axis < 0) assert_true(support_dot(up, cases[i].up) > 0);
    }
    double right[3], up[3];
    assert_int_equal(support_page_axes((const double[]){0, 0, 0}, (const double[]){0, 0, 1}, right, up), 2);
}

static void what_is_no_text_is_replaced(void **state) {
    static const struct {
        const char *text, *xml, *json;
    } cases[] = {
        {"a<b>&\"", "a&lt;b&gt;&amp;&quot;", "a\\u003cb>&\\\""},
        {"\t\x01\x7F\\", "\t\xEF\xBF\xBD\x7F\\", "\\u0009\\u0001\\u007f\\\\"},
        {"\xEF\xBF\xBE\xEF\xBF\xBF", "\xEF\xBF\xBD\xEF\xBF\xBD", "\xEF\xBF\xBE\xEF\xBF\xBF"},
        {"\xEF\xBF\xBD\xEF\xBE\xBF\xE2\x82\xAC", "\xEF\xBF\xBD\xEF\xBE\xBF\xE2\x82\xAC",
         "\xEF\xBF\xBD\xEF\xBE\xBF\xE2\x82\xAC"},
        {"\xE9t\xC3", "\xEF\xBF\xBDt\xEF\xBF\xBD", "\\ufffdt\\ufffd"},
    };
    char out[64];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        escape(support_xml_escape, cases[i].text, out);
        assert_string_equal(out, cases[i].xml);
        escape(support_json_escape, cases[i].text, out);
        assert_string_equal(out, cases[i].json);
    }
}

static void sentences_are_one_line_of_text(void **state) {
    froe_diagnostic why;
    char text[] = "a\nb\x7F\xFFz\xC3\xA9";
    (void)state;
    support_one_line(text);
    assert_string_equal(text, "a?b??z\xC3\xA9");
    assert_int_equal(support_fail_file(&why, "read", "map.svg", 123456), FROE_E_IO);
    assert_string_equal(why.message, "map.svg: The file cannot be read: error 123456.");
}

static void endings_of_names_are_short(void **state) {
    static const char *const cases[][2] = {{"a/b.SvG", "svg"},
                                           {"a.b/c", ""},
                                           {"a.", ""},
                                           {"x.fifteen-letters", "fifteen-letters"},
                                           {"x.sixteen--letters", ""}};
    static const support_embedded files[] = {{"a", NULL, 1}, {"b", NULL, 2}, {NULL, NULL, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(support_path_extension(cases[i][0]).text, cases[i][1]);
    assert_ptr_equal(support_embedded_named(files, "b"), files + 1);
    assert_null(support_embedded_named(files, "c"));
}

static void numbers_that_stand_alone_are_passed(void **state) {
    static const char *const none[] = {" 1", "x", "1 ,2", "1x", "-", "\"1\""};
    double x = 7;
    bool last = false;
    (void)state;
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        char text[32] = "", *at = text;
        strcpy(text, none[i]);
        assert_false(support_csv_plain(&at, ',', &x, &last));
        assert_ptr_equal(at, text);
    }
    char text[32] = "-.5,.25,2\r\n3", *at = text;
    const double wanted[] = {-0.5, 0.25, 2, 3};
    for (int i = 0; i < 4; i++) {
        assert_true(support_csv_plain(&at, ',', &x, &last));
        assert_true(x == wanted[i] && last == (i > 1));
    }
    assert_int_equal(*at, 0);
}

/* ----------------------------------------------------------------- coordinate systems -- */

static void begins_with(const froe_crs *crs, bool named, const char *member) {
    const support_geojson begin = support_geojson_begin(crs);
    assert_int_equal(support_geojson_names(crs), named);
    if (member) assert_non_null(strstr(begin.text, member));
    assert_int_equal(strstr(begin.text, "\"crs\"") != NULL, member != NULL);
    assert_non_null(strstr(begin.text, "\"features\":["));
}

static void collections_name_their_coordinate_system(void **state) {
    char code[256] = "FROE:";
    froe_crs crs = {.kind = FROE_CRS_UNKNOWN, .code = ""};
    (void)state;
    begins_with(&crs, true, "\"crs\":null");
    crs = (froe_crs){.kind = FROE_CRS_GEOGRAPHIC, .code = "EPSG:4326"};
    begins_with(&crs, true, NULL);
    crs.code = "OGC:CRS84";
    begins_with(&crs, true, NULL);
    crs.code = "OGC:CRS83";
    begins_with(&crs, true, "\"urn:ogc:def:crs:OGC:1.3:CRS83\"");
    crs.code = "EPSG:4258";
    begins_with(&crs, true, "\"urn:ogc:def:crs:EPSG::4258\"");
    crs.kind = FROE_CRS_PROJECTED, crs.code = "EPSG:4326";
    begins_with(&crs, true, "\"urn:ogc:def:crs:EPSG::4326\"");
    crs.code = "mine";
    begins_with(&crs, false, NULL);
    memset(code + 5, 1, 200); /* each becomes six letters, which have room for a part of them */
    crs.code = code;
    begins_with(&crs, true, "\"urn:ogc:def:crs:FROE::\\u0001");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(characters_are_those_of_unicode),
        cmocka_unit_test(text_in_utf16_is_told_from_numbers),
        cmocka_unit_test(folders_and_virtual_files_are_no_files),
        cmocka_unit_test(a_page_has_axes_whatever_is_up),
        cmocka_unit_test(what_is_no_text_is_replaced),
        cmocka_unit_test(sentences_are_one_line_of_text),
        cmocka_unit_test(endings_of_names_are_short),
        cmocka_unit_test(numbers_that_stand_alone_are_passed),
        cmocka_unit_test(collections_name_their_coordinate_system),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
