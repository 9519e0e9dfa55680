/* escape.c: any bytes, as of names from files, made characters of XML or JSON. */
#include "support/escape.h"
#include "support/utf8.h"
#include <stdint.h>
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

/* The four hexadecimal digits of \uXXXX; -1: they are none. */
static int code_unit(const char *digits) {
    int code = 0;
    for (int i = 0; i < 4; i++) {
        const char c = digits[i], letter = (char)(c | 0x20);
        if (c >= '0' && c <= '9')
            code = code << 4 | (c - '0');
        else if (letter >= 'a' && letter <= 'f')
            code = code << 4 | (letter - 'a' + 10);
        else
            return -1;
    }
    return code;
}

/* The code point of an escape that begins at `*at`, behind its backslash; surrogates are one in a pair. 0: it is none,
 * or one that no string can hold. */
static uint32_t read_code_point(char **at) {
    int high = code_unit(*at + 1), low;
    if (high < 0 || (high & 0xfc00) == 0xdc00) return 0;
    *at += 5;
    if ((high & 0xfc00) != 0xd800) return (uint32_t)high;
    if ((*at)[0] != '\\' || (*at)[1] != 'u' || (low = code_unit(*at + 2)) < 0 || (low & 0xfc00) != 0xdc00) return 0;
    *at += 6;
    return 0x10000 + ((uint32_t)(high & 0x3ff) << 10 | (uint32_t)(low & 0x3ff));
}

bool support_json_unescape(char **text, char **out) {
    static const char from[] = "\"\\/bfnrt", into[] = "\"\\/\b\f\n\r\t";
    if (**text == 'u') {
        uint32_t c = read_code_point(text);
        static const uint8_t first[] = {0, 0xc0, 0xe0, 0xf0};
        int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
        if (!c) return false;
        *(*out)++ = (char)(first[more] | c >> 6 * more);
        while (more--) *(*out)++ = (char)(0x80 | (c >> 6 * more & 0x3f));
        return true;
    }
    const char *known = **text ? strchr(from, **text) : NULL;
    if (known) *(*out)++ = into[known - from], ++*text;
    return known != NULL;
}
