/* escape.c: names come from files, where anything may be found. */
#include "escape.h"
#include <stdbool.h>
#include <string.h>

/* Bytes of the UTF-8 character that begins here, shortest form, no surrogates (RFC 3629); 0: there is none. */
static size_t length_of(const unsigned char *c) {
    if (c[0] < 0x80) return 1;
    const size_t n = c[0] >= 0xC2 && c[0] <= 0xDF   ? 2
                     : (c[0] & 0xF0) == 0xE0        ? 3
                     : c[0] >= 0xF0 && c[0] <= 0xF4 ? 4
                                                    : 0;
    for (size_t i = 1; i < n; i++)
        if ((c[i] & 0xC0) != 0x80) return 0;
    const bool wrong = (c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xED && c[1] > 0x9F) ||
                       (c[0] == 0xF0 && c[1] < 0x90) || (c[0] == 0xF4 && c[1] > 0x8F) ||
                       (c[0] == 0xEF && c[1] == 0xBF && c[2] >= 0xBE);
    return wrong ? 0 : n;
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
    size_t n = length_of((const unsigned char *)at);
    *text += n ? n : 1;
    const char *as = n ? name_of(*at) : "\xEF\xBF\xBD";
    if (as) n = strlen(as);
    memcpy(out, as ? as : at, n);
    return n;
}
