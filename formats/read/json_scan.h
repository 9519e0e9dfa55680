/* json_scan.h: a JSON text (RFC 8259) in one pass, a value at a time, without a tree of it.
 *
 *     {"a": [1, 2], "b": "c"}       formats_scan_member() a, formats_scan_item(), formats_scan_number() 1, ...
 *
 * The text ends with a NUL, and none is in it; numbers are read ahead of it (support/decimal/decimal.h). What readers
 * of JSON disagree about, or few files have, is odd: names of members with escapes, whole numbers of more than 18
 * digits, numbers that are infinite as doubles, values nested more than FORMATS_SCAN_DEPTH deep. */
#ifndef FROE_FORMATS_JSON_SCAN_H
#define FROE_FORMATS_JSON_SCAN_H
#include "support/decimal/decimal.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FORMATS_SCAN_DEPTH = 64 };

/** A string between its quotation marks. */
typedef struct formats_scan_text {
    char *text;
    size_t length;
    bool escaped; /**< there are backslashes in it */
} formats_scan_text;

typedef enum formats_scan_step { FORMATS_SCAN_ODD, FORMATS_SCAN_END, FORMATS_SCAN_MORE } formats_scan_step;

static inline void formats_scan_blanks(char **at) {
    while (**at == ' ' || **at == '\n' || **at == '\r' || **at == '\t') ++*at;
}
/** Passes blanks and that byte. False: another is there. */
static inline bool formats_scan_byte(char **at, char byte) {
    formats_scan_blanks(at);
    if (**at != byte) return false;
    ++*at;
    return true;
}
/** Passes blanks and the value null. */
bool formats_scan_null(char **at);
/** The next member of an object whose brace is passed: goes up to its value. `first`: none was before it. */
formats_scan_step formats_scan_member(char **at, bool first, formats_scan_text *name);
/** The same of an array: goes up to the next value. */
formats_scan_step formats_scan_item(char **at, bool first);
/** A string, behind blanks. Its escapes are right. */
bool formats_scan_string(char **at, formats_scan_text *out);
/** Is the text this word? */
bool formats_scan_is(const formats_scan_text *text, const char *word);
/** Decodes a string in its place and ends it with a NUL: after it was passed. */
char *formats_scan_decode(formats_scan_text *text);
/** Any value, behind blanks. */
bool formats_scan_skip(char **at);

/** As formats_scan_number(), of any form. */
bool formats_scan_any_number(char **at, double *value);

/** The double nearest to a number that stands here. */
static inline bool formats_scan_number(char **at, double *value) {
    char *c = *at + (**at == '-'), *first = c;
    uint64_t w = 0;
    if (*c == '0')
        c++;
    else
        for (; (unsigned char)(*c - '0') < 10; c++) w = 10 * w + (uint64_t)(*c - '0');
    int q = 0;
    if (c == first) return false;
    if (c - first > 18) return formats_scan_any_number(at, value);
    if (*c == '.') {
        const char *point = ++c;
        c = (char *)support_decimal_digits(c, &w);
        q = (int)(point - c);
        if (!q || c - first > 20) return formats_scan_any_number(at, value);
    }
    if (*c == 'e' || *c == 'E') return formats_scan_any_number(at, value);
    const double size = support_decimal_nearest(w, q);
    *value = **at != '-' ? size : q ? -size : 0 - size; /* whole numbers have one zero */
    *at = c;
    return true;
}

#endif
