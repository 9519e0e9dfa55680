/* csv.c: points, boxes, balls, segments and hulls from comma-separated values, recognised by
 * their header line (RFC 4180, with commas, semicolons or tabs).
 *
 *     x,y,z       lo_x,lo_y,hi_x,hi_y       x,y,r       from_x,from_y,to_x,to_y       hull,x,y
 *
 * A hull has one row for each corner: rows one after the other with the same number are one hull. */
#include "formats/input/csv_header.h"
#include "formats/read/readers.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct csv_row {
    double corners[2 * FROE_MAX_DIM], radius; /* corner 1 directly behind corner 0 */
    uint64_t tag, hull;
    bool tagged;
} csv_row;

/** The hull whose rows are read. */
typedef struct csv_hull {
    uint64_t number, row, tag; /* row: its first */
    bool tagged;
    ARRAY(double) corners;
} csv_hull;

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
    const bool hull = role == FORMATS_CSV_HULL && t->kind == FROE_HULL;
    if (role != FORMATS_CSV_TAG && !hull) return FROE_OK;
    char *end;
    errno = 0;
    *(hull ? &r->hull : &r->tag) = strtoull(field, &end, 10);
    if (!hull) r->tagged = true;
    if (end == field || *end || errno || *field == '-')
        return formats_sink_fail(sink, FROE_E_FORMAT, "The %s '%.40s' is not a whole number below 2^64.",
                                 hull ? "hull" : "tag", field);
    return FROE_OK;
}

/* Ends the hull whose rows were read, if there is one. */
static froe_status end_hull(formats_sink *sink, csv_hull *hull) {
    if (!hull->corners.count) return FROE_OK;
    froe_status status = formats_sink_feature(sink, hull->row);
    sink->tagged = hull->tagged;
    sink->tag = hull->tag;
    if (!status) status = formats_sink_hull(sink, hull->corners.data, hull->corners.count / (size_t)sink->dim);
    hull->corners.count = 0;
    return status;
}

/* A row as a corner of the hull that it says. */
static froe_status take_corner(formats_sink *sink, const csv_row *r, uint64_t row, csv_hull *hull) {
    if (hull->corners.count && hull->number != r->hull) {
        const froe_status status = end_hull(sink, hull);
        if (status) return status;
    }
    if (!hull->corners.count) hull->number = r->hull, hull->row = row, hull->tag = r->tag, hull->tagged = r->tagged;
    return array_append(&sink->alloc, &hull->corners, r->corners, (size_t)sink->dim) ? FROE_OK
                                                                                     : support_fail_memory(sink->diag);
}

/* A row as the object that it says. */
static froe_status read_row(formats_sink *sink, const formats_csv_table *t, char **at, uint64_t row, csv_hull *hull) {
    csv_row r = {.tag = 0};
    bool last = false;
    int column = 0;
    froe_status status = t->kind == FROE_HULL ? FROE_OK : formats_sink_feature(sink, row);
    sink->number = row;
    while (!last && !status) {
        char *field = formats_csv_field(at, t->separator, &last);
        if (column < t->columns) status = read_field(sink, t, t->role[column], field, &r);
        ++column;
    }
    if (status) return status;
    if (column != t->columns)
        return formats_sink_fail(sink, FROE_E_FORMAT, "The row has %d columns, and the header %d.", column, t->columns);
    if (t->kind == FROE_HULL) return take_corner(sink, &r, row, hull);
    sink->tagged = r.tagged;
    sink->tag = r.tag;
    if (t->kind == FROE_SEGMENT) return formats_sink_segment(sink, r.corners, r.corners + t->dim);
    if (t->kind == FROE_BOX) return formats_sink_box(sink, r.corners, r.corners + t->dim);
    if (t->kind == FROE_BALL) return formats_sink_ball(sink, r.corners, r.radius);
    return formats_sink_point(sink, r.corners);
}

froe_status formats_read_csv(const formats_source *source, formats_sink *sink) {
    enum { ROWS_PER_REPORT = 4096 };
    formats_text text = {0};
    formats_csv_table t;
    csv_hull hull = {.number = 0};
    uint64_t row = 0;
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
            "%s: Columns of boxes are lo_ and hi_, of segments from_ and to_, of the same two or more axes, as in "
            "lo_x,lo_y,hi_x,hi_y.",
            name);
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
        status = read_row(sink, &t, &at, ++row, &hull);
        if (!status && row % ROWS_PER_REPORT == 0)
            status = formats_sink_progress(sink, (double)(at - text.data) / (double)text.count);
    }
    if (!status) status = end_hull(sink, &hull);
    array_free(&sink->alloc, &hull.corners);
    array_free(&sink->alloc, &text);
    return status;
}
