/* csv.c: points, boxes and balls from comma-separated values, recognised by
 * their header line (RFC 4180, with commas, semicolons or tabs).
 *
 *     x,y,z          lo_x,lo_y,hi_x,hi_y          x,y,r
 */
#include "formats/input/csv_header.h"
#include "formats/read/readers.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct csv_row {
    double corners[2 * FROE_MAX_DIM], radius; /* corner 1 directly behind corner 0 */
    uint64_t tag;
    bool tagged;
} csv_row;

static froe_status read_csv_number(formats_sink *sink, const char *field, double *value) {
    char *end;
    *value = strtod(field, &end); /* correctly rounded, in the C locale of this thread */
    if (end != field && !*end) return FROE_OK;
    if (!*field) return formats_sink_fail(sink, FROE_E_FORMAT, "A coordinate is missing.");
    return formats_sink_fail(sink, FROE_E_FORMAT, "'%.40s' is not a number.", field);
}

static froe_status read_field(formats_sink *sink, const formats_csv_table *t, int role, const char *field, csv_row *r) {
    if (role == FORMATS_CSV_RADIUS && t->kind == FROE_BALL) return read_csv_number(sink, field, &r->radius);
    if (role < FORMATS_CSV_RADIUS) {
        int corner = role / FROE_MAX_DIM, axis = role % FROE_MAX_DIM;
        return read_csv_number(sink, field, &r->corners[corner * t->dim + axis]);
    }
    if (role != FORMATS_CSV_TAG) return FROE_OK;
    char *end;
    errno = 0;
    r->tag = strtoull(field, &end, 10);
    r->tagged = true;
    if (end == field || *end || errno || *field == '-')
        return formats_sink_fail(sink, FROE_E_FORMAT, "The tag '%.40s' is not a whole number below 2^64.", field);
    return FROE_OK;
}

/* A row as the object that it says. */
static froe_status read_row(formats_sink *sink, const formats_csv_table *t, char **at) {
    csv_row r = {.tag = 0};
    bool last = false;
    int column = 0;
    froe_status status = formats_sink_feature(sink, sink->report.features + 1);
    while (!last && !status) {
        char *field = formats_csv_field(at, t->separator, &last);
        if (column < t->columns) status = read_field(sink, t, t->role[column], field, &r);
        ++column;
    }
    if (status) return status;
    if (column != t->columns)
        return formats_sink_fail(sink, FROE_E_FORMAT, "The row has %d columns, and the header %d.", column, t->columns);
    sink->tagged = r.tagged;
    sink->tag = r.tag;
    if (t->kind == FROE_BOX) return formats_sink_box(sink, r.corners, r.corners + t->dim);
    if (t->kind == FROE_BALL) return formats_sink_ball(sink, r.corners, r.radius);
    return formats_sink_point(sink, r.corners);
}

froe_status formats_read_csv(const formats_source *source, formats_sink *sink) {
    enum { ROWS_PER_REPORT = 4096 };
    formats_text text = {0};
    formats_csv_table t;
    froe_status status = formats_load(source, sink, false, &text);
    char *at = text.data;
    const formats_csv_header what = status ? FORMATS_CSV_OURS : formats_csv_read_header(&at, &t);
    const char *name = support_short(source->path);
    if (what == FORMATS_CSV_BEYOND)
        status =
            support_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: The header has more than %d axes.", name, FROE_MAX_DIM);
    else if (what == FORMATS_CSV_HALVES)
        status = support_fail(
            sink->diag, FROE_E_FORMAT,
            "%s: Columns of boxes are lo_ and hi_ of the same two or more axes, as in lo_x,lo_y,hi_x,hi_y.", name);
    else if (what == FORMATS_CSV_OTHER)
        status = support_fail(sink->diag, FROE_E_IO, "%s: The file changed while it was read.", name);
    if (!status) status = formats_sink_open(sink, t.dim);
    sink->unit = "row";
    sink->report.layers = 1;
    if (!status)
        formats_report_format(sink, "float64", "CSV %ss", t.kind == FROE_BOX ? "boxe" : froe_kind_name(t.kind));
    while (!status && *at) {
        const char *word = at + strspn(at, " \t\r");
        if (*word == '\n' || !*word) { /* a blank line */
            at += strcspn(at, "\n");
            at += *at == '\n';
            continue;
        }
        status = read_row(sink, &t, &at);
        if (!status && sink->report.features % ROWS_PER_REPORT == 0)
            status = formats_sink_progress(sink, (double)(at - text.data) / (double)text.count);
    }
    array_free(&sink->alloc, &text);
    return status;
}
