/* writer.c: text files, numbers and quotes. */
#include "formats/write/writer.h"
#include "support/decimal/decimal.h"
#include "support/escape.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

froe_status formats_writer_open(formats_writer *w, const char *path, froe_diagnostic *diag) {
    if (!support_locale_enter(&w->locale)) return support_fail_memory(diag);
    froe_status status = support_writer_open(&w->out, path, NULL, diag);
    if (status) support_locale_leave(&w->locale);
    return status;
}

froe_status formats_writer_close(formats_writer *w, froe_status status) {
    support_locale_leave(&w->locale);
    return support_writer_close(&w->out, status);
}

/* ------------------------------------------------------------------ text -- */

void formats_put(formats_writer *w, const char *text) {
    support_writer_put(&w->out, text, strlen(text));
}

static void put_byte(formats_writer *w, char byte) {
    support_writer_put(&w->out, &byte, 1);
}

void formats_put_number(formats_writer *w, double value) {
    char text[SUPPORT_DECIMAL_ROOM + SUPPORT_DECIMAL_AHEAD] = "", *end;
    if (value == 0) value = 0;                               /* not -0 */
    size_t length = support_decimal_format(text, value, 15); /* 0.1 stays 0.1; what has more digits gets all 17 */
    if (support_decimal_ahead(text, &end) != value) length = support_decimal_format(text, value, 17);
    support_writer_put(&w->out, text, length);
}

void formats_put_whole(formats_writer *w, uint64_t value) {
    char text[24];
    support_writer_put(&w->out, text, support_decimal_whole(text, value));
}

void formats_put_point(formats_writer *w, const double *p, int dim, const char *separator) {
    for (int k = 0; k < dim; ++k) {
        if (k) formats_put(w, separator);
        formats_put_number(w, p[k]);
    }
}

void formats_put_json(formats_writer *w, const char *text) {
    char out[8];
    put_byte(w, '"');
    for (size_t n; (n = support_json_escape(&text, out));) support_writer_put(&w->out, out, n);
    put_byte(w, '"');
}

void formats_put_csv(formats_writer *w, const char *text) {
    if (!strpbrk(text, ",\"\r\n")) return formats_put(w, text);
    put_byte(w, '"');
    for (; *text; ++text) {
        if (*text == '"') put_byte(w, '"');
        put_byte(w, *text);
    }
    put_byte(w, '"');
}

void formats_put_word(formats_writer *w, const char *text) {
    for (; *text; ++text) put_byte(w, (unsigned char)*text <= ' ' || *text == 0x7f ? '_' : *text);
}
