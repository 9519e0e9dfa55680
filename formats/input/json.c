/* json.c: reads a JSON text (RFC 8259). The `span` of a container that is not yet closed says which one it lies in. */
#include "formats/input/json.h"
#include "support/decimal/decimal.h"
#include "support/escape.h"
#include "support/utf8.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct parser {
    const froe_allocator *alloc;
    formats_json_values *values;
    char *at, *end;
    size_t open; /* the innermost container that is not closed, counted from 1; 0: there is none */
    size_t line;
    formats_json_error *error;
} parser;

static froe_status expected(const parser *p, const char *what) {
    int near = (int)strcspn(p->at, " \t\r\n,:[]{}");
    p->error->line = p->line;
    if (p->at == p->end)
        snprintf(p->error->sentence, sizeof p->error->sentence, "JSON needs %s near the end of the file.", what);
    else
        snprintf(p->error->sentence, sizeof p->error->sentence, "JSON needs %s near '%.*s'.", what,
                 near > 30 ? 30
                 : near    ? near
                           : 1,
                 p->at);
    return FROE_E_FORMAT;
}

static void skip_blanks(parser *p) {
    for (; *p->at == ' ' || *p->at == '\t' || *p->at == '\r' || *p->at == '\n'; p->at++) p->line += *p->at == '\n';
}

static bool take_byte(parser *p, char byte) {
    if (*p->at != byte || p->at == p->end) return false;
    p->at++;
    return true;
}

static froe_status put_value(parser *p, formats_json_kind kind, const char *text, double number) {
    const formats_json value = {.kind = kind, .span = 1, .number = number, .text = text};
    return array_push(p->alloc, p->values, value) ? FROE_OK : FROE_E_MEMORY;
}

/* ----------------------------------------------------------------- scalars -- */

static bool skip_digits(char **at) {
    size_t digits = strspn(*at, "0123456789");
    *at += digits;
    return digits > 0;
}

static froe_status read_json_number(parser *p) {
    char *begin = p->at, *at = begin + (*begin == '-');
    bool right = *at == '0' ? at++, true : skip_digits(&at);
    if (right && *at == '.') {
        at++;
        right = skip_digits(&at);
    }
    if (right && (*at == 'e' || *at == 'E')) {
        at += at[1] == '+' || at[1] == '-' ? 2 : 1;
        right = skip_digits(&at);
    }
    if (!right) return expected(p, "a number");
    char *end;
    const double number = support_decimal(begin, &end);
    if (isinf(number)) return expected(p, "a smaller number");
    p->at = at;
    return put_value(p, FORMATS_JSON_NUMBER, begin, number);
}

/* What a string stands for is never longer than it: it is decoded where it lies. */
static froe_status read_string(parser *p) {
    char *begin = p->at + 1, *to = begin;
    for (p->at = begin; *p->at != '"';) {
        size_t length = support_utf8_length(p->at);
        if (p->at == p->end || (unsigned char)*p->at < 0x20) return expected(p, "the end of a string");
        if (!length) return expected(p, "UTF-8");
        if (*p->at == '\\') {
            char *escape = p->at++;
            if (!support_json_unescape(&p->at, &to)) return p->at = escape, expected(p, "a character");
        } else {
            memmove(to, p->at, length);
            to += length, p->at += length;
        }
    }
    p->at++;
    *to = '\0';
    return put_value(p, FORMATS_JSON_STRING, begin, 0);
}

/* -------------------------------------------------------------- containers -- */

/* A value, or the beginning of a container. */
static froe_status read_value(parser *p) {
    static const char *const names[] = {"null", "true", "false"};
    skip_blanks(p);
    if (*p->at == '"') return read_string(p);
    if (*p->at == '-' || (*p->at >= '0' && *p->at <= '9')) return read_json_number(p);
    if (*p->at != '[' && *p->at != '{') {
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            size_t length = strlen(names[i]);
            if (strncmp(p->at, names[i], length) != 0) continue;
            p->at += length;
            return put_value(p, FORMATS_JSON_NAME, p->at - length, 0);
        }
        return expected(p, "a value");
    }
    froe_status status = put_value(p, *p->at == '[' ? FORMATS_JSON_ARRAY : FORMATS_JSON_OBJECT, p->at, 0);
    if (status) return status;
    p->values->data[p->values->count - 1].span = p->open;
    p->open = p->values->count;
    p->at++;
    return FROE_OK;
}

static froe_status read_key(parser *p) {
    formats_json *object = p->values->data + p->open - 1;
    skip_blanks(p);
    if (*p->at != '"') return expected(p, object->count ? "a string" : "a string or '}'");
    froe_status status = read_string(p);
    skip_blanks(p);
    if (!status && !take_byte(p, ':')) status = expected(p, "':'");
    return status;
}

/* Goes on behind a value, or behind the beginning of a container: closes what ends there. True: a value follows. */
static bool goes_on(parser *p, bool begun, froe_status *status) {
    while (p->open) {
        formats_json *container = p->values->data + p->open - 1;
        const char *close = container->kind == FORMATS_JSON_ARRAY ? "']'" : "'}'";
        container->count += !begun;
        skip_blanks(p);
        if (!take_byte(p, close[1])) {
            if (!begun && !take_byte(p, ',')) *status = expected(p, close);
            return !*status;
        }
        size_t outer = container->span;
        container->span = p->values->count - (p->open - 1);
        p->open = outer;
        begun = false;
    }
    return false;
}

froe_status formats_json_read(const froe_allocator *alloc, char *text, size_t length, formats_json_values *values,
                              formats_json_error *error) {
    parser p = {.alloc = alloc, .values = values, .at = text, .end = text + length, .line = 1, .error = error};
    froe_status status = FROE_OK;
    bool more = true;
    while (more && !status) {
        size_t outer = p.open;
        if (p.open && values->data[p.open - 1].kind == FORMATS_JSON_OBJECT) status = read_key(&p);
        if (!status) status = read_value(&p);
        if (!status) more = goes_on(&p, p.open != outer, &status);
    }
    skip_blanks(&p);
    return !status && p.at != p.end ? expected(&p, "the end of the file") : status;
}

const formats_json *formats_json_get(const formats_json *object, const char *name) {
    if (!formats_json_is(object, FORMATS_JSON_OBJECT)) return NULL;
    const formats_json *found = NULL, *member = object + 1;
    for (size_t i = 0; i < object->count; i++, member = formats_json_next(member + 1))
        if (!strcmp(member->text, name)) found = member + 1;
    return found;
}
