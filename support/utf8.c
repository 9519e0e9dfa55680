/* utf8.c: Unicode 15, table 3-7. */
#include "support/utf8.h"
#include <stdbool.h>

size_t support_utf8_length(const char *text) {
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

/* Is the character, of Latin-1, one of a text? */
static bool is_written(unsigned char c) {
    return (c >= 0x20 && c < 0x7F) || c >= 0xA0 || c == '\t' || c == '\n' || c == '\r';
}

bool support_is_utf16(const char *bytes, size_t size) {
    const unsigned char *c = (const unsigned char *)bytes;
    if (size < 4) return false;
    const bool marked = (c[0] == 0xFF && c[1] == 0xFE && (c[2] || c[3])) || (c[0] == 0xFE && c[1] == 0xFF);
    if (marked) return true;
    const int at = !c[0]; /* of the low bytes */
    return !c[1 - at] && !c[3 - at] && is_written(c[at]) && is_written(c[2 + at]);
}

bool support_is_utf8(const char *text) {
    size_t length = 1;
    for (; text && *text && length; text += length) length = support_utf8_length(text);
    return length;
}
