/* pages.h: PDF and EPS files of render read back, as far as they are written: operators and their numbers. */
#ifndef FROE_TESTS_VECTOR_PAGES_H
#define FROE_TESTS_VECTOR_PAGES_H
#include "support/memory.h"
#include <froe/render.h>
#include <stdlib.h>
#include <string.h>

typedef struct page_bytes {
    char *text; /* with a zero byte after it */
    size_t count, calls;
} page_bytes;

static inline bool keep_bytes(void *user, const void *bytes, size_t count) {
    page_bytes *p = user;
    p->text = realloc(p->text, p->count + count + 1);
    assert_non_null(p->text);
    memcpy(p->text + p->count, bytes, count);
    p->count += count, p->calls++;
    p->text[p->count] = '\0';
    return true;
}

static inline page_bytes page_of(const froe_tree *tree, froe_render_format format, const froe_render_options *o,
                                 froe_render_report *report) {
    page_bytes p = {NULL, 0, 0};
    froe_diagnostic why = {.message = ""};
    if (froe_render_write(tree, format, keep_bytes, &p, o, report, &why)) fail_msg("%s", why.message);
    return p;
}

/** What the page shows: from the first operator to the last. */
static inline const char *page_content(const page_bytes *p, const char **end) {
    const char *pdf = strstr(p->text, "\nstream\n"), *eps = strstr(p->text, "rectclip\n");
    assert_true(pdf || eps);
    *end = strstr(p->text, pdf ? "endstream" : "restore\n");
    assert_non_null(*end);
    return pdf ? pdf + strlen("\nstream\n") : eps + strlen("rectclip\n");
}

typedef struct page_operator {
    char name[8];
    double number[8];
    int count;
} page_operator;

/** The next operator with the numbers before it; the a in "/a51 gs" is a number, and brackets are parted from them.
 * False: there is no more. */
static inline bool page_next(const char **at, const char *end, page_operator *out) {
    *out = (page_operator){.count = 0};
    while (*at < end) {
        char *after;
        if (strchr(" \n[]/", **at)) {
            ++*at;
            continue;
        }
        if (**at == 'a') ++*at;
        const double x = strtod(*at, &after);
        if (after != *at) {
            assert_true(out->count < 8);
            out->number[out->count++] = x;
            *at = after;
            continue;
        }
        const size_t length = strcspn(*at, " \n[]/");
        assert_true(length < sizeof out->name);
        memcpy(out->name, *at, length);
        *at += length;
        return true;
    }
    return false;
}
#endif
