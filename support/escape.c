/* escape.c: any bytes, as of names from files, made characters of XML or JSON. */
#include "support/escape.h"
#include "support/utf8.h"
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* U+FFFE and U+FFFF are characters that XML has not. */
static bool is_foreign(const char *at, size_t length) {
    return length == 3 && !memcmp(at, "\xEF\xBF", 2) && (unsigned char)at[2] >= 0xBE;
}

static const char *entity_of(char c) {
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

size_t support_xml_escape(const char **text, char out[8]) {
    const char *at = *text;
    if (!*at) return 0;
    size_t n = support_utf8_length(at);
    *text += n ? n : 1;
    const char *as = n && !is_foreign(at, n) ? entity_of(*at) : "\xEF\xBF\xBD";
    if (as) n = strlen(as);
    memcpy(out, as ? as : at, n);
    return n;
}

size_t support_json_escape(const char **text, char out[8]) {
    const unsigned char c = (unsigned char)**text;
    const size_t length = support_utf8_length(*text);
    if (!c) return 0;
    size_t written = length;
    if (!length || c < 0x20 || c == 0x7f || c == '<') { /* no text ends the script of a page that it stands in */
        written = (size_t)snprintf(out, 8, "\\u%04x", length ? c : 0xfffdu);
    } else if (c == '"' || c == '\\') {
        out[0] = '\\', out[1] = (char)c;
        written = 2;
    } else
        memcpy(out, *text, length);
    *text += length ? length : 1;
    return written;
}
