/* test_json.c: JSON texts: what they hold, what is refused and where, at any depth, without memory. */
#include "formats/input/json.h"
#include "support/memory.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct document {
    char *text;
    formats_json_values values;
    formats_json_error error;
} document;

static froe_status read_text(document *d, const froe_allocator *alloc, const char *text, size_t length) {
    *d = (document){.text = malloc(length + 1)};
    assert_non_null(d->text);
    memcpy(d->text, text, length);
    d->text[length] = '\0';
    return formats_json_read(alloc, d->text, length, &d->values, &d->error);
}

static void drop(document *d, const froe_allocator *alloc) {
    array_free(alloc, &d->values);
    free(d->text);
}

static void values_are_what_the_text_says(void **state) {
    (void)state;
    static const char text[] =
        " {\"a\" : [1, -0.5e1, 0, 1e-400, 1.7976931348623157e308, 9007199254740993],\r\n\t\"b\":{},\"c\":[],\n"
        "\"d\":\"\\\"\\\\\\/\\b\\f\\n\\r\\t\\u0041\\u00e9\\u20AC\\ud83d\\ude00\xc3\xa9\", "
        "\"e\":null,\"f\":[true,[false]],"
        "\"a\u00e9\":7, \"a\":3.25} ";
    static const double numbers[] = {1, -5, 0, 0, DBL_MAX, 9007199254740992};
    document d;
    const froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(read_text(&d, &alloc, text, sizeof text - 1), FROE_OK);
    const formats_json *root = d.values.data, *list = root + 2;
    assert_true(formats_json_is(root, FORMATS_JSON_OBJECT) && root->count == 8);
    assert_int_equal(root->span, d.values.count);
    assert_int_equal(formats_json_size(list), 6);
    size_t i = 0;
    FORMATS_JSON_EACH(item, list)
    assert_true(formats_json_is(item, FORMATS_JSON_NUMBER) && item->number == numbers[i++]);
    assert_int_equal(i, 6);
    assert_true(formats_json_get(root, "a")->number == 3.25); /* the last of a name */
    assert_true(formats_json_get(root, "a\u00e9")->number == 7);
    assert_true(formats_json_is(formats_json_get(root, "b"), FORMATS_JSON_OBJECT) &&
                !formats_json_get(formats_json_get(root, "b"), "a"));
    assert_int_equal(formats_json_size(formats_json_get(root, "c")), 0);
    FORMATS_JSON_EACH(none, formats_json_get(root, "c")) fail();
    FORMATS_JSON_EACH(other, formats_json_get(root, "nothing")) fail();
    assert_string_equal(formats_json_string(formats_json_get(root, "d")),
                        "\"\\/\b\f\n\r\tA\u00e9\u20ac\U0001f600\u00e9");
    assert_true(formats_json_is(formats_json_get(root, "e"), FORMATS_JSON_NAME) &&
                !formats_json_string(formats_json_get(root, "e")));
    assert_int_equal(formats_json_size(formats_json_get(root, "f")), 2);
    assert_null(formats_json_get(NULL, "a"));
    assert_null(formats_json_get(list, "a"));
    drop(&d, &alloc);
}

typedef struct bad {
    const char *text;
    size_t line;
    const char *reason;
} bad;

static void what_is_no_json_is_refused_with_its_line(void **state) {
    (void)state;
    static const bad all[] = {
        {"", 1, "JSON needs a value near the end of the file."},
        {"[1,\n2", 2, "JSON needs ']' near the end of the file."},
        {"{", 1, "JSON needs a string or '}' near the end of the file."},
        {"{\"a\":1,}", 1, "JSON needs a string near '}'"},
        {"{\"a\" 1}", 1, "JSON needs ':' near '1'"},
        {"{\"a\":1]", 1, "JSON needs '}' near ']'"},
        {"[1}", 1, "JSON needs ']' near '}'"},
        {"[1 2]", 1, "JSON needs ']' near '2'"},
        {"[1,]", 1, "JSON needs a value near ']'"},
        {"\n\n[]\n[]", 4, "JSON needs the end of the file near '['"},
        {"[nul]", 1, "JSON needs a value near 'nul'"},
        {"[NaN]", 1, "JSON needs a value near 'NaN'"},
        {"[01]", 1, "JSON needs ']' near '1'"},
        {"[0x10]", 1, "JSON needs ']' near 'x10'"},
        {"[+1]", 1, "JSON needs a value near '+1'"},
        {"[-]", 1, "JSON needs a number near '-'"},
        {"[-inf]", 1, "JSON needs a number near '-inf'"},
        {"[1.]", 1, "JSON needs a number near '1.'"},
        {"[.5]", 1, "JSON needs a value near '.5'"},
        {"[1e]", 1, "JSON needs a number near '1e'"},
        {"[1e309]", 1, "JSON needs a smaller number near '1e309'"},
        {"[\"a", 1, "JSON needs the end of a string near the end of the file."},
        {"[\"a\nb\"]", 1, "JSON needs the end of a string near '\n'"},
        {"[\"\\x\"]", 1, "JSON needs a character near '\\x\"'"},
        {"[\"\\u0000\"]", 1, "JSON needs a character near '\\u0000\"'"},
        {"[\"\\u12g4\"]", 1, "JSON needs a character near '\\u12g4\"'"},
        {"[\"\\ud800\"]", 1, "JSON needs a character near '\\ud800\"'"},
        {"[\"\\ud800\\u0041\"]", 1, "JSON needs a character near '\\ud800\\u0041\"'"},
        {"[\"\\udc00\"]", 1, "JSON needs a character near '\\udc00\"'"},
        {"[\"\xc0\xaf\"]", 1, "JSON needs UTF-8 near"},
        {"[\"\xed\xa0\x80\"]", 1, "JSON needs UTF-8 near"},
        {"\xef\xbb\xbf[]", 1, "JSON needs a value near"},
    };
    const froe_allocator alloc = support_allocator(NULL);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        document d;
        froe_status status = read_text(&d, &alloc, all[i].text, strlen(all[i].text));
        if (status != FROE_E_FORMAT || d.error.line != all[i].line ||
            strncmp(d.error.sentence, all[i].reason, strlen(all[i].reason)) != 0)
            fail_msg("%s: %d, line %zu: %s", all[i].text, status, d.error.line, d.error.sentence);
        drop(&d, &alloc);
    }
    document d;
    assert_int_equal(read_text(&d, &alloc, "[1,\0]", 5), FROE_E_FORMAT); /* a zero byte ends no text */
    drop(&d, &alloc);
    assert_int_equal(read_text(&d, &alloc, "[1]\0", 4), FROE_E_FORMAT);
    drop(&d, &alloc);
    assert_int_equal(read_text(&d, &alloc, "[\"a\0\"]", 6), FROE_E_FORMAT);
    drop(&d, &alloc);
}

/* Each beginning of a text is no text, and nothing beyond its end is read (as sanitizers see). */
static void each_beginning_is_refused(void **state) {
    (void)state;
    static const char text[] = "{\"k\":[-1.5e+3,\"\\ud83d\\ude00\\n\u20ac\",{\"x\":true}],\"l\":null}";
    const froe_allocator alloc = support_allocator(NULL);
    for (size_t length = 0; length < sizeof text; length++) {
        document d;
        assert_int_equal(read_text(&d, &alloc, text, length), length + 1 < sizeof text ? FROE_E_FORMAT : FROE_OK);
        drop(&d, &alloc);
    }
}

static void any_depth_will_do(void **state) {
    (void)state;
    enum { DEPTH = 1000000 };
    char *text = malloc(2 * DEPTH);
    assert_non_null(text);
    memset(text, '[', DEPTH);
    memset(text + DEPTH, ']', DEPTH);
    const froe_allocator alloc = support_allocator(NULL);
    document d;
    assert_int_equal(read_text(&d, &alloc, text, 2 * DEPTH), FROE_OK);
    const formats_json *values = d.values.data;
    assert_true(values[0].span == DEPTH && values[DEPTH - 1].span == 1 && values[DEPTH - 2].count == 1);
    drop(&d, &alloc);
    assert_int_equal(read_text(&d, &alloc, text, 2 * DEPTH - 1), FROE_E_FORMAT);
    drop(&d, &alloc);
    free(text);
}

static froe_status without_memory(void *user, const froe_allocator *alloc) {
    document d;
    froe_status status = read_text(&d, alloc, user, strlen(user));
    if (!status) assert_int_equal(d.values.count, 2001);
    drop(&d, alloc);
    return status;
}

static void memory_that_runs_out_is_no_bad_syntax(void **state) {
    (void)state;
    static char text[20000] = "[0";
    for (size_t i = 1, at = 2; i < 2000; i++)
        at += (size_t)snprintf(text + at, sizeof text - at, i % 2 ? ",\"s\"" : ",%zu", i);
    strcat(text, "]");
    assert_true(test_memory_each(without_memory, text) > 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_what_the_text_says),
        cmocka_unit_test(what_is_no_json_is_refused_with_its_line),
        cmocka_unit_test(each_beginning_is_refused),
        cmocka_unit_test(any_depth_will_do),
        cmocka_unit_test(memory_that_runs_out_is_no_bad_syntax),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
