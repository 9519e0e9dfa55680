/* output.c: bytes collected to some kilobytes before the receiver is called. */
#include "output.h"
#include "support/escape.h"
#include "support/floats.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

froe_status vector_flush(vector_output *o) {
    const size_t count = o->filled;
    o->filled = 0;
    if (!o->status && count && !support_callback(o->fn(o->user, o->buffer, count))) o->status = FROE_E_IO;
    return o->status;
}

void vector_put(vector_output *o, const void *bytes, size_t count) {
    const char *at = bytes;
    o->count += count;
    while (count) {
        const size_t room = sizeof o->buffer - o->filled, part = count < room ? count : room;
        memcpy(o->buffer + o->filled, at, part);
        o->filled += part, at += part, count -= part;
        if (o->filled == sizeof o->buffer) vector_flush(o);
    }
}

void vector_print(vector_output *o, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    vector_put(o, text, (size_t)length);
}

void vector_put_escaped(vector_output *o, const char *text) {
    char out[8];
    for (size_t n; (n = support_xml_escape(&text, out));) vector_put(o, out, n);
}

void vector_put_json(vector_output *o, const char *text) {
    char out[8];
    for (size_t n; (n = support_json_escape(&text, out));) vector_put(o, out, n);
}

vector_digits vector_real(int digits, double x) {
    vector_digits out;
    size_t kept = 0;
    snprintf(out.text, sizeof out.text, "%.*g", digits, x);
    for (const char *at = out.text; *at; at++) { /* whatever parts the fraction, of one byte or more, becomes a point */
        const bool plain = strchr("+-0123456789e", *at) != NULL;
        if (plain || !kept || out.text[kept - 1] != '.') out.text[kept++] = plain ? *at : '.';
    }
    out.text[kept] = '\0';
    return out;
}

vector_digits vector_exact(double x) {
    char text[40];
    snprintf(text, sizeof text, "%.15g", x);
    return vector_real(strtod(text, NULL) == x ? 15 : 17, x);
}

void vector_put_exactly(vector_output *o, double x) {
    vector_print(o, "%s", vector_exact(x).text);
}
