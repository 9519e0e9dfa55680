/* escape.c: names come from files, where anything may be found. */
#include "escape.h"
#include <stdbool.h>
#include <string.h>

size_t draw_utf8_length(const char *text) {
    const unsigned char *c = (const unsigned char *)text;
    if (c[0] < 0x80) return 1;
    const size_t n = c[0] >= 0xC2 && c[0] <= 0xDF   ? 2
                     : (c[0] & 0xF0) == 0xE0        ? 3
                     : c[0] >= 0xF0 && c[0] <= 0xF4 ? 4
                                                    : 0;
    for (size_t i = 1; i < n; i++)
        if ((c[i] & 0xC0) != 0x80) return 0;
    const bool wrong = (c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xED && c[1] > 0x9F) ||
                       (c[0] == 0xF0 && c[1] < 0x90) || (c[0] == 0xF4 && c[1] > 0x8F);
    return wrong ? 0 : n;
}

/* U+FFFE and U+FFFF are characters that XML has not. */
static bool is_foreign(const char *at, size_t length) {
    return length == 3 && !memcmp(at, "\xEF\xBF", 2) && (unsigned char)at[2] >= 0xBE;
}

static const char *name_of(char c) {
    switch (c) {
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '&':
        return "&amp;";
    case '"':
        return "&quot;";
    default:
        return (unsigned char)c < 0x20 && !strchr("\t\n\r", c) ? "\xEF\xBF\xBD" : NULL;
    }
}

size_t draw_escape(const char **text, char out[8]) {
    const char *at = *text;
    if (!*at) return 0;
    size_t n = draw_utf8_length(at);
    *text += n ? n : 1;
    const char *as = n && !is_foreign(at, n) ? name_of(*at) : "\xEF\xBF\xBD";
    if (as) n = strlen(as);
    memcpy(out, as ? as : at, n);
    return n;
}
