/* json_scan.c: see json_scan.h. */
#include "formats/read/json_scan.h"
#include "support/arithmetic.h"
#include "support/escape.h"
#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------ scalars -- */

bool formats_scan_string(char **at, formats_scan_text *out) {
    if (!formats_scan_byte(at, '"')) return false;
    char *c = *at;
    *out = (formats_scan_text){.text = c};
    for (;;) {
        while ((unsigned char)*c >= ' ' && *c != '"' && *c != '\\') c++;
        if (*c != '\\') break;
        char scratch[8], *to = scratch;
        c++;
        out->escaped = true;
        if (!support_json_unescape(&c, &to)) return false;
    }
    if (*c != '"') return false;
    out->length = (size_t)(c - out->text);
    *at = c + 1;
    return true;
}

bool formats_scan_is(const formats_scan_text *text, const char *word) {
    const size_t length = strlen(word);
    return text->length == length && !memcmp(text->text, word, length);
}

char *formats_scan_decode(formats_scan_text *text) {
    char *from = text->text, *to = from, *const end = from + text->length;
    while (text->escaped && from < end) {
        if (*from == '\\')
            from++, (void)support_json_unescape(&from, &to);
        else
            *to++ = *from++;
    }
    if (text->escaped) text->length = (size_t)(to - text->text);
    text->escaped = false;
    text->text[text->length] = '\0';
    return text->text;
}

static bool pass_digits(char **at) {
    char *const first = *at;
    while ((unsigned char)(**at - '0') < 10) ++*at;
    return *at > first;
}

bool formats_scan_any_number(char **at, double *value) {
    enum { MOST_WHOLE = 18, MOST_LENGTH = 1000 };
    char *c = *at + (**at == '-'), *const first = c, *end;
    if (*c == '0' ? (c++, false) : !pass_digits(&c)) return false;
    bool whole = true;
    if (*c == '.') {
        whole = false, c++;
        if (!pass_digits(&c)) return false;
    }
    if (*c == 'e' || *c == 'E') {
        whole = false;
        c += c[1] == '+' || c[1] == '-' ? 2 : 1;
        if (!pass_digits(&c)) return false;
    }
    if (c - first > (whole ? MOST_WHOLE : MOST_LENGTH)) return false;
    *value = support_decimal_ahead(*at, &end);
    *at = c;
    return end == c && isfinite(*value);
}

static bool pass_word(char **at, const char *word) {
    const size_t length = strlen(word);
    if (strncmp(*at, word, length) != 0) return false;
    *at += length;
    return true;
}

bool formats_scan_null(char **at) {
    formats_scan_blanks(at);
    return pass_word(at, "null");
}

/* --------------------------------------------------------------- containers -- */

formats_scan_step formats_scan_member(char **at, bool first, formats_scan_text *name) {
    if (formats_scan_byte(at, '}')) return FORMATS_SCAN_END;
    if (!first && !formats_scan_byte(at, ',')) return FORMATS_SCAN_ODD;
    if (!formats_scan_string(at, name) || name->escaped || !formats_scan_byte(at, ':')) return FORMATS_SCAN_ODD;
    return FORMATS_SCAN_MORE;
}

formats_scan_step formats_scan_item(char **at, bool first) {
    if (formats_scan_byte(at, ']')) return FORMATS_SCAN_END;
    return first || formats_scan_byte(at, ',') ? FORMATS_SCAN_MORE : FORMATS_SCAN_ODD;
}

static bool skip_scalar(char **at) {
    formats_scan_text text;
    double number;
    switch (**at) {
    case '"':
        return formats_scan_string(at, &text);
    case 't':
        return pass_word(at, "true");
    case 'f':
        return pass_word(at, "false");
    case 'n':
        return pass_word(at, "null");
    default:
        return formats_scan_number(at, &number);
    }
}

bool formats_scan_skip(char **at) {
    uint64_t objects = 0; /* a bit for each container that is open, the innermost lowest: is it an object? */
    int depth = 0;
    bool first = false;
    do {
        formats_scan_text name;
        if (depth) { /* up to the next value of the container */
            const formats_scan_step step =
                objects & 1 ? formats_scan_member(at, first, &name) : formats_scan_item(at, first);
            if (step == FORMATS_SCAN_ODD) return false;
            if (step == FORMATS_SCAN_END) {
                objects >>= 1, depth--, first = false;
                continue;
            }
        }
        formats_scan_blanks(at);
        first = **at == '{' || **at == '[';
        if (!first && !skip_scalar(at)) return false;
        if (!first) continue;
        if (++depth > FORMATS_SCAN_DEPTH) return false;
        objects = objects << 1 | (**at == '{');
        ++*at;
    } while (depth);
    return true;
}
